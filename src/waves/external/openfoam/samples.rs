//! A vertical line sampled by OpenFOAM, and the selection of its samples in the water at one time.

use std::path::Path;

use super::super::surface::SurfaceSeries;
use super::frame::Frame;

/// A sample counts as in water from this volume fraction of water upwards [-]; all other samples are left out.
const WATER: f64 = 0.5;

/// A value of larger magnitude marks a point outside the mesh; OpenFOAM writes about 1e300 there.
pub(super) const OUTSIDE_MESH: f64 = 1e30;

/// A vertical line sampled by an OpenFOAM function object.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vertical<'a> {
    /// Folder `postProcessing/<name>`.
    pub folder: &'a Path,
    /// Name of the velocity field, `U`.
    pub velocity: &'a str,
    /// Name of the volume fraction field, such as `alpha.water`; `None` if every sample is always in water.
    pub water: Option<&'a str>,
    /// Axes of the OpenFOAM run.
    pub frame: Frame,
    /// Surface level, if known.
    pub surface: Option<&'a SurfaceSeries>,
}

/// A sampled point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    /// Level z [m].
    pub(super) z_m: f64,
    /// Velocity along x [m/s].
    pub(super) u_m_s: f64,
    /// Volume fraction of water [-].
    pub(super) water: f64,
}

/// Returns levels z [m] and velocities [m/s] of the samples inside the mesh and in water, from the bed upwards.
pub(super) fn in_water(samples: impl Iterator<Item = Sample>) -> (Vec<f64>, Vec<f64>) {
    // NaN is kept, so that `VelocityTable::checked` reports it.
    let mut kept: Vec<Sample> = samples.filter(|s| !(s.u_m_s.abs() > OUTSIDE_MESH || s.water < WATER)).collect();
    kept.sort_by(|a, b| a.z_m.total_cmp(&b.z_m));
    kept.iter().map(|s| (s.z_m, s.u_m_s)).unzip()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn air_and_points_outside_the_mesh_are_left_out() {
        let sample = |z_m, u_m_s, water| Sample { z_m, u_m_s, water };
        let samples = [sample(0.4, 4.0, 0.9), sample(0.1, 1.0, 1.0), sample(0.6, 9.0, 0.2), sample(0.0, -1e300, 1.0)];
        assert_eq!(in_water(samples.into_iter()), (vec![0.1, 0.4], vec![1.0, 4.0]));
    }
}
