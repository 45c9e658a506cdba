//! `breakwater wave`: the flume model alone.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{
    Trouble,
    folder::{fresh_folder, stem},
    input::load,
};
use crate::{
    case::{Quantity, Wave},
    output::{OutputError, write_atomically, write_flume_gauges, write_flume_piston},
    report::wave_page::write_wave_page,
    simulation::flume::incoming::{ml_piston, particle_start, run_flume},
    waves::external::{
        comparison::Comparison,
        openfoam::{Frame, Up, gauges},
    },
};

/// Run the wave along the flume without particles, in seconds: gauges, the ML-piston's motion and a plot.
#[derive(Args)]
pub struct WaveArguments {
    /// The case file.
    case: PathBuf,
    /// Folder of the results; without it, runs/<name of the case>-wave.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Replace what the folder holds.
    #[arg(long)]
    overwrite: bool,
    /// Compare with OpenFOAM (z pointing up): its folder postProcessing with probes of alpha.water on a vertical in a
    /// folder for each gauge of the case, as tools/openfoam leaves it; or that of the function object interfaceHeight,
    /// whose locations are the gauges in their order.
    #[arg(long, value_name = "FOLDER")]
    beside: Option<PathBuf>,
}

impl WaveArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let case = load(&self.case)?;
        let refuse = |reason: &str| Err(Trouble::refused(format!("{}: {reason}", self.case.display())));
        if matches!(case.wave, Wave::Given(_)) {
            return refuse("wave.kind: the wave comes from files of another program, so that no flume model runs");
        }
        if case.wave != Wave::None && !case.wavemaker.is_ml_piston() {
            return refuse(
                "wavemaker.kind: the wave is made in the particles, so that no flume model runs; `breakwater check` shows \
                 the wave's length and the paddle's stroke",
            );
        }
        let Some(record) = run_flume(&case).map_err(Trouble::refused)? else {
            return refuse(
                "wave: the case has no wave; give it one, e.g. {\"kind\": \"solitary\", \"height_m\": 0.045}",
            );
        };
        let elevations = || case.gauges.iter().filter(|gauge| gauge.quantity == Quantity::Elevation);
        let names: Vec<&str> = elevations().map(|gauge| gauge.name.as_str()).collect();
        let frame = Frame { up: Up::Z, origin_z_m: 0.0 };
        let beside = match &self.beside {
            Some(_) if names.is_empty() => {
                return refuse("gauges: --beside needs gauges of the kind \"elevation\" to compare by");
            }
            Some(folder) => gauges::read(folder, &names, "alpha.water", frame).map_err(Trouble::refused)?,
            None => Vec::new(),
        };
        let dir = self.out.unwrap_or_else(|| Path::new("runs").join(format!("{}-wave", stem(&self.case))));
        fresh_folder(&dir, self.overwrite)?;
        let start = particle_start(&case, Some(&record));
        let piston = ml_piston(&case, &record, start);
        let write = || -> Result<PathBuf, OutputError> {
            write_flume_gauges(&case, &record, &dir.join("flume_gauges.csv"))?;
            let path = dir.join("ml_piston_velx.csv");
            let mut table = Vec::new();
            piston.write_velx(&mut table).map_err(OutputError::io(&path))?;
            write_atomically(&path, &table)?;
            if let Wave::Solitary(wave) = &case.wave {
                write_flume_piston(wave, &dir.join("flume_piston.csv"))?;
            }
            write_wave_page(&case, &record, &piston, &beside, &dir)
        };
        let page = write().map_err(Trouble::failed)?;
        println!("wavemaker of the particles at x = {} m, from flume time {start:.2} s", case.domain.x[0]);
        for (number, gauge) in elevations().enumerate() {
            let (height, time) = record.crest(number);
            println!("  {:8} x = {:6.2} m: crest {:.4} m at {time:.2} s", gauge.name, gauge.at[0], height);
            let Some(series) = beside.get(number) else { continue };
            match Comparison::new(&record, number, series, case.flume.still_level) {
                Some(other) => println!(
                    "  {:22} beside it {:.4} m ({:+.1} %) at {:.2} s ({:+.2} s); rms difference {:.1} % of the crest",
                    "",
                    other.crest_m,
                    100.0 * other.height,
                    other.crest_s,
                    other.delay_s,
                    100.0 * other.rms
                ),
                None => println!("  {:22} beside it: no time in common, or no wave", ""),
            }
        }
        println!("water kept to {:.1e} of its volume", record.volume_error);
        println!("plot: {}", page.display());
        Ok(())
    }
}
