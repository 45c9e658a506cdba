//! Comparison of the flume model with another program at one gauge.

use super::{surface::SurfaceSeries, table::linear};
use crate::waves::flume_model::record::FlumeRecord;

/// Difference between the surface elevations of another program and of the flume model at a gauge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Comparison {
    /// Crest elevation of the other program above still water level [m].
    pub crest_m: f64,
    /// Time of the crest of the other program [s].
    pub crest_s: f64,
    /// Crest elevation of the other program divided by the crest elevation of the flume model, minus 1 [-].
    pub relative_height_difference: f64,
    /// Delay of the crest relative to the flume model [s]; positive if the crest of the other program is later.
    pub delay_s: f64,
    /// RMS difference of the two elevations, divided by the crest elevation of the flume model [-]. It is taken over
    /// the times of the other program that lie within the flume run.
    pub relative_rms: f64,
}

impl Comparison {
    /// Compares `other`, from another program, with the flume model at a gauge. `still_level_m` is the still water
    /// level z of `other` [m]. `None` if both series have no common time or the flume model has no crest at the gauge.
    pub fn new(record: &FlumeRecord, gauge: usize, other: &SurfaceSeries, still_level_m: f64) -> Option<Self> {
        let (flume_m, flume_s) = record.crest(gauge);
        let (top_m, crest_s) = other.crest();
        let crest_m = top_m - still_level_m;
        let series = &record.gauge_elevations_m[gauge];
        let common = other.points().filter(|[t, _]| (0.0..=record.end_s()).contains(t));
        let differences = common.map(|[t, z]| z - still_level_m - linear(record.times_s(), series, t));
        let (count, sum) = differences.fold((0, 0.0), |(count, sum), d| (count + 1, sum + d * d));
        let relative_rms = (sum / f64::from(count)).sqrt() / flume_m;
        let compared = Self {
            crest_m,
            crest_s,
            relative_height_difference: crest_m / flume_m - 1.0,
            delay_s: crest_s - flume_s,
            relative_rms,
        };
        (count > 0 && flume_m > 0.0).then_some(compared)
    }
}
