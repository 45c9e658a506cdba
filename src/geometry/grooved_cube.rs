//! Grooved cube (Antifer block): a slightly tapered cube with a groove down the middle of each side.
//!
//! Assumed, over its height: 1.086 wide at the foot, 1.005 at the top, grooves of radius 0.12, the proportions usually
//! quoted for Antifer blocks (after Frens 2007, over the cube root of the volume there). They fit each other: the volume
//! is 1.003 H^3. A half-round groove is not the hollow of convex blocks; here it is a rectangular one of the same width
//! and section.

use std::f64::consts::PI;

use glam::DVec3;

use super::polyhedron::{Polyhedron, PolyhedronError};

/// Width at foot and top over the height [-].
const WIDTH: [f64; 2] = [1.086, 1.005];
/// Half of the width of a groove over the height [-].
const GROOVE: f64 = 0.12;
/// Depth of a rectangular groove with the section of a half-round one over the height [-].
const DEPTH: f64 = 0.25 * PI * GROOVE;

/// Convex blocks of a grooved cube of the given height [m] about the middle of its height: the kernel between the
/// grooves and the four corners beside them.
///
/// # Errors
/// If the dimensions leave nothing.
pub fn blocks(height_m: f64) -> Result<Vec<Polyhedron>, PolyhedronError> {
    let half = WIDTH.map(|w| 0.5 * w * height_m);
    let (groove, depth) = (GROOVE * height_m, DEPTH * height_m);
    let prism = |low: [[f64; 2]; 2], high: [[f64; 2]; 2]| {
        let level = |k: usize| {
            let z = (k as f64 - 0.5) * height_m;
            let ([x0, y0], [x1, y1]) = (low[k], high[k]);
            [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(|[x, y]| DVec3::new(x, y, z))
        };
        Polyhedron::between(&level(0), &level(1))
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
