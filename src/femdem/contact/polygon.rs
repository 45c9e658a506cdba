//! Convex parts of a triangle: clipping by planes, and integrals.
//!
//! Points have the local coordinates (s, t) of the triangle: its corners are (0, 0), (1, 0) and (0, 1). Clipping:
//! Sutherland & Hodgman (1974), "Reentrant polygon clipping", CACM 17, 32-42. In this code, the two parts of a cut
//! share the new corners, and every other corner belongs to only one part. Rounding therefore never loses area or
//! counts area twice.

use std::ops::Sub;

use glam::DVec2;

/// Largest number of corners: a triangle has three, and each cut adds at most one. Four faces and three planes between
/// sub-tetrahedra can cut the triangle.
const CAPACITY: usize = 10;

/// A linear function on a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Linear {
    /// Value at the first corner.
    origin: f64,
    /// Values at the other two corners minus the value at the first corner.
    slope: DVec2,
}

impl Linear {
    /// Creates the linear function with the given values at the corners.
    pub fn with_values([a, b, c]: [f64; 3]) -> Self {
        Self { origin: a, slope: DVec2::new(b - a, c - a) }
    }

    /// Returns the value at a point.
    pub fn at(&self, point: DVec2) -> f64 {
        self.origin + self.slope.dot(point)
    }
}

impl Sub for Linear {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self { origin: self.origin - other.origin, slope: self.slope - other.slope }
    }
}

/// A convex part of a triangle. Its corners are in order around the polygon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polygon {
    corners: [DVec2; CAPACITY],
    count: usize,
}

/// Position of a polygon relative to a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Side {
    /// Entirely on the positive side, or in the plane.
    Positive,
    /// Entirely on the negative side.
    Negative,
    /// On both sides.
    Both(Cut),
}

/// Cut of a polygon by a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cut {
    /// Indices of the first and the last corner of the positive part.
    run: [usize; 2],
    /// Intersections of the plane with the edge before the first corner and with the edge after the last corner.
    ends: [DVec2; 2],
}

impl Polygon {
    /// Returns the whole triangle.
    pub fn triangle() -> Self {
        let mut polygon = Self::EMPTY;
        for corner in [DVec2::ZERO, DVec2::X, DVec2::Y] {
            polygon.push(corner);
        }
        polygon
    }

    const EMPTY: Self = Self { corners: [DVec2::ZERO; CAPACITY], count: 0 };

    /// Returns the corners in order, in the coordinates (s, t) of the triangle [-].
    pub fn corners(&self) -> &[DVec2] {
        &self.corners[..self.count]
    }

    fn push(&mut self, corner: DVec2) {
        self.corners[self.count] = corner;
        self.count += 1;
    }

    /// Returns the side of a plane on which the polygon lies. The plane is where the function `side` is zero.
    pub fn side(&self, side: Linear) -> Side {
        let mut sides = [0.0; CAPACITY];
        let (mut lowest, mut highest) = (f64::INFINITY, f64::NEG_INFINITY);
        let mut farthest = 0;
        for (i, corner) in self.corners().iter().enumerate() {
            sides[i] = side.at(*corner);
            lowest = if sides[i] < lowest { sides[i] } else { lowest };
            if sides[i] > highest {
                (highest, farthest) = (sides[i], i);
            }
        }
        if lowest >= 0.0 {
            return Side::Positive;
        }
        if highest <= 0.0 {
            return Side::Negative;
        }
        // The positive part is the sequence of positive corners around the corner `farthest`. Because of rounding, a
        // corner outside this sequence may also be positive. It stays in the negative part with its neighbours, so each
        // part gains at most one corner.
        let (mut first, mut last) = (farthest, farthest);
        while sides[self.before(first)] >= 0.0 {
            first = self.before(first);
        }
        while sides[self.after(last)] >= 0.0 {
            last = self.after(last);
        }
        let crossing = |inside: usize, outside: usize| {
            let share = sides[inside] / (sides[inside] - sides[outside]);
            self.corners[inside].lerp(self.corners[outside], share)
        };
        let ends = [crossing(first, self.before(first)), crossing(last, self.after(last))];
        Side::Both(Cut { run: [first, last], ends })
    }

    /// Returns the part on the positive side of a cut.
    pub fn positive_part(&self, cut: &Cut) -> Self {
        let [first, last] = cut.run;
        self.part([first, last], [cut.ends[1], cut.ends[0]])
    }

    /// Returns the part on the negative side of a cut.
    pub fn negative_part(&self, cut: &Cut) -> Self {
        let [first, last] = cut.run;
        self.part([self.after(last), self.before(first)], cut.ends)
    }

    /// Returns the polygon of the corners from `first` to `last` and the two corners `closing`.
    #[inline]
    fn part(&self, [first, last]: [usize; 2], closing: [DVec2; 2]) -> Self {
        let mut part = Self::EMPTY;
        let mut i = first;
        while i != last {
            part.push(self.corners[i]);
            i = self.after(i);
        }
        for corner in [self.corners[last], closing[0], closing[1]] {
            part.push(corner);
        }
        part
    }

    fn after(&self, i: usize) -> usize {
        if i + 1 == self.count { 0 } else { i + 1 }
    }

    fn before(&self, i: usize) -> usize {
        if i == 0 { self.count - 1 } else { i - 1 }
    }

    /// Returns the part in which all functions are positive, if there is one.
    pub fn clip(self, functions: &[Linear; 4]) -> Option<Self> {
        let mut inside = self;
        for side in functions {
            match inside.side(*side) {
                Side::Positive => {}
                Side::Negative => return None,
                Side::Both(cut) => inside = inside.positive_part(&cut),
            }
        }
        Some(inside)
    }

    /// Returns the integrals of a function, `weight`, over the polygon.
    pub fn integrate(&self, weight: Linear) -> Moments {
        let corners = self.corners();
        let (a, mut b) = (corners[0], corners[1]);
        let (w_a, mut w_b) = (weight.at(a), weight.at(b));
        let mut moments = Moments::default();
        for &c in &corners[2..] {
            let w_c = weight.at(c);
            let share = (b - a).perp_dot(c - a);
            let sum = w_a + w_b + w_c;
            moments.zeroth += share * sum;
            moments.first += share * (sum * (a + b + c) + w_a * a + w_b * b + w_c * c);
            (b, w_b) = (c, w_c);
        }
        // These formulas are exact on each triangle (a, b, c): the integrands are linear, or products of two linear
        // functions.
        Moments { zeroth: moments.zeroth / 3.0, first: moments.first / 12.0 }
    }
}

/// Integrals of a weight function over a polygon, divided by the area of the whole triangle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Moments {
    /// Integral of the weight [-].
    pub zeroth: f64,
    /// Integral of the weight times the coordinates (s, t) [-].
    pub first: DVec2,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::SplitMix64;

    fn random_linear(random: &mut SplitMix64) -> Linear {
        Linear::with_values([0; 3].map(|_| 2.0 * random.next_share() - 1.0))
    }

    #[test]
    fn integrals_over_a_triangle_have_their_textbook_values() {
        // The mean of a barycentric coordinate is 1/3. The mean of the product of two coordinates is 1/6 if both are
        // the same, else 1/12.
        let moments = Polygon::triangle().integrate(Linear::with_values([0.0, 1.0, 0.0]));
        assert!((moments.zeroth - 1.0 / 3.0).abs() < 1e-16);
        assert!((moments.first - DVec2::new(1.0 / 6.0, 1.0 / 12.0)).length() < 1e-16);
    }

    #[test]
    fn integrals_over_the_parts_add_up_to_the_whole() {
        let mut random = SplitMix64::new(1);
        let (mut cuts, mut most) = (0, 0);
        for _ in 0..20_000 {
            let weight = random_linear(&mut random);
            let whole = Polygon::triangle().integrate(weight);
            let mut parts = vec![Polygon::triangle()];
            for _ in 0..7 {
                let side = random_linear(&mut random);
                let cut = |part: &Polygon| match part.side(side) {
                    Side::Both(cut) => vec![part.positive_part(&cut), part.negative_part(&cut)],
                    Side::Positive | Side::Negative => vec![*part],
                };
                parts = parts.iter().flat_map(cut).collect();
            }
            cuts += parts.len() - 1;
            most = most.max(parts.iter().map(|part| part.corners().len()).max().unwrap());
            let mut sum = Moments::default();
            for part in parts.iter().map(|part| part.integrate(weight)) {
                sum.zeroth += part.zeroth;
                sum.first += part.first;
            }
            // Tolerance: rounding of the sum over all parts.
            assert!((sum.zeroth - whole.zeroth).abs() < 1e-14);
            assert!((sum.first - whole.first).length() < 1e-14);
        }
        assert!(cuts > 100_000 && most >= 6, "{cuts} {most}");
    }

    #[test]
    fn a_polygon_in_the_plane_lies_on_one_side_only() {
        let triangle = Polygon::triangle();
        assert_eq!(triangle.side(Linear::with_values([0.0; 3])), Side::Positive);
        assert_eq!(triangle.side(Linear::with_values([0.0, -1.0, 0.0])), Side::Negative);
    }

    #[test]
    fn clipping_keeps_the_part_where_all_functions_are_positive() {
        let side = |a, b, c| Linear::with_values([a, b, c]);
        // The square 1/4 < s, t < 1/2 has 1/8 of the area of the triangle s + t < 1.
        let square = [side(-0.25, 0.75, -0.25), side(0.5, -0.5, 0.5), side(-0.25, -0.25, 0.75), side(0.5, 0.5, -0.5)];
        let inside = Polygon::triangle().clip(&square).unwrap();
        let one = Linear::with_values([1.0; 3]);
        assert!((inside.integrate(one).zeroth - 0.125).abs() < 1e-15);
        assert!(Polygon::triangle().clip(&[side(-1.0, -0.5, 0.0); 4]).is_none());
    }
}
