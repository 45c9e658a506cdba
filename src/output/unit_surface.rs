//! File with the surface of an armour unit, for the drawings in the report.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::{OutputError, write_atomically};
use crate::geometry::solid::Solid;

/// A closed surface of triangles in the body axes of the unit. The origin is the centre of mass.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct UnitSurface {
    /// Corner points of the triangles [m].
    pub vertices_m: Vec<[f64; 3]>,
    /// Indices of the three corner points of each triangle, in counter-clockwise order for a viewer outside the unit.
    pub triangles: Vec<[u32; 3]>,
}

impl UnitSurface {
    /// Name of the surface file of the first model of units in a run folder.
    pub const FILE: &str = "unit_surface.json";

    /// Copies the surface of a solid.
    pub fn of(solid: &Solid) -> Self {
        let vertices_m = solid.vertices().iter().map(|v| v.to_array()).collect();
        Self { vertices_m, triangles: solid.triangles().to_vec() }
    }

    /// Returns the name of the surface file of a model of units in a run folder; `model` counts the models of all groups
    /// from 0.
    pub fn file_of(model: usize) -> String {
        if model == 0 { Self::FILE.to_owned() } else { format!("unit_surface_{}.json", model + 1) }
    }

    /// Writes the surface of each model of units into a run folder.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write_models<'a>(models: impl Iterator<Item = &'a Solid>, dir: &Path) -> Result<(), OutputError> {
        models.enumerate().try_for_each(|(model, solid)| Self::of(solid).write(&dir.join(Self::file_of(model))))
    }

    /// Writes the surface to `path`.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), OutputError> {
        let bytes = serde_json::to_vec(self).map_err(OutputError::json(path))?;
        write_atomically(path, &bytes)
    }

    /// Reads a surface from `path`.
    ///
    /// # Errors
    /// If the file cannot be read, or a triangle refers to a missing corner point.
    pub fn read(path: &Path) -> Result<Self, OutputError> {
        let bytes = std::fs::read(path).map_err(OutputError::io(path))?;
        let surface: Self = serde_json::from_slice(&bytes).map_err(OutputError::json(path))?;
        let points = surface.vertices_m.len();
        match surface.triangles.iter().flatten().find(|i| **i as usize >= points) {
            Some(i) => Err(OutputError::content(
                path,
                format!("a triangle refers to point {i}, but there are only {points} points, numbered from 0"),
            )),
            None => Ok(surface),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_surface_reads_back_and_a_missing_corner_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(UnitSurface::FILE);
        let mut surface = UnitSurface {
            vertices_m: vec![[0.0, 0.0, 0.1], [0.1, 0.0, 0.0], [0.0, 0.1, 0.0]],
            triangles: vec![[0, 1, 2]],
        };
        surface.write(&path).unwrap();
        assert_eq!(UnitSurface::read(&path).unwrap(), surface);
        surface.triangles.push([0, 1, 3]);
        surface.write(&path).unwrap();
        assert!(UnitSurface::read(&path).unwrap_err().to_string().contains("point 3, but there are only 3 points"));
    }
}
