//! Times at which an output is due.

use serde::{Deserialize, Serialize};

/// An output that is due at regular times; part of every checkpoint.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Schedule {
    /// Number of outputs so far.
    pub count: u64,
    /// Time between outputs [s]; `None` for an output that is never due.
    interval: Option<f64>,
    /// Time from which the intervals count [s]: the start of the run, or the time at which the interval changed.
    from: f64,
    /// Number of outputs at this time.
    before: u64,
    /// Number of intervals from this time to the next output: 0 if an output is due at this time.
    skipped: u64,
}

impl Schedule {
    /// Returns the schedule of an output that is due at the start of the run and then at every interval [s].
    pub fn every(interval: Option<f64>) -> Self {
        Self { count: 0, interval, from: 0.0, before: 0, skipped: 0 }
    }

    /// Returns the schedule of an output that is never due.
    pub fn never() -> Self {
        Self::every(None)
    }

    /// Returns the schedule of an output that is first due after one interval [s].
    pub fn after_every(interval: Option<f64>) -> Self {
        Self { skipped: 1, ..Self::every(interval) }
    }

    /// Returns true if the output is due at `time` [s].
    pub fn is_due(&self, time: f64) -> bool {
        let intervals = (self.count - self.before + self.skipped) as f64;
        // The tolerance covers rounding errors of `time`.
        self.interval.is_some_and(|interval| time >= self.from + intervals * interval - 1e-12)
    }

    /// Changes the interval [s] at `time` [s]: the next output is due one new interval later. The same interval changes
    /// nothing.
    pub fn set_interval(&mut self, interval: Option<f64>, time: f64) {
        if interval != self.interval {
            *self = Self { count: self.count, interval, from: time, before: self.count, skipped: 1 };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the times at which an output is due in time steps of 0.125 s, from `from` to `to` [s].
    fn due(schedule: &mut Schedule, from: f64, to: f64) -> Vec<f64> {
        let steps = ((to - from) / 0.125) as u64;
        let times = (0..=steps).map(|step| from + 0.125 * step as f64);
        times
            .filter(|time| {
                let is_due = schedule.is_due(*time);
                schedule.count += u64::from(is_due);
                is_due
            })
            .collect()
    }

    #[test]
    fn outputs_are_due_at_every_interval() {
        let mut schedule = Schedule::every(Some(0.25));
        assert_eq!(due(&mut schedule, 0.0, 0.5), [0.0, 0.25, 0.5]);
        assert_eq!(due(&mut Schedule::after_every(Some(0.25)), 0.0, 0.5), [0.25, 0.5]);
        assert!(due(&mut Schedule::every(None), 0.0, 9.0).is_empty());
    }

    #[test]
    fn a_new_interval_counts_from_its_change() {
        let mut schedule = Schedule::every(Some(0.25));
        due(&mut schedule, 0.0, 0.5);
        let unchanged = schedule;
        schedule.set_interval(Some(0.25), 0.6);
        assert_eq!(schedule, unchanged);
        schedule.set_interval(Some(0.5), 0.625);
        assert_eq!(due(&mut schedule, 0.625, 2.125), [1.125, 1.625, 2.125]);
        schedule.set_interval(None, 2.125);
        assert!(due(&mut schedule, 2.125, 9.0).is_empty());
        schedule.set_interval(Some(1.0), 9.0);
        assert_eq!(due(&mut schedule, 9.0, 11.0), [10.0, 11.0]);
    }
}
