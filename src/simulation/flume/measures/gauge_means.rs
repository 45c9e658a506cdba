//! Pressures and forces at the gauges: at the current time, and averaged over the time between two rows of
//! `gauges.csv`.
//!
//! The largest pressure of an impact lasts for less than the time between two rows, so the pressures at the times of
//! the rows could miss it. A pressure sensor, too, shows a mean over a short time. The mean pressure times the time
//! between two rows is the exact impulse per area.

use glam::DVec3;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::case::{Gauge, Quantity};
use crate::rigid::Load;
use crate::simulation::flume::Simulation;

/// Integrals over time of the values of gauges since the last [`take`](Self::take); part of every checkpoint.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct GaugeMeans {
    /// Integral of each value, for a pressure the impulse per area [Pa s]; `None` if the gauge was dry all the time.
    impulses: Vec<Option<f64>>,
    /// Time over which the values are summed [s].
    over: f64,
}

impl GaugeMeans {
    /// Adds the values of a time step of length `dt` [s]; `None` for dry gauges.
    fn add(&mut self, dt: f64, values: Vec<Option<f64>>) {
        self.impulses.resize(values.len(), None);
        for (sum, value) in self.impulses.iter_mut().zip(values) {
            if let Some(value) = value {
                *sum = Some(sum.unwrap_or(0.0) + dt * value);
            }
        }
        self.over += dt;
    }

    /// Returns the mean of each value since the last call, with zero for the time while the gauge was dry; `None` for a
    /// gauge that was dry all the time. Returns an empty list if no time step was added.
    pub fn take(&mut self) -> Vec<Option<f64>> {
        let Self { impulses, over } = std::mem::take(self);
        impulses.into_iter().map(|sum| sum.map(|impulse| impulse / over)).collect()
    }
}

impl Simulation {
    /// Returns true if the water between the moving ends covers x [m], at least the smoothing length away from them.
    pub fn is_between_moving_ends(&self, x: f64) -> bool {
        let [from, to] = self.between_moving_ends();
        let h = self.case.numerics.h;
        (from + h..to - h).contains(&x)
    }

    /// Returns the values of the gauges in the particle domain whose means are written, in their order: the pressure
    /// [Pa], or force [N] and moment [N m] on a part along x, y and z. `None` for pressure gauges that are dry or not
    /// between the moving ends. The current state must be evaluated and in the memory of the host.
    pub fn gauge_values(&self) -> Vec<Option<f64>> {
        let of_gauge = |gauge: &Gauge| match gauge.quantity {
            Quantity::Pressure => self.sensor_pressures(&[self.gauge_position(gauge)]),
            Quantity::PartForce(part) => {
                let Load { force, torque } = self.part_load(part, gauge.at.into());
                force.to_array().into_iter().chain(torque.to_array()).map(Some).collect()
            }
            Quantity::Elevation | Quantity::Velocity | Quantity::Force(_) => Vec::new(),
        };
        self.case.gauges.iter().filter(|gauge| gauge.in_domain).flat_map(of_gauge).collect()
    }

    /// Returns the pressure that a sensor would show at each of these points [Pa]; `None` for points that are dry or
    /// not between the moving ends.
    pub(super) fn sensor_pressures(&self, points: &[DVec3]) -> Vec<Option<f64>> {
        let place = |at: &DVec3| self.is_between_moving_ends(at.x).then(|| (self.region_at(at.x).sampler(), *at));
        let places: Vec<_> = points.iter().map(place).collect();
        places.par_iter().map(|place| place.and_then(|(sampler, at)| sampler.sensor_pressure(at))).collect()
    }

    /// Adds the values of the gauges over a time step of length `dt` [s] from the current, evaluated state. Does
    /// nothing if a graphics card computes the water, because the state is not in the memory of the host.
    pub fn sum_gauge_values(&mut self, dt: f64) {
        let has_mean = |gauge: &Gauge| matches!(gauge.quantity, Quantity::Pressure | Quantity::PartForce(_));
        if !self.case.gauges.iter().any(|gauge| gauge.in_domain && has_mean(gauge)) || self.is_on_gpu() {
            return;
        }
        let values = self.gauge_values();
        self.statistics.gauge_means.add(dt, values);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_pressure_counts_dry_time_as_zero_pressure() {
        let mut means = GaugeMeans::default();
        assert!(means.take().is_empty());
        means.add(0.25, vec![Some(8.0), None]);
        means.add(0.75, vec![None, None]);
        assert_eq!(means.take(), [Some(2.0), None]);
        assert!(means.take().is_empty());
    }
}
