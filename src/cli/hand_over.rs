//! `breakwater hand-over`: the hardest impacts of a run, computed again with units that break.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{AnyCase, Trouble, load_any, run::MachineArguments};
use crate::{
    case::{Case, DryCase, Handover},
    output::{BreakageSummary, OutputError, Summary},
    report::run::write_report,
    simulation::{
        breakage::{
            model::Model,
            results::{Breakage, Moved, state_in_words},
            run::{FOLDER, hand_over},
        },
        dry_test::summary::DrySummary,
    },
};

/// Do the units break? Computes the hardest impacts of a finished run again, at the scale of the prototype, with units that
/// deform and crack, as the case's `fracture` says. `run` does so at its end; this goes on after an interruption, or
/// once more with another `fracture` in the run's case.json.
#[derive(Args)]
pub struct HandOverArguments {
    /// Folder of the run.
    dir: PathBuf,
    #[command(flatten)]
    machine: MachineArguments,
}

impl HandOverArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let case = load_any(&self.dir.join("case.json"))?;
        let options = self.machine.prepare()?;
        let has_one = match &case {
            AnyCase::Wet(case) => case.fracture.is_some(),
            AnyCase::Dry(case) => case.fracture.is_some(),
        };
        if !has_one {
            let what = "has no `fracture`: write there what the units are made of, and run the case again";
            return Err(Trouble::refused(format!("{}: {what}", self.dir.join("case.json").display())));
        }
        match &case {
            AnyCase::Wet(case) => {
                let summary = Summary::read(&self.dir).map_err(Trouble::refused)?;
                of_run(case, &summary, &self.dir, options.quiet)
            }
            AnyCase::Dry(case) => {
                let summary = DrySummary::read(&self.dir).map_err(Trouble::refused)?;
                of_dry_run(case, &summary, &self.dir, options.quiet)
            }
        }
    }
}

/// Hand the impacts of a finished run with water over, if its case says so.
pub(super) fn of_run(case: &Case, summary: &Summary, dir: &Path, quiet: bool) -> Result<(), Trouble> {
    let (Some(handover), Some(model)) = (&case.fracture, Model::of_case(case)) else { return Ok(()) };
    let moved = |unit: &crate::output::UnitSummary| Moved { displacement: unit.displacement_m, damaged: unit.damaged };
    let moved: Vec<Moved> = summary.units.iter().map(moved).collect();
    let ended = go(&model, handover, &moved, dir, quiet);
    // With what there is.
    let told = tell_in_files(summary, dir).map_err(Trouble::failed);
    ended.and(told)
}

/// Take what came of the impacts into summary and report of a run with water.
fn tell_in_files(summary: &Summary, dir: &Path) -> Result<(), OutputError> {
    let breakage = Breakage::read_if_present(dir)?;
    Summary { breakage: breakage.as_ref().map(BreakageSummary::from), ..summary.clone() }.write(dir)?;
    write_report(dir).map(drop)
}

/// Hand the impacts of a finished dry run over, if its case says so.
pub(super) fn of_dry_run(case: &DryCase, summary: &DrySummary, dir: &Path, quiet: bool) -> Result<(), Trouble> {
    let Some(handover) = &case.fracture else { return Ok(()) };
    let limit = case.units.damage_distance;
    let moved = |unit: &crate::simulation::dry_test::summary::DryUnit| Moved {
        displacement: unit.moved_m,
        damaged: unit.moved_m > limit,
    };
    let moved: Vec<Moved> = summary.units.iter().map(moved).collect();
    go(&Model::of_dry(case), handover, &moved, dir, quiet)
}

fn go(model: &Model, handover: &Handover, moved: &[Moved], dir: &Path, quiet: bool) -> Result<(), Trouble> {
    if !quiet {
        eprintln!("impacts at the scale of the prototype, {} times as long:", handover.scale);
    }
    let breakage = hand_over(model, handover, moved, dir, quiet).map_err(Trouble::failed)?;
    tell(&breakage, dir);
    let lost: Vec<String> = breakage
        .impacts
        .iter()
        .filter_map(|impact| impact.failure.as_ref().map(|failure| format!("{}: {failure}", impact.name)))
        .collect();
    if lost.is_empty() { Ok(()) } else { Err(Trouble::failed(lost.join("\n"))) }
}

/// Units whose row is printed.
const MOST_LINES: usize = 20;

fn tell(breakage: &Breakage, dir: &Path) {
    println!("units of the prototype:");
    for unit in breakage.units.iter().take(MOST_LINES) {
        print!("  unit {:2}: hit with {:.3} MN", unit.unit, unit.peak_force_n * 1e-6);
        if let Some(stress) = unit.nominal_stress_pa {
            print!(", nominal stress {:.2} MPa", stress * 1e-6);
        }
        match (unit.sigma_1_pa, unit.crack_area_m2, unit.broken) {
            (Some(sigma_1), Some(area), Some(broken)) => {
                let state = state_in_words(broken, area);
                println!(", sigma_1 {:.2} MPa, {area:.3} m2 of cracks, {state}", sigma_1 * 1e-6);
            }
            _ => println!(", not handed over"),
        }
    }
    if breakage.units.len() > MOST_LINES {
        println!("  ... {} units in all, see {}", breakage.units.len(), Breakage::TABLE);
    }
    println!(
        "  {:.0} % moved further than the damage distance, {:.0} % broke",
        100.0 * breakage.damaged_ratio,
        100.0 * breakage.broken_ratio
    );
    println!("cases and results: {}; table: {}", dir.join(FOLDER).display(), dir.join(Breakage::TABLE).display());
}
