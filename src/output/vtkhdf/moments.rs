//! Reads the points, triangles and fields of a VTKHDF file at each recorded time.

use std::{
    ops::Range,
    path::{Path, PathBuf},
};

use glam::{DVec3, Vec3};
use hdf5_metno::{Dataset, File, H5Type};

use super::super::OutputError;
use super::Cells;
use super::layout::{Hdf5Result, TOPOLOGIES, damaged, entries, read_vectors, unlocked};

/// Reader of a file that a [`super::PolyDataSeries`] wrote: water particles, water surface, units, cracks.
#[derive(Debug)]
pub struct PolyDataMoments {
    path: PathBuf,
    file: File,
    times_s: Vec<f64>,
    counts: Vec<usize>,
}

impl PolyDataMoments {
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

    /// Returns the index of the recorded time nearest to `time_s` [s]; `None` if the file has no recorded times.
    pub fn nearest(&self, time_s: f64) -> Option<usize> {
        let distance = |moment: &usize| (self.times_s[*moment] - time_s).abs();
        (0..self.times_s.len()).min_by(|a, b| distance(a).total_cmp(&distance(b)))
    }

    /// Returns true if the points have a field with this name.
    pub fn has(&self, field: &str) -> bool {
        self.file.group("VTKHDF/PointData").is_ok_and(|data| data.link_exists(field))
    }

    /// Reads the points [m] at the recorded time with the index `moment`.
    ///
    /// # Errors
    /// If the file cannot be read.
    ///
    /// # Panics
    /// If `moment` is not less than the number of recorded times.
    pub fn points(&self, moment: usize) -> Result<Vec<[f32; 3]>, OutputError> {
        self.vectors_at(moment, "Points", "Steps/PointOffsets")
    }

    /// Reads the triangles at the recorded time with the index `moment`: the indices of their three corners in the list
    /// of points.
    ///
    /// # Errors
    /// If the file cannot be read, or a triangle refers to a missing point.
    ///
    /// # Panics
    /// If `moment` is not less than the number of recorded times.
    pub fn triangles(&self, moment: usize) -> Result<Vec<[u32; 3]>, OutputError> {
        let topology = Cells::Triangles.topology();
        let group = TOPOLOGIES[topology];
        let read = || -> Hdf5Result<Vec<[u32; 3]>> {
            let count = entries(&self.file, &format!("{group}/NumberOfConnectivityIds"), self.times_s.len())?[moment];
            let starts = self.file.dataset("VTKHDF/Steps/ConnectivityIdOffsets")?;
            let start = starts.read_2d::<i64>()?.get((moment, topology)).copied();
            let start = start.and_then(|start| usize::try_from(start).ok()).ok_or_else(|| damaged(&starts))?;
            let dataset = self.file.dataset(&format!("VTKHDF/{group}/Connectivity"))?;
            let corner = |id: &i64| {
                let index = usize::try_from(*id).ok().filter(|index| *index < self.counts[moment]);
                index.map(|index| index as u32).ok_or_else(|| damaged(&dataset))
            };
            let ids = dataset.read_slice_1d::<i64, _>(start..start + count)?;
            let corners = ids.iter().map(corner).collect::<Hdf5Result<Vec<u32>>>()?;
            Ok(corners.chunks_exact(3).map(|corners| [corners[0], corners[1], corners[2]]).collect())
        };
        read().map_err(OutputError::hdf5(&self.path))
    }

    /// Reads the corner points [m] of all triangles at the recorded time with the index `moment`.
    ///
    /// # Errors
    /// If the file cannot be read.
    ///
    /// # Panics
    /// If `moment` is not less than the number of recorded times.
    pub fn corners(&self, moment: usize) -> Result<Vec<[DVec3; 3]>, OutputError> {
        let points = self.points(moment)?;
        let corner = |index: u32| Vec3::from_array(points[index as usize]).as_dvec3();
        Ok(self.triangles(moment)?.into_iter().map(|triangle| triangle.map(corner)).collect())
    }

    /// Reads a field with one number per point at the recorded time with the index `moment`. Returns the value at the
    /// first corner of each triangle.
    ///
    /// # Errors
    /// If the file cannot be read, or does not have the field.
    ///
    /// # Panics
    /// If `moment` is not less than the number of recorded times.
    pub fn of_triangles<T: H5Type + Copy>(&self, moment: usize, field: &str) -> Result<Vec<T>, OutputError> {
        let values = self.numbers::<T>(moment, field)?;
        Ok(self.triangles(moment)?.into_iter().map(|[first, ..]| values[first as usize]).collect())
    }

    /// Reads a field with one number per point at the recorded time with the index `moment`.
    ///
    /// # Errors
    /// If the file cannot be read, or does not have the field.
    ///
    /// # Panics
    /// If `moment` is not less than the number of recorded times.
    pub fn numbers<T: H5Type + Copy>(&self, moment: usize, field: &str) -> Result<Vec<T>, OutputError> {
        let read = || -> Hdf5Result<Vec<T>> {
            let (dataset, rows) =
                self.rows(moment, &format!("PointData/{field}"), &format!("Steps/PointDataOffsets/{field}"))?;
            Ok(dataset.read_slice_1d::<T, _>(rows)?.to_vec())
        };
        read().map_err(OutputError::hdf5(&self.path))
    }

    /// Reads a field with one vector per point at the recorded time with the index `moment`.
    ///
    /// # Errors
    /// If the file cannot be read, or does not have the field.
    ///
    /// # Panics
    /// If `moment` is not less than the number of recorded times.
    pub fn vectors(&self, moment: usize, field: &str) -> Result<Vec<[f32; 3]>, OutputError> {
        self.vectors_at(moment, &format!("PointData/{field}"), &format!("Steps/PointDataOffsets/{field}"))
    }

    fn vectors_at(&self, moment: usize, name: &str, starts: &str) -> Result<Vec<[f32; 3]>, OutputError> {
        let read = || -> Hdf5Result<Vec<[f32; 3]>> {
            let (dataset, rows) = self.rows(moment, name, starts)?;
            read_vectors(&dataset, rows.start, rows.len())
        };
        read().map_err(OutputError::hdf5(&self.path))
    }

    /// Returns a dataset with one row per point, and its rows for the recorded time with the index `moment`.
    fn rows(&self, moment: usize, name: &str, starts: &str) -> Hdf5Result<(Dataset, Range<usize>)> {
        let start = entries(&self.file, starts, self.times_s.len())?[moment];
        Ok((self.file.dataset(&format!("VTKHDF/{name}"))?, start..start + self.counts[moment]))
    }
}

#[cfg(test)]
mod tests {
    use super::super::{FieldKind, FieldValues, PolyDataSeries};
    use super::*;

    #[test]
    fn triangles_and_fields_read_back_at_every_recorded_time() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("cracks.vtkhdf");
        let fields = [("mode", FieldKind::Integer), ("velocity", FieldKind::Vector)];
        let mut series = PolyDataSeries::create(&path, Cells::Triangles, &fields).unwrap();
        for (time, count) in [(0.0, 0), (0.1, 2), (0.2, 3)] {
            let points: Vec<[f32; 3]> = (0..3 * count).map(|i| [i as f32, time as f32, 0.0]).collect();
            let triangles: Vec<[u32; 3]> = (0..count).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
            let mode: Vec<i32> = (0..3 * count as i32).collect();
            let values = [FieldValues::Integer(&mode), FieldValues::Vector(&points)];
            series.append(time, &points, &triangles, &values).unwrap();
        }
        // The file is still open for writing, as during a run.
        let moments = PolyDataMoments::open(&path).unwrap();
        assert_eq!(moments.times_s(), [0.0, 0.1, 0.2]);
        assert_eq!([0.04, 0.06, 9.0].map(|time| moments.nearest(time)), [Some(0), Some(1), Some(2)]);
        assert!(moments.points(0).unwrap().is_empty() && moments.triangles(0).unwrap().is_empty());
        assert_eq!(moments.triangles(2).unwrap()[1], [3, 4, 5]);
        assert_eq!(moments.points(2).unwrap()[5], [5.0, 0.2, 0.0]);
        assert_eq!(moments.vectors(1, "velocity").unwrap(), moments.points(1).unwrap());
        assert_eq!(moments.corners(2).unwrap()[1][2].x, 5.0);
        assert_eq!(moments.numbers::<i32>(1, "mode").unwrap(), [0, 1, 2, 3, 4, 5]);
        assert_eq!(moments.of_triangles::<i32>(1, "mode").unwrap(), [0, 3]);
        assert!(moments.has("mode") && !moments.has("none"));
        assert!(moments.numbers::<i32>(1, "none").is_err());
        assert!(PolyDataMoments::open(&folder.path().join("none.vtkhdf")).is_err());
    }

    #[test]
    fn a_damaged_file_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("cracks.vtkhdf");
        let mut series = PolyDataSeries::create(&path, Cells::Triangles, &[("mode", FieldKind::Integer)]).unwrap();
        for time in [0.0, 0.1, 0.2] {
            series.append(time, &[[0.0; 3]; 3], &[[0, 1, 2]], &[FieldValues::Integer(&[1; 3])]).unwrap();
        }
        drop(series);
        let file = unlocked().open_rw(&path).unwrap();
        file.dataset("VTKHDF/Steps/PointOffsets").unwrap().resize(1).unwrap();
        file.dataset("VTKHDF/Steps/PointDataOffsets/mode").unwrap().write_raw(&[0_i64, -1, 6]).unwrap();
        file.dataset("VTKHDF/Polygons/Connectivity").unwrap().write_raw(&[0_i64, 1, 7]).unwrap();
        drop(file);
        let moments = PolyDataMoments::open(&path).unwrap();
        assert!(moments.points(2).unwrap_err().to_string().contains("is damaged"));
        assert!(moments.numbers::<i32>(1, "mode").unwrap_err().to_string().contains("is damaged"));
        assert!(moments.triangles(0).unwrap_err().to_string().contains("is damaged"));
    }
}
