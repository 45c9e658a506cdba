//! `breakwater breakage`: the hardest impacts of a run, re-run at prototype scale with breakable units.

use std::path::{Path, PathBuf};

use clap::Args;

use super::Trouble;
use crate::{
    case::{Case, DryCase, Handover},
    cli::{
        input::{AnyCase, load_any},
        machine::MachineArguments,
    },
    output::{BreakageSummary, Summary, UnitSummary, driver::Control},
    report::{fracture::write_fracture_report, run::write_report},
    simulation::{
        breakage::{
            model::Model,
            results::{Breakage, Moved, state_in_words},
            run::{FOLDER, hand_over},
        },
        dry_test::summary::{DrySummary, DryUnit},
    },
};

/// Re-run the hardest impacts of a finished run at prototype scale, with units that can break.
///
/// Settings: `fracture` in the case. `run` does this at its end; use this command to continue after an interruption, or
/// to repeat it after a change of `fracture` in the case.json of the run.
#[derive(Args)]
pub struct BreakageArguments {
    /// Folder of the run.
    dir: PathBuf,
    #[command(flatten)]
    machine: MachineArguments,
}

impl BreakageArguments {
    pub(in crate::cli) fn execute(self) -> Result<(), Trouble> {
        let file = self.dir.join("case.json");
        let case = load_any(&file)?;
        let control = self.machine.prepare()?;
        let asks = match &case {
            AnyCase::Wet(case) => case.fracture.is_some(),
            AnyCase::Dry(case) => case.fracture.is_some(),
        };
        if !asks {
            let what = "has no `fracture`; add it with the material of the units to the case, and rerun the case";
            return Err(Trouble::refused(format!("{}: {what}", file.display())));
        }
        match &case {
            AnyCase::Wet(case) => {
                let summary = Summary::read(&self.dir).map_err(Trouble::refused)?;
                after_flume_run(case, &summary, &self.dir, &control)
            }
            AnyCase::Dry(case) => {
                let summary = DrySummary::read(&self.dir).map_err(Trouble::refused)?;
                after_dry_test(case, &summary, &self.dir, &control)
            }
        }
    }
}

/// Analyses breakage after a flume run, if its case asks for it; then writes summary and report again with the results.
pub(in crate::cli) fn after_flume_run(
    case: &Case,
    summary: &Summary,
    dir: &Path,
    control: &Control,
) -> Result<(), Trouble> {
    let (Some(settings), Some(model)) = (&case.fracture, Model::of_case(case)) else { return Ok(()) };
    let moved = |unit: &UnitSummary| Moved { displacement: unit.displacement_m, damaged: unit.damaged };
    let moved: Vec<Moved> = summary.units.iter().map(moved).collect();
    let ended = analyse(&model, settings, &moved, dir, control);
    // Also after a failure: the report then shows the impacts that were computed.
    let breakage = Breakage::read_if_present(dir).map_err(Trouble::failed)?;
    let summary = Summary { breakage: breakage.as_ref().map(BreakageSummary::from), ..summary.clone() };
    summary.write(dir).and_then(|()| write_report(dir)).map_err(Trouble::failed)?;
    ended
}

/// Analyses breakage after a dry test, if its case asks for it.
pub(super) fn after_dry_test(
    case: &DryCase,
    summary: &DrySummary,
    dir: &Path,
    control: &Control,
) -> Result<(), Trouble> {
    let Some(settings) = &case.fracture else { return Ok(()) };
    let limit = case.units.damage_distance;
    let moved = |unit: &DryUnit| Moved { displacement: unit.moved_m, damaged: unit.moved_m > limit };
    let moved: Vec<Moved> = summary.units.iter().map(moved).collect();
    analyse(&Model::of_dry(case), settings, &moved, dir, control)
}

fn analyse(model: &Model, settings: &Handover, moved: &[Moved], dir: &Path, control: &Control) -> Result<(), Trouble> {
    if !control.quiet {
        eprintln!("impacts re-run at prototype scale, length scale {}:", settings.scale);
    }
    let breakage = hand_over(model, settings, moved, dir, control).map_err(Trouble::failed)?;
    for impact in breakage.impacts.iter().filter(|impact| impact.failure.is_none()) {
        write_fracture_report(&dir.join(FOLDER).join(&impact.name)).map_err(Trouble::failed)?;
    }
    tell(&breakage, dir);
    let failures: Vec<String> = breakage
        .impacts
        .iter()
        .filter_map(|impact| impact.failure.as_ref().map(|failure| format!("{}: {failure}", impact.name)))
        .collect();
    if failures.is_empty() { Ok(()) } else { Err(Trouble::failed(failures.join("\n"))) }
}

/// Largest number of units that are printed.
const MOST_LINES: usize = 20;

fn tell(breakage: &Breakage, dir: &Path) {
    println!("units of the prototype:");
    for unit in breakage.units.iter().take(MOST_LINES) {
        print!("  unit {:2}: largest impact force {:.3} MN", unit.unit, unit.peak_force_n * 1e-6);
        if let Some(stress) = unit.nominal_stress_pa {
            print!(", nominal stress {:.2} MPa", stress * 1e-6);
        }
        match (unit.sigma_1_pa, unit.crack_area_m2, unit.broken) {
            (Some(sigma_1), Some(area), Some(broken)) => {
                let state = state_in_words(broken, area);
                println!(", sigma_1 {:.2} MPa, {area:.3} m2 of cracks, {state}", sigma_1 * 1e-6);
            }
            _ => println!(", no impact re-run"),
        }
    }
    if breakage.units.len() > MOST_LINES {
        println!("  ... {} units in all, see {}", breakage.units.len(), Breakage::TABLE);
    }
    println!(
        "  {:.0} % of the units moved further than the damage distance, {:.0} % broke",
        100.0 * breakage.damaged_ratio,
        100.0 * breakage.broken_ratio
    );
    println!("cases and results: {}; table: {}", dir.join(FOLDER).display(), dir.join(Breakage::TABLE).display());
}
