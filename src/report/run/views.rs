//! Side views and top view of the units before and after the wave.

use super::super::plot::short;
use super::folder::RunFolder;
use super::motion::Pose;
use super::scene::{ImpactScene, Poses, bed_in, range, unit_radius};
use super::solids::ViewDirection;
use super::window::{Window, label, svg};

/// Space that the number of a unit needs [px].
const NUMBER: [f64; 2] = [26.0, 14.0];

/// Returns the three views of a run: side view before the wave, side view after the wave, top view. Empty without
/// units.
pub fn views(run: &RunFolder) -> String {
    let ends: Vec<(u32, [Pose; 2])> = run.motions.iter().filter_map(|m| Some((m.unit, m.ends()?))).collect();
    let places = ends.iter().flat_map(|(_, poses)| poses.map(|pose| pose.position_m[0]));
    let Some([low, high]) = range(places) else { return String::new() };
    let room = 5.0 * unit_radius(run);
    let x = [low - room, high + room];
    let times = run.motions.iter().find_map(|m| Some([*m.time_s.first()?, *m.time_s.last()?])).unwrap_or_default();
    let mut html = String::new();
    for (moment, title) in [(0, "Side view before the wave"), (1, "Side view after the wave")] {
        let drawing = side_view(run, x, &ends, moment, title);
        let time = short(times[moment], 2);
        html += &format!("<figure>{drawing}<figcaption>{title}, at flume time {time} s.</figcaption></figure>\n");
    }
    let sides = if run.summary.side_walls { "with side walls" } else { "periodic across the flume" };
    html += &format!(
        "<figure>{}<figcaption>Top view, {sides}. Outlines: initial positions. Solid: final positions. Arrows: \
         displacements. Thin lines: corners of the bed profile, such as toes and crest edges of the mound. Numbers \
         that would overlap are left out.</figcaption></figure>\n",
        top_view(run, x, &ends)
    );
    html
}

fn poses_at(ends: &[(u32, [Pose; 2])], moment: usize) -> Poses {
    ends.iter().map(|(unit, poses)| (*unit, poses[moment])).collect()
}

fn side_view(run: &RunFolder, x: [f64; 2], ends: &[(u32, [Pose; 2])], moment: usize, title: &str) -> String {
    let (level, radius) = (run.summary.still_water_level_m, unit_radius(run));
    let centres = ends.iter().flat_map(|(_, poses)| poses.map(|pose| pose.position_m[2]));
    let heights = centres.flat_map(|z| [z - radius, z + radius]).chain(bed_in(run, x).into_iter().map(|p| p[1]));
    let [low, high] = range(heights.chain([level])).unwrap_or([0.0, 1.0]);
    let scene = ImpactScene::new(run, Window::new(x, [low - 0.5 * radius, high + 0.6 * radius]), ViewDirection::Side);
    let drawing = scene.still_water()
        + &scene.bed()
        + &scene.units(&poses_at(ends, moment), moment == 1)
        + &scene.still_water_level();
    svg(title, scene.window.height(), &scene.window.framed(&format!("side{moment}"), "z [m]", &drawing))
}

fn top_view(run: &RunFolder, x: [f64; 2], ends: &[(u32, [Pose; 2])]) -> String {
    let across = ends.iter().flat_map(|(_, poses)| poses.map(|pose| pose.position_m[1]));
    let [low, high] = range(across.chain([0.0, run.summary.domain_width_m])).unwrap_or([0.0, 1.0]);
    let radius = unit_radius(run);
    let room = if run.summary.side_walls { 0.0 } else { 0.6 * radius };
    let scene = ImpactScene::new(run, Window::new(x, [low - room, high + room]), ViewDirection::Above);
    let window = &scene.window;
    let [left, top, right, bottom] = window.edges();
    let mut drawing = format!("<path class=\"plan\" d=\"M{left:.1} {top:.1}H{right:.1}V{bottom:.1}H{left:.1}Z\"/>");
    for point in run.profile.iter().filter(|p| x[0] < p[0] && p[0] < x[1]) {
        let px = window.at(point[0], 0.0)[0];
        drawing += &format!("<path class=\"edge\" d=\"M{px:.1} {top:.1}V{bottom:.1}\"/>");
    }
    for (unit, poses) in ends {
        drawing += &scene.outline(*unit, poses[0]);
    }
    drawing += &scene.units(&poses_at(ends, 1), true);
    let mut taken: Vec<[f64; 2]> = Vec::new();
    for (unit, poses) in ends {
        let [from, to] = poses.map(|pose| window.at(pose.position_m[0], pose.position_m[1]));
        drawing += &arrow(from, to);
        let place = [to[0] + 1.05 * radius * window.scale + 4.0, to[1] + 4.0];
        let overlaps = |other: &[f64; 2]| (0..2).all(|axis| (place[axis] - other[axis]).abs() < NUMBER[axis]);
        if !taken.iter().any(overlaps) {
            drawing += &label(place[0], place[1], "note halo", &unit.to_string());
            taken.push(place);
        }
    }
    drawing += &format!("<path class=\"side\" d=\"M{left:.1} {top:.1}H{right:.1}M{left:.1} {bottom:.1}H{right:.1}\"/>");
    let title = "Top view of the units before and after the wave";
    svg(title, window.height(), &window.framed("above", "y [m]", &drawing))
}

/// Draws an arrow between two points [px]; nothing if they are less than 6 px apart.
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
