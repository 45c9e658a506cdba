//! Validates terrain: a triangle surface from an STL file on which units stand.

use std::path::Path;
use std::sync::Arc;

use glam::DVec3;

use crate::case::file::TerrainFile;
use crate::case::reading::check::{Checker, as_text, more_than};
use crate::geometry::profile::Profile;
use crate::geometry::stl::{self, StlError};
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
    /// Metres per length unit of the file [-].
    pub scale: f64,
}

impl SiteTerrain {
    /// Name of the STL file in the run folder.
    pub const FILE: &str = "terrain.stl";

    /// Returns the `terrain` entry for the case file in the run folder. The entry refers to the file [`Self::FILE`].
    pub(in crate::case) fn entry(&self) -> TerrainFile {
        TerrainFile { path: Self::FILE.to_owned(), scale: self.scale, section_y_m: None }
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
        Err(StlError::Format { reason, .. }) => {
            return refuse(format!("a complete STL file ({reason})"), "export the surface as STL again");
        }
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

/// Number of sample points along each side of the area in which terrain and domain overlap. A terrain that covers less
/// than about a fortieth of each side may be missed.
const SAMPLES: u32 = 40;
/// Largest allowed length of the surface, divided by the length of the domain [-]. A surface in millimetres that is
/// read in metres is a thousand times too long.
const LONGEST: f64 = 200.0;
/// Smallest allowed length of the surface, divided by the length of the domain [-]. The smallest useful surface is a
/// rock of a few centimetres in a domain of some metres. A surface in metres that is read in millimetres is smaller.
const SHORTEST: f64 = 5e-3;

/// Checks that the surface has a plausible size, lies in the domain and faces up. The domain has the length x\[0\] to
/// x\[1\], the width 0 to `width` and walls up to `top_z` [m].
pub fn validate_place(
    terrain: &SiteTerrain,
    profile: &Profile,
    x: [f64; 2],
    width: f64,
    top_z: f64,
    check: &mut Checker,
) {
    let [low, high] = terrain.surface.bounds();
    let range = |low: f64, high: f64| format!("{} to {} m", as_text(low), as_text(high));
    let extent = |low: DVec3, high: DVec3| {
        format!("x = {}, y = {}, z = {}", range(low.x, high.x), range(low.y, high.y), range(low.z, high.z))
    };
    let given = format!("a surface with {}", extent(low, high));
    let (from, to) = (low.max(DVec3::new(x[0], 0.0, low.z)), high.min(DVec3::new(x[1], width, high.z)));
    let step = (to - from) / f64::from(SAMPLES);
    let at = |index: u32, from: f64, step: f64| from + (f64::from(index) + 0.5) * step;
    let places = (0..SAMPLES).flat_map(|i| (0..SAMPLES).map(move |j| (i, j)));
    let samples: Vec<(f64, f64, bool)> = places
        .map(|(i, j)| (at(i, from.x, step.x), at(j, from.y, step.y)))
        .filter_map(|(x, y)| terrain.surface.highest(x, y).map(|(z, faces_up)| (x, z, faces_up)))
        .collect();
    let share_of_length = (high - low).max_element() / (x[1] - x[0]);
    let highest = samples.iter().map(|(_, z, _)| *z).fold(f64::MIN, f64::max);
    let scale = format!("`flume.terrain.scale` is {}; write 0.001 for a file in millimetres", as_text(terrain.scale));
    let (allowed, advice) = if !(SHORTEST..=LONGEST).contains(&share_of_length) {
        (format!("of about the size of the domain, x = {}", range(x[0], x[1])), scale)
    } else if samples.is_empty() || step.x <= 0.0 || step.y <= 0.0 {
        let domain = format!("x = {}, y = {}", range(x[0], x[1]), range(0.0, width));
        (format!("in the domain, {domain}"), format!("move the surface or the domain, or correct the scale: {scale}"))
    } else if samples.iter().filter(|(.., faces_up)| *faces_up).count() * 2 < samples.len() {
        ("facing up".to_owned(), "reverse the triangles: they must be counter-clockwise seen from above".to_owned())
    } else if highest > top_z {
        let allowed = format!("below the top of the walls, `domain.top_z_m` = {} m", as_text(top_z));
        (allowed, format!("raise the walls, or correct the scale: {scale}"))
    } else if samples.iter().all(|(x, z, _)| *z < profile.z(*x)) {
        let advice = format!("raise the surface above the bed, or correct the scale: {scale}");
        ("above the bed at one place at least".to_owned(), advice)
    } else {
        return;
    };
    check.reject("flume.terrain", given, allowed, &advice);
}
