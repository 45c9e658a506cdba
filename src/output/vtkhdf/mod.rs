//! Moving points and surfaces for ParaView: VTKHDF temporal PolyData (version 2.0), one file per series.
//!
//! Layout: <https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/>. Every step (recorded time) is one
//! part of the file. All cells of a kind have the same number of corners n. Therefore all steps share one list
//! `Offsets`: 0, n, 2n, ..., long enough for the step with most cells. Connectivity (the corner points of the cells) is
//! written again only if it differs from the previous step; so are fields of integers. A series can also use the points
//! of the last step again while they rest. `NSteps` is written last, and then the file is flushed, so
//! that a killed run leaves a file of complete steps.

use std::path::{Path, PathBuf};

use hdf5_metno::{Dataset, File, Group};

use self::layout::{
    Hdf5Result, TOPOLOGIES, append_rows, append_rows_of, append_values, create_unlocked, cut, damaged, entry,
    open_with_steps, read_vectors, set_row, set_row_of_4, write_skeleton,
};
use super::OutputError;

pub use self::moments::PolyDataMoments;
pub use self::volume::{TetMoment, TetSeries};

mod layout;
mod moments;
#[cfg(test)]
mod tests;
mod volume;

/// Kind of the cells in a [`PolyDataSeries`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cells {
    /// One cell per point, for particles.
    Vertices,
    /// Triangles, for surfaces.
    Triangles,
}

impl Cells {
    fn topology(self) -> usize {
        match self {
            Self::Vertices => 0,
            Self::Triangles => 2,
        }
    }

    fn corners(self) -> usize {
        match self {
            Self::Vertices => 1,
            Self::Triangles => 3,
        }
    }
}

/// Type of a field value at each point or cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FieldKind {
    /// One f32.
    Scalar,
    /// Three f32.
    Vector,
    /// A symmetric tensor: six f32 in the order of ParaView, xx, yy, zz, xy, yz, xz.
    Tensor,
    /// One i32.
    Integer,
}

/// Values of a field in one step, one value per point or cell.
#[derive(Debug, Clone, Copy)]
pub enum FieldValues<'a> {
    /// Values of a field of [`FieldKind::Scalar`].
    Scalar(&'a [f32]),
    /// Values of a field of [`FieldKind::Vector`].
    Vector(&'a [[f32; 3]]),
    /// Values of a field of [`FieldKind::Tensor`].
    Tensor(&'a [[f32; 6]]),
    /// Values of a field of [`FieldKind::Integer`].
    Integer(&'a [i32]),
}

impl FieldValues<'_> {
    fn kind(&self) -> FieldKind {
        match self {
            Self::Scalar(_) => FieldKind::Scalar,
            Self::Vector(_) => FieldKind::Vector,
            Self::Tensor(_) => FieldKind::Tensor,
            Self::Integer(_) => FieldKind::Integer,
        }
    }

    fn len(&self) -> usize {
        match self {
            Self::Scalar(values) => values.len(),
            Self::Vector(values) => values.len(),
            Self::Tensor(values) => values.len(),
            Self::Integer(values) => values.len(),
        }
    }
}

/// A VTKHDF file of points or triangles that grows step by step; a step is one recorded time.
#[derive(Debug)]
pub struct PolyDataSeries {
    path: PathBuf,
    file: File,
    cells: Cells,
    fields: Vec<(String, FieldKind)>,
    steps: usize,
    /// Triangles of the last step, and the row in `Connectivity` where they start.
    last_triangles: Vec<[u32; 3]>,
    last_connectivity_start: usize,
    /// Points that have moved by less than this since they were written are not written again [m]; `None` if points are
    /// always written.
    rest: Option<f32>,
    /// Points and fields of the last step; `None` after the file was opened.
    last: Option<LastStep>,
}

/// What the next step can use again.
#[derive(Debug, Default)]
struct LastStep {
    /// Points of the last step, and the row in `Points` where they start.
    points: Vec<[f32; 3]>,
    point_start: usize,
    /// For each field, its integers, and the row where its values start.
    fields: Vec<(Vec<i32>, usize)>,
}

impl PolyDataSeries {
    /// Creates a file for cells of one kind and the given point fields. Overwrites an existing file.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn create(path: &Path, cells: Cells, fields: &[(&str, FieldKind)]) -> Result<Self, OutputError> {
        let create = || -> Hdf5Result<File> {
            let file = create_unlocked(path)?;
            write_skeleton(&file, fields)?;
            file.flush()?;
            Ok(file)
        };
        let file = create().map_err(OutputError::hdf5(path))?;
        Ok(Self {
            path: path.to_owned(),
            file,
            cells,
            fields: fields.iter().map(|(name, kind)| ((*name).to_owned(), *kind)).collect(),
            steps: 0,
            last_triangles: Vec::new(),
            last_connectivity_start: 0,
            rest: None,
            last: None,
        })
    }

    /// Uses the points and fields of the last step again while no point has moved further than `distance` [m] since it
    /// was written. A film then shows points at rest exactly in their last position.
    pub fn skipping_rest(self, distance: f64) -> Self {
        Self { rest: Some(distance as f32), ..self }
    }

    /// Opens the file of an interrupted run and keeps only the first `steps` steps. Creates a missing file if it had no
    /// steps.
    ///
    /// # Errors
    /// If the file cannot be opened or created, lacks a field, or has fewer than `steps` steps.
    pub fn reopen(path: &Path, cells: Cells, fields: &[(&str, FieldKind)], steps: usize) -> Result<Self, OutputError> {
        if steps == 0 && !path.exists() {
            return Self::create(path, cells, fields);
        }
        let file = open_with_steps(path, "PointData", fields, steps)?;
        let mut series = Self {
            path: path.to_owned(),
            file,
            cells,
            fields: fields.iter().map(|(name, kind)| ((*name).to_owned(), *kind)).collect(),
            steps,
            last_triangles: Vec::new(),
            last_connectivity_start: 0,
            rest: None,
            last: None,
        };
        series.truncate().map_err(OutputError::hdf5(path))?;
        Ok(series)
    }

    /// Appends one step: time [s], points [m], triangles (none for [`Cells::Vertices`]) and the values of each field,
    /// in the order in which the fields were created.
    ///
    /// # Errors
    /// If the file cannot be written.
    ///
    /// # Panics
    /// If the fields do not match those of the file, or a field does not have one value per point.
    pub fn append(
        &mut self,
        time_s: f64,
        points_m: &[[f32; 3]],
        triangles: &[[u32; 3]],
        values: &[FieldValues<'_>],
    ) -> Result<(), OutputError> {
        assert!(self.cells == Cells::Triangles || triangles.is_empty(), "a series of vertices has no triangles");
        assert_eq!(values.len(), self.fields.len(), "{}: one list of values per field", self.path.display());
        for ((name, kind), value) in self.fields.iter().zip(values) {
            assert_eq!(*kind, value.kind(), "kind of field {name}");
            assert_eq!(points_m.len(), value.len(), "length of field {name}");
        }
        self.write_step(time_s, points_m, triangles, values).map_err(OutputError::hdf5(&self.path))
    }

    /// Returns the number of steps in the file.
    pub fn steps(&self) -> usize {
        self.steps
    }

    fn write_step(
        &mut self,
        time_s: f64,
        points: &[[f32; 3]],
        triangles: &[[u32; 3]],
        values: &[FieldValues<'_>],
    ) -> Hdf5Result<()> {
        let root = self.file.group("VTKHDF")?;
        let steps = root.group("Steps")?;
        let (row, topology) = (self.steps, self.cells.topology());
        let count = match self.cells {
            Cells::Vertices => points.len(),
            Cells::Triangles => triangles.len(),
        };

        let mut last = match self.last.take() {
            Some(last) => last,
            None => self.recall_last_step(&root, &steps)?,
        };
        let is_at_rest = self.rest.is_some_and(|distance| are_within(&last.points, points, distance));
        if !is_at_rest {
            last.point_start = append_rows_of(&root.dataset("Points")?, points)?;
            // Without the option, the points are not needed again.
            last.points = if self.rest.is_some() { points.to_vec() } else { Vec::new() };
        }
        let point_start = last.point_start;
        let connectivity_start = self.write_cells(&root, points.len(), triangles, count)?;
        let point_data = root.group("PointData")?;
        let point_data_offsets = steps.group("PointDataOffsets")?;
        last.fields.resize_with(self.fields.len(), Default::default);
        for (((name, _), value), (integers, start)) in self.fields.iter().zip(values).zip(&mut last.fields) {
            let is_same = matches!(value, FieldValues::Integer(values) if self.rest.is_some() && values == integers);
            if !is_same && !is_at_rest {
                *start = append_values(&point_data.dataset(name)?, value)?;
                if let (FieldValues::Integer(values), true) = (value, self.rest.is_some()) {
                    *integers = values.to_vec();
                }
            }
            set_row(&point_data_offsets.dataset(name)?, row, *start as i64)?;
        }
        self.last = Some(last);

        set_row(&root.dataset("NumberOfPoints")?, row, points.len() as i64)?;
        for (index, name) in TOPOLOGIES.into_iter().enumerate() {
            let cells = if index == topology { count } else { 0 };
            let group = root.group(name)?;
            set_row(&group.dataset("NumberOfCells")?, row, cells as i64)?;
            set_row(&group.dataset("NumberOfConnectivityIds")?, row, (cells * self.cells.corners()) as i64)?;
        }
        set_row(&steps.dataset("Values")?, row, time_s)?;
        set_row(&steps.dataset("PartOffsets")?, row, row as i64)?;
        set_row(&steps.dataset("NumberOfParts")?, row, 1_i64)?;
        set_row(&steps.dataset("PointOffsets")?, row, point_start as i64)?;
        let mut connectivity_starts = [0_i64; 4];
        connectivity_starts[topology] = connectivity_start as i64;
        set_row_of_4(&steps.dataset("CellOffsets")?, row, [0; 4])?;
        set_row_of_4(&steps.dataset("ConnectivityIdOffsets")?, row, connectivity_starts)?;

        self.steps += 1;
        steps.attr("NSteps")?.write_scalar(&(self.steps as i64))?;
        self.file.flush()
    }

    /// Reads the points and integers of the last kept step.
    fn recall_last_step(&self, root: &Group, steps: &Group) -> Hdf5Result<LastStep> {
        let (Some(row), Some(_)) = (self.steps.checked_sub(1), self.rest) else { return Ok(LastStep::default()) };
        let point_start = entry(&steps.dataset("PointOffsets")?, row)?;
        let count = entry(&root.dataset("NumberOfPoints")?, row)?;
        let points = read_vectors(&root.dataset("Points")?, point_start, count)?;
        let field = |(name, kind): &(String, FieldKind)| -> Hdf5Result<(Vec<i32>, usize)> {
            let start = entry(&steps.group("PointDataOffsets")?.dataset(name)?, row)?;
            let values = root.group("PointData")?.dataset(name)?;
            let integers = match kind {
                FieldKind::Integer => values.read_slice_1d::<i32, _>(start..start + count)?.to_vec(),
                _ => Vec::new(),
            };
            Ok((integers, start))
        };
        let fields = self.fields.iter().map(field).collect::<Hdf5Result<_>>()?;
        Ok(LastStep { points, point_start, fields })
    }

    /// Writes the cells of this step that the file does not have yet; returns the row of `Connectivity` where this step
    /// starts.
    fn write_cells(&mut self, root: &Group, points: usize, triangles: &[[u32; 3]], count: usize) -> Hdf5Result<usize> {
        let group = root.group(TOPOLOGIES[self.cells.topology()])?;
        let offsets = group.dataset("Offsets")?;
        let (present, corners) = (offsets.size(), self.cells.corners());
        let missing: Vec<i64> = (present..=count).map(|i| (i * corners) as i64).collect();
        append_rows(&offsets, &missing)?;

        let connectivity = group.dataset("Connectivity")?;
        match self.cells {
            Cells::Vertices => {
                let missing: Vec<i64> = (connectivity.size()..points).map(|i| i as i64).collect();
                append_rows(&connectivity, &missing)?;
                Ok(0)
            }
            Cells::Triangles => {
                if self.steps == 0 || self.last_triangles != triangles {
                    let ids: Vec<i64> = triangles.iter().flatten().map(|i| i64::from(*i)).collect();
                    self.last_connectivity_start = append_rows(&connectivity, &ids)?;
                    self.last_triangles = triangles.to_vec();
                }
                Ok(self.last_connectivity_start)
            }
        }
    }

    /// Cuts every dataset after the last of the `self.steps` kept steps.
    fn truncate(&mut self) -> Hdf5Result<()> {
        let root = self.file.group("VTKHDF")?;
        let steps = root.group("Steps")?;
        steps.attr("NSteps")?.write_scalar(&(self.steps as i64))?;
        let kept = self.steps;

        let end_of = |starts: &Dataset| -> Hdf5Result<usize> {
            let Some(last) = kept.checked_sub(1) else { return Ok(0) };
            Ok(entry(starts, last)? + entry(&root.dataset("NumberOfPoints")?, last)?)
        };
        cut(&root.dataset("Points")?, end_of(&steps.dataset("PointOffsets")?)?)?;
        let point_data_offsets = steps.group("PointDataOffsets")?;
        for (name, _) in &self.fields {
            let starts = point_data_offsets.dataset(name)?;
            cut(&root.group("PointData")?.dataset(name)?, end_of(&starts)?)?;
            cut(&starts, kept)?;
        }
        if self.cells == Cells::Triangles {
            self.recall_last_triangles(&root, &steps)?;
        }
        cut(&root.dataset("NumberOfPoints")?, kept)?;
        for name in TOPOLOGIES {
            let group = root.group(name)?;
            cut(&group.dataset("NumberOfCells")?, kept)?;
            cut(&group.dataset("NumberOfConnectivityIds")?, kept)?;
        }
        let of_steps =
            ["Values", "PartOffsets", "NumberOfParts", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"];
        of_steps.into_iter().try_for_each(|name| cut(&steps.dataset(name)?, kept))?;
        self.file.flush()
    }

    /// Reads the triangles of the last kept step, and cuts the dataset `Connectivity` after these triangles.
    fn recall_last_triangles(&mut self, root: &Group, steps: &Group) -> Hdf5Result<()> {
        let group = root.group(TOPOLOGIES[Cells::Triangles.topology()])?;
        let connectivity = group.dataset("Connectivity")?;
        let Some(last) = self.steps.checked_sub(1) else { return connectivity.resize(0) };
        let ids = entry(&group.dataset("NumberOfConnectivityIds")?, last)?;
        let offsets = steps.dataset("ConnectivityIdOffsets")?;
        let start = offsets.read_2d::<i64>()?.get((last, Cells::Triangles.topology())).copied();
        self.last_connectivity_start =
            start.and_then(|start| usize::try_from(start).ok()).ok_or_else(|| damaged(&offsets))?;
        let end = self.last_connectivity_start + ids;
        cut(&connectivity, end)?;
        let corners = connectivity.read_slice_1d::<i64, _>(self.last_connectivity_start..end)?;
        let corners: Vec<u32> = corners.iter().map(|i| u32::try_from(*i).unwrap_or(0)).collect();
        self.last_triangles = corners.chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        Ok(())
    }
}

/// Returns true if as many points as before are no further than `distance` [m] from their positions before.
fn are_within(before: &[[f32; 3]], now: &[[f32; 3]], distance: f32) -> bool {
    let is_near = |(a, b): (&[f32; 3], &[f32; 3])| {
        (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f32>() <= distance * distance
    };
    before.len() == now.len() && before.iter().zip(now).all(is_near)
}
