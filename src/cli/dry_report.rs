//! What the terminal shows of a dry run.

use std::path::Path;

use super::Trouble;
use crate::{
    case::DryCase,
    output::progress::readable,
    simulation::dry_test::{
        run::DryError,
        summary::{DrySummary, Ended},
    },
};

/// Units whose motion is printed: a pile is not read unit by unit.
const MOST_LINES: usize = 20;

/// Say what is to be run.
pub(super) fn introduce(case: &DryCase, dir: &Path, quiet: bool) {
    if quiet {
        return;
    }
    let (units, threads) = (&case.units, rayon::current_num_threads());
    eprintln!("{}", case.title);
    eprintln!(
        "  {} units ({}) of {} kg, {} s at most, on {threads} threads",
        units.placements.len(),
        units.shape.kind.name(),
        units.mass,
        case.stop.duration
    );
    case.assumptions.iter().for_each(|assumption| eprintln!("  assumed: {assumption}"));
    eprintln!("  results in {}", dir.display());
}

/// Say how a dry run ended.
pub(super) fn finish(ended: Result<DrySummary, DryError>, dir: &Path) -> Result<DrySummary, Trouble> {
    let summary = match ended {
        Ok(summary) => summary,
        Err(error @ DryError::Setup(_)) => return Err(Trouble::refused(error)),
        Err(error) => return Err(Trouble::failed(error)),
    };
    let why = match summary.stopped {
        Ended::Duration => "time of the case over",
        Ended::AtRest => "units at rest",
        Ended::TestOver => "test over",
    };
    println!(
        "{:.2} s simulated in {} substeps and {} ({why})",
        summary.simulated_s,
        summary.substeps,
        readable(summary.execution.wall_s)
    );
    for unit in summary.units.iter().take(MOST_LINES) {
        print!("  unit {:2}: moved {:.4} m, turned {:.1} degrees", unit.unit, unit.moved_m, unit.turned_deg);
        match (unit.slides_at_deg, unit.friction) {
            (Some(angle), Some(friction)) => println!(", slides at {angle:.2} degrees (tangent {friction:.4})"),
            _ => println!(),
        }
    }
    if summary.units.len() > MOST_LINES {
        println!("  ... {} units in all, see units.csv", summary.units.len());
    }
    println!(
        "  {} contacts, deepest overlap {:.3} % of the height, kinetic energy {:.1e} J",
        summary.contacts_now,
        100.0 * summary.deepest_overlap,
        summary.kinetic_j
    );
    println!("summary: {}; units.vtkhdf opens in ParaView", dir.join(DrySummary::FILE).display());
    Ok(summary)
}
