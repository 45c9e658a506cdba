//! Surface of the water as a snapshot for films and ParaView.
//!
//! [`WaterParts`] is a copy of the water in single precision. The thread that writes the files reconstructs the surface
//! from this copy while the run continues.

use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
};

use glam::DVec3;
use rayon::{ThreadPool, ThreadPoolBuilder, prelude::*};

use crate::simulation::flume::Simulation;
use crate::{
    output::{Cells, FieldKind, FieldValues, OutputError, PolyDataSeries, progress::print_line},
    sph::surface::{Cloud, Surface},
};

/// File name of the snapshots of the water surface.
pub const SURFACE_FILE: &str = "surface.vtkhdf";

const FIELDS: [(&str, FieldKind); 2] = [("velocity", FieldKind::Vector), ("pressure", FieldKind::Scalar)];

/// The water of each region at one time.
pub struct WaterParts {
    /// Flume time [s].
    time: f64,
    /// Particles of each region with its buffers, and the range of x [m] that belongs to the region.
    parts: Vec<(Cloud, [f32; 2])>,
}

impl WaterParts {
    /// Copies the current water in the box that the `output` section of the case requests.
    pub fn of(simulation: &Simulation) -> Self {
        let tait = simulation.solver().parameters().tait;
        let part = |region: &Simulation| {
            let water = &region.water;
            let everywhere = [f64::NEG_INFINITY, f64::INFINITY];
            let chosen = particles_in(region, everywhere, simulation.case.output.fluid_box);
            let of = |value: &[DVec3]| chosen.iter().map(|&i| value[i as usize].as_vec3().to_array()).collect();
            let cloud = Cloud {
                spacing: region.case.domain.dp as f32,
                position: of(&water.position),
                velocity: of(&water.velocity),
                pressure: chosen.iter().map(|&i| tait.pressure(water.density[i as usize]) as f32).collect(),
            };
            (cloud, region.own_x().map(|x| x as f32))
        };
        Self { time: simulation.flume_time(), parts: simulation.regions().map(part).collect() }
    }

    /// Reconstructs the surface. Regions of different particle spacing meet where the range of one of them ends.
    fn surface(&self) -> Result<Surface, String> {
        let mut whole = Surface::default();
        for (cloud, x) in &self.parts {
            whole.append(&Surface::of(cloud)?.between(*x));
        }
        Ok(whole)
    }
}

/// The open file of the water surface.
pub struct SurfaceSeries {
    series: PolyDataSeries,
    /// The parallel loops of the reconstruction run in this pool of one thread, so that they leave the other threads to
    /// the simulation.
    pool: ThreadPool,
}

impl SurfaceSeries {
    /// Creates the file in the run folder.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn create(dir: &Path) -> Result<Self, OutputError> {
        Ok(Self::with(PolyDataSeries::create(&dir.join(SURFACE_FILE), Cells::Triangles, &FIELDS)?))
    }

    /// Opens the file of an interrupted run and keeps its first `steps` snapshots.
    ///
    /// # Errors
    /// If the file is missing or shorter than at the checkpoint.
    pub fn reopen(dir: &Path, steps: u64) -> Result<Self, OutputError> {
        let path = dir.join(SURFACE_FILE);
        Ok(Self::with(PolyDataSeries::reopen(&path, Cells::Triangles, &FIELDS, steps as usize)?))
    }

    fn with(series: PolyDataSeries) -> Self {
        let pool = ThreadPoolBuilder::new().num_threads(1).thread_name(|_| "surface".to_owned()).build();
        Self { series, pool: pool.expect("the operating system starts a thread for the water surface") }
    }

    /// Reconstructs the surface and appends it to the file. If the reconstruction fails, prints a warning and appends an
    /// empty surface: a picture must not end a run.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn append(&mut self, water: &WaterParts) -> Result<(), OutputError> {
        let attempt = || self.pool.install(|| water.surface());
        let made = catch_unwind(AssertUnwindSafe(attempt)).unwrap_or_else(|_| Err("see the message above".to_owned()));
        let surface = made.unwrap_or_else(|what| {
            print_line(&format!("warning: {SURFACE_FILE}: no surface at {:.4} s: {what}", water.time));
            Surface::default()
        });
        let values = [FieldValues::Vector(&surface.velocity), FieldValues::Scalar(&surface.pressure)];
        self.series.append(water.time, &surface.points, &surface.triangles, &values)
    }
}

/// Returns the indices of the particles of a region that are in a range of x and, if there is a box, inside the box [m].
pub fn particles_in(region: &Simulation, [from, to]: [f64; 2], corners: Option<[[f64; 3]; 2]>) -> Vec<u32> {
    let corners = corners.unwrap_or([[f64::NEG_INFINITY; 3], [f64::INFINITY; 3]]).map(DVec3::from_array);
    let position = &region.water.position;
    let inside = |&i: &u32| {
        let place = position[i as usize];
        (from..to).contains(&place.x) && place.cmpge(corners[0]).all() && place.cmple(corners[1]).all()
    };
    (0..position.len() as u32).into_par_iter().with_min_len(4096).filter(inside).collect()
}
