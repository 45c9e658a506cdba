//! CSV tables of the flume model: surface elevation at the gauges, and motion of the piston.

use std::path::Path;

use super::{CsvSeries, OutputError, columns};
use crate::{
    case::{Case, Quantity},
    waves::{flume_model::record::FlumeRecord, theory::solitary::SolitaryWave},
};

/// Maximum time between two rows in the table of the piston motion [s].
const PISTON_INTERVAL: f64 = 0.02;

/// Writes a CSV table with the surface elevation in the flume model at the elevation gauges of the case.
///
/// # Errors
/// If the file cannot be written.
pub fn write_flume_gauges(case: &Case, record: &FlumeRecord, path: &Path) -> Result<(), OutputError> {
    let gauges = case.gauges.iter().filter(|gauge| gauge.quantity == Quantity::Elevation);
    let names: Vec<String> =
        ["time_s".to_owned()].into_iter().chain(gauges.map(|gauge| columns::elevation(&gauge.name))).collect();
    let mut series = CsvSeries::create(path, &names)?;
    let row = |(k, &time): (usize, &f64)| -> Vec<f64> {
        [time].into_iter().chain(record.gauge_elevations_m.iter().map(|gauge| gauge[k])).collect()
    };
    series.append_rows(record.times_s().iter().enumerate().map(row))
}

/// Writes a CSV table with the motion of the piston in the flume model, from the start to the end of the stroke.
///
/// # Errors
/// If the file cannot be written.
pub fn write_flume_piston(wave: &SolitaryWave, path: &Path) -> Result<(), OutputError> {
    let mut series = CsvSeries::create(path, &["time_s", "displacement_m", "velocity_m_s"])?;
    let steps = (wave.duration_s() / PISTON_INTERVAL).ceil();
    let time = |k: u32| f64::from(k) / steps * wave.duration_s();
    let row = |t: f64| [t, wave.piston_displacement_m(t), wave.piston_velocity_m_s(t)];
    series.append_rows((0..=steps as u32).map(|k| row(time(k))))
}
