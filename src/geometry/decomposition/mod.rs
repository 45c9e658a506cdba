//! Division of a body into convex parts by plane cuts, and the volume error of the parts.
//!
//! The concavity of a piece is the volume of its convex hull minus its own volume. The piece with the largest concavity
//! is cut by the plane that reduces the total concavity most, until the total is small. This is the method of Wei et
//! al. (2022) with a volume as the measure and without look-ahead. Cuts along reflex edges divide a body with plane
//! faces exactly (Chazelle 1984). At the end, pieces are merged if their common hull is nearly filled.

mod coarse;
mod convex_hull;
mod hull;
mod measure;
mod piece;
mod planes;
mod section;

use glam::DVec3;
use rayon::prelude::*;

use self::hull::Hull;
pub use self::hull::MOST_CORNERS;
use self::piece::Piece;
use super::convex::{half_space::HalfSpace, polyhedron::Polyhedron};
use super::solid::Solid;

/// Largest number of parts. The search for contacts allows no more.
pub const MOST_PARTS: usize = 63;
/// Total error at which no further cut is made, divided by the volume of the body [-].
const CUT_UNTIL: f64 = 0.01;
/// Total error up to which pieces are merged, divided by the volume of the body [-].
const MERGE_UNTIL: f64 = 0.015;
/// Weight of the volume of a piece that is too thin, in the choice of a cut. Later cuts can reduce a concavity, but a
/// piece that is too thin stays an error.
const WEIGHT_OF_THIN: f64 = 4.0;
/// Relative change of the error or of the reflex edges below which a cut changes nothing. The value allows for the
/// tolerances of the cut and of the hull.
const NO_CHANGE: f64 = 1e-4;
/// The search looks for parts that are thicker by this factor than necessary, because a part differs slightly from the
/// hull of its pieces.
const MARGIN: f64 = 1.02;

/// Convex parts of a body and their volume error.
#[derive(Debug, Clone)]
pub struct Decomposition {
    /// Convex parts [m].
    pub parts: Vec<Polyhedron>,
    /// Volume of the symmetric difference of body and parts, divided by the volume of the body [-].
    pub volume_error: f64,
}

/// Measures the volume error of the parts.
pub fn measure(solid: &Solid, parts: Vec<Polyhedron>) -> Decomposition {
    let volume_error = measure::volume_error(solid, &parts);
    Decomposition { parts, volume_error }
}

/// Divides a body into at most [`MOST_PARTS`] convex parts with at most [`MOST_CORNERS`] corners each. A ball of the
/// radius `thinnest` [m] fits into every part; thinner pieces are left out, and their volume counts as error.
pub fn decompose(solid: &Solid, thinnest: f64) -> Decomposition {
    let [low, high] = solid.bounds();
    let (middle, size) = (0.5 * (low + high), 0.5 * (high - low).max_element());
    let vertices: Vec<DVec3> = solid.vertices().iter().map(|v| (*v - middle) / size).collect();
    let volume = solid.volume_properties().volume / size.powi(3);
    let search = Search { thinnest: MARGIN * thinnest / size };
    let whole = search.part(&vertices, volume);
    let parts = if whole.error <= CUT_UNTIL * volume {
        vec![whole]
    } else {
        let (vertices, triangles) = coarse::coarsened(vertices, solid.triangles());
        let pieces = search.cut(Piece::new(vertices, &triangles), CUT_UNTIL * volume);
        search.merged(pieces, MERGE_UNTIL * volume)
    };
    let polyhedron = |part: &Part| part.hull.as_ref()?.polyhedron(size, middle);
    let parts = parts.iter().filter_map(polyhedron).filter(|part| part.inner_radius() >= thinnest).collect();
    measure(solid, parts)
}

/// A piece of the body, or several merged pieces. Lengths are relative to half the longest edge of the bounding box of
/// the body.
#[derive(Debug, Clone)]
struct Part {
    volume: f64,
    /// Corners of the convex hull.
    corners: Vec<DVec3>,
    /// Convex hull; `None` if it is too thin.
    hull: Option<Hull>,
    /// Volume error if the hull replaces the pieces, or if the part is left out because it is too thin.
    error: f64,
}

/// Search for convex parts.
struct Search {
    /// Smallest radius of a ball that fits into every part.
    thinnest: f64,
}

impl Search {
    fn part(&self, points: &[DVec3], volume: f64) -> Part {
        let hull = Hull::new(points);
        let corners = hull.as_ref().map_or_else(|| points.to_vec(), |hull| hull.corners().to_vec());
        let hull = hull.filter(|hull| hull.has_room_for(self.thinnest));
        let error = hull.as_ref().map_or(volume, |hull| (hull.volume() - volume).max(0.0));
        Part { volume, corners, hull, error }
    }

    /// Cuts the body until the total error is below the limit, or no cut helps.
    fn cut(&self, body: Piece, limit: f64) -> Vec<Part> {
        let part = |piece: Piece| {
            let part = self.part(piece.vertices(), piece.volume());
            (piece, part)
        };
        let mut open = vec![part(body)];
        let mut done: Vec<Part> = Vec::new();
        loop {
            let total: f64 = done.iter().chain(open.iter().map(|(_, part)| part)).map(|part| part.error).sum();
            if total <= limit || open.len() + done.len() >= MOST_PARTS {
                break;
            }
            // No cut helps a piece that is too thin. Small errors of all parts together stay below the limit.
            let needs_cut = |part: &Part| part.hull.is_some() && part.error > limit / MOST_PARTS as f64;
            let worst = (0..open.len())
                .filter(|index| needs_cut(&open[*index].1))
                .max_by(|a, b| open[*a].1.error.total_cmp(&open[*b].1.error));
            let Some((piece, whole)) = worst.map(|index| open.swap_remove(index)) else { break };
            match self.best_cut(&piece, whole.error) {
                Some(pieces) => open.extend(pieces.into_iter().map(part)),
                None => done.push(whole),
            }
        }
        done.extend(open.into_iter().map(|(_, part)| part));
        done
    }

    /// Pieces of the best cut; `None` if no cut helps. A cut through a ring does not reduce the error, but the next cut
    /// does. In such a case, the best cut removes the most reflex edges.
    fn best_cut(&self, piece: &Piece, error: f64) -> Option<Vec<Piece>> {
        let weighted = |piece: &Piece| {
            let part = self.part(piece.vertices(), piece.volume());
            if part.hull.is_some() { part.error } else { WEIGHT_OF_THIN * part.error }
        };
        let cut = |plane: &HalfSpace| {
            let pieces = piece.cut(plane);
            (pieces.iter().map(weighted).sum::<f64>(), pieces)
        };
        let mut cuts: Vec<(f64, Vec<Piece>)> = planes::candidates(piece).par_iter().map(cut).collect();
        cuts.retain(|(left, pieces)| pieces.len() > 1 && *left <= error * (1.0 + NO_CHANGE));
        if !cuts.iter().any(|(left, _)| *left < error * (1.0 - NO_CHANGE)) {
            let before = planes::reflex_weight(piece);
            let left = cuts.into_par_iter().map(|(_, pieces)| (pieces.iter().map(planes::reflex_weight).sum(), pieces));
            cuts = left.filter(|(left, _)| *left < before * (1.0 - NO_CHANGE)).collect();
        }
        cuts.into_iter().min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, pieces)| pieces)
    }

    /// Merges the two parts whose merger increases the error least, as long as there are too many parts, or the total
    /// error stays below the limit or does not increase.
    fn merged(&self, mut parts: Vec<Part>, limit: f64) -> Vec<Part> {
        let merge = |a: &Part, b: &Part| self.part(&[&a.corners[..], &b.corners[..]].concat(), a.volume + b.volume);
        let mut left: Vec<usize> = (0..parts.len()).collect();
        let mut pairs: Vec<(usize, usize, Part)> = Vec::new();
        for i in 0..parts.len() {
            pairs.extend((0..i).map(|j| (i, j, merge(&parts[i], &parts[j]))));
        }
        loop {
            let total: f64 = left.iter().map(|index| parts[*index].error).sum();
            let increase = |pair: &(usize, usize, Part)| pair.2.error - parts[pair.0].error - parts[pair.1].error;
            let best = (0..pairs.len()).min_by(|a, b| increase(&pairs[*a]).total_cmp(&increase(&pairs[*b])));
            let is_allowed =
                |index: &usize| left.len() > MOST_PARTS || total + increase(&pairs[*index]) <= limit.max(total);
            let Some(best) = best.filter(is_allowed) else { break };
            let (i, j, both) = pairs.swap_remove(best);
            left.retain(|index| *index != i && *index != j);
            pairs.retain(|(a, b, _)| ![i, j].contains(a) && ![i, j].contains(b));
            pairs.extend(left.iter().map(|index| (parts.len(), *index, merge(&both, &parts[*index]))));
            left.push(parts.len());
            parts.push(both);
        }
        left.into_iter().map(|index| parts[index].clone()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::armour_unit::{ArmourUnit, cuboid, dolos};

    #[test]
    fn convex_body_is_a_single_part() {
        let (vertices, triangles) = cuboid::surface(DVec3::new(1.0, 2.0, 3.0));
        let found = decompose(&Solid::new(vertices, triangles).unwrap(), 0.1);
        // Limit 1e-9: rounding errors.
        assert!(found.parts.len() == 1 && found.volume_error < 1e-9, "{found:?}");
        assert_eq!(found.parts[0].corners().len(), 8);
    }

    #[test]
    fn exact_parts_have_no_volume_error() {
        let unit = ArmourUnit::dolos(1.0, 0.36, 0.03).unwrap();
        let blocks = dolos::blocks(1.0, 0.36).unwrap();
        // The surface is the union of these parts. Limit 1e-9: rounding errors.
        assert!(measure(unit.solid(), blocks.clone()).volume_error < 1e-9);
        let [all, missing] = [&blocks[..], &blocks[..1]].map(|part| part.iter().map(Polyhedron::volume).sum::<f64>());
        let found = measure(unit.solid(), blocks[1..].to_vec()).volume_error;
        // The first block overlaps others, so its share of the total volume is only an upper bound.
        assert!(found > 0.1 && found < missing / (all - missing), "{found}");
    }

    #[test]
    fn no_part_is_thinner_than_required() {
        // A plate of 0.04 m at the side of a cube is too thin for a ball with a radius of 0.05 m.
        let corners = |low: [f64; 3], high: [f64; 3]| {
            let corner = |n: usize| DVec3::from_array(std::array::from_fn(|k| [low[k], high[k]][n >> k & 1]));
            Polyhedron::hull(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
        };
        let blocks = [corners([0.0; 3], [1.0; 3]), corners([1.0, 0.0, 0.0], [1.5, 1.0, 0.04])];
        let (vertices, triangles) = crate::geometry::convex::union::surface(&blocks);
        let found = decompose(&Solid::new(vertices, triangles).unwrap(), 0.05);
        assert!(!found.parts.is_empty() && found.parts.iter().all(|part| part.inner_radius() >= 0.05));
        // The plate has 2 % of the volume. The search stops at an error of 1.5 %.
        assert!(found.volume_error < 0.035, "{}", found.volume_error);
    }

    #[test]
    fn parts_do_not_depend_on_the_number_of_threads() {
        let unit = ArmourUnit::dolos(1.0, 0.34, 0.03).unwrap();
        let parts = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| decompose(unit.solid(), 0.05)).parts
        };
        assert_eq!(parts(1), parts(3));
    }
}
