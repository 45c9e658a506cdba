//! Cubic interpolation on unevenly spaced points; linear or constant next to dry points.

use std::ops::Range;

/// Interpolation stencil: first index, weights and number of points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stencil {
    first: usize,
    weights: [f64; 4],
    points: usize,
}

impl Stencil {
    /// Creates the stencil for `x` among the increasing `xs`. `usable(index)` is false for points to leave out, such as
    /// dry cells. The stencil is a cubic through four points. It is a straight line through two points if one of the
    /// outer points is missing or not usable. It is a single point if a point next to x is not usable or x is outside
    /// the range.
    pub(super) fn at(xs: &[f64], x: f64, usable: impl Fn(usize) -> bool) -> Self {
        let last = xs.len() - 1;
        let single = |first| Self { first, weights: [1.0, 0.0, 0.0, 0.0], points: 1 };
        if x <= xs[0] {
            return single(0);
        }
        if x >= xs[last] {
            return single(last);
        }
        let left = xs.partition_point(|&p| p <= x) - 1;
        let share = (x - xs[left]) / (xs[left + 1] - xs[left]);
        if !(usable(left) && usable(left + 1)) {
            let use_left = if usable(left) == usable(left + 1) { share < 0.5 } else { usable(left) };
            return single(if use_left { left } else { left + 1 });
        }
        if left == 0 || left + 2 > last || !usable(left - 1) || !usable(left + 2) {
            return Self { first: left, weights: [1.0 - share, share, 0.0, 0.0], points: 2 };
        }
        let nodes = &xs[left - 1..left + 3];
        let mut weights = [1.0; 4];
        for (i, weight) in weights.iter_mut().enumerate() {
            for (j, node) in nodes.iter().enumerate() {
                if i != j {
                    *weight *= (x - node) / (nodes[i] - node);
                }
            }
        }
        Self { first: left - 1, weights, points: 4 }
    }

    /// Index of the first point. If this point is not usable, no point of the stencil is usable.
    pub(super) fn point(&self) -> usize {
        self.first
    }

    /// Indices of all points of the stencil.
    pub(super) fn points(&self) -> Range<usize> {
        self.first..self.first + self.points
    }

    /// Sum of `value(index)` over the points of the stencil, multiplied by their weights.
    pub(super) fn apply(&self, value: impl Fn(usize) -> f64) -> f64 {
        (0..self.points).map(|i| self.weights[i] * value(self.first + i)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stencil_reproduces_cubics_and_leaves_out_dry_points() {
        let xs = [0.0, 1.0, 2.5, 3.0, 4.0];
        let f = |x: f64| 1.0 + x - 2.0 * x * x + 0.5 * x.powi(3);
        let interpolated = Stencil::at(&xs, 2.7, |_| true).apply(|i| f(xs[i]));
        assert!((interpolated - f(2.7)).abs() < 1e-12);
        assert_eq!(Stencil::at(&xs, 2.7, |i| i != 4).apply(|i| xs[i]), 2.7);
        assert_eq!(Stencil::at(&xs, 2.7, |i| i < 3).apply(|i| xs[i]), 2.5);
        assert_eq!(Stencil::at(&xs, -1.0, |_| true).apply(|i| xs[i]), 0.0);
        assert_eq!(Stencil::at(&xs, 9.0, |_| true).apply(|i| xs[i]), 4.0);
    }
}
