//! Data that the report reads from the folder of a fracture run.

use std::path::{Path, PathBuf};

use crate::case::FractureCase;
use crate::output::{OutputError, PolyDataMoments, Table};
use crate::report::plot::short;
use crate::simulation::fracture::summary::{FractureSummary, InitiationSummary};

/// The contents of a run folder. A field is `None` if the run did not write the file.
pub struct FractureFolder {
    /// Path of the run folder.
    pub dir: PathBuf,
    /// The case with its mesh.
    pub case: FractureCase,
    /// Content of `summary.json`.
    pub summary: FractureSummary,
    /// `energy.csv`: energy balance.
    pub energy: Option<Table>,
    /// `cracks.csv`: failed faces.
    pub cracks: Option<Table>,
    /// Triangles for the pictures: outer surfaces of the bodies, crack faces, section plane.
    pub pictures: Option<[PolyDataMoments; 3]>,
}

impl FractureFolder {
    /// Reads a run folder.
    ///
    /// # Errors
    /// If case, mesh or summary are missing, or an existing file is invalid.
    pub fn read(dir: &Path) -> Result<Self, OutputError> {
        let path = dir.join("case.json");
        let case = FractureCase::load(&path).map_err(|error| OutputError::content(&path, error.to_string()))?;
        let files = ["surfaces.vtkhdf", "cracks.vtkhdf", "section.vtkhdf"].map(|name| dir.join(name));
        let pictures = if files.iter().all(|file| file.exists()) {
            let [surfaces, cracks, section] = files.each_ref().map(|file| PolyDataMoments::open(file));
            Some([surfaces?, cracks?, section?])
        } else {
            None
        };
        Ok(Self {
            summary: FractureSummary::read(dir)?,
            energy: Table::read_if_present(&dir.join("energy.csv"))?,
            cracks: Table::read_if_present(&dir.join("cracks.csv"))?,
            dir: dir.to_owned(),
            case,
            pictures,
        })
    }

    /// Returns true if at least one face failed by sliding.
    pub fn has_slid_faces(&self) -> bool {
        self.cracks.as_ref().and_then(|table| table.get("mode")).is_some_and(|modes| modes.contains(&2.0))
    }

    /// Returns true if the folder contains a file with this name.
    pub fn has(&self, file: &str) -> bool {
        self.dir.join(file).exists()
    }

    /// Indices of the bodies that the pictures show: all bodies that can crack. If no body can crack: all bodies
    /// without constraints; if every body has constraints: all bodies.
    pub fn shown_bodies(&self) -> Vec<usize> {
        let setup = &self.case.setup;
        let is_constrained = |body: usize| {
            let nodes = || setup.tets[setup.bodies[body].tets.clone()].iter().flatten();
            setup.constraints.iter().any(|constraint| nodes().any(|node| constraint.nodes.contains(node)))
        };
        let all = 0..setup.bodies.len();
        let cracking: Vec<usize> = all.clone().filter(|body| setup.bodies[*body].cohesion.is_some()).collect();
        if !cracking.is_empty() {
            return cracking;
        }
        let free: Vec<usize> = all.clone().filter(|body| !is_constrained(*body)).collect();
        if free.is_empty() { all.collect() } else { free }
    }

    /// Converts a time of the run [s] to report time [ms]: time since the impact, or since the start of the run if no
    /// bodies touched.
    pub fn clock_ms(&self, time_s: f64) -> f64 {
        (time_s - self.summary.impact_s.unwrap_or(0.0)) * 1e3
    }

    /// Describes a time of the run [s] as time after or before the impact, or after the start of the run.
    pub fn time_in_words(&self, time_s: f64) -> String {
        let clock = self.clock_ms(time_s);
        match (self.summary.impact_s, clock < 0.0) {
            (Some(_), false) => format!("{clock:.2} ms after the impact"),
            (Some(_), true) => format!("{:.2} ms before the impact", -clock),
            (None, _) => format!("{clock:.2} ms after the start"),
        }
    }

    /// Name of the time from [`Self::clock_ms`], for axes and tables.
    pub fn clock_name(&self) -> &'static str {
        if self.summary.impact_s.is_some() { "time since the impact" } else { "time since the start" }
    }
}

/// Describes the position where a crack started, by the distance from the nearest landmark or by coordinates.
pub fn place_in_words(initiation: &InitiationSummary) -> String {
    match (&initiation.near, initiation.distance_m) {
        (Some(near), Some(0.0)) => format!("at the {}", without_article(near)),
        (Some(near), Some(distance)) => format!("{} mm from the {}", short(distance * 1e3, 0), without_article(near)),
        _ => {
            let [x, y, z] = initiation.place.map(|c| short(c, 3));
            format!("at ({x}, {y}, {z}) m")
        }
    }
}

/// Returns a name without a leading "the ".
fn without_article(name: &str) -> &str {
    name.strip_prefix("the ").unwrap_or(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_position_is_given_by_landmark_or_coordinates() {
        let words = |near: Option<&str>, distance_m: Option<f64>| {
            let (body, mode, near) = ("unit".to_owned(), "opening".to_owned(), near.map(str::to_owned));
            let (place, since_impact_s, t_s, area_m2) = ([0.1, -0.2, 0.0], None, 0.0, 0.0);
            place_in_words(&InitiationSummary { t_s, since_impact_s, body, place, near, distance_m, mode, area_m2 })
        };
        assert_eq!(words(Some("upper corner"), Some(0.0)), "at the upper corner");
        assert_eq!(words(Some("the upper corner"), Some(0.0684)), "68 mm from the upper corner");
        assert_eq!(words(None, None), "at (0.1, \u{2212}0.2, 0) m");
    }
}
