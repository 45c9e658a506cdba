//! `breakwater wave`: runs the flume model without particles.

use std::path::{Path, PathBuf};

use clap::Args;

use super::{
    CommandError,
    folder::{fresh_folder, stem},
    input::{read, show_warnings},
};
use crate::{
    case::{Case, InputKind, Quantity, Wave},
    output::{OutputError, write_atomically, write_flume_gauges, write_flume_piston},
    report::wave_page::write_wave_page,
    simulation::flume::wave::incoming::{ml_piston, particle_start, run_flume},
    waves::external::{
        comparison::Comparison,
        openfoam::{Frame, Up, gauges},
    },
};

/// Compute only the wave in the flume, without particles (takes seconds): gauges, wavemaker motion and a plot.
#[derive(Args)]
pub struct WaveArguments {
    /// The case file.
    case: PathBuf,
    /// Folder of the results; default: runs/NAME-wave, with the name of the case file.
    #[arg(long)]
    out: Option<PathBuf>,
    /// Replace the results in the folder; default: a folder with files is refused.
    #[arg(long)]
    overwrite: bool,
    /// Compare with an OpenFOAM run (z upwards); default: no comparison.
    ///
    /// FOLDER is the folder postProcessing of the OpenFOAM run. It has one folder per gauge with vertical probes of
    /// alpha.water, as tools/openfoam writes them. FOLDER can also be the folder of the function object
    /// interfaceHeight, whose locations are the elevation gauges of the case in the same order.
    #[arg(long, value_name = "FOLDER")]
    beside: Option<PathBuf>,
}

impl WaveArguments {
    pub(super) fn execute(self) -> Result<(), CommandError> {
        let case = Case::from_document(&read(&self.case, &[InputKind::Flume])?).map_err(CommandError::refused)?;
        show_warnings(&case.warnings);
        let refuse = |reason: &str| Err(CommandError::refused(format!("{}: {reason}", self.case.display())));
        if matches!(case.wave, Wave::External(_)) {
            return refuse("wave.kind: the wave is read from files of another program; this case has no flume model");
        }
        if case.wave != Wave::None && !case.wavemaker.follows_flume_model() {
            return refuse(
                "wavemaker.kind: the paddle makes the wave in the particle domain; this case has no flume model. \
                 `breakwater check` shows the wavelength and the stroke",
            );
        }
        let Some(record) = run_flume(&case).map_err(CommandError::refused)? else {
            return refuse("wave: the case has no wave; add one, e.g. {\"kind\": \"solitary\", \"height_m\": 0.045}");
        };
        let elevations = || case.gauges.iter().filter(|gauge| gauge.quantity == Quantity::Elevation);
        let names: Vec<&str> = elevations().map(|gauge| gauge.name.as_str()).collect();
        let frame = Frame { up: Up::Z, origin_z_m: 0.0 };
        let beside = match &self.beside {
            Some(_) if names.is_empty() => {
                return refuse("gauges: --beside needs at least one gauge of kind \"elevation\"");
            }
            Some(folder) => gauges::read(folder, &names, "alpha.water", frame).map_err(CommandError::refused)?,
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
        let page = write().map_err(CommandError::failed)?;
        println!("particle domain: wavemaker at x = {} m, start at flume time {start:.2} s", case.domain.x[0]);
        for (number, gauge) in elevations().enumerate() {
            let (height, time) = record.crest(number);
            println!("  {:8} x = {:6.2} m: crest {:.4} m at {time:.2} s", gauge.name, gauge.at[0], height);
            let Some(series) = beside.get(number) else { continue };
            match Comparison::new(&record, number, series, case.flume.still_water_level) {
                Some(other) => println!(
                    "  {:22} OpenFOAM {:.4} m ({:+.1} %) at {:.2} s ({:+.2} s); rms difference {:.1} % of the crest",
                    "",
                    other.crest_m,
                    100.0 * other.relative_height_difference,
                    other.crest_s,
                    other.delay_s,
                    100.0 * other.relative_rms
                ),
                None => println!("  {:22} OpenFOAM: no common time range, or no wave", ""),
            }
        }
        println!("relative error of the water volume: {:.1e}", record.volume_error);
        println!("plot: {}", page.display());
        Ok(())
    }
}
