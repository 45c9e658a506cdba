//! Elements of the drawings of the flume: bed, still water level and units.

use super::cover::Cover;
use super::folder::RunFolder;
use super::motion::Pose;
use super::solids::{ViewDirection, coarsened, reach, shaded, silhouette};
use super::window::{Window, label, path_point};
use crate::output::UnitSurface;

/// Distance beyond the edge of the window at which outlines are no longer visible [px].
const OUTSIDE: f64 = 5.0;

/// Numbers of the units (from 1) with their positions and orientations.
pub type Poses = Vec<(u32, Pose)>;

/// The flume with its units, in one window and one viewing direction.
pub struct ImpactScene<'a> {
    run: &'a RunFolder,
    /// Part of the flume that is drawn.
    pub window: Window,
    eye: ViewDirection,
    surfaces: Vec<UnitSurface>,
}

impl<'a> ImpactScene<'a> {
    /// Creates the scene for a window and a viewing direction.
    pub fn new(run: &'a RunFolder, window: Window, eye: ViewDirection) -> Self {
        let surfaces = run.surfaces.iter().map(|surface| coarsened(surface, window.scale)).collect();
        Self { run, window, eye, surfaces }
    }

    /// Draws a white background. On a dark page, the colours of the water would be hard to read without it.
    pub fn sky(&self) -> String {
        let [left, top, right, bottom] = self.window.edges();
        format!("<path class=\"sky\" d=\"M{left:.1} {top:.1}H{right:.1}V{bottom:.1}H{left:.1}Z\"/>\n")
    }

    /// Draws bed, mound and obstacles in side view. The bed is filled down to the lower edge of the window.
    pub fn bed(&self) -> String {
        let bottom = self.window.edges()[3];
        let bed: Vec<[f64; 2]> =
            bed_in(self.run, self.window.x).iter().map(|point| self.window.at(point[0], point[1])).collect();
        let (Some([x0, y0]), Some([x1, y1])) = (bed.first(), bed.last()) else { return String::new() };
        let line = bed.iter().map(|point| path_point(*point)).collect::<Vec<_>>().join("L");
        // Both ends of the bed extend beyond the window, so that their vertical outlines are clipped.
        let (left, right, bottom) = (x0 - OUTSIDE, x1 + OUTSIDE, bottom + OUTSIDE);
        self.obstacles()
            + &format!(
                "<path class=\"bed\" d=\"M{left:.1} {y0:.1}L{line}L{right:.1} {y1:.1}V{bottom:.1}H{left:.1}Z\"/>\n"
            )
    }

    /// Draws the fixed obstacles as rectangles, and the parts of the structure as their sections.
    fn obstacles(&self) -> String {
        let rectangle = |[low, high]: &[[f64; 3]; 2]| {
            let [[x0, up0, _], [x1, up1, _]] = [low, high].map(|corner| self.eye.project(*corner));
            let ([left, bottom], [right, top]) = (self.window.at(x0, up0), self.window.at(x1, up1));
            format!("<path class=\"bed\" d=\"M{left:.1} {bottom:.1}V{top:.1}H{right:.1}V{bottom:.1}Z\"/>\n")
        };
        let section = |points: &[[f64; 2]]| {
            let corner = |[x, z]: &[f64; 2]| {
                let [x, up, _] = self.eye.project([*x, 0.0, *z]);
                path_point(self.window.at(x, up))
            };
            let corners: Vec<String> = points.iter().map(corner).collect();
            format!("<path class=\"bed\" d=\"M{}Z\"/>\n", corners.join("L"))
        };
        let summary = &self.run.summary;
        let sections = summary.sections.iter().map(|part| section(&part.points_m));
        let bodies = summary.bodies.iter().map(|body| section(&body.side_view_m));
        summary.obstacles_m.iter().map(rectangle).chain(sections).chain(bodies).collect()
    }

    /// Draws the still water as an area from the still water level down to the lower edge of the window.
    pub fn still_water(&self) -> String {
        let [left, _, right, bottom] = self.window.edges();
        let surface = self.window.at(0.0, self.run.summary.still_water_level_m)[1];
        format!("<path class=\"water\" d=\"M{left:.1} {surface:.1}H{right:.1}V{bottom:.1}H{left:.1}Z\"/>\n")
    }

    /// Draws the line of the still water level with its label.
    pub fn still_water_level(&self) -> String {
        let [left, _, right, _] = self.window.edges();
        let surface = self.window.at(0.0, self.run.summary.still_water_level_m)[1];
        format!("<path class=\"still\" d=\"M{left:.1} {surface:.1}H{right:.1}\"/>")
            + &label(left + 8.0, surface - 6.0, "note halo", "still water level")
            + "\n"
    }

    /// Draws the units, the most distant unit first. If `judged` is true, damaged units have a different colour.
    pub fn units(&self, poses: &[(u32, Pose)], judged: bool) -> String {
        let damaged = |unit: u32| judged && self.run.summary.units.iter().any(|u| u.unit == unit && u.damaged);
        let mut order: Vec<&(u32, Pose)> = poses.iter().collect();
        let depth = |pose: &Pose| self.eye.project(pose.position_m)[2];
        order.sort_by(|a, b| depth(&b.1).total_cmp(&depth(&a.1)));
        let mut cover = Cover::new(&self.window);
        let units = order.into_iter().map(|(unit, pose)| {
            let class = if damaged(*unit) { "unit damaged" } else { "unit" };
            let shape = match self.surface_of(*unit) {
                Some(surface) => shaded(surface, *pose, &self.window, self.eye, &mut cover),
                None => self.disc(*pose),
            };
            format!("<g class=\"{class}\"><title>unit {unit}</title>{shape}</g>\n")
        });
        // The units are computed from front to back, because front units cover others. They are painted from back to
        // front.
        units.collect::<Vec<_>>().into_iter().rev().collect()
    }

    fn surface_of(&self, unit: u32) -> Option<&UnitSurface> {
        self.surfaces.get(self.run.surface_of(unit))
    }

    /// Draws the silhouette of a unit as a pale area with an outline.
    pub fn outline(&self, unit: u32, pose: Pose) -> String {
        let Some(surface) = self.surface_of(unit) else { return format!("<g class=\"ghost\">{}</g>", self.disc(pose)) };
        let data = silhouette(surface, pose, &self.window, self.eye);
        format!("<path class=\"ghost\" d=\"{data}\"/>\n")
    }

    /// Draws a unit of unknown shape as a disc.
    fn disc(&self, pose: Pose) -> String {
        let [x, up, _] = self.eye.project(pose.position_m);
        let ([cx, cy], r) = (self.window.at(x, up), unit_radius(self.run) * self.window.scale);
        format!("<circle class=\"s4\" cx=\"{cx:.1}\" cy=\"{cy:.1}\" r=\"{r:.1}\"/>")
    }
}

/// Half the size of the largest unit [m], for margins and for drawing units of unknown shape.
pub fn unit_radius(run: &RunFolder) -> f64 {
    let surface = run.surfaces.iter().map(reach).fold(0.0, f64::max);
    if surface > 0.0 { surface } else { 0.5 * run.summary.damage_distance_m.unwrap_or(0.1) }
}

/// Returns the corner points [x, z] of the bed between two positions x [m], including the bed at both positions. Empty
/// if the bed profile is unknown.
pub fn bed_in(run: &RunFolder, [from, to]: [f64; 2]) -> Vec<[f64; 2]> {
    let end = |x: f64| bed_z(run, x).map(|z| [x, z]);
    let corners = run.profile.iter().copied().filter(|p| from < p[0] && p[0] < to);
    end(from).into_iter().chain(corners).chain(end(to)).collect()
}

fn bed_z(run: &RunFolder, x: f64) -> Option<f64> {
    let piece = run.profile.windows(2).find(|w| w[0][0] <= x && x <= w[1][0])?;
    let ([x0, z0], [x1, z1]) = (piece[0], piece[1]);
    // A vertical wall has two corners at the same x; the second corner is used.
    Some(if x1 > x0 { z0 + (z1 - z0) * (x - x0) / (x1 - x0) } else { z1 })
}

/// Returns the smallest and the largest value; `None` without values.
pub fn range(values: impl IntoIterator<Item = f64>) -> Option<[f64; 2]> {
    values.into_iter().fold(None, |range, v| Some(range.map_or([v, v], |[a, b]: [f64; 2]| [a.min(v), b.max(v)])))
}
