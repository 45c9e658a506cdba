//! The comparison as text for a terminal.

use std::fmt;

use super::published::{MEASURED, SERIES};
use super::{Comparison, RunResult, WaveComparison};

/// Width of a column.
const COLUMN: usize = 9;

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "Tetrapods on a PVC mound, Mitsui et al. (2023): displacement seen from above [m]")?;
        self.waves.iter().try_for_each(|wave| write_wave(f, wave))
    }
}

fn write_wave(f: &mut fmt::Formatter<'_>, wave: &WaveComparison) -> fmt::Result {
    let published = &wave.published;
    writeln!(f, "\nSolitary wave H = {:.1} cm", 100.0 * published.height_m)?;
    let width = wave.runs.iter().map(|run| run.name.chars().count() + 2).fold(COLUMN, usize::max);
    let rule = "-".repeat(12 + SERIES.len() * COLUMN + wave.runs.len() * width);

    write!(f, "{:12}", "unit")?;
    SERIES.iter().try_for_each(|name| write!(f, "{name:>COLUMN$}"))?;
    wave.runs.iter().try_for_each(|run| write!(f, "{:>width$}", run.name))?;
    writeln!(f, "\n{rule}")?;
    for place in wave.places() {
        write!(f, "{place:12}")?;
        (0..SERIES.len()).try_for_each(|series| write_number(f, COLUMN, wave.published_m(series, place)))?;
        wave.runs.iter().try_for_each(|run| write_number(f, width, wave.run_m(run, place)))?;
        writeln!(f)?;
    }
    writeln!(f, "{rule}")?;
    write!(f, "{:12}", "mean [m]")?;
    (0..SERIES.len()).try_for_each(|series| write_number(f, COLUMN, Some(published.mean_m(series))))?;
    wave.runs.iter().try_for_each(|run| write_number(f, width, Some(run.mean_m)))?;
    write!(f, "\n{:12}", "damaged [%]")?;
    (0..SERIES.len()).try_for_each(|series| write!(f, "{:>COLUMN$.0}", 100.0 * published.damage_ratio(series)))?;
    wave.runs.iter().try_for_each(|run| write!(f, "{:>width$.0}", 100.0 * run.damage_ratio))?;
    if wave.tells_breakage() {
        // Nothing was published about breakage: units of the flume do not break.
        write!(f, "\n{:12}{:>2$}", "broken [%]", "", SERIES.len() * COLUMN)?;
        let ratio = |run: &RunResult| run.breakage.as_ref().map(|breakage| 100.0 * breakage.broken_ratio);
        wave.runs.iter().try_for_each(|run| match ratio(run) {
            Some(percent) => write!(f, "{percent:>width$.0}"),
            None => write!(f, "{:>width$}", "-"),
        })?;
    }
    write!(f, "\n{:12}", "vs EXP [%]")?;
    for series in 0..SERIES.len() {
        let deviation = 100.0 * (published.mean_m(series) / published.measured_mean_m() - 1.0);
        if series < MEASURED { write!(f, "{:>COLUMN$}", "")? } else { write!(f, "{deviation:>+COLUMN$.1}")? }
    }
    wave.runs.iter().try_for_each(|run| write!(f, "{:>+width$.1}", run.deviation_percent))?;
    writeln!(f, "\n\nEXP: mean of the three repetitions, {:.3} m.", published.measured_mean_m())?;
    write_resolutions(f, wave)?;
    for remark in wave.remarks() {
        writeln!(f, "{remark}")?;
    }
    Ok(())
}

/// Deviation of the mean at each resolution: published and of the runs.
fn write_resolutions(f: &mut fmt::Formatter<'_>, wave: &WaveComparison) -> fmt::Result {
    writeln!(f, "Deviation of the mean displacement from EXP by distance between particles:")?;
    for resolution in &wave.published.convergence {
        let dp = 1000.0 * resolution.dp_m;
        write!(f, "  {dp:>5.1} mm {:>+8.1} %  published (SPH1), ", resolution.deviation_percent)?;
        writeln!(f, "{:.1} million particles, {:.1} h", 1e-6 * resolution.particles, resolution.runtime_h)?;
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
