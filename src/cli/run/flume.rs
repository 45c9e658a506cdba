//! Runs flume cases and prints their results.

use std::{path::Path, sync::Arc};

use super::{CommandError, MOST_LINES, breakage, command_error, report_error};
use crate::{
    case::{Case, Reference},
    output::{
        GroupSummary, Summary,
        driver::{Control, RunError},
        progress::readable,
    },
    report::run::write_report,
    simulation::flume::{
        branch::Start,
        run::{RunOptions, resume, run},
    },
};

/// Runs a case from its start or from the checkpoint of another run, then the breakage analysis if the case has the key
/// `breakage`.
pub(super) fn run_case(
    case: &Arc<Case>,
    start: Option<Start>,
    dir: &Path,
    options: &RunOptions,
) -> Result<(), CommandError> {
    introduce(case, dir, options);
    let ended = match start {
        Some(start) => start.run(dir, options),
        None => run(case.clone(), dir, options),
    };
    let summary = finish(ended, dir, &options.control)?;
    breakage::after_flume_run(case, &summary, dir, &options.control)
}

/// Continues a flume run from its last checkpoint, then makes the breakage analysis if the case has the key `breakage`.
pub(super) fn resume_case(case: &Arc<Case>, dir: &Path, options: &RunOptions) -> Result<(), CommandError> {
    introduce(case, dir, options);
    let summary = finish(resume(case.clone(), dir, options), dir, &options.control)?;
    breakage::after_flume_run(case, &summary, dir, &options.control)
}

fn introduce(case: &Case, dir: &Path, options: &RunOptions) {
    if options.control.quiet {
        return;
    }
    let estimate = case.estimate();
    eprintln!("{}", case.title);
    eprintln!(
        "  about {:.0} thousand particles, dp = {} m, {} s in about {:.0} steps on {}, {} threads",
        estimate.particles() / 1e3,
        case.domain.dp,
        case.stop.duration,
        estimate.steps,
        options.device.name(),
        rayon::current_num_threads()
    );
    for assumption in &case.assumptions {
        eprintln!("  assumed: {assumption}");
    }
    eprintln!("  results in {}", dir.display());
}

/// Writes the report of a run, prints the results and returns the summary.
pub(in crate::cli) fn finish(
    ended: Result<Summary, RunError>,
    dir: &Path,
    control: &Control,
) -> Result<Summary, CommandError> {
    let summary = ended.map_err(|error| command_error(error, dir))?;
    let report = write_report(dir).map_err(|error| report_error(error, dir))?;
    if !control.silent {
        tell(&summary, &report, dir);
    }
    Ok(summary)
}

fn tell(summary: &Summary, report: &Path, dir: &Path) {
    println!(
        "{:.2} s simulated in {} steps and {} ({})",
        summary.simulated_s,
        summary.steps,
        readable(summary.execution.wall_s),
        summary.stopped
    );
    for unit in summary.units.iter().take(MOST_LINES) {
        let damaged = if unit.damaged { ", damaged" } else { "" };
        println!("  unit {:2}: moved {:.3} m{damaged}", unit.unit, unit.displacement_m);
    }
    if summary.units.len() > MOST_LINES {
        println!("  ... {} units in total, see summary.json", summary.units.len());
    }
    for group in summary.groups.iter().filter(|group| !group.fixed && summary.groups.len() > 1) {
        let GroupSummary { name, mean_displacement_m, damage_ratio, .. } = group;
        println!("  {name}: mean displacement {mean_displacement_m:.3} m, damage ratio {:.0} %", 100.0 * damage_ratio);
    }
    if let (Some(mean), Some(ratio)) = (summary.mean_displacement_m, summary.damage_ratio) {
        println!("  mean displacement {mean:.3} m, damage ratio {:.0} %", 100.0 * ratio);
    }
    for group in summary.groups.iter().filter(|group| !group.fixed) {
        println!(
            "  {}: {} displaced (N_od {:.2}), {} rocking (N_or {:.2}), N_omov {:.2}",
            group.name, group.displaced, group.n_od, group.rocking, group.n_or, group.n_omov
        );
    }
    for gauge in summary.force_gauges.iter().take(MOST_LINES) {
        println!("  force gauge {}", gauge.name);
        for component in gauge.components() {
            let ([largest, at], [smallest, then], name) = (component.largest, component.smallest, component.name);
            let impulse = component.impulse_n_s.map_or(String::new(), |impulse| format!(", impulse {impulse:.4} N s"));
            println!("    {name}: largest {largest:.4} at {at:.3} s, smallest {smallest:.4} at {then:.3} s{impulse}");
        }
    }
    if summary.force_gauges.len() > MOST_LINES {
        println!("  ... {} force gauges in total, see summary.json", summary.force_gauges.len());
    }
    println!("report: {}", report.display());
    if Reference::folder_of_run(dir).is_some() {
        println!("compare with the measurements: breakwater compare {}", dir.display());
    }
}
