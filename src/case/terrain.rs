//! A triangle surface to stand on, read from an STL file.

use std::path::Path;
use std::sync::Arc;

use super::check::{Checker, above};
use super::file::TerrainFile;
use crate::geometry::stl;
use crate::geometry::terrain::Terrain;

/// Triangles at most: a run keeps about a kilobyte for each.
const MOST_TRIANGLES: usize = 2_000_000;

/// A triangle surface with what was read, so that a run can keep it beside its case.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteTerrain {
    /// The surface [m].
    pub surface: Arc<Terrain>,
    /// Content of the file.
    pub content: Arc<Vec<u8>>,
    scale: f64,
}

impl SiteTerrain {
    /// Name of the file in a run's folder.
    pub const FILE: &str = "terrain.stl";

    /// The entry of a case file that lies beside [`Self::FILE`].
    pub(super) fn entry(&self) -> TerrainFile {
        TerrainFile { path: Self::FILE.to_owned(), scale: self.scale }
    }
}

/// Read the file, seen from the folder of the case file `case_name`.
pub(super) fn validate(file: &TerrainFile, case_name: &str, check: &mut Checker) -> Option<SiteTerrain> {
    let advice = "1 for a file in metres, 0.001 for one in millimetres";
    if !check.number("flume.terrain.scale", file.scale, above(0.0).up_to(1000.0), "", advice) {
        return None;
    }
    let path = Path::new(case_name).parent().unwrap_or(Path::new("")).join(&file.path);
    let shown = format!("{:?}", path.display().to_string());
    let mut refuse = |allowed: String, advice: &str| {
        check.refuse("flume.terrain.path", shown.clone(), allowed, advice);
        None
    };
    let content = match std::fs::read(&path) {
        Ok(content) => content,
        Err(error) => return refuse(format!("a file that can be read ({error})"), "paths are seen from the case file"),
    };
    let surface = match stl::parse_terrain(&content, &path, file.scale) {
        Ok(surface) => surface,
        Err(error) => {
            let advice =
                "triangles must be counter-clockwise seen from where the units are, and share their edges in pairs";
            return refuse(format!("a surface to stand on ({error})"), advice);
        }
    };
    if surface.triangles().len() > MOST_TRIANGLES {
        return refuse(format!("at most {MOST_TRIANGLES} triangles"), "simplify the surface to the size of a leg");
    }
    Some(SiteTerrain { surface: Arc::new(surface), content: Arc::new(content), scale: file.scale })
}
