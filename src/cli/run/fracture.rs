//! `breakwater fracture`: runs fracture cases and prints their results.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{CommandError, command_error, report_error};
use crate::{
    case::{FractureCase, InputKind},
    cli::{
        folder::{fresh_folder, stem},
        input::{read, show_warnings},
        machine::MachineArguments,
    },
    femdem::world::World,
    output::{
        driver::{Control, RunError},
        progress::readable,
    },
    report::fracture::write_fracture_report,
    simulation::fracture::{
        detail::tets_bytes,
        run::{resume, run, world},
        summary::FractureSummary,
    },
};

/// Run a fracture case: deformable bodies of tetrahedra that collide and crack.
///
/// The results are written to one folder: energy balance, surfaces with stresses, cracks, summary and report.
#[derive(Args)]
pub struct FractureArguments {
    /// The fracture case file.
    case: PathBuf,
    /// Folder of the results; default: runs/NAME, with the name of the case file.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Replace the results in the folder; default: a folder with files is refused.
    #[arg(long)]
    overwrite: bool,
    #[command(flatten)]
    machine: MachineArguments,
}

impl FractureArguments {
    pub(in crate::cli) fn execute(self) -> Result<(), CommandError> {
        let document = read(&self.case, &[InputKind::Fracture])?;
        let case = FractureCase::from_document(&document).map_err(CommandError::refused)?;
        show_warnings(&case.warnings);
        let dir = self.out.unwrap_or_else(|| Path::new("runs").join(stem(&self.case)));
        run_case(&case, &self.case, &dir, self.overwrite, &self.machine.prepare()?)
    }
}

/// Runs a fracture case from its start; `path` names the case file in errors.
pub(super) fn run_case(
    case: &FractureCase,
    path: &Path,
    dir: &Path,
    overwrite: bool,
    control: &Control,
) -> Result<(), CommandError> {
    let world = at_start(case, path)?;
    fresh_folder(dir, overwrite)?;
    introduce(case, dir, control);
    finish(run(case, world, dir, control), dir, control)
}

/// Continues an interrupted fracture run from its last checkpoint.
pub(super) fn resume_case(case: &FractureCase, dir: &Path, control: &Control) -> Result<(), CommandError> {
    let world = at_start(case, &dir.join("case.json"))?;
    introduce(case, dir, control);
    finish(resume(case, world, dir, control), dir, control)
}

/// Builds the initial state of a fracture case; `path` names the case file in errors.
fn at_start(case: &FractureCase, path: &Path) -> Result<World, CommandError> {
    world(case).map_err(|error| CommandError::refused(format!("{}: {error}", path.display())))
}

fn introduce(case: &FractureCase, dir: &Path, control: &Control) {
    if !control.quiet {
        eprintln!("{}\n  results in {}", case.title, dir.display());
        case.assumptions.iter().for_each(|assumption| eprintln!("  assumed: {assumption}"));
    }
}

/// Writes the report of a run and prints the results.
fn finish(ended: Result<FractureSummary, RunError>, dir: &Path, control: &Control) -> Result<(), CommandError> {
    let summary = ended.map_err(|error| command_error(error, dir))?;
    let report = write_fracture_report(dir).map_err(|error| report_error(error, dir))?;
    if !control.silent {
        tell(&summary, dir);
        println!("report: {}", report.display());
    }
    Ok(())
}

/// Prints mesh, joints, time step and file size of a fracture case.
pub(in crate::cli) fn check(case: &FractureCase, path: &Path) -> Result<(), CommandError> {
    let world = at_start(case, path)?;
    println!("{}: {}", path.display(), case.title);
    for quality in &case.mesh.quality {
        println!(
            "  {:10}  {} tetrahedra, {:.4} m3, edges {:.1} to {:.1} mm, smallest angle {:.1} degrees",
            quality.body,
            quality.tets,
            quality.volume,
            quality.edge_min * 1e3,
            quality.edge_max * 1e3,
            quality.angle_min_deg
        );
    }
    println!(
        "  joints      {} faces that can crack, {} cracked at the start",
        world.joints.count(),
        case.setup.cracks.len()
    );
    println!(
        "  time step   {:.3e} s, {:.0} steps for {} s",
        world.dt,
        (case.duration / world.dt).ceil(),
        case.duration
    );
    if case.tets_interval.is_some() {
        println!("  tets.vtkhdf {:.0} MB, more if cracks separate nodes", tets_bytes(case) * 1e-6);
    }
    Ok(())
}

fn tell(summary: &FractureSummary, dir: &Path) {
    println!(
        "{:.3} ms simulated in {} steps and {}, {:.2e} tetrahedra times steps per second",
        summary.simulated_s * 1e3,
        summary.steps,
        readable(summary.execution.wall_s),
        summary.tet_steps_per_s
    );
    for (number, initiation) in summary.initiation.iter().enumerate() {
        let [x, y, z] = initiation.place;
        println!(
            "  crack {} in {}: starts after {:.3} ms at ({x:.3}, {y:.3}, {z:.3}) m, {}, final area {:.1} cm2",
            number + 1,
            initiation.body,
            initiation.t_s * 1e3,
            initiation.mode,
            initiation.area_m2 * 1e4
        );
    }
    println!(
        "  crack area {:.1} cm2, {} pieces, energy residual {:.2} % of the peak kinetic energy",
        summary.crack_area_m2 * 1e4,
        summary.fragments.len(),
        100.0 * summary.energy_residual_ratio
    );
    println!("summary: {}; surfaces.vtkhdf and cracks.vtkhdf open in ParaView", dir.join("summary.json").display());
}
