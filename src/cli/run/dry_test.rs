//! Runs dry tests and prints their results.

use std::{path::Path, sync::Arc};

use super::{CommandError, MOST_LINES, breakage, command_error};
use crate::cli::counted;
use crate::{
    case::DryTestCase,
    output::{
        driver::{Control, RunError},
        progress::readable,
    },
    simulation::dry_test::{
        run::{resume, run},
        summary::DryTestSummary,
    },
};

/// Runs a dry test from its start, then the breakage analysis if the case has the key `breakage`.
pub(super) fn run_case(case: &Arc<DryTestCase>, dir: &Path, control: &Control) -> Result<(), CommandError> {
    introduce(case, dir, control.quiet);
    let summary = finish(run(case.clone(), dir, control), dir, control)?;
    breakage::after_dry_test(case, &summary, dir, control)
}

/// Continues a dry test from its last checkpoint, then makes the breakage analysis if the case has the key `breakage`.
pub(super) fn resume_case(case: &Arc<DryTestCase>, dir: &Path, control: &Control) -> Result<(), CommandError> {
    introduce(case, dir, control.quiet);
    let summary = finish(resume(case.clone(), dir, control), dir, control)?;
    breakage::after_dry_test(case, &summary, dir, control)
}

fn introduce(case: &DryTestCase, dir: &Path, quiet: bool) {
    if quiet {
        return;
    }
    let (units, threads) = (&case.units, rayon::current_num_threads());
    eprintln!("{}", case.title);
    for group in &units.groups {
        let (count, kind) = (counted(group.members.len(), "unit"), group.shape().kind.name());
        eprintln!("  {count} ({kind}) of {} kg", group.mass);
    }
    eprintln!("  {} s at most, on {threads} threads", case.stop.duration);
    case.assumptions.iter().for_each(|assumption| eprintln!("  assumed: {assumption}"));
    eprintln!("  results in {}", dir.display());
}

/// Prints the results of a dry test and returns its summary.
fn finish(
    ended: Result<DryTestSummary, RunError>,
    dir: &Path,
    control: &Control,
) -> Result<DryTestSummary, CommandError> {
    let summary = ended.map_err(|error| command_error(error, dir))?;
    if !control.silent {
        tell(&summary, dir);
    }
    Ok(summary)
}

fn tell(summary: &DryTestSummary, dir: &Path) {
    println!(
        "{:.2} s simulated in {} substeps and {} ({})",
        summary.simulated_s,
        summary.substeps,
        readable(summary.execution.wall_s),
        summary.stopped
    );
    for unit in summary.units.iter().take(MOST_LINES) {
        print!(
            "  unit {:2}: moved {:.4} m, sank {:.4} m, turned {:.1} degrees",
            unit.unit, unit.moved_m, unit.sank_m, unit.turned_deg
        );
        match (unit.slides_at_deg, unit.friction) {
            (Some(angle), Some(friction)) => println!(", slides at {angle:.2} degrees, tangent {friction:.4}"),
            _ => println!(),
        }
    }
    if summary.units.len() > MOST_LINES {
        println!("  ... {} units in total, see units.csv", summary.units.len());
    }
    println!(
        "  {} contacts, deepest overlap {:.3} % of the height, kinetic energy {:.1e} J",
        summary.contacts_now,
        100.0 * summary.deepest_overlap,
        summary.kinetic_j
    );
    println!("summary: {}; units.vtkhdf opens in ParaView", dir.join(DryTestSummary::FILE).display());
}
