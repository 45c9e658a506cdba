//! Pictures of transparent units with their crack faces.

use std::collections::BTreeMap;

use glam::DVec3;

use super::folder::FractureFolder;
use crate::output::OutputError;
use crate::report::raster::{Canvas, Colour, View, mixed};

/// Width and height of a picture [px], twice its size on the page.
pub const SIZE: [f64; 2] = [900.0, 660.0];
/// Viewing direction: from the front, slightly from the left and from above. The corner between the stem and the
/// upright fluke of a Dolos is then visible.
const AHEAD: DVec3 = DVec3::new(0.26, 0.86, -0.43);
/// Width of the margin divided by the size of the picture [-].
const MARGIN: f64 = 0.05;

/// Colour of the units: yellow, so that blue opening cracks are clearly visible.
pub const UNIT: Colour = [0.97, 0.83, 0.32];
/// Colour of new cracks that opened (mode I).
pub const OPENED: Colour = [0.05, 0.25, 0.75];
/// Colour of new cracks that slid (mode II).
pub const SLID: Colour = [0.85, 0.28, 0.05];
/// Colour of pre-existing cracks.
pub const OLD: Colour = [0.30, 0.62, 0.66];
const OTHERS: Colour = [0.80, 0.80, 0.79];
const PAPER: Colour = [1.0; 3];
const INK: Colour = [0.25, 0.20, 0.05];

/// Opacity of one front face of a unit [-].
const FACE_OPACITY: f32 = 0.26;
/// An edge is drawn if the cosine of the angle between the normals of its two faces is less than this value.
const SMOOTH: f64 = 0.94;

/// Returns the colour of a crack face; `mode` is the value in `cracks.vtkhdf` (0: pre-existing, 1: opening, 2:
/// sliding).
pub fn crack_colour(mode: i32) -> Colour {
    match mode {
        0 => OLD,
        2 => SLID,
        _ => OPENED,
    }
}

/// View and edges that all unit pictures of a run share.
pub struct UnitScene {
    /// Projection of the pictures.
    pub view: View,
    shown: Vec<usize>,
    /// Edges to draw: for each of the two adjacent faces, the index of the face and of the first corner of the edge (0
    /// to 2).
    edges: Vec<[(usize, usize); 2]>,
}

impl UnitScene {
    /// Creates the scene of a run, with all shown bodies in the view.
    pub fn new(run: &FractureFolder) -> Self {
        let mesh = &run.case.mesh;
        let shown = run.shown_bodies();
        let exteriors = &mesh.faces.exteriors;
        let corners =
            |face: usize| exteriors[face].nodes.map(|k| mesh.mesh.tets[exteriors[face].tet as usize][usize::from(k)]);
        let is_shown = |tet: usize| shown.iter().any(|body| run.case.setup.bodies[*body].tets.contains(&tet));
        let nodes = (0..exteriors.len()).filter(|face| is_shown(exteriors[*face].tet as usize)).flat_map(corners);
        let view = View::along(AHEAD, nodes.map(|node| mesh.mesh.nodes[node as usize]), SIZE, MARGIN);
        let normal = |face: usize| {
            let [a, b, c] = corners(face).map(|node| mesh.mesh.nodes[node as usize]);
            (b - a).cross(c - a).normalize_or_zero()
        };
        // For each edge: the adjacent faces, each with the index (0 to 2) of the first corner of the edge.
        let mut at_edge: BTreeMap<[u32; 2], Vec<(usize, usize)>> = BTreeMap::new();
        for face in 0..exteriors.len() {
            let nodes = corners(face);
            for k in 0..3 {
                let (a, b) = (nodes[k], nodes[(k + 1) % 3]);
                at_edge.entry([a.min(b), a.max(b)]).or_default().push((face, k));
            }
        }
        let sharp_edge = |faces: &Vec<(usize, usize)>| match faces.as_slice() {
            [a, b] if normal(a.0).dot(normal(b.0)) < SMOOTH => Some([*a, *b]),
            _ => None,
        };
        Self { view, edges: at_edge.values().filter_map(sharp_edge).collect(), shown }
    }

    /// Returns the picture of the units at a recorded time as a data URI.
    ///
    /// # Errors
    /// If the files cannot be read.
    pub fn picture(&self, run: &FractureFolder, frame: usize) -> Result<String, OutputError> {
        let Some([surfaces, cracks, _]) = &run.pictures else { return Ok(String::new()) };
        let (outside, body) = (surfaces.corners(frame)?, surfaces.of_triangles::<i32>(frame, "body")?);
        let is_unit = |face: usize| self.shown.contains(&(body[face] as usize));
        let (faces, modes) = (cracks.corners(frame)?, cracks.of_triangles::<i32>(frame, "mode")?);
        let project = |corners: &[DVec3; 3]| corners.map(|corner| self.view.project(corner));
        let normal = |[a, b, c]: &[DVec3; 3]| (*b - *a).cross(*c - *a);
        let lit = |colour: Colour, normal: DVec3| mixed([0.0; 3], colour, self.view.light(normal) as f32);

        // Bodies that are not shown transparently are drawn first, as the background.
        let mut canvas = Canvas::new(&self.view, PAPER);
        for (_, corners) in outside.iter().enumerate().filter(|(face, _)| !is_unit(*face)) {
            canvas.fill(project(corners), lit(OTHERS, normal(corners)));
        }
        self.draw_edges(&mut canvas, &outside, |face| !is_unit(face), [0.45; 3], 0.5);
        // The back faces of the units hide other bodies behind them.
        for (_, corners) in outside.iter().enumerate().filter(|(face, _)| is_unit(*face)) {
            if !self.view.faces(normal(corners)) {
                // A face in contact may lie slightly behind the surface of the other body, so it is drawn 3 px nearer.
                let nearer = project(corners).map(|[x, y, depth]| [x, y, depth - 3.0 / self.view.scale]);
                canvas.fill(nearer, mixed(PAPER, UNIT, 0.55));
            }
        }
        let behind = canvas.depth.clone();
        for (corners, mode) in faces.iter().zip(&modes) {
            let towards = normal(corners);
            let towards = if self.view.faces(towards) { towards } else { -towards };
            canvas.fill(project(corners), lit(crack_colour(*mode), towards));
        }
        // Every front face is a transparent layer over the objects behind it. The nearest front face gives the shade.
        let mut veil = vec![(0_i32, f64::INFINITY, PAPER); behind.len()];
        for (_, corners) in outside.iter().enumerate().filter(|(face, _)| is_unit(*face)) {
            let normal = normal(corners);
            if self.view.faces(normal) {
                let colour = lit(UNIT, normal);
                canvas.visit(project(corners), |sample, depth| {
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
                let clear = (1.0 - FACE_OPACITY).powi(layers) * if is_crack { 1.0 } else { 0.6 };
                canvas.colour[sample] = mixed(shade, canvas.colour[sample], clear);
                canvas.depth[sample] = nearest;
            }
        }
        self.draw_edges(&mut canvas, &outside, is_unit, INK, 0.75);
        Ok(canvas.data_uri())
    }

    /// Draws the visible sharp edges of the faces selected by `is_drawn`.
    fn draw_edges(
        &self,
        canvas: &mut Canvas,
        outside: &[[DVec3; 3]],
        is_drawn: impl Fn(usize) -> bool,
        ink: Colour,
        strength: f32,
    ) {
        // The depth tolerance is a few pixels, because an edge lies on its adjacent faces and these must not hide it.
        let hidden = 3.0 / self.view.scale;
        for [(face, k), _] in self.edges.iter().filter(|[(face, _), _]| is_drawn(*face)) {
            let Some(corners) = outside.get(*face) else { continue };
            let ends = [corners[*k], corners[(*k + 1) % 3]].map(|corner| self.view.project(corner));
            canvas.line(ends, 1.6, ink, strength, hidden);
        }
    }
}
