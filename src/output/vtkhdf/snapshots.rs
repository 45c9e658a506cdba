//! Reads the water particles of a run at each recorded time.

use std::path::{Path, PathBuf};

use hdf5_metno::File;

use super::super::OutputError;
use super::layout::{Hdf5Result, entries, read_vectors, unlocked};

/// Reader of a file of particles with velocities that a [`super::PolyDataSeries`] wrote.
#[derive(Debug)]
pub struct WaterSnapshots {
    path: PathBuf,
    file: File,
    times_s: Vec<f64>,
    /// For each recorded time: number of particles, and first rows of their positions and of their velocities.
    counts: Vec<usize>,
    point_starts: Vec<usize>,
    velocity_starts: Vec<usize>,
}

/// The particles at one recorded time.
#[derive(Debug, Clone, PartialEq)]
pub struct WaterSnapshot {
    /// Position of each particle [m].
    pub points_m: Vec<[f32; 3]>,
    /// Velocity of each particle [m/s].
    pub velocity_m_s: Vec<[f32; 3]>,
}

impl WaterSnapshots {
    /// Opens the file, to which a run may still write. Returns `None` if the file has no velocities.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn open(path: &Path) -> Result<Option<Self>, OutputError> {
        Self::index(path).map_err(OutputError::hdf5(path))
    }

    fn index(path: &Path) -> Hdf5Result<Option<Self>> {
        let file = unlocked().open(path)?;
        if !file.group("VTKHDF/PointData")?.link_exists("velocity") {
            return Ok(None);
        }
        let present = file.group("VTKHDF/Steps")?.attr("NSteps")?.read_scalar::<i64>()?;
        let mut times_s = file.dataset("VTKHDF/Steps/Values")?.read_raw::<f64>()?;
        times_s.truncate(usize::try_from(present).unwrap_or(0));
        let list = |name: &str| entries(&file, name, times_s.len());
        Ok(Some(Self {
            path: path.to_owned(),
            counts: list("NumberOfPoints")?,
            point_starts: list("Steps/PointOffsets")?,
            velocity_starts: list("Steps/PointDataOffsets/velocity")?,
            times_s,
            file,
        }))
    }

    /// Returns the recorded times [s].
    pub fn times_s(&self) -> &[f64] {
        &self.times_s
    }

    /// Returns the index of the recorded time nearest to `time_s` [s]; `None` if the file has no recorded times.
    pub fn nearest(&self, time_s: f64) -> Option<usize> {
        let distance = |step: &usize| (self.times_s[*step] - time_s).abs();
        (0..self.times_s.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Reads the particles at the recorded time with the index `step`.
    ///
    /// # Errors
    /// If the file cannot be read.
    ///
    /// # Panics
    /// If `step` is not less than the number of recorded times.
    pub fn read(&self, step: usize) -> Result<WaterSnapshot, OutputError> {
        assert!(step < self.times_s.len(), "{}: no recorded time {step}", self.path.display());
        let rows = |name: &str, start: usize| -> Hdf5Result<Vec<[f32; 3]>> {
            let dataset = self.file.dataset(&format!("VTKHDF/{name}"))?;
            read_vectors(&dataset, start, self.counts[step])
        };
        let read = || -> Hdf5Result<WaterSnapshot> {
            Ok(WaterSnapshot {
                points_m: rows("Points", self.point_starts[step])?,
                velocity_m_s: rows("PointData/velocity", self.velocity_starts[step])?,
            })
        };
        read().map_err(OutputError::hdf5(&self.path))
    }
}
