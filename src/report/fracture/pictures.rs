//! Pictures of the run: units with cracks, and stress in the section plane, at the same recorded times.

use super::folder::{FractureFolder, place_in_words};
use super::moments::{Moment, Why, impact_and_end, main_cracks, moments};
use super::stress_picture::{StressScene, css};
use super::unit_picture::{OLD, OPENED, SIZE, SLID, UNIT, UnitScene};
use crate::output::OutputError;
use crate::report::plot::{escape, short};
use crate::simulation::fracture::summary::InitiationSummary;

/// Returns the content of the report section "Pictures", or a note if the run wrote no surfaces.
///
/// # Errors
/// If a file cannot be read.
pub fn pictures(run: &FractureFolder) -> Result<String, OutputError> {
    let words = "<p>No pictures, because the run wrote no surfaces. Set <code>output.surfaces_interval_s</code> in \
                 the case to a value above 0.</p>\n";
    Ok(figures(run, moments, "in the table above")?.unwrap_or_else(|| words.to_owned()))
}

/// Returns pictures just after the impact and at the end of the run, for the report about all impacts of a flume run;
/// `None` if the run wrote no surfaces.
///
/// # Errors
/// If a file cannot be read.
pub fn of_impact_and_end(run: &FractureFolder) -> Result<Option<String>, OutputError> {
    figures(run, impact_and_end, "in the report of the impact")
}

/// Function that chooses the shown moments from the recorded times [s], the time of the impact [s] and the crack
/// initiations.
type Choice = fn(&[f64], Option<f64>, &[InitiationSummary]) -> Vec<Moment>;

/// Returns legend and pictures of the chosen moments. `listed` says where the reader finds the list of numbered cracks.
fn figures(run: &FractureFolder, choose: Choice, listed: &str) -> Result<Option<String>, OutputError> {
    let Some([surfaces, cracks, section]) = &run.pictures else { return Ok(None) };
    let complete = [surfaces, cracks, section].map(|file| file.times_s().len()).into_iter().min().unwrap_or(0);
    let times = &surfaces.times_s()[..complete];
    let shown = choose(times, run.summary.impact_s, &run.summary.initiation);
    let units = UnitScene::new(run);
    let stress = StressScene::new(run, &shown.iter().map(|moment| moment.frame).collect::<Vec<_>>())?;
    let mut html = legend(run, &stress, listed);
    for moment in &shown {
        let time = times[moment.frame];
        let heading = format!("<strong>{}</strong>{}", run.time_in_words(time), events(run, moment));
        html += &format!(
            "<figure class=\"moment\">\n<figcaption>{heading}</figcaption>\n<div class=\"shots\">\n{}{}</div>\n</figure>\n",
            picture("Units with cracks", &units.picture(run, moment.frame)?, &labels(run, &units, time)),
            picture("First principal stress in the section plane", &stress.picture(run, moment.frame)?, ""),
        );
    }
    Ok(Some(html))
}

fn picture(title: &str, uri: &str, over: &str) -> String {
    let [w, h] = SIZE;
    format!(
        "<svg class=\"shot\" viewBox=\"0 0 {w} {h}\" role=\"img\" aria-label=\"{title}\"><title>{title}</title>\
         <image width=\"{w}\" height=\"{h}\" href=\"{uri}\"/>{over}</svg>\n"
    )
}

/// Draws the numbers of the main cracks that have started by `time` [s], next to the positions where the cracks
/// started.
fn labels(run: &FractureFolder, units: &UnitScene, time: f64) -> String {
    let mut svg = String::new();
    for number in main_cracks(&run.summary.initiation) {
        let initiation = &run.summary.initiation[number - 1];
        if initiation.t_s > time {
            continue;
        }
        let [x, y, _] = units.view.project(glam::DVec3::from_array(initiation.place));
        let (tx, ty) = (x - 74.0, y - 74.0);
        svg += &format!(
            "<path d=\"M{x:.0} {y:.0}L{tx:.0} {ty:.0}\" stroke=\"#1b1f24\" stroke-width=\"2.5\"/>\
             <circle cx=\"{x:.0}\" cy=\"{y:.0}\" r=\"5\" fill=\"#1b1f24\"/>\
             <circle cx=\"{tx:.0}\" cy=\"{ty:.0}\" r=\"21\" fill=\"#fff\" stroke=\"#1b1f24\" stroke-width=\"2.5\"/>\
             <text x=\"{tx:.0}\" y=\"{:.0}\" font-size=\"28\" font-weight=\"600\" text-anchor=\"middle\" fill=\"#1b1f24\">{number}</text>",
            ty + 10.0
        );
    }
    svg
}

/// Describes the events between the previous moment and this moment.
fn events(run: &FractureFolder, moment: &Moment) -> String {
    let main = main_cracks(&run.summary.initiation);
    let describe_crack = |number: &usize| {
        let initiation = &run.summary.initiation[*number - 1];
        format!("crack {number} started ({}, {})", initiation.mode, place_in_words(initiation))
    };
    let mut words: Vec<String> =
        moment.begun.iter().filter(|number| main.contains(number)).map(describe_crack).collect();
    let small = moment.begun.len() - words.len();
    if small > 0 {
        words.push(format!("smaller cracks started: {small}"));
    }
    match moment.why {
        Why::Impact if run.summary.impact_s.is_some() => words.insert(0, "just after the impact".to_owned()),
        Why::Impact => words.insert(0, "start of the run".to_owned()),
        Why::End => words.insert(0, "end of the run".to_owned()),
        Why::Crack | Why::Between => {}
    }
    if words.is_empty() { String::new() } else { escape(&format!(": {}", words.join("; "))) }
}

fn legend(run: &FractureFolder, stress: &StressScene, listed: &str) -> String {
    let setup = &run.case.setup;
    let slid = run.summary.initiation.iter().any(|i| i.mode == "sliding");
    let mut entries = vec![("unit surface (transparent)", UNIT)];
    if setup.bodies.iter().any(|body| body.cohesion.is_some()) {
        entries.push(("opening crack (mode I)", OPENED));
    }
    if slid || run.has_slid_faces() {
        entries.push(("sliding crack (mode II)", SLID));
    }
    if !setup.cracks.is_empty() {
        entries.push(("pre-existing crack", OLD));
    }
    let swatch =
        |(name, colour): (&str, [f32; 3])| format!("<span><i style=\"background:{}\"></i>{name}</span>", css(colour));
    let entries: String = entries.into_iter().map(swatch).collect();
    let plane = &run.case.section;
    let [x, y, z] = plane.point.to_array().map(|c| short(c, 3));
    format!(
        "<p>Left: transparent units, seen from the front, left and above. The numbers are the crack numbers {listed}. \
         Right: \u{3c3}\u{2081} in the plane through ({x}, {y}, {z}) m {}, which moves with the bodies. Thin black \
         lines are outlines, thick black lines are cracks. {} Displacements are drawn to scale, so that crack \
         openings are too small to see.</p>\n<div class=\"swatches\">{entries}</div>\n{}",
        normal_in_words(plane.normal),
        stress.scale_in_words(),
        stress.legend()
    )
}

fn normal_in_words(normal: glam::DVec3) -> String {
    for (axis, name) in [(glam::DVec3::X, "x"), (glam::DVec3::Y, "y"), (glam::DVec3::Z, "z")] {
        if normal.dot(axis).abs() > 1.0 - 1e-9 {
            return format!("normal to {name}");
        }
    }
    let [x, y, z] = normal.to_array().map(|c| short(c, 3));
    format!("with normal ({x}, {y}, {z})")
}
