//! Groups and datasets of a VTKHDF PolyData file, and how rows are put into them.

use hdf5_metno::types::FixedAscii;
use hdf5_metno::{Dataset, File, Group, H5Type};

use super::FieldKind;

pub(super) type Hdf5Result<T> = hdf5_metno::Result<T>;

/// Rows of a chunk in the long datasets (64 KiB for one f32 a row).
const LONG_CHUNK: usize = 16_384;
/// Rows of a chunk in the datasets with one row a step.
const STEP_CHUNK: usize = 256;
/// The four topologies of VTK's PolyData, in the order of the columns of `CellOffsets`.
pub(super) const TOPOLOGIES: [&str; 4] = ["Vertices", "Lines", "Polygons", "Strips"];

/// HDF5 without file locks, so that ParaView can look at a run in progress.
pub(super) fn unlocked() -> hdf5_metno::FileBuilder {
    let mut builder = File::with_options();
    builder.with_fapl(|access| access.file_locking(false));
    builder
}

/// Groups, attributes and empty datasets.
pub(super) fn write_skeleton(file: &File, fields: &[(&str, FieldKind)]) -> Hdf5Result<()> {
    let root = file.create_group("VTKHDF")?;
    root.new_attr_builder().with_data(&[2_i64, 0]).create("Version")?;
    let kind = FixedAscii::<8>::from_ascii("PolyData").map_err(|e| hdf5_metno::Error::from(e.to_string()))?;
    root.new_attr::<FixedAscii<8>>().create("Type")?.write_scalar(&kind)?;
    let steps = root.create_group("Steps")?;
    steps.new_attr::<i64>().create("NSteps")?.write_scalar(&0_i64)?;
    new_list::<f64>(&steps, "Values", STEP_CHUNK)?;
    for name in ["PartOffsets", "NumberOfParts", "PointOffsets"] {
        new_list::<i64>(&steps, name, STEP_CHUNK)?;
    }
    for name in ["CellOffsets", "ConnectivityIdOffsets"] {
        steps.new_dataset::<i64>().chunk((STEP_CHUNK, 4)).shape((0.., 4)).create(name)?;
    }
    new_list::<i64>(&root, "NumberOfPoints", STEP_CHUNK)?;
    new_list_of_3(&root, "Points")?;
    for name in TOPOLOGIES {
        let group = root.create_group(name)?;
        new_list::<i64>(&group, "NumberOfCells", STEP_CHUNK)?;
        new_list::<i64>(&group, "NumberOfConnectivityIds", STEP_CHUNK)?;
        // The reader wants the leading 0 even where there are no cells.
        append_rows(&new_list::<i64>(&group, "Offsets", LONG_CHUNK)?, &[0_i64])?;
        new_list::<i64>(&group, "Connectivity", LONG_CHUNK)?;
    }
    let point_data = root.create_group("PointData")?;
    let offsets = steps.create_group("PointDataOffsets")?;
    for (name, kind) in fields {
        match kind {
            FieldKind::Scalar => new_list::<f32>(&point_data, name, LONG_CHUNK)?,
            FieldKind::Vector => new_list_of_3(&point_data, name)?,
            FieldKind::Integer => new_list::<i32>(&point_data, name, LONG_CHUNK)?,
        };
        new_list::<i64>(&offsets, name, STEP_CHUNK)?;
    }
    Ok(())
}

fn new_list<T: H5Type>(group: &Group, name: &str, chunk: usize) -> Hdf5Result<Dataset> {
    group.new_dataset::<T>().chunk(chunk).shape(0..).create(name)
}

fn new_list_of_3(group: &Group, name: &str) -> Hdf5Result<Dataset> {
    group.new_dataset::<f32>().chunk((LONG_CHUNK, 3)).shape((0.., 3)).create(name)
}

/// Appends values to a list; returns where they start.
pub(super) fn append_rows<T: H5Type>(dataset: &Dataset, values: &[T]) -> Hdf5Result<usize> {
    let start = dataset.size();
    if !values.is_empty() {
        dataset.resize(start + values.len())?;
        dataset.write_slice::<_, T, _, _>(values, start..start + values.len())?;
    }
    Ok(start)
}

/// Appends rows of three values; returns where they start.
pub(super) fn append_rows_of_3(dataset: &Dataset, rows: &[[f32; 3]]) -> Hdf5Result<usize> {
    let start = dataset.size() / 3;
    if !rows.is_empty() {
        dataset.resize((start + rows.len(), 3))?;
        dataset.write_slice::<_, f32, _, _>(rows, (start..start + rows.len(), ..))?;
    }
    Ok(start)
}

/// Sets one row of a list, making the list `row + 1` long.
pub(super) fn set_row<T: H5Type + Copy>(dataset: &Dataset, row: usize, value: T) -> Hdf5Result<()> {
    dataset.resize(row + 1)?;
    dataset.write_slice::<_, T, _, _>(&[value], row..=row)
}

/// Sets one row of four values, making the list `row + 1` long.
pub(super) fn set_row_of_4(dataset: &Dataset, row: usize, values: [i64; 4]) -> Hdf5Result<()> {
    dataset.resize((row + 1, 4))?;
    dataset.write_slice::<_, i64, _, _>(&[values], (row..=row, ..))
}
