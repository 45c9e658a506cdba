//! Data that the report reads from a run folder.

use std::path::{Path, PathBuf};

use super::motion::{UnitMotion, motions};
use crate::output::{GroupSummary, OutputError, Summary, Table, UnitSurface};
use crate::simulation::breakage::results::Breakage;

/// The contents of a run folder. A field is empty or `None` if the run did not write its file.
#[derive(Debug)]
pub struct RunFolder {
    /// Path of the run folder.
    pub dir: PathBuf,
    /// Content of `summary.json`.
    pub summary: Summary,
    /// Bed profile with the mound, as corner points [x, z] [m].
    pub profile: Vec<[f64; 2]>,
    /// `gauges.csv`: gauge series in the particle domain.
    pub gauges: Option<Table>,
    /// `flume_gauges.csv`: surface elevation at the gauges in the flume model.
    pub flume_gauges: Option<Table>,
    /// Motion and forces of each unit.
    pub motions: Vec<UnitMotion>,
    /// `energy.csv`: energy balance.
    pub energy: Option<Table>,
    /// Surface of a unit of each group, relative to its centre of mass.
    pub surfaces: Vec<UnitSurface>,
    /// Results of the breakage analysis; `None` if the run has no breakage analysis.
    pub breakage: Option<Breakage>,
}

impl RunFolder {
    /// Name of the file with the water particles.
    pub const WATER: &str = "fluid.vtkhdf";
    /// Name of the file with the surface of the water.
    pub const SURFACE: &str = "surface.vtkhdf";
    /// Name of the picture of one recorded time of the run.
    pub const PICTURE: &str = "picture.svg";

    /// Reads a run folder. Only `summary.json` is required.
    ///
    /// # Errors
    /// If the summary is missing, or an existing file is invalid.
    pub fn read(run_dir: &Path) -> Result<Self, OutputError> {
        Self::with(Summary::read(run_dir)?, run_dir)
    }

    /// Reads the folder of a run in progress. Only `progress.json` is required.
    ///
    /// # Errors
    /// If `progress.json` is missing, or an existing file is invalid or is just being written.
    pub fn read_running(run_dir: &Path) -> Result<Self, OutputError> {
        Self::with(Summary::read_progress(run_dir)?, run_dir)
    }

    fn with(summary: Summary, run_dir: &Path) -> Result<Self, OutputError> {
        let table = |name: &str| Table::read_if_present(&run_dir.join(name));
        let profile = match table("profile.csv")? {
            Some(table) => table.column("x_m")?.iter().zip(table.column("z_m")?).map(|(x, z)| [*x, *z]).collect(),
            None => Vec::new(),
        };
        let models: u32 = summary.groups.iter().map(GroupSummary::shapes).sum();
        let surfaces = (0..models.max(1) as usize).map(|model| run_dir.join(UnitSurface::file_of(model)));
        let surfaces =
            surfaces.take_while(|path| path.exists()).map(|path| UnitSurface::read(&path)).collect::<Result<_, _>>()?;
        Ok(Self {
            summary,
            profile,
            gauges: table("gauges.csv")?,
            flume_gauges: table("flume_gauges.csv")?,
            motions: table("units.csv")?.map_or(Ok(Vec::new()), |units| motions(&units))?,
            energy: table("energy.csv")?,
            surfaces,
            breakage: Breakage::read_if_present(run_dir)?,
            dir: run_dir.to_owned(),
        })
    }

    /// Returns the index of the group of a unit, which has the number `unit`.
    pub fn group_of(&self, unit: u32) -> usize {
        self.summary.groups.iter().position(|group| group.contains(unit)).unwrap_or(0)
    }

    /// Returns the index in [`Self::surfaces`] of the surface of a unit, which has the number `unit`.
    pub fn surface_of(&self, unit: u32) -> usize {
        let group = self.group_of(unit);
        let groups = &self.summary.groups;
        let before: u32 = groups.iter().take(group).map(GroupSummary::shapes).sum();
        let member = groups.get(group).map_or(0, |group| unit.saturating_sub(group.units[0]) % group.shapes());
        (before + member) as usize
    }

    /// Returns true if the folder contains a file with this name.
    pub fn has(&self, file: &str) -> bool {
        self.dir.join(file).exists()
    }
}
