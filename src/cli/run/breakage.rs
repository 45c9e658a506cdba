//! `breakwater breakage`: re-runs the hardest impacts of a run at prototype scale with breakable units.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{CommandError, MOST_LINES};
use crate::{
    case::{BreakageSettings, Case, DryTestCase, InputFile, InputKind},
    cli::{
        input::{load_run, other_kind},
        machine::MachineArguments,
    },
    output::{BreakageSummary, Summary, UnitSummary, driver::Control},
    report::{fracture::write_fracture_report, run::write_report},
    simulation::{
        breakage::{
            model::Model,
            results::{Breakage, Moved, state_in_words},
            run::{FOLDER, analyse_breakage},
        },
        dry_test::summary::{DryTestSummary, DryUnit},
    },
};

/// Do the units break? Re-run the hardest impacts of a finished run at prototype scale, with units that deform and
/// crack.
///
/// The key `breakage` of the case has the settings. If the case has this key, `breakwater run` makes the analysis at
/// the end of the run. This command continues an interrupted analysis, or repeats the analysis after you have changed
/// `breakage` in the file case.json of the run.
#[derive(Args)]
pub struct BreakageArguments {
    /// Folder of the run.
    dir: PathBuf,
    #[command(flatten)]
    machine: MachineArguments,
}

impl BreakageArguments {
    pub(in crate::cli) fn execute(self) -> Result<(), CommandError> {
        let case = load_run(&self.dir, &[InputKind::Flume, InputKind::DryTest])?;
        let control = self.machine.prepare()?;
        match case {
            InputFile::Flume(case) if case.breakage.is_some() => {
                let summary = Summary::read(&self.dir).map_err(CommandError::refused)?;
                after_flume_run(&case, &summary, &self.dir, &control)
            }
            InputFile::DryTest(case) if case.breakage.is_some() => {
                let summary = DryTestSummary::read(&self.dir).map_err(CommandError::refused)?;
                after_dry_test(&case, &summary, &self.dir, &control)
            }
            InputFile::Flume(_) | InputFile::DryTest(_) => {
                let what = "has no key `breakage`; add it with the material of the units, and run the case again";
                Err(CommandError::refused(format!("{}: {what}", self.dir.join("case.json").display())))
            }
            other => Err(other_kind(&self.dir, other.kind())),
        }
    }
}

/// Analyses breakage after a flume run if the case has the key `breakage`. Then writes summary and report again, with
/// the results of the analysis.
pub(in crate::cli) fn after_flume_run(
    case: &Case,
    summary: &Summary,
    dir: &Path,
    control: &Control,
) -> Result<(), CommandError> {
    let (Some(settings), Some(model)) = (&case.breakage, Model::of_case(case)) else { return Ok(()) };
    let moved = |unit: &UnitSummary| Moved { displacement: unit.displacement_m, damaged: unit.damaged };
    let moved: Vec<Moved> = summary.units.iter().map(moved).collect();
    let ended = analyse(&model, settings, &moved, dir, control);
    // The results are read even after a failure, so that the report shows the impacts that were computed.
    let breakage = Breakage::read_if_present(dir).map_err(CommandError::failed)?;
    let summary = Summary { breakage: breakage.as_ref().map(BreakageSummary::from), ..summary.clone() };
    summary.write(dir).and_then(|()| write_report(dir)).map_err(CommandError::failed)?;
    ended
}

/// Analyses breakage after a dry test if the case has the key `breakage`.
pub(super) fn after_dry_test(
    case: &DryTestCase,
    summary: &DryTestSummary,
    dir: &Path,
    control: &Control,
) -> Result<(), CommandError> {
    let Some(settings) = &case.breakage else { return Ok(()) };
    let limits = case.units.groups[0].limits;
    let moved =
        |unit: &DryUnit| Moved { displacement: unit.moved_m, damaged: limits.is_damaged(unit.start_m, unit.end_m) };
    let moved: Vec<Moved> = summary.units.iter().map(moved).collect();
    analyse(&Model::of_dry(case), settings, &moved, dir, control)
}

fn analyse(
    model: &Model,
    settings: &BreakageSettings,
    moved: &[Moved],
    dir: &Path,
    control: &Control,
) -> Result<(), CommandError> {
    if !control.quiet {
        eprintln!("impacts re-run at prototype scale, length scale {}:", settings.scale);
    }
    let breakage = analyse_breakage(model, settings, moved, dir, control).map_err(CommandError::failed)?;
    for impact in breakage.impacts.iter().filter(|impact| impact.failure.is_none()) {
        write_fracture_report(&dir.join(FOLDER).join(&impact.name)).map_err(CommandError::failed)?;
    }
    if !control.silent {
        tell(&breakage, dir);
    }
    let failures: Vec<String> = breakage
        .impacts
        .iter()
        .filter_map(|impact| impact.failure.as_ref().map(|failure| format!("{}: {failure}", impact.name)))
        .collect();
    if failures.is_empty() { Ok(()) } else { Err(CommandError::failed(failures.join("\n"))) }
}

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
            _ => println!(", none of its impacts was re-run"),
        }
    }
    if breakage.units.len() > MOST_LINES {
        println!("  ... {} units in total, see {}", breakage.units.len(), Breakage::TABLE);
    }
    println!(
        "  {:.0} % of the units moved further than the damage distance, {:.0} % broke",
        100.0 * breakage.damaged_ratio,
        100.0 * breakage.broken_ratio
    );
    println!("cases and results: {}; table: {}", dir.join(FOLDER).display(), dir.join(Breakage::TABLE).display());
}
