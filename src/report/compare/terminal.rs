//! The comparison with measurements as text for the terminal.

use std::fmt;

use super::{Comparison, RunResult, WaveComparison};
use crate::case::Series;

/// Minimum width of a column with numbers [characters].
const COLUMN: usize = 9;
/// Width of the first column [characters].
const LABEL: usize = 14;

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: horizontal displacement [m]", self.title)?;
        self.waves.iter().try_for_each(|wave| write_wave(f, wave))?;
        self.notes.iter().try_for_each(|note| writeln!(f, "{note}"))
    }
}

fn write_wave(f: &mut fmt::Formatter<'_>, wave: &WaveComparison) -> fmt::Result {
    let reference = &wave.reference;
    writeln!(f, "\n{}", wave.title())?;
    let widest =
        |names: &mut dyn Iterator<Item = &str>| names.map(|name| name.chars().count() + 2).fold(COLUMN, usize::max);
    let column = widest(&mut reference.series.iter().map(|series| series.name.as_str()));
    let width = widest(&mut wave.runs.iter().map(|run| run.name.as_str()));
    let rule = "-".repeat(LABEL + reference.series.len() * column + wave.runs.len() * width);

    write!(f, "{:LABEL$}", "unit")?;
    reference.series.iter().try_for_each(|series| write!(f, "{:>column$}", series.name))?;
    wave.runs.iter().try_for_each(|run| write!(f, "{:>width$}", run.name))?;
    writeln!(f, "\n{rule}")?;
    for unit in wave.units() {
        write!(f, "{unit:LABEL$}")?;
        wave.reference_m(unit).try_for_each(|value| write_number(f, column, value))?;
        wave.runs.iter().try_for_each(|run| write_number(f, width, wave.run_m(run, unit)))?;
        writeln!(f)?;
    }
    writeln!(f, "{rule}")?;
    write!(f, "{:LABEL$}", "mean [m]")?;
    reference.series.iter().try_for_each(|series| write_number(f, column, Some(series.mean_m())))?;
    wave.runs.iter().try_for_each(|run| write_number(f, width, Some(run.mean_m)))?;
    write!(f, "\n{:LABEL$}", "damaged [%]")?;
    let damaged = |series: &Series| 100.0 * reference.damage_ratio(&series.displacement_m);
    reference.series.iter().try_for_each(|series| write!(f, "{:>column$.0}", damaged(series)))?;
    wave.runs.iter().try_for_each(|run| write!(f, "{:>width$.0}", 100.0 * run.damage_ratio))?;
    if wave.has_breakage() {
        // Measurements have no value for breakage, because the units of a physical model do not break.
        write!(f, "\n{:LABEL$}{:>2$}", "broken [%]", "", reference.series.len() * column)?;
        let ratio = |run: &RunResult| run.breakage.as_ref().map(|breakage| 100.0 * breakage.broken_ratio);
        wave.runs.iter().try_for_each(|run| match ratio(run) {
            Some(percent) => write!(f, "{percent:>width$.0}"),
            None => write!(f, "{:>width$}", "-"),
        })?;
    }
    write!(f, "\n{:LABEL$}", "deviation [%]")?;
    reference.series.iter().try_for_each(|series| match wave.published_deviation_percent(series) {
        Some(percent) => write!(f, "{percent:>+column$.1}"),
        None => write!(f, "{:>column$}", ""),
    })?;
    wave.runs.iter().try_for_each(|run| write!(f, "{:>+width$.1}", run.deviation_percent))?;
    let (repetitions, mean) = (reference.measured().count(), reference.measured_mean_m());
    writeln!(f, "\n\nMeasured mean displacement ({repetitions} repetitions): {mean:.3} m.")?;
    write_resolutions(f, wave)?;
    wave.remarks().iter().try_for_each(|remark| writeln!(f, "{remark}"))
}

/// Writes the deviation of the mean displacement for each particle spacing: published simulations, then the runs.
fn write_resolutions(f: &mut fmt::Formatter<'_>, wave: &WaveComparison) -> fmt::Result {
    writeln!(f, "Deviation of the mean displacement from the measured mean, for each particle spacing:")?;
    for resolution in &wave.reference.convergence {
        let dp = 1000.0 * resolution.dp_m;
        write!(f, "  {dp:>5.1} mm {:>+8.1} %  published", resolution.deviation_percent)?;
        resolution.particles.map_or(Ok(()), |number| write!(f, ", {:.1} million particles", 1e-6 * number))?;
        resolution.runtime_h.map_or(Ok(()), |hours| write!(f, ", {hours:.1} h"))?;
        writeln!(f)?;
    }
    for run in &wave.runs {
        let dp = 1000.0 * run.summary.dp_m;
        write!(f, "  {dp:>5.1} mm {:>+8.1} %  {}, ", run.deviation_percent, run.name)?;
        let hours = run.summary.execution.wall_s / 3600.0;
        writeln!(f, "{:.1} million particles, {hours:.1} h", 1e-6 * run.summary.particles as f64)?;
    }
    Ok(())
}

fn write_number(f: &mut fmt::Formatter<'_>, width: usize, value: Option<f64>) -> fmt::Result {
    match value {
        Some(value) => write!(f, "{value:>width$.3}"),
        None => write!(f, "{:>width$}", "-"),
    }
}
