//! Last sections of the report of a flume run: warnings, assumptions, how the run was made, and its files.

use super::super::plot::{escape, short};
use super::folder::RunFolder;
use crate::{
    output::{Summary, WaveSummary},
    report::page::{clock, grouped, section},
};

pub fn warnings(summary: &Summary) -> String {
    let items: String = summary.warnings.iter().map(|warning| format!("<li>{}</li>\n", escape(warning))).collect();
    let words = "<p>The results may be unreliable for these reasons.</p>\n";
    section("Warnings", &if items.is_empty() { items } else { format!("{words}<ul>\n{items}</ul>\n") })
}

pub fn assumptions(summary: &Summary) -> String {
    let items: String = summary.assumptions.iter().map(|a| format!("<li>{}</li>\n", escape(a))).collect();
    if items.is_empty() {
        return section("Assumptions", "<p>The case file lists no assumptions.</p>\n");
    }
    let words = "<p>No source gives these values. The author of the case chose them, and the results depend on \
                 them.</p>\n";
    section("Assumptions", &format!("{words}<ul>\n{items}</ul>\n"))
}

pub fn facts(summary: &Summary) -> String {
    let (counts, step, execution) = (&summary.particle_counts, &summary.time_step_s, &summary.execution);
    let mut rows = vec![
        (
            "Particles",
            format!(
                "{} ({} water, {} bed and walls, {} wavemaker, {} units)",
                grouped(summary.particles),
                grouped(counts.water),
                grouped(counts.bed),
                grouped(counts.wavemaker),
                grouped(counts.units)
            ),
        ),
        ("Particle spacing", format!("{} mm", short(1000.0 * summary.dp_m, 3))),
        (
            "Domain",
            format!(
                "x = {} to {} m, {}",
                short(summary.domain_x_m[0], 3),
                short(summary.domain_x_m[1], 3),
                width_and_sides(summary)
            ),
        ),
        (
            "Simulated time",
            format!(
                "{} s from flume time {} s; stopped: {}",
                short(summary.simulated_s, 3),
                short(summary.start_s, 3),
                summary.stopped
            ),
        ),
        (
            "Time steps",
            format!(
                "{}; mean {} \u{b5}s, range {} to {} \u{b5}s",
                grouped(summary.steps),
                short(1e6 * step.mean, 1),
                short(1e6 * step.min, 1),
                short(1e6 * step.max, 1)
            ),
        ),
        ("Speed of sound", format!("{} m/s (artificial)", short(summary.speed_of_sound_m_s, 2))),
        (
            "Computing time",
            format!(
                "{} with {} threads, water computed on the {}, {} time steps per second",
                clock(execution.wall_s),
                execution.threads,
                execution.device.as_deref().unwrap_or("processor"),
                short(execution.steps_per_s, 2)
            ),
        ),
    ];
    if let Some(mach) = summary.largest_mach {
        let words =
            format!("{} times the speed of sound; below 0.1, the water is nearly incompressible", short(mach, 3));
        rows.push(("Highest water speed", words));
    }
    if let Some(wave) = &summary.wave {
        let theory = if wave.theory.is_empty() { String::new() } else { format!(" ({})", wave.theory) };
        rows.push(("Wave", format!("{}{theory}, {} = {} m", wave.kind, height_symbol(wave), short(wave.height_m, 4))));
    }
    rows.push(("breakwater", format!("version {}", summary.breakwater_version)));
    rows.extend(execution.processor.clone().map(|name| ("Processor", name)));
    let mut html: String =
        rows.iter().map(|(name, value)| format!("<tr><td>{name}</td><td>{}</td></tr>\n", escape(value))).collect();
    html += &format!("<tr><td>Case hash</td><td><code>{}</code></td></tr>\n", escape(&summary.case_hash));
    section("How the run was made", &format!("<table class=\"facts\"><tbody>\n{html}</tbody></table>\n"))
}

/// Files of a run folder and their contents, in the order of the table in the report.
const FILES: [(&str, &str); 17] = [
    (RunFolder::PICTURE, "picture of water and units at one time"),
    (
        RunFolder::WATER,
        "water particles with velocity, pressure and density: open in ParaView 5.12 or later, show as <em>Point Gaussian</em>, colour by velocity",
    ),
    ("surface.vtkhdf", "surface of the water with velocity and pressure: opens in ParaView"),
    ("units.vtkhdf", "moving surfaces of the units: open in ParaView together with the water"),
    ("units.csv", "position, orientation, velocity, force of the water and contact force of each unit over time"),
    ("contacts.csv", "every contact event with position, velocity, peak force and impulse"),
    ("impacts.h5", "the hardest impacts of the units with their force histories: HDF5, for other programs"),
    (
        "breakage.csv",
        "displacement, peak impact force, stresses, cracks and pieces of each unit; forces and stresses at prototype scale",
    ),
    ("breakage.json", "content of breakage.csv, and the impacts that were re-run at prototype scale"),
    ("impacts", "folder with the fracture case and the results of each re-run impact"),
    ("gauges.csv", "gauge series of the particle domain"),
    ("flume_gauges.csv", "gauge series of the flume model"),
    ("energy.csv", "energy balance of water and units"),
    ("diagnostics.csv", "checks of the run: volume, Mach number and density of the water, time steps"),
    ("profile.csv", "bed profile with the mound"),
    ("summary.json", "the results on this page as JSON, for other programs"),
    ("case.json", "the case that was run"),
];

pub fn files(run: &RunFolder) -> String {
    let rows: String = (FILES.iter().filter(|(name, _)| run.has(name)))
        .map(|(name, what)| format!("<tr><td><code>{name}</code></td><td>{what}</td></tr>\n"))
        .collect();
    let words = "<p>Tables are CSV files in SI units; each column name includes the unit. Flume time 0 is the start of \
                 the wavemaker.</p>\n";
    section("Files of this run", &format!("{words}<table class=\"facts\"><tbody>\n{rows}</tbody></table>\n"))
}

/// Returns the symbol of the wave height in the summary: H_s for irregular waves (significant height), otherwise H.
pub fn height_symbol(wave: &WaveSummary) -> &'static str {
    if wave.kind == "irregular" { "H_s" } else { "H" }
}

/// Describes the width and the side boundaries of the particle domain.
fn width_and_sides(summary: &Summary) -> String {
    let sides = if summary.side_walls { "with side walls" } else { "periodic across the flume" };
    match summary.two_dimensional {
        true => "two-dimensional".to_owned(),
        false => format!("{} m wide, {sides}", short(summary.domain_width_m, 3)),
    }
}
