//! A vertical line sampled by OpenFOAM, and the selection of its samples in the water at one time.

use std::path::Path;

use super::super::error::ExternalError;
use super::super::surface::{SurfaceSeries, check_datum};
use super::super::table::Place;
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

/// Surface levels found between samples in water and samples in air.
#[derive(Default)]
pub(super) struct SampledSurface {
    /// Number of times with samples.
    times: usize,
    /// Levels z at the times at which the surface was between two samples [m].
    levels_m: Vec<f64>,
    /// Largest distance of the two samples around the surface [m].
    spacing_m: f64,
}

impl SampledSurface {
    /// Adds the samples of one time.
    pub(super) fn add(&mut self, samples: &[Sample]) {
        self.times += 1;
        let mut upwards: Vec<&Sample> = samples.iter().filter(|s| s.u_m_s.abs() <= OUTSIDE_MESH).collect();
        upwards.sort_by(|a, b| a.z_m.total_cmp(&b.z_m));
        let crossing = upwards.windows(2).rev().find(|pair| pair[0].water >= WATER && pair[1].water < WATER);
        if let Some([wet, dry]) = crossing {
            let spacing = dry.z_m - wet.z_m;
            self.levels_m.push(wet.z_m + spacing * (wet.water - WATER) / (wet.water - dry.water));
            self.spacing_m = self.spacing_m.max(spacing);
        }
    }

    /// Refuses levels that do not fit the still water level, see [`check_datum`]. Nothing is known if the surface was
    /// above the highest sample most of the time.
    pub(super) fn check(&self, folder: &Path, place: &Place) -> Result<(), ExternalError> {
        if 2 * self.levels_m.len() <= self.times {
            return Ok(());
        }
        let advice = "correct `flume.still_water_level_m`, or `origin_z_m`, the level z of OpenFOAM's origin";
        check_datum(folder, &self.levels_m, self.spacing_m, place, advice)
    }
}

/// Returns levels z [m] and velocities [m/s] of the samples inside the mesh and in water, from the bed upwards.
pub(super) fn in_water(samples: &[Sample]) -> (Vec<f64>, Vec<f64>) {
    // NaN is kept, so that `VelocityTable::checked` reports it.
    let mut kept: Vec<&Sample> =
        samples.iter().filter(|s| !(s.u_m_s.abs() > OUTSIDE_MESH || s.water < WATER)).collect();
    kept.sort_by(|a, b| a.z_m.total_cmp(&b.z_m));
    kept.iter().map(|s| (s.z_m, s.u_m_s)).unzip()
}

#[cfg(test)]
mod tests {
    use super::super::super::table::Layers;
    use super::*;

    #[test]
    fn surface_between_the_samples_must_fit_the_still_water() {
        let place = Place { bed_z_m: 0.0, still_water_z_m: 0.5, gravity_m_s2: 9.81, layers: Layers::AtLeastTwo };
        // Samples every 0.1 m under a surface at the level `still`, with a volume fraction of 0.75 below it.
        let check = |still: f64, top: f64| {
            let mut surface = SampledSurface::default();
            for _ in 0..3 {
                let z = (0..).map(|i| 0.1 * f64::from(i)).take_while(|&z| z <= top);
                let sample = |z_m| Sample { z_m, u_m_s: 0.0, water: if z_m <= still { 0.75 } else { 0.25 } };
                surface.add(&z.map(sample).collect::<Vec<_>>());
            }
            surface.check(Path::new("post"), &place).map_err(|error| error.to_string())
        };
        assert_eq!(check(0.5, 1.0), Ok(()));
        assert_eq!(check(0.6, 1.0), Ok(()), "one sample higher: not certain");
        for (still, median) in [(0.7, "0.75"), (0.3, "0.35")] {
            let message = check(still + 0.01, 1.0).unwrap_err();
            assert!(
                message.contains(&format!("the median {median} m")) && message.contains("`origin_z_m`"),
                "{message}"
            );
        }
        assert_eq!(check(0.9, 0.75), Ok(()), "no sample is in air");
    }

    #[test]
    fn air_and_points_outside_the_mesh_are_left_out() {
        let sample = |z_m, u_m_s, water| Sample { z_m, u_m_s, water };
        let samples = [sample(0.4, 4.0, 0.9), sample(0.1, 1.0, 1.0), sample(0.6, 9.0, 0.2), sample(0.0, -1e300, 1.0)];
        assert_eq!(in_water(&samples), (vec![0.1, 0.4], vec![1.0, 4.0]));
    }
}
