//! Side view and top view of the units before and after the wave.

use super::super::UnitSurface;
use super::super::plot::{Axis, escape, short};
use super::folder::RunFolder;
use super::motion::Pose;

/// Width of a view [px].
const WIDTH: f64 = 920.0;
/// Height of a view at most [px].
const MAX_HEIGHT: f64 = 560.0;
/// Levels of light on a surface.
const SHADES: f64 = 7.0;

/// Direction from which a view looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Eye {
    /// Along y: x to the right, z upwards.
    Side,
    /// Along -z: x to the right, y upwards.
    Above,
}

impl Eye {
    /// Horizontal and vertical coordinate on the paper, and distance towards the eye [m].
    fn project(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Side => [x, z, -y],
            Self::Above => [x, y, z],
        }
    }
}

/// A piece of the flume on paper with one scale for both directions.
struct Window {
    x: [f64; 2],
    up: [f64; 2],
    scale: f64,
    top: f64,
    left: f64,
}

impl Window {
    fn new(x: [f64; 2], up: [f64; 2]) -> Self {
        let scale = (WIDTH / (x[1] - x[0])).min(MAX_HEIGHT / (up[1] - up[0]));
        let left = 0.5 * (WIDTH - scale * (x[1] - x[0]));
        Self { x, up, scale, top: 4.0, left }
    }

    fn at(&self, x: f64, up: f64) -> [f64; 2] {
        [self.left + (x - self.x[0]) * self.scale, self.top + (self.up[1] - up) * self.scale]
    }

    fn bottom(&self) -> f64 {
        self.at(0.0, self.up[0])[1]
    }

    fn right(&self) -> f64 {
        self.at(self.x[1], 0.0)[0]
    }

    fn open(&self, title: &str, id: &str) -> String {
        let (height, title) = (self.bottom() + 40.0, escape(title));
        let (left, top, w, h) = (self.left, self.top, self.right() - self.left, self.bottom() - self.top);
        format!(
            "<svg class=\"view\" viewBox=\"0 0 {WIDTH} {height:.0}\" role=\"img\" aria-label=\"{title}\"><title>{title}</title>\
             <clipPath id=\"{id}\"><rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{w:.1}\" height=\"{h:.1}\"/></clipPath>\
             <g clip-path=\"url(#{id})\">\n"
        )
    }

    /// Ends the clipped drawing and puts the axis along the flume under it.
    fn close(&self) -> String {
        let axis = Axis::tight("", self.x, ((self.right() - self.left) / 60.0) as usize);
        let y = self.bottom();
        let mut svg = format!("</g><path class=\"axis\" d=\"M{:.1} {y:.1}H{:.1}\"/>", self.left, self.right());
        for tick in axis.ticks() {
            let x = self.at(tick, 0.0)[0];
            svg += &format!("<path class=\"axis\" d=\"M{x:.1} {y:.1}v5\"/>");
            svg += &label(x, y + 18.0, "tick mid", &axis.number(tick));
        }
        let middle = 0.5 * (self.left + self.right());
        svg += &label(middle, y + 35.0, "label mid", "x along the flume [m], the wave comes from the left");
        svg + "</svg>\n"
    }
}

fn label(x: f64, y: f64, class: &str, words: &str) -> String {
    format!("<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\">{}</text>", escape(words))
}

/// The three views of a run: side before, side after, from above; empty without units.
pub fn views(run: &RunFolder) -> String {
    let ends: Vec<(u32, [Pose; 2])> = run.motions.iter().filter_map(|m| Some((m.unit, m.ends()?))).collect();
    if ends.is_empty() {
        return String::new();
    }
    let scene = Scene { run, ends };
    let mut html = String::new();
    for (moment, title) in [(0, "Side view before the wave"), (1, "Side view after the wave")] {
        html += &format!("<figure>{}<figcaption>{title}.</figcaption></figure>\n", scene.side(moment, title));
    }
    let sides = if run.summary.side_walls { "between side walls" } else { "periodic across the flume" };
    html += &format!(
        "<figure>{}<figcaption>Seen from above, {sides}: outlines where the units stood, solid where they came to rest, \
         an arrow for each displacement. Thin lines are the toes and edges of the mound.</figcaption></figure>\n",
        scene.above()
    );
    html
}

struct Scene<'a> {
    run: &'a RunFolder,
    ends: Vec<(u32, [Pose; 2])>,
}

impl Scene<'_> {
    /// Half the size of a unit [m], for margins and for units without a surface.
    fn radius(&self) -> f64 {
        let surface = self.run.surface.as_ref().map_or(0.0, |surface| {
            surface.vertices_m.iter().map(|v| v.iter().map(|c| c * c).sum::<f64>().sqrt()).fold(0.0, f64::max)
        });
        if surface > 0.0 { surface } else { 0.5 * self.run.summary.damage_distance_m.unwrap_or(0.1) }
    }

    /// Part of the flume along x that holds all units with room beside them [m].
    fn x_range(&self) -> [f64; 2] {
        let xs = || self.ends.iter().flat_map(|(_, poses)| poses.map(|pose| pose.position_m[0]));
        let (low, high) = xs().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let room = 5.0 * self.radius();
        [low - room, high + room]
    }

    fn bed_z(&self, x: f64) -> Option<f64> {
        let piece = self.run.profile.windows(2).find(|w| w[0][0] <= x && x <= w[1][0])?;
        let ([x0, z0], [x1, z1]) = (piece[0], piece[1]);
        Some(z0 + (z1 - z0) * (x - x0) / (x1 - x0))
    }

    fn side(&self, moment: usize, title: &str) -> String {
        let (x, radius) = (self.x_range(), self.radius());
        let level = self.run.summary.still_water_level_m;
        let beds = x.into_iter().filter_map(|x| self.bed_z(x));
        let corners = self.run.profile.iter().filter(|p| x[0] < p[0] && p[0] < x[1]).map(|p| p[1]);
        let feet = self.ends.iter().flat_map(|(_, poses)| poses.map(|pose| pose.position_m[2] - radius));
        let tops = self.ends.iter().flat_map(|(_, poses)| poses.map(|pose| pose.position_m[2] + radius));
        let low = beds.chain(corners).chain(feet).fold(level, f64::min) - 0.5 * radius;
        let window = Window::new(x, [low, tops.fold(level, f64::max) + 0.6 * radius]);

        let mut svg = window.open(title, &format!("side{moment}"));
        let [left, surface] = window.at(x[0], level);
        let (right, bottom) = (window.right(), window.bottom());
        svg += &format!("<path class=\"water\" d=\"M{left:.1} {surface:.1}H{right:.1}V{bottom:.1}H{left:.1}Z\"/>");
        let bed: Vec<[f64; 2]> = (self.bed_z(x[0]).map(|z| [x[0], z]).into_iter())
            .chain(self.run.profile.iter().copied().filter(|p| x[0] < p[0] && p[0] < x[1]))
            .chain(self.bed_z(x[1]).map(|z| [x[1], z]))
            .collect();
        if let (Some(first), Some(last)) = (bed.first(), bed.last()) {
            let line: String = bed.iter().map(|p| path_point(&window, *p)).collect::<Vec<_>>().join("L");
            let ([x0, _], [x1, _]) = (window.at(first[0], 0.0), window.at(last[0], 0.0));
            svg += &format!("<path class=\"bed\" d=\"M{line}L{x1:.1} {bottom:.1}L{x0:.1} {bottom:.1}Z\"/>");
        }
        svg += &self.solids(&window, Eye::Side, moment);
        svg += &format!("<path class=\"still\" d=\"M{left:.1} {surface:.1}H{right:.1}\"/>");
        svg += &label(left + 8.0, surface - 6.0, "note halo", "still water level");
        svg + &window.close()
    }

    fn above(&self) -> String {
        let (x, width) = (self.x_range(), self.run.summary.domain_width_m);
        let across = self.ends.iter().flat_map(|(_, poses)| poses.map(|pose| pose.position_m[1]));
        let (low, high) = across.fold((0.0_f64, width), |(a, b), y| (a.min(y), b.max(y)));
        let room = if self.run.summary.side_walls { 0.0 } else { 0.6 * self.radius() };
        let window = Window::new(x, [low - room, high + room]);
        let mut svg = window.open("Units seen from above before and after the wave", "above");
        let (top, bottom) = (window.top, window.bottom());
        let (left, right) = (window.left, window.right());
        svg += &format!("<path class=\"plan\" d=\"M{left:.1} {top:.1}H{right:.1}V{bottom:.1}H{left:.1}Z\"/>");
        for point in self.run.profile.iter().filter(|p| x[0] < p[0] && p[0] < x[1]) {
            let px = window.at(point[0], 0.0)[0];
            svg += &format!("<path class=\"edge\" d=\"M{px:.1} {top:.1}V{bottom:.1}\"/>");
        }
        for (_, poses) in &self.ends {
            svg += &self.outline(&window, poses[0]);
        }
        svg += &self.solids(&window, Eye::Above, 1);
        for (unit, poses) in &self.ends {
            let [from, to] = poses.map(|pose| window.at(pose.position_m[0], pose.position_m[1]));
            svg += &arrow(from, to);
            let beyond = to[0] + 1.05 * self.radius() * window.scale;
            svg += &label(beyond + 4.0, to[1] + 4.0, "note halo", &unit.to_string());
        }
        svg += &format!("<path class=\"side\" d=\"M{left:.1} {top:.1}H{right:.1}M{left:.1} {bottom:.1}H{right:.1}\"/>");
        svg + &window.close()
    }

    /// All units at one moment, those further from the eye first.
    fn solids(&self, window: &Window, eye: Eye, moment: usize) -> String {
        let damaged = |unit: u32| self.run.summary.units.iter().any(|u| u.unit == unit && u.damaged);
        let mut order: Vec<&(u32, [Pose; 2])> = self.ends.iter().collect();
        let depth = |pose: &Pose| eye.project(pose.position_m)[2];
        order.sort_by(|a, b| depth(&a.1[moment]).total_cmp(&depth(&b.1[moment])));
        let mut svg = String::new();
        for (unit, poses) in order {
            let class = if moment == 1 && damaged(*unit) { "unit damaged" } else { "unit" };
            let shape = match &self.run.surface {
                Some(surface) => faces(surface, poses[moment], window, eye),
                None => self.disc(window, eye, poses[moment]),
            };
            svg += &format!("<g class=\"{class}\"><title>unit {unit}</title>{shape}</g>\n");
        }
        svg
    }

    fn disc(&self, window: &Window, eye: Eye, pose: Pose) -> String {
        let [x, up, _] = eye.project(pose.position_m);
        let [cx, cy] = window.at(x, up);
        format!("<circle class=\"s4\" cx=\"{cx:.1}\" cy=\"{cy:.1}\" r=\"{:.1}\"/>", self.radius() * window.scale)
    }

    /// The silhouette from above as a rim round a pale fill: the faces that look upwards, once with a stroke, once over it.
    fn outline(&self, window: &Window, pose: Pose) -> String {
        let Some(surface) = &self.run.surface else {
            return format!("<g class=\"ghost\">{}</g>", self.disc(window, Eye::Above, pose));
        };
        let points: Vec<[f64; 3]> = surface.vertices_m.iter().map(|v| pose.place(*v)).collect();
        let data: String = (surface.triangles.iter())
            .filter_map(|t| {
                let corners = t.map(|i| points[i as usize]);
                (normal(corners)[2] > 0.0).then(|| triangle_path(window, Eye::Above, corners))
            })
            .collect();
        format!("<path class=\"rim\" d=\"{data}\"/><path class=\"ghost\" d=\"{data}\"/>\n")
    }
}

/// The faces of a unit that look towards the eye, from back to front, shaded by a light from above left.
fn faces(surface: &UnitSurface, pose: Pose, window: &Window, eye: Eye) -> String {
    let points: Vec<[f64; 3]> = surface.vertices_m.iter().map(|v| pose.place(*v)).collect();
    let mut visible: Vec<(f64, usize, [[f64; 3]; 3])> = (surface.triangles.iter())
        .filter_map(|t| {
            let corners = t.map(|i| points[i as usize]);
            let [nx, nup, towards] = eye.project(normal(corners));
            let light = (-0.35 * nx + 0.62 * nup + 0.70 * towards).max(0.0);
            let depth = corners.iter().map(|c| eye.project(*c)[2]).sum::<f64>();
            (towards > 0.0).then_some((depth, (light * SHADES) as usize, corners))
        })
        .collect();
    visible.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut svg = String::new();
    for same in visible.chunk_by(|a, b| a.1 == b.1) {
        let data: String = same.iter().map(|face| triangle_path(window, eye, face.2)).collect();
        svg += &format!("<path class=\"s{}\" d=\"{data}\"/>", same[0].1.min(SHADES as usize - 1));
    }
    svg
}

fn triangle_path(window: &Window, eye: Eye, corners: [[f64; 3]; 3]) -> String {
    let [a, b, c] = corners.map(|corner| {
        let [x, up, _] = eye.project(corner);
        path_point(window, [x, up])
    });
    format!("M{a}L{b}L{c}Z")
}

fn path_point(window: &Window, [x, up]: [f64; 2]) -> String {
    let [px, py] = window.at(x, up);
    format!("{} {}", short(px, 1).replace('\u{2212}', "-"), short(py, 1).replace('\u{2212}', "-"))
}

/// Unit normal of a triangle; zero for one without area.
fn normal([a, b, c]: [[f64; 3]; 3]) -> [f64; 3] {
    let (u, v) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i]));
    let n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    let length = n.iter().map(|c| c * c).sum::<f64>().sqrt();
    if length > 0.0 { n.map(|c| c / length) } else { [0.0; 3] }
}

/// An arrow between two places on paper; none for less than 6 px.
fn arrow([x0, y0]: [f64; 2], [x1, y1]: [f64; 2]) -> String {
    let length = (x1 - x0).hypot(y1 - y0);
    if length < 6.0 {
        return String::new();
    }
    let (dx, dy) = ((x1 - x0) / length, (y1 - y0) / length);
    let (bx, by) = (x1 - 8.0 * dx, y1 - 8.0 * dy);
    format!(
        "<path class=\"arrow\" d=\"M{x0:.1} {y0:.1}L{bx:.1} {by:.1}\"/><path class=\"head\" d=\"M{x1:.1} {y1:.1}L{:.1} {:.1}L{:.1} {:.1}Z\"/>\n",
        bx - 4.0 * dy,
        by + 4.0 * dx,
        bx + 4.0 * dy,
        by - 4.0 * dx
    )
}
