//! Pictures of the first principal stress in the section plane.

use glam::DVec3;

use super::folder::FractureFolder;
use super::unit_picture::SIZE;
use crate::case::Plane;
use crate::output::OutputError;
use crate::report::plot::{Axis, short};
use crate::report::raster::{Canvas, Colour, View, mixed};

const PAPER: Colour = [1.0; 3];
const INK: Colour = [0.1; 3];
/// Width of the margin divided by the size of the picture [-].
const MARGIN: f64 = 0.05;
/// Colours from compression (blue) over zero (grey) to tension (red); colour-blind readers can distinguish them.
pub const SCALE: [Colour; 7] = [
    [0.13, 0.26, 0.52],
    [0.32, 0.54, 0.76],
    [0.68, 0.80, 0.90],
    [0.95, 0.95, 0.94],
    [0.97, 0.78, 0.65],
    [0.88, 0.42, 0.33],
    [0.60, 0.06, 0.14],
];
/// Number of colours in the legend.
const STEPS: usize = 40;

/// View and colour scale that all stress pictures of a run share.
pub struct StressScene {
    view: View,
    shown: Vec<usize>,
    /// Largest tensile strength of the bodies; zero if no body can crack [Pa].
    strength: f64,
    /// Stress at the upper end of the colour scale [Pa]; the lower end is the negative value.
    top: f64,
}

impl StressScene {
    /// Creates the scene of a run, with all shown bodies in the view. The colour scale ends at twice the tensile
    /// strength: cracks open only along element faces, so the stress exceeds the strength where no element face is
    /// normal to this stress. If no body has a strength, the scale ends at the largest stress at the recorded times
    /// `frames`.
    ///
    /// # Errors
    /// If the files cannot be read.
    pub fn new(run: &FractureFolder, frames: &[usize]) -> Result<Self, OutputError> {
        let shown = run.shown_bodies();
        let mesh = &run.case.mesh.mesh;
        let tets = shown.iter().flat_map(|body| mesh.bodies[*body].tets.clone());
        let places = tets.flat_map(|tet| mesh.corners(tet));
        let view = View::along(run.case.section.normal, places, SIZE, MARGIN);
        let strengths = run.case.setup.bodies.iter().filter_map(|body| body.cohesion).map(|c| c.strength.tensile);
        let strength = strengths.fold(0.0, f64::max);
        let mut top = 2.0 * strength;
        if let (true, Some([_, _, section])) = (top == 0.0, &run.pictures) {
            for frame in frames {
                let stresses = section.of_triangles::<f32>(*frame, "sigma_1")?;
                top = stresses.iter().fold(top, |top, sigma| top.max(f64::from(sigma.abs())));
            }
        }
        Ok(Self { view, shown, strength, top: if top > 0.0 { top } else { 1.0 } })
    }

    /// Returns the stress picture at a recorded time as a data URI.
    ///
    /// # Errors
    /// If the files cannot be read.
    pub fn picture(&self, run: &FractureFolder, frame: usize) -> Result<String, OutputError> {
        let Some([surfaces, cracks, section]) = &run.pictures else { return Ok(String::new()) };
        let (cut, sigma) = (section.corners(frame)?, section.of_triangles::<f32>(frame, "sigma_1")?);
        let cut_body = section.of_triangles::<i32>(frame, "body")?;
        let project_flat = |corner: DVec3| {
            let [x, y, _] = self.view.project(corner);
            [x, y, 0.0]
        };
        let mut canvas = Canvas::new(&self.view, PAPER);
        for (corners, sigma) in cut.iter().zip(&sigma) {
            canvas.fill(corners.map(project_flat), self.colour(f64::from(*sigma)));
        }
        let (outside, of_body) = (surfaces.corners(frame)?, surfaces.of_triangles::<i32>(frame, "body")?);
        let (faces, crack_body) = (cracks.corners(frame)?, cracks.of_triangles::<i32>(frame, "body")?);
        for body in 0..run.case.setup.bodies.len() {
            let cut_triangles = cut.iter().zip(&cut_body).filter(|(_, number)| **number == body as i32).map(|(c, _)| c);
            let Some(plane) = plane_of(cut_triangles) else { continue };
            let strength = if self.shown.contains(&body) { 0.9 } else { 0.45 };
            let mut trace = |triangles: &[[DVec3; 3]], bodies: &[i32], width: f64, strength: f32| {
                for (corners, _) in triangles.iter().zip(bodies).filter(|(_, number)| **number == body as i32) {
                    if let Some(ends) = crossing(&plane, corners) {
                        canvas.line(ends.map(project_flat), width, INK, strength, f64::INFINITY);
                    }
                }
            };
            trace(&outside, &of_body, 1.6, strength);
            trace(&faces, &crack_body, 4.5, 1.0);
        }
        Ok(canvas.data_uri())
    }

    fn colour(&self, sigma: f64) -> Colour {
        let at = (0.5 + 0.5 * sigma / self.top).clamp(0.0, 1.0) * (SCALE.len() - 1) as f64;
        let low = (at as usize).min(SCALE.len() - 2);
        mixed(SCALE[low], SCALE[low + 1], (at - low as f64) as f32)
    }

    /// Returns the legend as SVG: the colours and their stresses [MPa].
    pub fn legend(&self) -> String {
        let (left, width) = (10.0, 420.0);
        let mut svg = String::from(
            "<svg class=\"scale\" viewBox=\"0 0 450 58\" role=\"img\" aria-label=\"Stress scale\">\
             <text class=\"label\" x=\"10\" y=\"12\">first principal stress \u{3c3}\u{2081} [MPa], tension positive</text>",
        );
        let step = width / STEPS as f64;
        for k in 0..STEPS {
            let colour = self.colour(((k as f64 + 0.5) / STEPS as f64 * 2.0 - 1.0) * self.top);
            let x = left + step * k as f64;
            svg += &format!(
                "<rect x=\"{x:.1}\" y=\"19\" width=\"{:.1}\" height=\"12\" fill=\"{}\"/>",
                step + 0.3,
                css(colour)
            );
        }
        let ends = [-self.top * 1e-6, self.top * 1e-6];
        let axis = Axis::tight("", ends, 10);
        for tick in axis.ticks() {
            let x = left + width * axis.share(tick);
            svg += &format!("<text class=\"tick mid\" x=\"{x:.1}\" y=\"46\">{}</text>", axis.number(tick));
        }
        if self.strength > 0.0 {
            let x = left + width * axis.share(self.strength * 1e-6);
            svg += &format!("<path d=\"M{x:.1} 15V35\" stroke=\"currentColor\" stroke-width=\"2\"/>");
        }
        svg + "</svg>\n"
    }

    /// Explains the mark on the stress scale, or the end of the scale if there is no mark.
    pub fn scale_in_words(&self) -> String {
        let megapascals = |stress: f64| short(stress * 1e-6, 2);
        if self.strength > 0.0 {
            format!("The mark on the stress scale is the tensile strength, {} MPa.", megapascals(self.strength))
        } else {
            format!("The stress scale ends at the largest stress shown, {} MPa.", megapascals(self.top))
        }
    }
}

/// Formats a colour for CSS.
pub fn css(colour: Colour) -> String {
    let [r, g, b] = colour.map(|part| (part * 255.0).round() as u8);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Returns the current section plane of a body from its triangles in this plane, which moves with the body.
fn plane_of<'a>(triangles: impl Iterator<Item = &'a [DVec3; 3]>) -> Option<Plane> {
    let (mut normal, mut weight, mut moment) = (DVec3::ZERO, 0.0, DVec3::ZERO);
    for [a, b, c] in triangles {
        let of_triangle = (*b - *a).cross(*c - *a);
        normal += of_triangle;
        weight += of_triangle.length();
        moment += (*a + *b + *c) * (of_triangle.length() / 3.0);
    }
    (weight > 0.0).then(|| Plane { point: moment / weight, normal: normal.normalize_or(DVec3::Y) })
}

/// Returns the ends of the line in which a triangle and a plane intersect; `None` if they do not intersect.
fn crossing(plane: &Plane, corners: &[DVec3; 3]) -> Option<[DVec3; 2]> {
    let height = corners.map(|corner| plane.height(corner));
    let mut ends = (0..3)
        .map(|k| (k, (k + 1) % 3))
        .filter(|(a, b)| (height[*a] >= 0.0) != (height[*b] >= 0.0))
        .map(|(a, b)| corners[a].lerp(corners[b], height[a] / (height[a] - height[b])));
    Some([ends.next()?, ends.next()?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_intersects_a_plane_in_a_line() {
        let plane = Plane { point: DVec3::new(0.0, 0.5, 0.0), normal: DVec3::Y };
        let corners = [DVec3::ZERO, DVec3::new(2.0, 1.0, 0.0), DVec3::new(0.0, 1.0, 2.0)];
        assert_eq!(crossing(&plane, &corners), Some([DVec3::new(1.0, 0.5, 0.0), DVec3::new(0.0, 0.5, 1.0)]));
        assert_eq!(crossing(&plane, &corners.map(|corner| corner - DVec3::Y)), None);
    }

    #[test]
    fn the_section_plane_follows_a_rotated_body() {
        let turn = glam::DQuat::from_axis_angle(DVec3::X, 0.1);
        let square = [[DVec3::ZERO, DVec3::Z, DVec3::X], [DVec3::X, DVec3::Z, DVec3::X + DVec3::Z]];
        let turned = square.map(|triangle| triangle.map(|corner| turn * corner));
        let plane = plane_of(turned.iter()).unwrap();
        assert!((plane.normal - turn * DVec3::Y).length() < 1e-12, "{plane:?}");
    }
}
