//! Contact force against time in bounded memory.
//!
//! The force f is stored in time bins, each with its impulse. When there are too many bins, neighbouring bins are
//! merged. The pair with the smallest squared change of the force is merged first. This change is the integral of
//! (f - f_merged)^2 over time, |f_1 - f_2|^2 d_1 d_2 / (d_1 + d_2), with the mean forces f_1 and f_2 and the durations
//! d_1 and d_2 of the two bins. Impulses add up, so merging conserves the total impulse.

use glam::DVec3;
use serde::{Deserialize, Serialize};

/// Largest number of bins after merging.
pub const KEPT: usize = 64;

/// Number of bins that triggers merging.
const GROWN: usize = 128;

/// A force is added to the last bin if it differs from the mean force of the bin by at most this fraction of the peak
/// force [-]. A body at rest therefore needs few bins.
const SAME: f64 = 1e-3;

/// The bin with the peak force is merged only if the merged bin keeps at least this fraction of the peak force [-].
const PEAK_KEPT: f64 = 0.98;

/// A bin of a force history.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(from = "[f64; 5]", into = "[f64; 5]")]
pub struct ForceSample {
    /// Start time [s].
    pub start: f64,
    /// Duration [s].
    pub duration: f64,
    /// Integral of the force over the duration of the bin [N s].
    pub impulse: DVec3,
}

impl ForceSample {
    /// Mean force [N].
    pub fn force(&self) -> DVec3 {
        self.impulse / self.duration
    }

    /// Returns true if the mean force differs from `force` by at most `tolerance` [N].
    fn is_about(&self, force: DVec3, tolerance: f64) -> bool {
        (force * self.duration - self.impulse).length_squared() <= (tolerance * self.duration).powi(2)
    }

    /// Returns this bin merged with the next bin.
    fn with(&self, next: &Self) -> Self {
        let duration = self.duration + next.duration;
        Self { start: self.start, duration, impulse: self.impulse + next.impulse }
    }

    /// Least-squares change of the force if this bin is merged with the next bin [N2 s].
    fn cost(&self, next: &Self) -> f64 {
        let shared = self.duration * next.duration / (self.duration + next.duration);
        (self.force() - next.force()).length_squared() * shared
    }
}

impl From<[f64; 5]> for ForceSample {
    fn from([start, duration, x, y, z]: [f64; 5]) -> Self {
        Self { start, duration, impulse: DVec3::new(x, y, z) }
    }
}

impl From<ForceSample> for [f64; 5] {
    fn from(sample: ForceSample) -> Self {
        let [x, y, z] = sample.impulse.to_array();
        [sample.start, sample.duration, x, y, z]
    }
}

/// The last bin of a force history while it grows: all that most substeps need of the history.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GrowingBin {
    bin: ForceSample,
    /// Largest mean force of a substep in the history [N].
    peak: f64,
}

impl GrowingBin {
    /// Adds a substep that lasts `duration` [s], with its mean force [N], if the force is about that of the bin. Returns
    /// false if it is not; [`ForceHistory::add`] then adds the substep.
    pub fn add(&mut self, start: f64, duration: f64, force: DVec3) -> bool {
        let fits = self.bin.duration > 0.0
            && duration > 0.0
            && force.length_squared() <= self.peak * self.peak
            && self.bin.is_about(force, SAME * self.peak);
        if fits {
            self.bin = self.bin.with(&ForceSample { start, duration, impulse: force * duration });
        }
        fits
    }
}

/// Force on a body against time.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ForceHistory {
    /// Bins in time order, without gaps.
    samples: Vec<ForceSample>,
    /// Largest mean force of a substep [N].
    peak: f64,
    /// Index of the bin with the peak.
    peak_bin: usize,
}

impl ForceHistory {
    /// Bins up to now, in time order and without gaps: fewer than 128 bins, at most 64 after [`Self::shorten`].
    pub fn samples(&self) -> &[ForceSample] {
        &self.samples
    }

    /// Returns a copy of the last bin, for [`Self::store`].
    pub fn growing(&self) -> GrowingBin {
        let none = ForceSample { start: 0.0, duration: 0.0, impulse: DVec3::ZERO };
        GrowingBin { bin: self.samples.last().copied().unwrap_or(none), peak: self.peak }
    }

    /// Replaces the last bin by what has become of it.
    pub fn store(&mut self, growing: &GrowingBin) {
        if let Some(last) = self.samples.last_mut() {
            *last = growing.bin;
        }
    }

    /// Adds a substep that begins at `start` [s] and lasts `duration` [s], with its mean force [N].
    pub fn add(&mut self, start: f64, duration: f64, force: DVec3) {
        if duration <= 0.0 {
            return;
        }
        let new = ForceSample { start, duration, impulse: force * duration };
        // This function runs for every contact in every substep. To save time, it avoids roots and divisions.
        let largest = force.length_squared() > self.peak * self.peak;
        if largest {
            self.peak = force.length();
        }
        match self.samples.last_mut() {
            Some(last) if last.is_about(force, SAME * self.peak) => *last = last.with(&new),
            _ => self.samples.push(new),
        }
        if largest {
            self.peak_bin = self.samples.len() - 1;
        }
        if self.samples.len() >= GROWN {
            self.shorten();
        }
    }

    /// Merges neighbouring bins until at most `KEPT` are left.
    pub fn shorten(&mut self) {
        let mut costs: Vec<f64> = (1..self.samples.len()).map(|next| self.cost(next)).collect();
        while self.samples.len() > KEPT {
            let cheapest =
                (1..costs.len()).fold(0, |least, index| if costs[index] < costs[least] { index } else { least });
            self.samples[cheapest] = self.samples[cheapest].with(&self.samples[cheapest + 1]);
            self.samples.remove(cheapest + 1);
            costs.remove(cheapest);
            if self.peak_bin > cheapest {
                self.peak_bin -= 1;
            }
            // This also updates the costs next to the peak bin, whose index may have changed.
            for next in cheapest.max(1)..=(cheapest + 1).min(self.samples.len() - 1) {
                costs[next - 1] = self.cost(next);
            }
        }
    }

    /// Cost of merging bin `next` with the bin before it [N2 s]; infinite if the merged bin would lose the peak.
    fn cost(&self, next: usize) -> f64 {
        let [before, after] = [&self.samples[next - 1], &self.samples[next]];
        let holds_peak = self.peak_bin == next || self.peak_bin + 1 == next;
        if holds_peak && before.with(after).force().length() < PEAK_KEPT * self.peak {
            return f64::INFINITY;
        }
        before.cost(after)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// A half-sine of 1 ms and 1000 N between two 5 s intervals with a few newtons.
    fn force(time: f64) -> DVec3 {
        let weak = DVec3::new(0.1 * (3.0 * time).sin(), 0.0, 2.0 + (40.0 * time).sin());
        let phase = (time - 5.0) / 1e-3;
        let spike = if (0.0..1.0).contains(&phase) { 1000.0 * (PI * phase).sin() } else { 0.0 };
        weak + DVec3::Z * spike
    }

    #[test]
    fn short_spike_keeps_impulse_peak_and_shape() {
        let (mut history, mut impulse) = (ForceHistory::default(), DVec3::ZERO);
        let dt = 2e-5;
        for step in 0..500_000 {
            let start = f64::from(step) * dt;
            let now = force(start + 0.5 * dt);
            history.add(start, dt, now);
            impulse += now * dt;
            assert!(history.samples().len() < GROWN);
        }
        history.shorten();
        let samples = history.samples();
        assert!(samples.len() <= KEPT);
        let kept: DVec3 = samples.iter().map(|s| s.impulse).sum();
        // 1e-9 allows for the rounding errors of half a million additions.
        assert!((kept - impulse).length() < 1e-9 * impulse.length(), "{kept} {impulse}");
        let hardest = samples.iter().map(|s| s.force().length()).fold(0.0, f64::max);
        assert!((PEAK_KEPT * 1000.0..1004.0).contains(&hardest), "{hardest}");
        // The bins of the spike are about 30 us long. They differ from the true force by less than a tenth of the peak.
        let spike = samples.iter().filter(|s| s.start > 4.9999 && s.start + s.duration < 5.0011);
        let (mut count, mut error) = (0, 0.0_f64);
        for sample in spike {
            count += 1;
            let steps = (sample.duration / dt).round() as usize;
            let at = |k: usize| sample.start + (k as f64 + 0.5) * dt;
            error = (0..steps).map(|k| (force(at(k)) - sample.force()).length()).fold(error, f64::max);
        }
        println!("{count} samples of the spike, error {error:.1} N");
        assert!(count > 20 && error < 100.0, "{count} {error}");
        for pair in samples.windows(2) {
            assert!((pair[0].start + pair[0].duration - pair[1].start).abs() < 1e-9);
        }
    }

    #[test]
    fn constant_force_uses_one_sample() {
        let mut history = ForceHistory::default();
        for step in 0..10_000 {
            history.add(1e-3 * f64::from(step), 1e-3, DVec3::Z);
        }
        assert_eq!(history.samples().len(), 1);
        assert!((history.samples()[0].impulse.z - 10.0).abs() < 1e-9);
    }
}
