//! `breakwater place`: places the units of armour layers without water.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{CommandError, input::read};
use crate::{
    case::{InputKind, LayerJob},
    output::write_atomically,
    simulation::armour_layer::{PlacementError, place},
};

/// `place` warns if the overlap of two bodies at the end, divided by the height of a unit [-], exceeds this value.
const GOOD_OVERLAP: f64 = 0.01;

/// Place armour layers: lower the units of a case one by one onto the slope, without water, until they are at rest.
///
/// The poses (positions and rotations) are written to a placement file. Cases name this file as `units.placement_file`.
#[derive(Args)]
pub struct PlaceArguments {
    /// The case file; it must have the key `units.armour`.
    case: PathBuf,
    /// The placement file; default: the case file with the extension `.placement.json`.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Replace an existing placement file; default: the command is refused if the file exists.
    #[arg(long)]
    overwrite: bool,
    /// Show no progress; default: progress is shown.
    #[arg(long)]
    quiet: bool,
}

impl PlaceArguments {
    pub(super) fn execute(self) -> Result<(), CommandError> {
        let document = read(&self.case, &[InputKind::Flume, InputKind::DryTest])?;
        let job = LayerJob::from_document(&document).map_err(CommandError::refused)?;
        let out = self.out.unwrap_or_else(|| self.case.with_extension("placement.json"));
        if out.exists() && !self.overwrite {
            let what = "exists already; add --overwrite to replace it, or choose another file with --out FILE";
            return Err(CommandError::refused(format!("{}: {what}", out.display())));
        }
        let (count, quiet) = (job.count(), self.quiet);
        if !quiet {
            let (layers, density) = (job.armour.layers, job.armour.packing_density);
            eprintln!("{}\n  {count} units in {layers} layers, packing density {density}", job.title);
        }
        let tell = |placed: usize, time: f64| {
            if !quiet && (placed.is_multiple_of(25) || placed == count) {
                eprintln!("  {placed} of {count} units placed, {time:.2} s simulated");
            }
        };
        let placement = place(&job, tell).map_err(|error| match error {
            PlacementError::NoRoom { .. } => CommandError::refused(format!("{}: {error}", self.case.display())),
            PlacementError::Rigid(_) => CommandError::failed(error),
        })?;
        let mut text = serde_json::to_string_pretty(&placement.file(&job.title)).map_err(CommandError::failed)?;
        text.push('\n');
        write_atomically(&out, text.as_bytes()).map_err(CommandError::failed)?;
        println!("{} units settled in {:.2} s of simulated time", placement.units.len(), placement.time);
        println!("  packing density {:.3}, {} units rolled off", placement.packing_density, placement.rolled_off);
        println!(
            "  {} contacts, deepest overlap {:.3} % of the height; fastest unit {:.1e} m/s, kinetic energy {:.1e} \
             times the released potential energy",
            placement.contacts,
            100.0 * placement.deepest_overlap,
            placement.fastest,
            placement.unrest
        );
        if placement.deepest_overlap > GOOD_OVERLAP {
            eprintln!("warning: units overlap by more than 1 % of their height; use a stiffer material");
        }
        println!("{}: add \"placement_file\": {:?} to `units` of the case", out.display(), name_of(&out));
        Ok(())
    }
}

fn name_of(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}
