//! Outline of solids that are the same across the flume: bed, walls and parts of a structure, in x and z.
//!
//! The outline consists of directed segments with the water on their left side. Vertical rays tell water from solid:
//! below a point in the water, an odd number of segments crosses the ray.

pub mod polygon;
pub mod segments;

use std::collections::HashMap;

use glam::DVec2;

use super::profile::Profile;
use polygon::Polygon;
use segments::{closed, crossing, distance, is_even, left_normal, nearest};

/// Points nearer than this to each other count as one point, divided by the largest coordinate [-]. A binary STL file
/// stores coordinates with 24 bits, to 6e-8 of their value.
const TOUCH: f64 = 1e-6;

/// Segments that rise or fall by more than a thousand times their run count as vertical [-].
const VERTICAL: f64 = 1e-3;

/// The outline of bed, walls and parts in x and z. Seen along a segment, the water lies on the left.
#[derive(Debug, Clone, PartialEq)]
pub struct Outline {
    segments: Vec<[DVec2; 2]>,
    /// Segments that meet at a corner, in their direction.
    corners: Vec<[usize; 2]>,
}

impl Outline {
    /// Creates the outline through `points` [m].
    pub fn new(points: &[DVec2]) -> Self {
        Self::of(points.windows(2).map(|pair| [pair[0], pair[1]]).collect())
    }

    /// Creates the outline of these segments [m].
    fn of(segments: Vec<[DVec2; 2]>) -> Self {
        // Adding zero changes -0 to +0. Otherwise two equal coordinates could have different bits.
        let key = |point: DVec2| (point + 0.0).to_array().map(f64::to_bits);
        let starts: HashMap<[u64; 2], usize> =
            segments.iter().enumerate().rev().map(|(index, [from, _])| (key(*from), index)).collect();
        let next = |(index, [_, to]): (usize, &[DVec2; 2])| Some([index, *starts.get(&key(*to))?]);
        let corners = segments.iter().enumerate().filter_map(next).collect();
        Self { segments, corners }
    }

    /// Returns start and end of each segment [m].
    pub fn segments(&self) -> &[[DVec2; 2]] {
        &self.segments
    }

    /// Returns the two segments before and behind each corner.
    pub fn corners(&self) -> impl Iterator<Item = [[DVec2; 2]; 2]> {
        self.corners.iter().map(|corner| corner.map(|index| self.segments[index]))
    }

    /// Returns the outline of the solid behind this outline and of a polygon together. Where both touch, there is no
    /// gap between them.
    pub fn with(&self, polygon: &Polygon) -> Self {
        let touch = self.touch();
        let snapped: Vec<DVec2> = polygon.points().iter().map(|point| self.snapped(*point, touch)).collect();
        let edges: Vec<[DVec2; 2]> = closed(&snapped).filter(|[from, to]| from != to).collect();
        let (mut cuts, mut edge_cuts) = (vec![Vec::new(); self.segments.len()], vec![Vec::new(); edges.len()]);
        for (segment, cuts) in self.segments.iter().zip(&mut cuts) {
            for (edge, edge_cuts) in edges.iter().zip(&mut edge_cuts) {
                cut(segment, edge, touch, cuts, edge_cuts);
            }
        }
        let pieces = |lines: &[[DVec2; 2]], cuts: Vec<Vec<DVec2>>| -> Vec<[DVec2; 2]> {
            lines.iter().zip(cuts).flat_map(|(line, cuts)| divided(*line, cuts)).collect()
        };
        let (own, others) = (pieces(&self.segments, cuts), pieces(&edges, edge_cuts));
        let is_outside = |piece: &&[DVec2; 2]| {
            let middle = 0.5 * (piece[0] + piece[1]);
            match edges.iter().find(|edge| distance(edge, middle) <= touch) {
                // Two faces that touch: water is on the same side of both, or on neither side.
                Some(edge) => (edge[1] - edge[0]).dot(piece[1] - piece[0]) > 0.0,
                None => is_even(edges.iter().copied(), middle),
            }
        };
        let ends = self.ends();
        let is_in_water = |piece: &&[DVec2; 2]| {
            let middle = 0.5 * (piece[0] + piece[1]);
            // The flume ends there; beyond, the solid continues.
            let is_at_end = ends.iter().any(|end| piece.iter().all(|point| (point.x - end).abs() <= touch));
            !is_at_end
                && !self.segments.iter().any(|segment| distance(segment, middle) <= touch)
                && !self.is_solid(middle)
        };
        let kept = own.iter().filter(is_outside).chain(others.iter().filter(is_in_water));
        Self::of(kept.copied().collect())
    }

    /// Returns the outline as a bed profile; `None` if it is not one line with increasing x, or has vertical segments.
    pub fn as_profile(&self) -> Option<Profile> {
        let mut segments = self.segments.clone();
        segments.sort_by(|a, b| a[0].x.total_cmp(&b[0].x));
        let is_line = segments.iter().all(|[from, to]| to.x - from.x > VERTICAL * (to.y - from.y).abs())
            && segments.windows(2).all(|pair| pair[0][1] == pair[1][0]);
        let last = segments.last()?[1];
        is_line.then(|| Profile::new(segments.iter().map(|[from, _]| *from).chain([last]).map(Into::into).collect()))
    }

    /// Returns true if a point is behind the outline. The bed continues downwards without end.
    pub fn is_solid(&self, point: DVec2) -> bool {
        is_even(self.segments.iter().copied(), point)
    }

    /// Returns the distance along a ray to the first segment that faces it, within about 25 degrees [m]; `None` if there
    /// is none within `reach` [m]. `direction` is a unit vector.
    pub fn facing(&self, from: DVec2, direction: DVec2, reach: f64) -> Option<f64> {
        // Faces that touch can be as far from each other as this.
        let nothing = 2.0 * self.touch();
        let hit = |[a, b]: &[DVec2; 2]| {
            let along = b - a;
            if along.normalize_or_zero().perp_dot(direction).abs() < 0.9 {
                return None;
            }
            let across = direction.perp_dot(along);
            let offset = a - from;
            let (way, share) = (offset.perp_dot(along) / across, offset.perp_dot(direction) / across);
            (way > nothing && way < reach && (0.0..=1.0).contains(&share)).then_some(way)
        };
        self.segments.iter().filter_map(hit).min_by(f64::total_cmp)
    }

    /// Returns the point of the outline nearest to `point`.
    pub fn nearest(&self, point: DVec2) -> DVec2 {
        let candidates = self.segments.iter().map(|segment| nearest(segment, point));
        candidates
            .min_by(|a, b| a.distance_squared(point).total_cmp(&b.distance_squared(point)))
            .expect("an outline has at least one segment")
    }

    /// Returns the unit normal, directed into the water, at the outline point nearest to `point`, and the distance to
    /// this point [m], negative behind the outline. Returns `None` if the distance is `max_distance` [m] or more.
    pub fn normal_within(&self, point: DVec2, max_distance: f64) -> Option<(DVec2, f64)> {
        let is_far = |segment: &[DVec2; 2]| {
            let normal = left_normal(segment);
            // True if the point lies in front of the line through this segment, further away than `max_distance`.
            (point - segment[0]).dot(normal) > max_distance
        };
        if self.segments.iter().all(is_far) {
            return None;
        }
        // Signed distance, distance from the line through the segment, and normal.
        let mut best: Option<(f64, f64, DVec2)> = None;
        for segment in &self.segments {
            let (offset, normal) = (point - nearest(segment, point), left_normal(segment));
            let side = offset.dot(normal);
            let signed = if side < 0.0 { -offset.length() } else { offset.length() };
            // If the nearest point is the corner of two segments, the first segment decides. At a sharp corner, it can
            // be seen from the wrong side; then the segment whose line is further away decides.
            let is_better = best.is_none_or(|(least, side_of_best, _)| {
                let nearer = f64::abs(least) - signed.abs();
                let is_seen_better = signed * least < 0.0 && side.abs() > f64::abs(side_of_best);
                nearer > 1e-12 || (nearer > -1e-12 && is_seen_better)
            });
            if is_better {
                best = Some((signed, side, normal));
            }
        }
        best.filter(|(signed, ..)| *signed < max_distance).map(|(signed, _, normal)| (normal, signed))
    }

    /// Returns the distance below which two points count as one point [m].
    pub fn touch(&self) -> f64 {
        TOUCH * self.segments.iter().flatten().map(|point| point.abs().max_element()).fold(0.0, f64::max)
    }

    /// Returns x of both ends of the outline [m].
    fn ends(&self) -> [f64; 2] {
        let x = || self.segments.iter().flatten().map(|point| point.x);
        [x().fold(f64::INFINITY, f64::min), x().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// Returns the corner of the outline that a point touches; the point itself if it touches none.
    fn snapped(&self, point: DVec2, touch: f64) -> DVec2 {
        self.segments.iter().flatten().copied().find(|at| at.distance(point) <= touch).unwrap_or(point)
    }
}

/// Adds the points at which two segments touch or cross to the cuts of both.
fn cut(one: &[DVec2; 2], other: &[DVec2; 2], touch: f64, cuts: &mut Vec<DVec2>, other_cuts: &mut Vec<DVec2>) {
    let on_other = one.map(|end| distance(other, end) <= touch);
    let on_one = other.map(|end| distance(one, end) <= touch);
    other_cuts.extend(one.iter().zip(on_other).filter(|(_, on)| *on).map(|(end, _)| *end));
    cuts.extend(other.iter().zip(on_one).filter(|(_, on)| *on).map(|(end, _)| *end));
    if on_other.into_iter().chain(on_one).any(|on| on) {
        return;
    }
    if let Some(point) = crossing(one, other) {
        cuts.push(point);
        other_cuts.push(point);
    }
}

/// Returns the pieces of a segment between its cuts.
fn divided([from, to]: [DVec2; 2], mut cuts: Vec<DVec2>) -> Vec<[DVec2; 2]> {
    cuts.retain(|cut| *cut != from && *cut != to);
    cuts.sort_by(|a, b| (a - from).dot(to - from).total_cmp(&(b - from).dot(to - from)));
    cuts.dedup();
    let starts = [from].into_iter().chain(cuts.iter().copied());
    starts.zip(cuts.iter().copied().chain([to])).map(|(a, b)| [a, b]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outline(points: &[[f64; 2]]) -> Outline {
        Outline::new(&points.iter().map(|point| DVec2::from_array(*point)).collect::<Vec<_>>())
    }

    fn polygon(points: &[[f64; 2]]) -> Polygon {
        Polygon::new(points).unwrap()
    }

    #[test]
    fn a_mound_on_the_bed_gives_the_profile_with_this_mound() {
        let bed = outline(&[[0.0, 0.0], [1.0, 0.0], [3.0, 0.2]]);
        let mound = [[0.4, 0.0], [0.6, 0.3], [0.8, 0.3], [1.0, 0.0]];
        let wanted = Profile::new(vec![[0.0, 0.0], [0.4, 0.0], [0.6, 0.3], [0.8, 0.3], [1.0, 0.0], [3.0, 0.2]]);
        assert_eq!(bed.with(&polygon(&mound)).as_profile(), Some(wanted));
        // A mound that begins below a sloping bed meets the bed where both lines cross.
        let berm = [[1.5, -1.0], [1.5, 0.1], [2.5, 0.1], [2.5, -1.0]];
        assert_eq!(bed.with(&polygon(&berm)).as_profile(), None);
        let crossing = [[0.5, -0.5], [2.0, 1.0], [3.5, -0.5]];
        let profile = bed.with(&polygon(&crossing)).as_profile().unwrap();
        assert_eq!(profile.points()[..2], [[0.0, 0.0], [1.0, 0.0]]);
        // Right flank z = 3 - x, bed z = 0.1 (x - 1): they meet at x = 3.1 / 1.1.
        assert!((profile.points()[3][0] - 3.1 / 1.1).abs() < 1e-12, "{profile:?}");
    }

    #[test]
    fn a_wall_on_a_mound_leaves_no_gap_and_no_hidden_face() {
        let mound = outline(&[[-1.0, 0.0], [0.0, 0.0], [1.0, 0.5], [2.0, 0.5], [3.0, 0.0], [4.0, 0.0]]);
        // A crown wall with a nose. Its foot lies 1e-8 m above the crest, as rounded coordinates of a file.
        let foot = 0.5 + 1e-8;
        let wall = [[1.5, foot], [1.5, 0.8], [1.4, 0.8], [1.4, 0.9], [1.7, 0.9], [1.7, foot]];
        let both = mound.with(&polygon(&wall));
        assert_eq!(both.segments().len(), both.corners().count() + 1);
        let length: f64 = both.segments().iter().map(|[a, b]| a.distance(*b)).sum();
        let wanted =
            mound.segments().iter().map(|[a, b]| a.distance(*b)).sum::<f64>() - 0.2 + 0.3 + 0.1 + 0.1 + 0.3 + 0.4;
        assert!((length - wanted).abs() < 1e-6, "{length} {wanted}");
        assert!(both.is_solid(DVec2::new(1.6, 0.7)) && !both.is_solid(DVec2::new(1.45, 0.7)));
        assert!(both.is_solid(DVec2::new(1.45, 0.85)) && both.is_solid(DVec2::new(1.45, 0.45)));
        assert_eq!(both.as_profile(), None);
        // Seen from inside the seaward face, the rear face is 0.2 m away.
        let thickness = both.facing(DVec2::new(1.5, 0.7), DVec2::X, 1.0).unwrap();
        assert!((thickness - 0.2).abs() < 1e-12);
    }

    #[test]
    fn a_floating_part_has_an_outline_of_its_own() {
        let bed = outline(&[[0.0, 1.0], [0.0, 0.0], [2.0, 0.0], [2.0, 1.0]]);
        let both = bed.with(&polygon(&[[0.5, 0.3], [1.0, 0.3], [1.0, 0.6], [0.5, 0.6]]));
        assert_eq!((both.segments().len(), both.corners().count()), (7, 6));
        let (normal, distance) = both.normal_within(DVec2::new(0.75, 0.25), 0.1).unwrap();
        assert!((normal + DVec2::Y).length() < 1e-12 && (distance - 0.05).abs() < 1e-12);
        // A part at the end wall joins this wall.
        let at_wall = bed.with(&polygon(&[[1.5, 0.0], [2.0, 0.0], [2.0, 0.4], [1.5, 0.4]]));
        let points = [[0.0, 1.0], [0.0, 0.0], [1.5, 0.0], [1.5, 0.4], [2.0, 0.4], [2.0, 1.0]];
        let mut segments = at_wall.segments().to_vec();
        segments.sort_by(|a, b| (a[0].x, -a[1].y).partial_cmp(&(b[0].x, -b[1].y)).unwrap());
        for segment in outline(&points).segments() {
            assert!(segments.contains(segment), "{segment} is missing in {segments:?}", segment = segment[0]);
        }
        assert_eq!(segments.len(), 5);
    }
}
