//! The input files as the user writes them: one struct per JSON object, without derived values.
//!
//! The name of a key ends with its unit. Unknown keys are errors, because a misspelt key must not be ignored.
//! The solvers read the validated `Case` instead of these structs. The doc comments become descriptions in the JSON
//! schema.

mod breakage;
pub(super) mod domain;
mod dry_test;
mod flume;
mod fracture;
mod fracture_places;
mod groups;
mod numerics;
mod objects;
mod output;
mod reference;
mod shape;
mod structure;
mod sweep;
mod wave_source;
mod waves;

pub use breakage::{BaseFile, BreakageFile, BreakageMaterialFile, ImpactMeasure, ImpactSelectionFile, RerunMethod};
pub use domain::{BlockFile, BoxFile, DampingZoneFile, DomainFile, RelaxationZoneFile, Sides, WaterFile};
pub use dry_test::{DropFile, DryDomainFile, DryFile, DryFlumeFile, DryOutputFile, DryTestFile, TiltFile};
pub use flume::{FlumeFile, MoundFile, ShorewardEndFile, SpongeFile, TerrainFile};
pub use fracture::{
    BodyFrictionFile, ConstraintFile, FractureBodyFile, FractureFile, FractureMaterialFile, FractureOutputFile,
    FractureStopFile, Joints, LoadAxes, LoadFile, LoadedFaces, MethodFile, Softening, StrengthFile, VelocityFile,
};
pub use fracture_places::{LandmarkFile, SectionFile};
pub use groups::UnitGroupsFile;
pub use numerics::{Boundary, DensityDiffusion, NumericsFile, Scheme, SchemeDefaults, Viscosity, WallSlip};
pub use objects::{
    ArmourFile, ArmourOrientation, ContactFile, ContactLawName, DamageMeasure, ElevationFile, ForceFile, FrictionFile,
    GaugeFile, HeapFile, LineFile, MaterialFile, Orientation, PlacedGroupFile, PlacementFile, PointFile, PoseFile,
    ScatterFile, UnitsFile,
};
pub use output::{AtRestFile, FluidField, OutputFile, StopFile};
pub use reference::{ReferenceFile, ReferenceWaveFile, ReferenceWaveKind, SeriesFile, SeriesRole};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
pub use shape::{RockFile, Shape, StlFile};
pub use structure::{DragSource, PartFile, PartStlFile, PorousFile};
pub use sweep::{Combine, NormalFile, RandomFile, SweepFile, VaryFile};
pub use wave_source::{ExternalWaveFile, OpenfoamFile, SwashFile, SwashTableFile, UpFile, VelxFile, WaveSourceFile};
pub use waves::{
    FlapFile, IrregularFile, PistonFile, RegularFile, SolitaryFile, SolitaryTheory, WaveFile, WavemakerFile,
};

/// A flume case: the flume, the water, the wave and the armour units.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CaseFile {
    /// Path of the JSON schema, for editors (`breakwater schema` prints it). The solver ignores it.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Title of the case in reports, one line.
    pub title: String,
    /// Assumptions: values that the user had to assume because no source gives them. The report lists the assumptions.
    #[serde(default)]
    pub assumptions: Vec<String>,
    /// Folder with a `reference.json` and measured displacements, relative to the folder of the case file.
    /// `breakwater compare` compares the run with these displacements.
    // Not part of the hash of the case, because this key changes no result.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<String>,
    /// The whole flume: bed, mound and still water level.
    pub flume: FlumeFile,
    /// Particle domain: the part of the flume that is filled with particles.
    pub domain: DomainFile,
    /// Water and its artificial compressibility.
    #[serde(default)]
    pub fluid: FluidFile,
    /// Options and constants of the SPH scheme.
    #[serde(default)]
    pub numerics: NumericsFile,
    /// The wave. Without this key, no wave is generated.
    #[serde(default)]
    pub wave: WaveFile,
    /// Wavemaker at the seaward end of the particle domain.
    // Left out of the serialized case at its default, so that cases without this key keep their hash.
    #[serde(default, skip_serializing_if = "WavemakerFile::is_default")]
    pub wavemaker: WavemakerFile,
    /// The structure: solid parts, such as a mound, a toe berm, a crown wall or a caisson.
    // Left out of the serialized case at its default, so that cases without this key keep their hash.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub structure: Vec<PartFile>,
    /// The armour units, one group or a list of groups. Leave this key out for a flume without units.
    #[serde(default)]
    pub units: Option<UnitGroupsFile>,
    /// Materials of units and bed, with their elastic constants.
    #[serde(default)]
    pub materials: Vec<MaterialFile>,
    /// Friction coefficients for each pair of materials that can touch.
    #[serde(default)]
    pub friction: Vec<FrictionFile>,
    /// Contact between units, and between units and the bed.
    #[serde(default)]
    pub contact: ContactFile,
    /// Breakage analysis: re-runs the hardest impacts of the run at prototype scale with breakable units.
    // Left out of the serialized case at its default, so that cases without this key keep their hash.
    #[serde(alias = "fracture", default, skip_serializing_if = "Option::is_none")]
    pub breakage: Option<BreakageFile>,
    /// Gauges: points at which elevation, pressure or velocity of the water is measured.
    #[serde(default)]
    pub gauges: Vec<GaugeFile>,
    /// Output files and their intervals.
    #[serde(default)]
    pub output: OutputFile,
    /// Criteria that end the run: its duration, and rest of the units.
    pub stop: StopFile,
}

/// Water and its artificial compressibility.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FluidFile {
    /// Reference density of the water [kg/m3].
    pub density_kg_m3: f64,
    /// Gravitational acceleration [m/s2].
    pub gravity_m_s2: f64,
    /// Artificial speed of sound / sqrt(g d) [-], with the largest initial water depth d in the domain. The density
    /// varies by less than 1 % if the speed of sound is ten times the speed of the water. Default: 15 for waves; then
    /// hydrostatic compression makes still water less than 0.25 % too heavy. 20 for a block of water that collapses,
    /// because its front can reach 2 sqrt(g d).
    pub sound_speed_factor: Option<f64>,
    /// Exponent gamma of Tait's equation of state [-].
    pub tait_exponent: f64,
}

impl Default for FluidFile {
    fn default() -> Self {
        Self { density_kg_m3: 1000.0, gravity_m_s2: 9.81, sound_speed_factor: None, tait_exponent: 7.0 }
    }
}
