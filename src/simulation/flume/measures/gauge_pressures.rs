//! Pressure at the gauges: at the current time, and averaged over the time between two rows of `gauges.csv`.
//!
//! The largest pressure of an impact lasts for less than the time between two rows, so the pressures at the times of
//! the rows could miss it. A pressure sensor, too, shows a mean over a short time. The mean pressure times the time
//! between two rows is the exact impulse per area.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::case::{Case, Gauge, Quantity};
use crate::simulation::flume::Simulation;

/// Impulses per area at the pressure gauges since the last [`take`](Self::take); part of every checkpoint.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct GaugePressures {
    /// Impulse per area at each pressure gauge [Pa s]; `None` if the gauge was dry all the time.
    impulses: Vec<Option<f64>>,
    /// Time over which the pressures are summed [s].
    over: f64,
}

impl GaugePressures {
    /// Adds the pressures [Pa] of a time step of length `dt` [s]; `None` for dry gauges.
    fn add(&mut self, dt: f64, pressures: Vec<Option<f64>>) {
        self.impulses.resize(pressures.len(), None);
        for (sum, pressure) in self.impulses.iter_mut().zip(pressures) {
            if let Some(pressure) = pressure {
                *sum = Some(sum.unwrap_or(0.0) + dt * pressure);
            }
        }
        self.over += dt;
    }

    /// Returns the mean pressure at each pressure gauge since the last call [Pa], with zero for the time while the
    /// gauge was dry; `None` for a gauge that was dry all the time. Returns an empty list if no time step was added.
    pub fn take(&mut self) -> Vec<Option<f64>> {
        let Self { impulses, over } = std::mem::take(self);
        impulses.into_iter().map(|sum| sum.map(|impulse| impulse / over)).collect()
    }
}

/// Returns the gauges in the particle domain that measure pressure.
fn pressure_gauges(case: &Case) -> impl Iterator<Item = &Gauge> {
    case.gauges.iter().filter(|gauge| gauge.in_domain && gauge.quantity == Quantity::Pressure)
}

impl Simulation {
    /// Returns true if the water between the moving ends covers x [m], at least the smoothing length away from them.
    pub fn is_between_moving_ends(&self, x: f64) -> bool {
        let [from, to] = self.between_moving_ends();
        let h = self.case.numerics.h;
        (from + h..to - h).contains(&x)
    }

    /// Returns the pressure at each pressure gauge in the particle domain [Pa]; `None` for gauges that are dry or not
    /// between the moving ends. The current state must be evaluated and in the memory of the host.
    pub fn gauge_pressures(&self) -> Vec<Option<f64>> {
        let places: Vec<_> = pressure_gauges(&self.case)
            .map(|gauge| {
                let at = self.gauge_position(gauge);
                self.is_between_moving_ends(at.x).then(|| (self.region_at(at.x).sampler(), at))
            })
            .collect();
        places.par_iter().map(|place| place.and_then(|(sampler, at)| sampler.sensor_pressure(at))).collect()
    }

    /// Adds the pressures at the gauges over a time step of length `dt` [s] from the current, evaluated state. Does
    /// nothing if a graphics card computes the water, because the state is not in the memory of the host.
    pub fn sum_gauge_pressures(&mut self, dt: f64) {
        if pressure_gauges(&self.case).next().is_none() || self.is_on_gpu() {
            return;
        }
        let pressures = self.gauge_pressures();
        self.statistics.gauge_pressures.add(dt, pressures);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_pressure_counts_dry_time_as_zero_pressure() {
        let mut means = GaugePressures::default();
        assert!(means.take().is_empty());
        means.add(0.25, vec![Some(8.0), None]);
        means.add(0.75, vec![None, None]);
        assert_eq!(means.take(), [Some(2.0), None]);
        assert!(means.take().is_empty());
    }
}
