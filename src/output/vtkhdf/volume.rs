//! Tetrahedra for ParaView: VTKHDF temporal UnstructuredGrid, one file per series.
//!
//! As in [`super::PolyDataSeries`], every step (recorded time) is one part of the file. Connectivity (the nodes of the
//! tetrahedra) is written again only after nodes have separated. `Offsets` and `Types` are the same in every step. They
//! are still written in every step, because VTK expects the offsets of each part after those of the previous parts.

use std::path::{Path, PathBuf};

use hdf5_metno::{Dataset, File};

use super::super::OutputError;
use super::layout::{
    Hdf5Result, LONG_CHUNK, STEP_CHUNK, append_rows, append_rows_of, append_values, create_unlocked, cut, entry,
    new_field, new_group, new_list, new_root, new_rows, open_with_steps, set_row,
};
use super::{FieldKind, FieldValues};

/// VTK cell type of a linear tetrahedron.
const VTK_TETRA: u8 = 10;
/// Name of the point field that every file has.
const VELOCITY: &str = "velocity";

/// A VTKHDF file of tetrahedra that grows step by step; a step is one recorded time.
#[derive(Debug)]
pub struct TetSeries {
    path: PathBuf,
    file: File,
    fields: Vec<(String, FieldKind)>,
    steps: usize,
    /// Tetrahedra of the last step, and the row in `Connectivity` where they start.
    last_tets: Vec<[u32; 4]>,
    last_connectivity_start: usize,
}

/// Data of one recorded time in a file of tetrahedra.
#[derive(Debug, Clone, Copy)]
pub struct TetMoment<'a> {
    /// Time [s].
    pub time_s: f64,
    /// Positions of the nodes [m].
    pub points_m: &'a [[f32; 3]],
    /// Velocity of each node [m/s].
    pub velocity_m_s: &'a [[f32; 3]],
    /// Nodes of each tetrahedron; the number of tetrahedra is the same in every step.
    pub tets: &'a [[u32; 4]],
    /// Values of each field of the tetrahedra, in the order in which the fields were created.
    pub values: &'a [FieldValues<'a>],
}

impl TetSeries {
    /// Creates a file with the given fields of the tetrahedra. Overwrites an existing file.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn create(path: &Path, fields: &[(&str, FieldKind)]) -> Result<Self, OutputError> {
        let create = || -> Hdf5Result<File> {
            let file = create_unlocked(path)?;
            write_skeleton(&file, fields)?;
            file.flush()?;
            Ok(file)
        };
        let file = create().map_err(OutputError::hdf5(path))?;
        Ok(Self::new(path, file, fields, 0))
    }

    /// Opens the file of an interrupted run and keeps only the first `steps` steps. Creates a missing file if it had no
    /// steps.
    ///
    /// # Errors
    /// If the file cannot be opened or created, lacks a field, or has fewer than `steps` steps.
    pub fn reopen(path: &Path, fields: &[(&str, FieldKind)], steps: usize) -> Result<Self, OutputError> {
        if steps == 0 && !path.exists() {
            return Self::create(path, fields);
        }
        let file = open_with_steps(path, "CellData", fields, steps)?;
        let mut series = Self::new(path, file, fields, steps);
        series.truncate().map_err(OutputError::hdf5(path))?;
        Ok(series)
    }

    fn new(path: &Path, file: File, fields: &[(&str, FieldKind)], steps: usize) -> Self {
        let fields = fields.iter().map(|(name, kind)| ((*name).to_owned(), *kind)).collect();
        Self { path: path.to_owned(), file, fields, steps, last_tets: Vec::new(), last_connectivity_start: 0 }
    }

    /// Returns the number of steps in the file.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Appends one step with the data of `moment`.
    ///
    /// # Errors
    /// If the file cannot be written.
    ///
    /// # Panics
    /// If the fields do not match those of the file, or a field does not have one value per tetrahedron.
    pub fn append(&mut self, moment: &TetMoment<'_>) -> Result<(), OutputError> {
        assert_eq!(moment.points_m.len(), moment.velocity_m_s.len(), "one velocity per node");
        assert_eq!(moment.values.len(), self.fields.len(), "{}: one list of values per field", self.path.display());
        for ((name, kind), value) in self.fields.iter().zip(moment.values) {
            assert_eq!(*kind, value.kind(), "kind of field {name}");
            assert_eq!(moment.tets.len(), value.len(), "length of field {name}");
        }
        self.write_step(moment).map_err(OutputError::hdf5(&self.path))
    }

    fn write_step(&mut self, moment: &TetMoment<'_>) -> Hdf5Result<()> {
        let root = self.file.group("VTKHDF")?;
        let (steps, row, cells) = (root.group("Steps")?, self.steps, moment.tets.len());
        append_rows(&root.dataset("Offsets")?, &(0..=cells).map(|i| 4 * i as i64).collect::<Vec<_>>())?;
        let cell_start = append_rows(&root.dataset("Types")?, &vec![VTK_TETRA; cells])?;
        if row == 0 || self.last_tets != moment.tets {
            let ids: Vec<i64> = moment.tets.iter().flatten().map(|i| i64::from(*i)).collect();
            self.last_connectivity_start = append_rows(&root.dataset("Connectivity")?, &ids)?;
            self.last_tets = moment.tets.to_vec();
        }
        let point_start = append_rows_of(&root.dataset("Points")?, moment.points_m)?;
        let velocity_start = append_rows_of(&root.group("PointData")?.dataset(VELOCITY)?, moment.velocity_m_s)?;
        set_row(&steps.group("PointDataOffsets")?.dataset(VELOCITY)?, row, velocity_start as i64)?;
        for ((name, _), value) in self.fields.iter().zip(moment.values) {
            let start = append_values(&root.group("CellData")?.dataset(name)?, value)?;
            set_row(&steps.group("CellDataOffsets")?.dataset(name)?, row, start as i64)?;
        }
        let part_counts = [moment.points_m.len(), cells, 4 * cells];
        for (name, count) in ["NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"].into_iter().zip(part_counts)
        {
            set_row(&root.dataset(name)?, row, count as i64)?;
        }
        set_row(&steps.dataset("Values")?, row, moment.time_s)?;
        let starts = [row, 1, point_start, cell_start, self.last_connectivity_start];
        for (name, start) in STARTS.into_iter().zip(starts) {
            set_row(&steps.dataset(name)?, row, start as i64)?;
        }
        self.steps += 1;
        steps.attr("NSteps")?.write_scalar(&(self.steps as i64))?;
        self.file.flush()
    }

    /// Cuts every dataset after the last of the `self.steps` kept steps.
    fn truncate(&mut self) -> Hdf5Result<()> {
        let root = self.file.group("VTKHDF")?;
        let steps = root.group("Steps")?;
        let kept = self.steps;
        steps.attr("NSteps")?.write_scalar(&(kept as i64))?;
        let end_of = |starts: &Dataset, counts: &str| -> Hdf5Result<usize> {
            let Some(last) = kept.checked_sub(1) else { return Ok(0) };
            Ok(entry(starts, last)? + entry(&root.dataset(counts)?, last)?)
        };
        cut(&root.dataset("Points")?, end_of(&steps.dataset("PointOffsets")?, "NumberOfPoints")?)?;
        let starts = steps.group("PointDataOffsets")?.dataset(VELOCITY)?;
        cut(&root.group("PointData")?.dataset(VELOCITY)?, end_of(&starts, "NumberOfPoints")?)?;
        cut(&starts, kept)?;
        for (name, _) in &self.fields {
            let starts = steps.group("CellDataOffsets")?.dataset(name)?;
            cut(&root.group("CellData")?.dataset(name)?, end_of(&starts, "NumberOfCells")?)?;
            cut(&starts, kept)?;
        }
        let cells = end_of(&steps.dataset("CellOffsets")?, "NumberOfCells")?;
        cut(&root.dataset("Types")?, cells)?;
        cut(&root.dataset("Offsets")?, cells + kept)?;
        let connectivity = root.dataset("Connectivity")?;
        let starts = steps.dataset("ConnectivityIdOffsets")?;
        let end = end_of(&starts, "NumberOfConnectivityIds")?;
        cut(&connectivity, end)?;
        if let Some(last) = kept.checked_sub(1) {
            let start = entry(&starts, last)?;
            let corners = connectivity.read_slice_1d::<i64, _>(start..end)?;
            let corners: Vec<u32> = corners.iter().map(|i| u32::try_from(*i).unwrap_or(0)).collect();
            self.last_tets = corners.chunks_exact(4).map(|t| [t[0], t[1], t[2], t[3]]).collect();
            self.last_connectivity_start = start;
        }
        for name in ["NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"] {
            cut(&root.dataset(name)?, kept)?;
        }
        cut(&steps.dataset("Values")?, kept)?;
        STARTS.into_iter().try_for_each(|name| cut(&steps.dataset(name)?, kept))?;
        self.file.flush()
    }
}

/// Names of the datasets in `Steps` with one integer per step.
const STARTS: [&str; 5] = ["PartOffsets", "NumberOfParts", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"];

/// Creates the groups, attributes and empty datasets of an UnstructuredGrid file.
fn write_skeleton(file: &File, fields: &[(&str, FieldKind)]) -> Hdf5Result<()> {
    let [root, steps] = new_root::<16>(file, "UnstructuredGrid")?;
    steps.new_attr::<i64>().create("NSteps")?.write_scalar(&0_i64)?;
    new_list::<f64>(&steps, "Values", STEP_CHUNK)?;
    for name in STARTS {
        new_list::<i64>(&steps, name, STEP_CHUNK)?;
    }
    for name in ["NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"] {
        new_list::<i64>(&root, name, STEP_CHUNK)?;
    }
    new_rows::<3>(&root, "Points")?;
    for name in ["Offsets", "Connectivity"] {
        new_list::<i64>(&root, name, LONG_CHUNK)?;
    }
    new_list::<u8>(&root, "Types", LONG_CHUNK)?;
    let (point_data, point_offsets) = (new_group(&root, "PointData")?, new_group(&steps, "PointDataOffsets")?);
    new_field(&point_data, &point_offsets, VELOCITY, FieldKind::Vector)?;
    let (cell_data, cell_offsets) = (new_group(&root, "CellData")?, new_group(&steps, "CellDataOffsets")?);
    fields.iter().try_for_each(|(name, kind)| new_field(&cell_data, &cell_offsets, name, *kind))
}

#[cfg(test)]
mod tests {
    use super::*;

    const FIELDS: [(&str, FieldKind); 2] = [("stress", FieldKind::Tensor), ("body", FieldKind::Integer)];

    fn append(series: &mut TetSeries, time_s: f64, points: usize, tets: &[[u32; 4]]) {
        let points_m: Vec<[f32; 3]> = (0..points).map(|i| [i as f32, time_s as f32, 0.0]).collect();
        let stress: Vec<[f32; 6]> = (0..tets.len()).map(|i| [1, 2, 3, 4, 5, 6].map(|k| (10 * i + k) as f32)).collect();
        let body = vec![time_s as i32; tets.len()];
        let values = [FieldValues::Tensor(&stress), FieldValues::Integer(&body)];
        series
            .append(&TetMoment { time_s, points_m: &points_m, velocity_m_s: &points_m, tets, values: &values })
            .unwrap();
    }

    fn list(file: &File, name: &str) -> Vec<i64> {
        file.dataset(&format!("VTKHDF/{name}")).unwrap().read_raw().unwrap()
    }

    #[test]
    fn nodes_may_separate_and_a_resumed_series_continues_after_the_checkpoint() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("tets.vtkhdf");
        let (whole, split) = ([[0, 1, 2, 3], [1, 2, 3, 4]], [[0, 1, 2, 3], [5, 2, 3, 4]]);
        let mut series = TetSeries::create(&path, &FIELDS).unwrap();
        append(&mut series, 0.0, 5, &whole);
        append(&mut series, 1.0, 5, &whole);
        append(&mut series, 2.0, 6, &split);
        append(&mut series, 3.0, 6, &split);
        drop(series);
        let file = File::open(&path).unwrap();
        assert_eq!(list(&file, "Steps/ConnectivityIdOffsets"), [0, 0, 8, 8]);
        assert_eq!(list(&file, "Offsets"), [0, 4, 8].repeat(4));
        assert_eq!(list(&file, "Steps/CellOffsets"), [0, 2, 4, 6]);
        assert_eq!(file.dataset("VTKHDF/Types").unwrap().read_raw::<u8>().unwrap(), [10; 8]);
        assert_eq!(list(&file, "Steps/PointOffsets"), [0, 5, 10, 16]);
        assert_eq!(list(&file, "Steps/CellDataOffsets/stress"), [0, 2, 4, 6]);
        drop(file);
        let mut series = TetSeries::reopen(&path, &FIELDS, 2).unwrap();
        assert_eq!(series.steps(), 2);
        append(&mut series, 2.0, 6, &split);
        drop(series);
        let file = File::open(&path).unwrap();
        assert_eq!(list(&file, "NumberOfPoints"), [5, 5, 6]);
        assert_eq!(list(&file, "Connectivity").len(), 16);
        assert_eq!(list(&file, "Offsets"), [0, 4, 8].repeat(3));
        assert_eq!(list(&file, "Types"), [10; 6]);
        assert_eq!(file.dataset("VTKHDF/CellData/stress").unwrap().shape(), [6, 6]);
        assert_eq!(list(&file, "Steps/ConnectivityIdOffsets"), [0, 0, 8]);
        drop(file);
        let error = TetSeries::reopen(&path, &FIELDS, 9).unwrap_err();
        assert!(error.to_string().contains("has 3 steps, fewer than the 9"), "{error}");
    }
}
