//! Reads triangles at each recorded time: surfaces, cracks, cut planes.

use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};
use hdf5_metno::{File, H5Type};

use super::super::OutputError;
use super::layout::{Hdf5Result, entries, read_vectors, unlocked};

/// Reader of a file of triangles that a [`super::PolyDataSeries`] wrote. The triangles share no points.
#[derive(Debug)]
pub struct TriangleMoments {
    path: PathBuf,
    file: File,
    times_s: Vec<f64>,
    counts: Vec<usize>,
}

impl TriangleMoments {
    /// Opens the file, to which a run may still write.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn open(path: &Path) -> Result<Self, OutputError> {
        let read = || -> Hdf5Result<Self> {
            let file = unlocked().open(path)?;
            let present = file.group("VTKHDF/Steps")?.attr("NSteps")?.read_scalar::<i64>()?;
            let mut times_s = file.dataset("VTKHDF/Steps/Values")?.read_raw::<f64>()?;
            times_s.truncate(usize::try_from(present).unwrap_or(0));
            let counts = entries(&file, "NumberOfPoints", times_s.len())?;
            Ok(Self { path: path.to_owned(), file, times_s, counts })
        };
        read().map_err(OutputError::hdf5(path))
    }

    /// Returns the recorded times [s].
    pub fn times_s(&self) -> &[f64] {
        &self.times_s
    }

    /// Reads the corners [m] of all triangles at the recorded time with the index `moment`.
    ///
    /// # Errors
    /// If the file cannot be read.
    ///
    /// # Panics
    /// If `moment` is not less than the number of recorded times.
    pub fn triangles(&self, moment: usize) -> Result<Vec<[DVec3; 3]>, OutputError> {
        let read = || -> Hdf5Result<Vec<[DVec3; 3]>> {
            let start = entries(&self.file, "Steps/PointOffsets", self.times_s.len())?[moment];
            let dataset = self.file.dataset("VTKHDF/Points")?;
            let points = read_vectors(&dataset, start, self.counts[moment])?;
            let points: Vec<DVec3> = points.into_iter().map(|point| Vec3::from_array(point).as_dvec3()).collect();
            Ok(points.chunks_exact(3).map(|corners| [corners[0], corners[1], corners[2]]).collect())
        };
        read().map_err(OutputError::hdf5(&self.path))
    }

    /// Reads a field with one number per point at the recorded time with the index `moment`. Returns the value at the
    /// first corner of each triangle.
    ///
    /// # Errors
    /// If the file cannot be read, or does not have the field.
    ///
    /// # Panics
    /// If `moment` is not less than the number of recorded times.
    pub fn values<T: H5Type + Copy>(&self, moment: usize, field: &str) -> Result<Vec<T>, OutputError> {
        let read = || -> Hdf5Result<Vec<T>> {
            let start = entries(&self.file, &format!("Steps/PointDataOffsets/{field}"), self.times_s.len())?[moment];
            let dataset = self.file.dataset(&format!("VTKHDF/PointData/{field}"))?;
            let values = dataset.read_slice_1d::<T, _>(start..start + self.counts[moment])?;
            Ok(values.iter().copied().step_by(3).collect())
        };
        read().map_err(OutputError::hdf5(&self.path))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Cells, FieldKind, FieldValues, PolyDataSeries};
    use super::*;

    #[test]
    fn triangles_read_back_at_every_recorded_time() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("cracks.vtkhdf");
        let mut series = PolyDataSeries::create(&path, Cells::Triangles, &[("mode", FieldKind::Integer)]).unwrap();
        for (time, count) in [(0.0, 0), (0.1, 2), (0.2, 3)] {
            let points: Vec<[f32; 3]> = (0..3 * count).map(|i| [i as f32, time as f32, 0.0]).collect();
            let triangles: Vec<[u32; 3]> = (0..count).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
            let mode: Vec<i32> = (0..3 * count as i32).collect();
            series.append(time, &points, &triangles, &[FieldValues::Integer(&mode)]).unwrap();
        }
        let moments = TriangleMoments::open(&path).unwrap();
        assert_eq!(moments.times_s(), [0.0, 0.1, 0.2]);
        assert!(moments.triangles(0).unwrap().is_empty());
        assert_eq!(moments.triangles(2).unwrap()[1][2].x, 5.0);
        assert_eq!(moments.values::<i32>(1, "mode").unwrap(), [0, 3]);
        assert!(moments.values::<i32>(1, "none").is_err());
        drop(moments);
        let file = unlocked().open_rw(&path).unwrap();
        file.dataset("VTKHDF/Steps/PointOffsets").unwrap().resize(1).unwrap();
        file.dataset("VTKHDF/Steps/PointDataOffsets/mode").unwrap().write_raw(&[0_i64, -1, 6]).unwrap();
        drop(file);
        let moments = TriangleMoments::open(&path).unwrap();
        assert!(moments.triangles(2).unwrap_err().to_string().contains("is damaged"));
        assert!(moments.values::<i32>(1, "mode").unwrap_err().to_string().contains("is damaged"));
    }
}
