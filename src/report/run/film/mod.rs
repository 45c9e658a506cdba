//! The film of a flume run: bed, water and units over time.

mod bed;
mod units;
mod water;

use super::folder::RunFolder;
use super::moments::{shown_x, shown_z};
use super::scene::unit_radius;
use crate::output::OutputError;
use crate::report::film::{Clock, Scene, thinned, viewer_html};

use units::bodies;
use water::Water;

/// Largest number of frames.
const MOST_FRAMES: usize = 160;

/// Makes the film of a run; `start_s` is the time that is shown first [s]. Returns `None` for a run without recorded
/// water and units.
///
/// # Errors
/// If a file with the water cannot be read.
pub fn film(run: &RunFolder, start_s: Option<f64>) -> Result<Option<Scene>, OutputError> {
    let water = Water::open(run)?;
    let recorded: Vec<f64> = match (&water, run.motions.first()) {
        (Some(water), _) => water.times_s().to_vec(),
        (None, Some(motion)) => motion.time_s.clone(),
        (None, None) => return Ok(None),
    };
    let mut frames = thinned(recorded.len(), MOST_FRAMES);
    let mut series = vec![bed::bed(run)];
    series.extend(bed::structure(run));
    if let Some(water) = &water {
        let (of_water, chosen) = water.series(run, &frames)?;
        series.extend(of_water);
        frames = chosen;
    }
    let times: Vec<f64> = frames.iter().map(|frame| recorded[*frame]).collect();
    if times.is_empty() {
        return Ok(None);
    }
    let distance = |frame: &usize| (times[*frame] - start_s.unwrap_or(times[0])).abs();
    let start = (0..times.len()).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0);
    let (x, radius) = (shown_x(run), unit_radius(run));
    let units = run.motions.iter().filter_map(|motion| motion.ends()).flatten().map(|pose| pose.position_m[2] + radius);
    let z = shown_z(run, x, units);
    let corner = |end: usize| [x[end], [0.0, run.summary.domain_width_m][end], z[end]].map(|value| value as f32);
    Ok(Some(Scene {
        clock: Clock { unit: "s", per_second: 1.0, digits: 2 },
        start,
        corners: [corner(0), corner(1)],
        series,
        bodies: bodies(run, &times),
        times,
    }))
}

/// Returns the content of the report section: how the film was made, and the film.
pub fn section(scene: &Scene) -> String {
    let words = match scene.times.as_slice() {
        [first, .., last] => {
            let count = scene.times.len();
            let interval = (last - first) / (count - 1) as f64;
            format!("<p>{count} frames, one every {interval:.3} s. Between two frames, only the units move.</p>\n")
        }
        _ => String::new(),
    };
    words + &viewer_html(scene)
}
