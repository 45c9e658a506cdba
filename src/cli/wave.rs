//! `breakwater wave`: the flume model alone.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{Trouble, fresh_folder, load, stem};
use crate::{
    case::{Wave, Wavemaker},
    output::{OutputError, write_atomically, write_flume_gauges, write_wave_page},
    simulation::incoming::{ml_piston, particle_start, run_flume},
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
}

impl WaveArguments {
    pub(super) fn execute(self) -> Result<(), Trouble> {
        let case = load(&self.case)?;
        let refuse = |reason: &str| Err(Trouble::refused(format!("{}: {reason}", self.case.display())));
        if matches!(case.wave, Wave::Given(_)) {
            return refuse("wave.kind: the wave comes from files of another program, so that no flume model runs");
        }
        if case.wave != Wave::None && case.wavemaker != Wavemaker::MlPiston {
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
            write_wave_page(&case, &record, &piston, &dir)
        };
        let page = write().map_err(Trouble::failed)?;
        println!("wavemaker of the particles at x = {} m, from flume time {start:.2} s", case.domain.x[0]);
        let gauges = case.gauges.iter().filter(|gauge| gauge.quantity == crate::case::Quantity::Elevation);
        for (number, gauge) in gauges.enumerate() {
            let (height, time) = record.crest(number);
            println!("  {:8} x = {:6.2} m: crest {:.4} m at {time:.2} s", gauge.name, gauge.at[0], height);
        }
        println!("water kept to {:.1e} of its volume", record.volume_error);
        println!("plot: {}", page.display());
        Ok(())
    }
}
