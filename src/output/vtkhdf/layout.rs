//! Groups and datasets of VTKHDF files, and functions that append or set their rows.

use std::path::Path;

use hdf5_metno::plist::file_access::FileAccessBuilder;
use hdf5_metno::types::FixedAscii;
use hdf5_metno::{Dataset, File, Group, H5Type};

use super::super::OutputError;
use super::{FieldKind, FieldValues};

pub(super) type Hdf5Result<T> = hdf5_metno::Result<T>;

/// Rows per chunk in datasets with one row per point or cell. A chunk with one f32 per row has 64 KiB.
pub(super) const LONG_CHUNK: usize = 16_384;
/// Rows per chunk in the datasets with one row per step (recorded time).
pub(super) const STEP_CHUNK: usize = 256;
/// Names of the four topologies of PolyData in VTK, in the order of the columns of `CellOffsets`.
pub(super) const TOPOLOGIES: [&str; 4] = ["Vertices", "Lines", "Polygons", "Strips"];

/// Returns a file builder without file locks, so that ParaView can open the files of a run in progress.
pub(super) fn unlocked() -> hdf5_metno::FileBuilder {
    let mut builder = File::with_options();
    builder.with_fapl(|access| access.file_locking(false));
    builder
}

/// Creates a file, or empties an existing one. The indices of its chunks have checksums: the library refuses damaged
/// indices, while it crashes on some damaged indices of its oldest format, which has no checksums.
///
/// # Errors
/// If the file cannot be written.
pub(super) fn create_unlocked(path: &Path) -> Hdf5Result<File> {
    let from_version = |choose: fn(&mut FileAccessBuilder) -> &mut FileAccessBuilder| {
        let mut builder = unlocked();
        builder.with_fapl(choose);
        builder
    };
    // Files that version 1.10 creates have a mark while a program writes to them. ParaView could not open the file of a
    // run in progress, and no program the file of a killed run. So version 1.8 creates the file, and version 1.10 its
    // datasets.
    drop(from_version(FileAccessBuilder::libver_v18).with_fcpl(|file| file.obj_track_times(false)).create(path)?);
    from_version(FileAccessBuilder::libver_v110).open_rw(path)
}

/// Opens a file with at least `steps` steps and the given fields in the group `VTKHDF/{group}`.
///
/// # Errors
/// If the file cannot be opened, lacks a field, or has fewer steps.
pub(super) fn open_with_steps(
    path: &Path,
    group: &str,
    fields: &[(&str, FieldKind)],
    steps: usize,
) -> Result<File, OutputError> {
    let open = || -> Hdf5Result<(File, usize)> {
        let file = unlocked().open_rw(path)?;
        let present = file.group("VTKHDF/Steps")?.attr("NSteps")?.read_scalar::<i64>()?;
        for (name, _) in fields {
            file.dataset(&format!("VTKHDF/{group}/{name}"))?;
        }
        Ok((file, usize::try_from(present).unwrap_or(0)))
    };
    let (file, present) = open().map_err(OutputError::hdf5(path))?;
    if present < steps {
        let what = format!("has {present} steps, fewer than the {steps} at the checkpoint");
        return Err(OutputError::content(path, what));
    }
    Ok(file)
}

/// Creates a group without the wall time of its creation, so that equal runs have equal files.
pub(super) fn new_group(parent: &Group, name: &str) -> Hdf5Result<Group> {
    parent.create_group_builder().with_create_plist(|group| group.obj_track_times(false)).create(name)
}

/// Creates the groups `VTKHDF` and `Steps`, and the attributes for version and type. `LETTERS` is the length of
/// `type_name`, because VTK requires a string of exactly this length.
pub(super) fn new_root<const LETTERS: usize>(file: &File, type_name: &str) -> Hdf5Result<[Group; 2]> {
    let root = new_group(file, "VTKHDF")?;
    root.new_attr_builder().with_data(&[2_i64, 0]).create("Version")?;
    let kind = FixedAscii::<LETTERS>::from_ascii(type_name).map_err(|e| hdf5_metno::Error::from(e.to_string()))?;
    root.new_attr::<FixedAscii<LETTERS>>().create("Type")?.write_scalar(&kind)?;
    let steps = new_group(&root, "Steps")?;
    Ok([root, steps])
}

/// Creates the groups, attributes and empty datasets of a PolyData file.
pub(super) fn write_skeleton(file: &File, fields: &[(&str, FieldKind)]) -> Hdf5Result<()> {
    let [root, steps] = new_root::<8>(file, "PolyData")?;
    steps.new_attr::<i64>().create("NSteps")?.write_scalar(&0_i64)?;
    new_list::<f64>(&steps, "Values", STEP_CHUNK)?;
    for name in ["PartOffsets", "NumberOfParts", "PointOffsets"] {
        new_list::<i64>(&steps, name, STEP_CHUNK)?;
    }
    for name in ["CellOffsets", "ConnectivityIdOffsets"] {
        steps.new_dataset::<i64>().chunk((STEP_CHUNK, 4)).shape((0.., 4)).create(name)?;
    }
    new_list::<i64>(&root, "NumberOfPoints", STEP_CHUNK)?;
    new_rows::<3>(&root, "Points")?;
    for name in TOPOLOGIES {
        let group = new_group(&root, name)?;
        new_list::<i64>(&group, "NumberOfCells", STEP_CHUNK)?;
        new_list::<i64>(&group, "NumberOfConnectivityIds", STEP_CHUNK)?;
        // The VTK reader needs the first offset 0 even if there are no cells.
        append_rows(&new_list::<i64>(&group, "Offsets", LONG_CHUNK)?, &[0_i64])?;
        new_list::<i64>(&group, "Connectivity", LONG_CHUNK)?;
    }
    let point_data = new_group(&root, "PointData")?;
    let offsets = new_group(&steps, "PointDataOffsets")?;
    fields.iter().try_for_each(|(name, kind)| new_field(&point_data, &offsets, name, *kind))
}

/// Creates the dataset of a field, and the dataset with the first row of each step in this field.
pub(super) fn new_field(data: &Group, offsets: &Group, name: &str, kind: FieldKind) -> Hdf5Result<()> {
    match kind {
        FieldKind::Scalar => new_list::<f32>(data, name, LONG_CHUNK)?,
        FieldKind::Vector => new_rows::<3>(data, name)?,
        FieldKind::Tensor => new_rows::<6>(data, name)?,
        FieldKind::Integer => new_list::<i32>(data, name, LONG_CHUNK)?,
    };
    new_list::<i64>(offsets, name, STEP_CHUNK)?;
    Ok(())
}

/// Appends the values of a field; returns the row of the first new value.
pub(super) fn append_values(dataset: &Dataset, values: &FieldValues<'_>) -> Hdf5Result<usize> {
    match values {
        FieldValues::Scalar(values) => append_rows(dataset, values),
        FieldValues::Vector(values) => append_rows_of(dataset, values),
        FieldValues::Tensor(values) => append_rows_of(dataset, values),
        FieldValues::Integer(values) => append_rows(dataset, values),
    }
}

/// Cuts a dataset to its first `rows` rows.
///
/// # Errors
/// If the dataset has fewer rows.
pub(super) fn cut(dataset: &Dataset, rows: usize) -> Hdf5Result<()> {
    let mut shape = dataset.shape();
    match shape.first_mut() {
        Some(present) if *present >= rows => *present = rows,
        _ => return Err(damaged(dataset)),
    }
    dataset.resize(shape)
}

/// Returns the entry `row` of a dataset with one count or start row per step.
///
/// # Errors
/// If the entry is missing or negative.
pub(super) fn entry(dataset: &Dataset, row: usize) -> Hdf5Result<usize> {
    let entries = dataset.read_1d::<i64>()?;
    entries.get(row).and_then(|entry| usize::try_from(*entry).ok()).ok_or_else(|| damaged(dataset))
}

/// Reads the entries of a dataset with one count or start row per step, for the first `steps` steps.
///
/// # Errors
/// If the dataset has fewer entries, or an entry is negative.
pub(super) fn entries(file: &File, name: &str, steps: usize) -> Hdf5Result<Vec<usize>> {
    let dataset = file.dataset(&format!("VTKHDF/{name}"))?;
    let values: Vec<i64> = dataset.read_raw()?;
    let kept = values.get(..steps).ok_or_else(|| damaged(&dataset))?;
    kept.iter().map(|value| usize::try_from(*value).map_err(|_| damaged(&dataset))).collect()
}

/// Reads `count` rows of three values, starting at the row `start`.
///
/// # Errors
/// If the dataset has fewer rows, or does not have three columns.
pub(super) fn read_vectors(dataset: &Dataset, start: usize, count: usize) -> Hdf5Result<Vec<[f32; 3]>> {
    let rows = dataset.read_slice_2d::<f32, _>((start..start + count, ..))?;
    if rows.ncols() != 3 {
        return Err(damaged(dataset));
    }
    Ok(rows.outer_iter().map(|row| [row[0], row[1], row[2]]).collect())
}

/// Returns the error for a dataset whose content does not match the rest of the file.
pub(super) fn damaged(dataset: &Dataset) -> hdf5_metno::Error {
    format!("the dataset {} is damaged; rerun the case", dataset.name()).into()
}

pub(super) fn new_list<T: H5Type>(group: &Group, name: &str, chunk: usize) -> Hdf5Result<Dataset> {
    group.new_dataset::<T>().chunk(chunk).shape(0..).create(name)
}

pub(super) fn new_rows<const N: usize>(group: &Group, name: &str) -> Hdf5Result<Dataset> {
    group.new_dataset::<f32>().chunk((LONG_CHUNK, N)).shape((0.., N)).create(name)
}

/// Appends values to a dataset of one column; returns the row of the first new value.
pub(super) fn append_rows<T: H5Type>(dataset: &Dataset, values: &[T]) -> Hdf5Result<usize> {
    let start = dataset.size();
    if !values.is_empty() {
        dataset.resize(start + values.len())?;
        dataset.write_slice::<_, T, _, _>(values, start..start + values.len())?;
    }
    Ok(start)
}

/// Appends rows of `N` values; returns the index of the first new row.
pub(super) fn append_rows_of<const N: usize>(dataset: &Dataset, rows: &[[f32; N]]) -> Hdf5Result<usize> {
    let start = dataset.size() / N;
    if !rows.is_empty() {
        dataset.resize((start + rows.len(), N))?;
        dataset.write_slice::<_, f32, _, _>(rows, (start..start + rows.len(), ..))?;
    }
    Ok(start)
}

/// Sets one row of a dataset of one column, and sets the length of the dataset to `row + 1`.
pub(super) fn set_row<T: H5Type + Copy>(dataset: &Dataset, row: usize, value: T) -> Hdf5Result<()> {
    dataset.resize(row + 1)?;
    dataset.write_slice::<_, T, _, _>(&[value], row..=row)
}

/// Sets one row of a dataset of four columns, and sets the length of the dataset to `row + 1`.
pub(super) fn set_row_of_4(dataset: &Dataset, row: usize, values: [i64; 4]) -> Hdf5Result<()> {
    dataset.resize((row + 1, 4))?;
    dataset.write_slice::<_, i64, _, _>(&[values], (row..=row, ..))
}
