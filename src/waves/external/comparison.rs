//! The flume model beside another program, at one gauge.

use super::{surface::SurfaceSeries, table::linear};
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
    /// Compare a series with the flume model's at a gauge, in still water of the level [m]; `None` if they have no
    /// time in common or the flume model shows no crest there.
    pub fn new(record: &FlumeRecord, gauge: usize, other: &SurfaceSeries, still_level_m: f64) -> Option<Self> {
        let (ours_m, ours_s) = record.crest(gauge);
        let (top_m, crest_s) = other.crest();
        let crest_m = top_m - still_level_m;
        let series = &record.gauge_elevations_m[gauge];
        let common = other.points().filter(|[t, _]| (0.0..=record.end_s()).contains(t));
        let differences = common.map(|[t, z]| z - still_level_m - linear(record.times_s(), series, t));
        let (count, sum) = differences.fold((0, 0.0), |(count, sum), d| (count + 1, sum + d * d));
        let rms = (sum / f64::from(count)).sqrt() / ours_m;
        let compared = Self { crest_m, crest_s, height: crest_m / ours_m - 1.0, delay_s: crest_s - ours_s, rms };
        (count > 0 && ours_m > 0.0).then_some(compared)
    }
}
