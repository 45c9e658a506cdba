//! Validates terrain: a triangle surface from an STL file on which units stand.

use std::path::Path;
use std::sync::Arc;

use crate::case::file::TerrainFile;
use crate::case::reading::check::{Checker, more_than};
use crate::geometry::stl;
use crate::geometry::terrain::Terrain;

/// Largest number of triangles. A run needs about one kilobyte of memory per triangle.
const MOST_TRIANGLES: usize = 2_000_000;

/// A triangle surface and the content of its STL file. A run saves this content next to its case file.
#[derive(Debug, Clone, PartialEq)]
pub struct SiteTerrain {
    /// The surface [m].
    pub surface: Arc<Terrain>,
    /// Content of the STL file.
    pub content: Arc<Vec<u8>>,
    scale: f64,
}

impl SiteTerrain {
    /// Name of the STL file in the run folder.
    pub const FILE: &str = "terrain.stl";

    /// Returns the `terrain` entry for the case file in the run folder. The entry refers to the file [`Self::FILE`].
    pub(in crate::case) fn entry(&self) -> TerrainFile {
        TerrainFile { path: Self::FILE.to_owned(), scale: self.scale }
    }
}

/// Reads and validates the STL file. Its path is relative to the folder of the case file `case_name`.
pub fn validate(file: &TerrainFile, case_name: &str, check: &mut Checker) -> Option<SiteTerrain> {
    let advice = "1 for a file in metres, 0.001 for a file in millimetres";
    if !check.number("flume.terrain.scale", file.scale, more_than(0.0).up_to(1000.0), "", advice) {
        return None;
    }
    let path = Path::new(case_name).parent().unwrap_or(Path::new("")).join(&file.path);
    let shown = format!("{:?}", path.display().to_string());
    let mut refuse = |allowed: String, advice: &str| {
        check.reject("flume.terrain.path", shown.clone(), allowed, advice);
        None
    };
    let content = match std::fs::read(&path) {
        Ok(content) => content,
        Err(error) => {
            return refuse(format!("a file that can be read ({error})"), "paths are relative to the case file");
        }
    };
    let surface = match stl::parse_terrain(&content, &path, file.scale) {
        Ok(surface) => surface,
        Err(error) => {
            let advice =
                "triangles must be counter-clockwise seen from the units, and at most two triangles may share an edge";
            return refuse(format!("a valid terrain surface ({error})"), advice);
        }
    };
    if surface.triangles().len() > MOST_TRIANGLES {
        return refuse(
            format!("at most {MOST_TRIANGLES} triangles"),
            "use triangles about as large as a leg of a unit",
        );
    }
    Some(SiteTerrain { surface: Arc::new(surface), content: Arc::new(content), scale: file.scale })
}
