//! `breakwater place`: places the units of armour layers and heaps.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{CommandError, input::read};
use crate::{
    case::{InputKind, LayerJob, Layers, Placing},
    output::write_atomically,
    simulation::armour_layer::{ArmourLayers, Packing, PlacedGroup, PlacementError, place},
};

/// `place` warns if the overlap of two bodies at the end, divided by the height of a unit [-], exceeds this value.
const GOOD_OVERLAP: f64 = 0.01;

/// Place armour layers and heaps: lower the units of layers one by one onto the slope, let those of a heap fall, and
/// wait until all are at rest.
///
/// The poses (positions and rotations) are written to a placement file. Cases name this file as `units.placement_file`.
#[derive(Args)]
pub struct PlaceArguments {
    /// The case file; it must have the key `units.armour` or `units.heap`.
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
        let counts: Vec<usize> = job.placings.iter().map(|placing| job.count_of(placing)).collect();
        let (count, quiet) = (counts.iter().sum::<usize>(), self.quiet);
        if !quiet {
            eprintln!("{}", job.title);
            for (placing, count) in job.placings.iter().zip(&counts) {
                let name = &job.units.groups[placing.group()].name;
                match placing {
                    Placing::Heap(_) => eprintln!("  {name}: heap of {count} units"),
                    Placing::Layers(Layers { armour, .. }) => {
                        let (number, density) = (armour.layers, armour.packing_density);
                        eprintln!("  {name}: {count} units in {number} layers, packing density {density}");
                    }
                }
            }
        }
        let tell = |placed: usize, time: f64| {
            if !quiet && (placed.is_multiple_of(25) || placed == count) {
                eprintln!("  {placed} of {count} units placed, {time:.2} s simulated");
            }
        };
        let placed = place(&job, tell).map_err(|error| match error {
            PlacementError::NoRoom { .. } => CommandError::refused(format!("{}: {error}", self.case.display())),
            PlacementError::Rigid(_) => CommandError::failed(error),
        })?;
        let file = placed.file(&job.title, job.units.groups.len());
        let mut text = serde_json::to_string_pretty(&file).map_err(CommandError::failed)?;
        text.push('\n');
        write_atomically(&out, text.as_bytes()).map_err(CommandError::failed)?;
        tell_result(&placed, &out);
        let incomplete = |group: &PlacedGroup| Some((group.name.clone(), group.packing.filter(|p| !p.is_complete())?));
        match placed.groups.iter().find_map(incomplete) {
            None => Ok(()),
            Some((name, Packing { density, wanted, rolled_off, .. })) => Err(CommandError::failed(format!(
                "{}: {name}: the packing density is {density:.3} instead of {wanted:.3}, and {rolled_off} units rolled \
                 off; support the toe of the layers with fixed units or an obstacle, make the slope flatter, or ask for a \
                 smaller packing density. The placement is in {}",
                self.case.display(),
                out.display()
            ))),
        }
    }
}

fn tell_result(placed: &ArmourLayers, out: &Path) {
    for PlacedGroup { name, units, packing } in &placed.groups {
        let count = units.len();
        match packing {
            None => println!("{name}: {count} units"),
            Some(Packing { density, rolled_off, .. }) => {
                println!("{name}: {count} units, packing density {density:.3}, {rolled_off} units rolled off");
            }
        }
    }
    println!(
        "  settled in {:.2} s of simulated time; {} contacts, deepest overlap {:.3} % of the height; fastest unit {:.1e} \
         m/s, kinetic energy {:.1e} times the released potential energy",
        placed.time,
        placed.contacts,
        100.0 * placed.deepest_overlap,
        placed.fastest,
        placed.unrest
    );
    if placed.deepest_overlap > GOOD_OVERLAP {
        eprintln!("warning: units overlap by more than 1 % of their height; use a stiffer material");
    }
    println!("{}: add \"placement_file\": {:?} to the placed groups of `units`", out.display(), name_of(out));
}

fn name_of(path: &Path) -> String {
    path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default()
}
