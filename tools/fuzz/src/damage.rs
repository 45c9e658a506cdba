//! Damages the files of a run folder.

use std::fs;
use std::path::Path;

use hdf5_metno::types::{TypeDescriptor, VarLenUnicode};
use hdf5_metno::{Dataset, File, Group, H5Type};

use crate::json::Mutator;
use crate::random::Random;
use crate::text;

/// Name of the HDF5 attribute with the JSON text of a checkpoint.
const STATE: &str = "state";

/// Damages run folders; the mutations of JSON files use the keys of the valid files.
pub struct Damage {
    json: Mutator,
}

impl Damage {
    pub fn new(runs: &[Vec<(String, Vec<u8>)>]) -> Self {
        let files = runs.iter().flatten().filter(|(name, _)| name == "checkpoint.json");
        Self { json: Mutator::new(files.map(|(_, content)| content)) }
    }

    /// Damages one file of the run folder, in most cases the checkpoint. `is_intact` is true if no file of the folder is
    /// damaged yet.
    pub fn apply(&self, dir: &Path, is_intact: bool, random: &mut Random) {
        let mut names: Vec<String> =
            fs::read_dir(dir).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        let checkpoint = names.iter().find(|name| name.starts_with("checkpoint.")).cloned();
        let name = checkpoint.filter(|_| random.below(4) > 0).unwrap_or_else(|| random.pick(&names).clone());
        let path = dir.join(&name);
        // The HDF5 library fails, hangs or allocates too much memory if the file is damaged already.
        let is_state = is_intact && name.starts_with("checkpoint.h5");
        if is_state && random.below(8) > 0 && self.damage_state(&path, random).is_ok() {
            return;
        }
        let content = fs::read(&path).unwrap();
        let damaged = match name.ends_with(".json") {
            true => self.json.mutate(&content, random),
            false if random.below(20) == 0 => return fs::remove_file(&path).unwrap(),
            false => text::mutate(&content, random),
        };
        fs::write(path, damaged).unwrap();
    }

    /// Damages the JSON text or a dataset of a checkpoint.
    fn damage_state(&self, path: &Path, random: &mut Random) -> hdf5_metno::Result<()> {
        let file = File::open_rw(path)?;
        if random.below(2) == 0 {
            let state = file.attr(STATE)?.read_scalar::<VarLenUnicode>()?.to_string();
            let state = self.json.mutate(state.as_bytes(), random);
            let Ok(state) = String::from_utf8_lossy(&state).parse::<VarLenUnicode>() else { return Ok(()) };
            file.delete_attr(STATE)?;
            return file.new_attr::<VarLenUnicode>().create(STATE)?.write_scalar(&state);
        }
        let mut datasets = Vec::new();
        for group in file.groups()? {
            datasets.extend(group.datasets()?.into_iter().map(|dataset| (group.clone(), dataset)));
        }
        if datasets.is_empty() {
            return Ok(());
        }
        let (group, dataset) = random.pick(&datasets);
        use hdf5_metno::types::{FloatSize, IntSize};
        match dataset.dtype()?.to_descriptor()? {
            TypeDescriptor::Float(FloatSize::U4) => damage_values(group, dataset, &[f32::NAN, 1e38, -1.0, 0.0], random),
            TypeDescriptor::Float(_) => {
                let extremes = [f64::NAN, f64::INFINITY, 1e308, -1e308, 1e18, -1.0, 0.0, 1.0, 1e-308];
                damage_values(group, dataset, &extremes, random)
            }
            TypeDescriptor::Unsigned(IntSize::U1) => damage_values(group, dataset, &[0_u8, 1, 3, 9, u8::MAX], random),
            TypeDescriptor::Unsigned(IntSize::U4) => damage_values(group, dataset, &[0, 1, 40, u32::MAX], random),
            _ => damage_values(group, dataset, &[0, 1, 40, u64::MAX], random),
        }
    }
}

/// Replaces values of a dataset by extreme values, or replaces the dataset by one with another shape.
fn damage_values<T: H5Type + Copy>(
    group: &Group,
    dataset: &Dataset,
    extremes: &[T],
    random: &mut Random,
) -> hdf5_metno::Result<()> {
    let mut values: Vec<T> = dataset.read_raw()?;
    let shape = dataset.shape();
    let name = dataset.name();
    let name = name.rsplit('/').next().unwrap_or_default();
    let rows = shape[0];
    let width = shape.get(1).copied().unwrap_or(1);
    match random.below(6) {
        0..3 if !values.is_empty() => {
            for _ in 0..1 + random.below(3) {
                let at = random.below(values.len());
                values[at] = *random.pick(extremes);
            }
            if random.below(4) == 0 {
                values.fill(*random.pick(extremes));
            }
            return dataset.write_raw(&values);
        }
        3 => {
            group.unlink(name)?;
            return Ok(());
        }
        4 => values.truncate(random.below(rows + 1) * width),
        _ => values.resize((rows + 1 + random.below(3)) * width, *random.pick(extremes)),
    }
    group.unlink(name)?;
    let shape = if shape.len() == 1 { vec![values.len()] } else { vec![values.len() / width, width] };
    group.new_dataset::<T>().shape(shape).create(name)?.write_raw(&values)
}
