//! Units half transparent, with the crack faces in them.

use std::collections::BTreeMap;

use glam::DVec3;

use super::folder::FractureFolder;
use crate::output::OutputError;
use crate::report::raster::{Canvas, Colour, View, mixed};

/// Width and height of a picture [px], twice as fine as it is shown.
pub const SIZE: [f64; 2] = [900.0, 660.0];
/// From the front, a little from the left and above: the corner between stem and upright fluke is in sight.
const AHEAD: DVec3 = DVec3::new(0.26, 0.86, -0.43);
/// Margin of a picture, as a share of it.
const MARGIN: f64 = 0.05;

/// Colours of the paper's figures: units yellow, new cracks blue where they opened. Sliding and cracks from before the run
/// need colours of their own.
pub const UNIT: Colour = [0.97, 0.83, 0.32];
/// New crack, opened.
pub const OPENED: Colour = [0.05, 0.25, 0.75];
/// New crack, slid.
pub const SLID: Colour = [0.85, 0.28, 0.05];
/// Crack from before the run.
pub const OLD: Colour = [0.30, 0.62, 0.66];
const OTHERS: Colour = [0.80, 0.80, 0.79];
const PAPER: Colour = [1.0; 3];
const INK: Colour = [0.25, 0.20, 0.05];

/// What one face of a unit takes of the light from behind it.
const VEIL: f32 = 0.26;
/// Faces that meet at less than this angle are one to the eye: its cosine.
const SMOOTH: f64 = 0.94;

/// Colour of a crack face by its mode in the files.
pub fn crack_colour(mode: i32) -> Colour {
    match mode {
        0 => OLD,
        2 => SLID,
        _ => OPENED,
    }
}

/// What all pictures of a run share.
pub struct UnitScene {
    /// The view.
    pub view: View,
    shown: Vec<usize>,
    /// Edges to draw: faces with the corners of both sides.
    edges: Vec<[(usize, usize); 2]>,
}

impl UnitScene {
    /// The scene of a run.
    pub fn new(run: &FractureFolder) -> Self {
        let mesh = &run.case.mesh;
        let shown = run.shown_bodies();
        let exteriors = &mesh.faces.exteriors;
        let corners =
            |face: usize| exteriors[face].nodes.map(|k| mesh.mesh.tets[exteriors[face].tet as usize][usize::from(k)]);
        let of_shown = |tet: usize| shown.iter().any(|body| run.case.setup.bodies[*body].tets.contains(&tet));
        let nodes = (0..exteriors.len()).filter(|face| of_shown(exteriors[*face].tet as usize)).flat_map(corners);
        let view = View::along(AHEAD, nodes.map(|node| mesh.mesh.nodes[node as usize]), SIZE, MARGIN);
        let normal = |face: usize| {
            let [a, b, c] = corners(face).map(|node| mesh.mesh.nodes[node as usize]);
            (b - a).cross(c - a).normalize_or_zero()
        };
        // Faces at each edge, with the number of the edge's first corner in the face.
        let mut at_edge: BTreeMap<[u32; 2], Vec<(usize, usize)>> = BTreeMap::new();
        for face in 0..exteriors.len() {
            let nodes = corners(face);
            for k in 0..3 {
                let (a, b) = (nodes[k], nodes[(k + 1) % 3]);
                at_edge.entry([a.min(b), a.max(b)]).or_default().push((face, k));
            }
        }
        let sharp = |faces: &Vec<(usize, usize)>| match faces.as_slice() {
            [a, b] if normal(a.0).dot(normal(b.0)) < SMOOTH => Some([*a, *b]),
            _ => None,
        };
        Self { view, edges: at_edge.values().filter_map(sharp).collect(), shown }
    }

    /// The picture of a moment as the address of an image.
    ///
    /// # Errors
    /// If the files cannot be read.
    pub fn picture(&self, run: &FractureFolder, frame: usize) -> Result<String, OutputError> {
        let Some([surfaces, cracks, _]) = &run.pictures else { return Ok(String::new()) };
        let (outside, body) = (surfaces.triangles(frame)?, surfaces.values::<i32>(frame, "body")?);
        let is_unit = |face: usize| self.shown.contains(&(body[face] as usize));
        let (faces, modes) = (cracks.triangles(frame)?, cracks.values::<i32>(frame, "mode")?);
        let place = |corners: &[DVec3; 3]| corners.map(|corner| self.view.project(corner));
        let normal = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a);
        let lit = |colour: Colour, normal: DVec3| mixed([0.0; 3], colour, self.view.light(normal) as f32);

        // Behind everything: the other bodies.
        let mut canvas = Canvas::new(&self.view, PAPER);
        for (_, corners) in outside.iter().enumerate().filter(|(face, _)| !is_unit(*face)) {
            canvas.fill(place(corners), lit(OTHERS, normal(corners)));
        }
        self.draw_edges(&mut canvas, &outside, |face| !is_unit(face), [0.45; 3], 0.5);
        // The sides of the units that look away, which hide the others where these are further off.
        for (_, corners) in outside.iter().enumerate().filter(|(face, _)| is_unit(*face)) {
            if !self.view.faces(normal(corners)) {
                // A face that presses another body lies a hair behind its surface.
                let nearer = place(corners).map(|[x, y, depth]| [x, y, depth - 3.0 / self.view.scale]);
                canvas.fill(nearer, mixed(PAPER, UNIT, 0.55));
            }
        }
        let behind = canvas.depth.clone();
        for (corners, mode) in faces.iter().zip(&modes) {
            let towards = normal(corners);
            let towards = if self.view.faces(towards) { towards } else { -towards };
            canvas.fill(place(corners), lit(crack_colour(*mode), towards));
        }
        // Every side that looks this way is a veil over what it hides; the nearest one gives the shade.
        let mut veil = vec![(0_i32, f64::INFINITY, PAPER); behind.len()];
        for (_, corners) in outside.iter().enumerate().filter(|(face, _)| is_unit(*face)) {
            let normal = normal(corners);
            if self.view.faces(normal) {
                let colour = lit(UNIT, normal);
                canvas.visit(place(corners), |sample, depth| {
                    let of_sample = &mut veil[sample];
                    if depth <= canvas.depth[sample] {
                        of_sample.0 += 1;
                    }
                    if depth < of_sample.1 {
                        (of_sample.1, of_sample.2) = (depth, colour);
                    }
                });
            }
        }
        for (sample, (layers, nearest, shade)) in veil.into_iter().enumerate() {
            if layers > 0 {
                let is_crack = canvas.depth[sample] < behind[sample];
                let clear = (1.0 - VEIL).powi(layers) * if is_crack { 1.0 } else { 0.6 };
                canvas.colour[sample] = mixed(shade, canvas.colour[sample], clear);
                canvas.depth[sample] = nearest;
            }
        }
        self.draw_edges(&mut canvas, &outside, is_unit, INK, 0.75);
        Ok(canvas.data_uri())
    }

    /// Draws the sharp edges of some faces that are in sight.
    fn draw_edges(
        &self,
        canvas: &mut Canvas,
        outside: &[[DVec3; 3]],
        of: impl Fn(usize) -> bool,
        ink: Colour,
        strength: f32,
    ) {
        // A few pixels: a line lies on the faces that it bounds.
        let hidden = 3.0 / self.view.scale;
        for [(face, k), _] in self.edges.iter().filter(|[(face, _), _]| of(*face)) {
            let Some(corners) = outside.get(*face) else { continue };
            let ends = [corners[*k], corners[(*k + 1) % 3]].map(|corner| self.view.project(corner));
            canvas.line(ends, 1.6, ink, strength, hidden);
        }
    }
}
