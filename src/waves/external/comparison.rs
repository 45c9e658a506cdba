//! The flume model beside another program, at one gauge.

use super::surface::SurfaceSeries;
use crate::waves::record::FlumeRecord;

/// How another program's surface at a gauge differs from the flume model's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Comparison {
    /// Its highest elevation above the still water [m].
    pub crest_m: f64,
    /// When that comes [s].
    pub crest_s: f64,
    /// Height of its crest over the flume model's, less one [-].
    pub height: f64,
    /// How much later its crest comes [s].
    pub delay_s: f64,
    /// Root mean square of the difference at its own times, those which the flume model covers, over the flume model's
    /// crest [-].
    pub rms: f64,
}

impl Comparison {
    /// Compare a series with the flume model's at a gauge, in still water of the level [m].
    pub fn new(record: &FlumeRecord, gauge: usize, other: &SurfaceSeries, still_level_m: f64) -> Self {
        let (ours_m, ours_s) = record.crest(gauge);
        let (top_m, crest_s) = other.crest();
        let crest_m = top_m - still_level_m;
        let differences = other.points().filter(|[t, _]| (0.0..=record.end_s()).contains(t)).map(|[t, z]| {
            let place = t / record.interval_s;
            let series = &record.gauge_elevations_m[gauge];
            let before = (place as usize).min(series.len() - 2);
            let ours = series[before] + (place - before as f64) * (series[before + 1] - series[before]);
            z - still_level_m - ours
        });
        let (count, sum) = differences.fold((0, 0.0), |(count, sum), d| (count + 1, sum + d * d));
        let rms = (sum / f64::from(count.max(1))).sqrt() / ours_m;
        Self { crest_m, crest_s, height: crest_m / ours_m - 1.0, delay_s: crest_s - ours_s, rms }
    }
}
