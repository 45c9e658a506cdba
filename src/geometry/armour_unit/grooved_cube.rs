//! Grooved cube (Antifer block): a slightly tapered cube with a vertical groove in the middle of each side.
//!
//! Divided by the height, the width is 1.086 at the foot and 1.005 at the top, and the groove radius 0.12 (assumed).
//! These are the usual proportions of Antifer blocks (Frens 2007, who divides by the cube root of the volume). This
//! cube root practically equals the height H, because the volume is 1.003 H^3. Convex blocks cannot form a half-round
//! groove. A rectangular groove of the same width and sectional area replaces it.

use std::f64::consts::PI;

use glam::DVec3;

use crate::geometry::convex::polyhedron::{Polyhedron, PolyhedronError};

/// Width at foot and top, divided by the height [-].
const WIDTH: [f64; 2] = [1.086, 1.005];
/// Half of the width of a groove, divided by the height [-].
const GROOVE: f64 = 0.12;
/// Depth of a rectangular groove with the sectional area of a half-round groove, divided by the height [-].
const DEPTH: f64 = 0.25 * PI * GROOVE;

/// Convex blocks of a grooved cube of the given height [m], centred at mid-height: the core between the grooves and the
/// four corner blocks.
///
/// # Errors
/// If a block is flat.
pub fn blocks(height_m: f64) -> Result<Vec<Polyhedron>, PolyhedronError> {
    let half = WIDTH.map(|w| 0.5 * w * height_m);
    let (groove, depth) = (GROOVE * height_m, DEPTH * height_m);
    let prism = |low: [[f64; 2]; 2], high: [[f64; 2]; 2]| {
        let level = |k: usize| {
            let z = (k as f64 - 0.5) * height_m;
            let ([x0, y0], [x1, y1]) = (low[k], high[k]);
            [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(|[x, y]| DVec3::new(x, y, z))
        };
        Polyhedron::hull_of_polygons(&level(0), &level(1))
    };
    let inner = half.map(|h| h - depth);
    let mut blocks = vec![prism(inner.map(|h| [-h; 2]), inner.map(|h| [h; 2]))?];
    for [x, y] in [[1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0]] {
        let corner = |h: f64| [x * h, y * h];
        let (near, far) = ([corner(groove); 2], half.map(corner));
        blocks.push(prism(near, far)?);
    }
    Ok(blocks)
}
