//! Validates a unit from STL files: its surface and its convex parts. The parts come from files or from decomposition.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::case::file::StlFile;
use crate::case::reading::check::{Checker, as_text, more_than};
use crate::geometry::armour_unit::LARGEST_ROUNDING;
use crate::geometry::convex::polyhedron::Polyhedron;
use crate::geometry::decomposition::{self, Decomposition, MOST_PARTS};
use crate::geometry::solid::Solid;
use crate::geometry::stl::{self, StlError};

/// Largest allowed volume that convex parts and unit do not have in common, divided by the volume of the unit [-].
const LARGEST_ERROR: f64 = 0.05;

/// Largest number of triangles of a file. On two cores, `check` takes about 6 s for this number.
const MOST_TRIANGLES: usize = 200_000;

/// A unit from STL files and the content of these files. A run saves the content next to its case file.
#[derive(Debug, Clone)]
pub struct StlUnit {
    solid: Arc<Solid>,
    parts: Arc<Vec<Polyhedron>>,
    /// Volume that convex parts and unit do not have in common, divided by the volume of the unit [-].
    pub volume_error: f64,
    /// Name in the run folder and content of each file.
    files: Arc<Vec<(String, Vec<u8>)>>,
    scale: f64,
}

impl PartialEq for StlUnit {
    fn eq(&self, other: &Self) -> bool {
        self.files == other.files && self.scale == other.scale
    }
}

impl StlUnit {
    /// Returns the closed surface of the unit [m].
    pub fn solid(&self) -> &Solid {
        &self.solid
    }

    /// Returns the convex parts of the unit [m].
    pub fn parts(&self) -> &[Polyhedron] {
        &self.parts
    }

    /// Returns the name in the run folder and the content of each file.
    pub fn files(&self) -> &[(String, Vec<u8>)] {
        &self.files
    }

    /// Returns the `stl` entry for the case file in the run folder. The entry refers to [`Self::files`].
    pub fn entry(&self) -> StlFile {
        let names: Vec<String> = self.files.iter().map(|(name, _)| name.clone()).collect();
        StlFile { path: names[0].clone(), scale: self.scale, parts: names[1..].to_vec() }
    }
}

/// Reads the STL files and checks that the convex parts fill the unit. Paths are relative to the folder of the case
/// file `case_name`. The names of the stored files begin with `stem`.
pub fn validate(
    file: &StlFile,
    rounding_share: f64,
    case_name: &str,
    stem: &str,
    check: &mut Checker,
) -> Option<StlUnit> {
    let advice = "1 for a file in metres, 0.001 for a file in millimetres";
    if !check.number(".stl.scale", file.scale, more_than(0.0).up_to(1000.0), "", advice) {
        return None;
    }
    if file.parts.len() > MOST_PARTS {
        let given = format!("{} files", file.parts.len());
        check.reject(".stl.parts", given, format!("at most {MOST_PARTS}"), "use fewer convex parts");
        return None;
    }
    let folder = Path::new(case_name).parent().unwrap_or(Path::new(""));
    let mut files = Vec::new();
    let mut read = |path: &str, key: &str, name: String, check: &mut Checker| {
        let path: PathBuf = folder.join(path);
        let mut refuse = |reason: String| {
            let advice = "write one closed surface without holes, with triangles counter-clockwise seen from outside";
            check.reject(key, format!("{:?}", path.display().to_string()), reason, advice);
        };
        match std::fs::read(&path) {
            Ok(bytes) => match stl::parse(&bytes, &path, file.scale) {
                Ok(solid) if solid.triangles().len() > MOST_TRIANGLES => {
                    let given = format!("{:?} with {} triangles", path.display().to_string(), solid.triangles().len());
                    let advice = "make the mesh coarser; a few thousand triangles describe any unit";
                    check.reject(key, given, format!("at most {MOST_TRIANGLES} triangles"), advice);
                    None
                }
                Ok(solid) => {
                    let bodies = solid.body_count();
                    if bodies > 1 {
                        refuse(format!("one body (the file has {bodies} separate closed surfaces)"));
                        return None;
                    }
                    if let Some(point) = solid.self_intersection() {
                        refuse(format!("a surface that does not intersect itself (it does near {point} m)"));
                        return None;
                    }
                    files.push((name, bytes));
                    Some(solid)
                }
                Err(StlError::Format { reason, .. }) => {
                    refuse(format!("a complete STL file ({reason})"));
                    None
                }
                Err(error) => {
                    refuse(format!("a closed surface ({error})"));
                    None
                }
            },
            Err(error) => {
                refuse(format!("a file that can be read ({error})"));
                None
            }
        }
    };
    let solid = read(&file.path, ".stl.path", format!("{stem}.stl"), check)?;
    let mut parts = Vec::new();
    for (index, path) in file.parts.iter().enumerate() {
        let part = read(path, &format!(".stl.parts[{index}]"), format!("{stem}_part_{}.stl", index + 1), check)?;
        match Polyhedron::hull(part.vertices()) {
            Ok(hull) => parts.push(hull),
            Err(error) => {
                let advice = "each part is replaced by its convex hull";
                check.reject(&format!(".stl.parts[{index}]"), format!("{path:?}"), error.to_string(), advice);
                return None;
            }
        }
    }
    let [low, high] = solid.bounds();
    // The rounding of a part needs this inner radius.
    let thinnest = rounding_share * (high.z - low.z) / LARGEST_ROUNDING;
    let (key, advice, found) = if parts.is_empty() {
        let advice = format!(
            "give the convex parts as separate STL files in `stl.parts`; parts thinner than {} m do not fit \
             contact.rounding_share = {rounding_share}",
            as_text(2.0 * thinnest)
        );
        (".stl.path", advice, decomposition::decompose(&solid, thinnest))
    } else {
        let advice = "check that the parts fill the unit, have no dents and are in the same place".to_owned();
        (".stl.parts", advice, decomposition::measure(&solid, parts))
    };
    let Decomposition { parts, volume_error } = found;
    if volume_error > LARGEST_ERROR || parts.is_empty() {
        let given = format!(
            "{} convex parts that differ from the unit by {:.1} % of its volume",
            parts.len(),
            100.0 * volume_error
        );
        let allowed = format!("parts that differ by at most {} %", as_text(100.0 * LARGEST_ERROR));
        check.reject(key, given, allowed, advice);
        return None;
    }
    Some(StlUnit {
        solid: Arc::new(solid),
        parts: Arc::new(parts),
        volume_error,
        files: Arc::new(files),
        scale: file.scale,
    })
}
