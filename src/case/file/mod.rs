//! The input files as the user writes them: one struct per JSON object, no derived values.
//!
//! Keys carry their unit. Unknown keys are refused, so that a misspelt key is never ignored.
//! `Case` is the validated form that the solvers read. The doc comments become the JSON schema.

mod breakage;
mod dry_test;
mod fracture;
mod fracture_places;
mod numerics;
mod objects;
mod reference;
mod sweep;
mod wave_source;
mod waves;

pub use breakage::{BaseFile, BreakageFile, BreakageMaterialFile, ImpactMeasure, ImpactSelectionFile, RerunMethod};
pub use dry_test::{DropFile, DryDomainFile, DryFile, DryFlumeFile, DryOutputFile, DryTestFile, TerrainFile, TiltFile};
pub use fracture::{
    BodyFrictionFile, ConstraintFile, FractureBodyFile, FractureFile, FractureMaterialFile, FractureOutputFile,
    FractureStopFile, Joints, LoadAxes, LoadFile, LoadedFaces, MethodFile, Softening, StrengthFile, VelocityFile,
};
pub use fracture_places::{LandmarkFile, SectionFile};
pub use numerics::{Boundary, DensityDiffusion, NumericsFile, Viscosity, WallSlip};
pub use objects::{
    ArmourFile, ArmourOrientation, ContactFile, ContactLawName, ElevationFile, FrictionFile, GaugeFile, MaterialFile,
    Orientation, PlacementFile, PointFile, PoseFile, Shape, StlFile, UnitsFile,
};
pub use reference::{ReferenceFile, ReferenceWaveFile, ReferenceWaveKind, SeriesFile, SeriesRole};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
pub use sweep::{Combine, SweepFile, VaryFile};
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
    /// Name of the case in reports, one line.
    pub title: String,
    /// Assumptions: values that no source gives. The report lists them.
    #[serde(default)]
    pub assumptions: Vec<String>,
    /// Folder of a `reference.json` with measured displacements, seen from the case file: `breakwater compare` compares
    /// the run with them.
    // Not part of the fingerprint: it changes no result.
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
    /// The wave; left out, the water is still.
    #[serde(default)]
    pub wave: WaveFile,
    /// Wavemaker at the seaward end of the particle domain.
    // Not written at its default, so that the hash of cases without this key does not change.
    #[serde(default, skip_serializing_if = "WavemakerFile::is_default")]
    pub wavemaker: WavemakerFile,
    /// The armour units; leave them out for a flume with water only.
    #[serde(default)]
    pub units: Option<UnitsFile>,
    /// Materials of units and bed, with their elastic constants.
    #[serde(default)]
    pub materials: Vec<MaterialFile>,
    /// Friction for each pair of materials that can touch.
    #[serde(default)]
    pub friction: Vec<FrictionFile>,
    /// Contact between units, and between units and the bed.
    #[serde(default)]
    pub contact: ContactFile,
    /// Breakage analysis: re-runs the hardest impacts at prototype scale with breakable units.
    // Not written at its default, so that the hash of cases without this key does not change.
    #[serde(alias = "fracture", default, skip_serializing_if = "Option::is_none")]
    pub breakage: Option<BreakageFile>,
    /// Gauges: points at which the water is measured.
    #[serde(default)]
    pub gauges: Vec<GaugeFile>,
    /// Output files and their intervals.
    #[serde(default)]
    pub output: OutputFile,
    /// When the run ends.
    pub stop: StopFile,
}

/// Bed, mound and still water of the whole flume. x points from the wavemaker to the shore, z upwards.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FlumeFile {
    /// Corner points [x, z] of the bed [m], from the wavemaker to the shore; x must increase.
    pub bed_m: Vec<[f64; 2]>,
    /// Still water level [m], in the z of `bed_m`.
    pub still_water_level_m: f64,
    /// A trapezoidal mound on the bed.
    #[serde(default)]
    pub mound: Option<MoundFile>,
    /// Material of bed and mound, one of `materials`; required if the case has units.
    #[serde(default)]
    pub material: Option<String>,
    /// Number of layers of the flume model, 1 to 8.
    #[serde(default = "default_layers")]
    pub layers: u32,
    /// Cell size of the flume model [m].
    #[serde(default = "default_cell_m")]
    pub cell_m: f64,
    /// Manning's n of the bed in the flume model [s m^(-1/3)]: 0.010 glass, 0.013 smooth concrete. By default the bed
    /// has no friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub manning_s_m13: Option<f64>,
    /// Boundary at the shoreward end of the flume model.
    #[serde(default, skip_serializing_if = "ShorewardEndFile::is_wall")]
    pub right_end: ShorewardEndFile,
}

impl FlumeFile {
    /// Returns a flume without water, for dry tests.
    pub(super) fn dry(bed_m: Vec<[f64; 2]>, mound: Option<MoundFile>) -> Self {
        let cell_m = default_cell_m();
        let (layers, right_end) = (default_layers(), ShorewardEndFile::default());
        let (material, manning_s_m13) = (None, None);
        Self { bed_m, still_water_level_m: 0.0, mound, material, layers, cell_m, manning_s_m13, right_end }
    }
}

fn default_layers() -> u32 {
    2
}

fn default_cell_m() -> f64 {
    0.05
}

/// Boundary at the shoreward end of the flume model.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum ShorewardEndFile {
    /// A wall. The bed may rise above the water before it.
    Wall {},
    /// An open boundary that long waves leave. The bed must end under water.
    Radiating {},
    /// A sponge layer that damps waves, with a wall behind it.
    Sponge(SpongeFile),
}

impl Default for ShorewardEndFile {
    fn default() -> Self {
        Self::Wall {}
    }
}

impl ShorewardEndFile {
    /// Whether it is the default, which is not written, so that the hash of cases without this key does not change.
    fn is_wall(&self) -> bool {
        matches!(self, Self::Wall {})
    }
}

/// Sponge layer in front of the end wall.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpongeFile {
    /// Length [m]; two wavelengths absorb a wave.
    pub length_m: f64,
}

/// A trapezoidal mound.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MoundFile {
    /// x of the middle of the crest [m].
    pub centre_x_m: f64,
    /// Width of the crest [m].
    pub crest_width_m: f64,
    /// Crest level [m], in the z of `bed_m`.
    pub crest_z_m: f64,
    /// Seaward slope as horizontal run per unit of rise [-]: 2 for a slope of 1:2.
    pub seaward_run_per_rise: f64,
    /// Lee slope as horizontal run per unit of rise [-].
    pub lee_run_per_rise: f64,
}

/// Particle domain: the part of the flume that is filled with particles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DomainFile {
    /// x of the seaward and of the shoreward end [m]. The wavemaker (without a wave, a wall) stands at the seaward end,
    /// a wall at the shoreward end.
    pub x_m: [f64; 2],
    /// Width across the flume [m]; leave it out in two dimensions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width_m: Option<f64>,
    /// Boundaries at the two sides of the flume.
    pub sides: Sides,
    /// Top of the walls [m]. A particle that rises more than one wall height above it counts as escaped.
    pub top_z_m: f64,
    /// Particle spacing dp [m].
    pub dp_m: f64,
    /// Initial water.
    #[serde(default)]
    pub water: WaterFile,
    /// Time of the flume model at which the particles start [s]. By default they start when the velocity at the
    /// wavemaker reaches `start_at_share` of its maximum.
    #[serde(default)]
    pub start_s: Option<f64>,
    /// Share of the maximum velocity at the wavemaker at which the particles start [-].
    #[serde(default = "default_start_share")]
    pub start_at_share: f64,
    /// Damping zone: slows the water down, so that the end of the domain reflects no waves.
    // Not written at its default, so that the hash of cases without this key does not change.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping_zone: Option<DampingZoneFile>,
    /// Relaxation zone: drives the water at the wavemaker to the velocity of the flume model. Waves that the structure
    /// reflects are absorbed there instead of being reflected again.
    // Not written at its default, so that the hash of cases without this key does not change.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relaxation_zone: Option<RelaxationZoneFile>,
    /// Obstacles: fixed boxes in the water.
    // Not written at its default, so that the hash of cases without this key does not change.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub obstacles: Vec<BoxFile>,
}

pub(super) fn default_start_share() -> f64 {
    0.03
}

/// A zone in which the velocity v of the water decays, dv/dt = -f v. The rate f grows with the square of the distance
/// from 0 at the seaward end of the zone to `coefficient_per_s` at its shoreward end. It is constant beyond.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DampingZoneFile {
    /// x of the seaward and of the shoreward end of the zone [m].
    pub x_m: [f64; 2],
    /// Rate f at the shoreward end [1/s].
    #[serde(default = "default_damping_per_s")]
    pub coefficient_per_s: f64,
}

fn default_damping_per_s() -> f64 {
    10.0
}

/// A zone in which the velocity v of the water relaxes to the velocity of the flume model, dv/dt = -f (v - v_flume).
/// The rate f falls with the square of the distance from `coefficient_per_s` at the wavemaker to 0 at the zone's end.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RelaxationZoneFile {
    /// x of the shoreward end of the zone [m].
    pub end_x_m: f64,
    /// Rate f at the wavemaker [1/s].
    #[serde(default = "default_damping_per_s")]
    pub coefficient_per_s: f64,
}

/// A fixed box with edges along the axes; water flows around it. A box that touches the bed or an end of the domain
/// leaves no gap there.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxFile {
    /// Lower corner [x, y, z] [m].
    pub low_m: [f64; 3],
    /// Upper corner [x, y, z] [m].
    pub high_m: [f64; 3],
}

/// Boundaries at the two sides of the flume.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Sides {
    /// Periodic sides: what leaves on one side enters on the other.
    Periodic,
    /// Solid walls at y = 0 and y = width.
    Walls,
    /// Two dimensions: one layer of particles, nothing varies across the flume. Units must be cuboids; they move along
    /// x and z and rotate about y.
    TwoDimensional,
}

/// Initial water.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum WaterFile {
    /// Up to the still water level. If the wave has already entered, up to the free surface of the flume model.
    StillLevel {},
    /// A block of water between two x, from the bed up to a level: a dam break.
    Block(BlockFile),
}

impl Default for WaterFile {
    fn default() -> Self {
        Self::StillLevel {}
    }
}

/// A block of water between two x, from the bed up to a level.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BlockFile {
    /// x of the seaward and of the shoreward face of the block [m].
    pub x_m: [f64; 2],
    /// Top of the block [m].
    pub top_z_m: f64,
}

/// Water and its artificial compressibility.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct FluidFile {
    /// Reference density [kg/m3].
    pub density_kg_m3: f64,
    /// Gravitational acceleration [m/s2].
    pub gravity_m_s2: f64,
    /// Speed of sound as a multiple of sqrt(g d) [-], where d is the largest still water depth in the domain. With 10
    /// the density varies by less than 1 % as long as the water is slower than a long wave. With 15 the weight of the
    /// compressed water is right within 0.25 %.
    pub sound_speed_factor: f64,
    /// Exponent gamma of Tait's equation of state [-].
    pub tait_exponent: f64,
}

impl Default for FluidFile {
    fn default() -> Self {
        Self { density_kg_m3: 1000.0, gravity_m_s2: 9.81, sound_speed_factor: 15.0, tait_exponent: 7.0 }
    }
}

/// Output files and their intervals.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OutputFile {
    /// Interval of the fluid snapshots [s]; 0 for none.
    pub fluid_interval_s: f64,
    /// Interval of the unit surfaces [s]; 0 for none.
    pub units_interval_s: f64,
    /// Interval of the tables of gauges, unit motion, unit forces and energy [s].
    pub series_interval_s: f64,
    /// Interval of the checkpoints in simulated time [s]; 0 writes one checkpoint, at the end.
    pub checkpoint_interval_s: f64,
    /// Fields of each water particle in the fluid snapshots, besides its position; each at most once. The report draws
    /// the water only if `velocity` is one of them.
    // Not written at its default, so that the hash of cases without this key does not change.
    #[serde(skip_serializing_if = "is_every_field")]
    pub fluid_fields: Vec<FluidField>,
    /// Lower and upper corner [[x, y, z], [x, y, z]] of a box [m]: the fluid snapshots contain only the water particles
    /// inside it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fluid_box_m: Option<[[f64; 3]; 2]>,
}

impl Default for OutputFile {
    fn default() -> Self {
        Self {
            fluid_interval_s: 0.1,
            units_interval_s: 0.02,
            series_interval_s: 0.01,
            checkpoint_interval_s: 0.5,
            fluid_fields: FluidField::ALL.to_vec(),
            fluid_box_m: None,
        }
    }
}

fn is_every_field(fields: &[FluidField]) -> bool {
    fields == FluidField::ALL
}

/// Field of a water particle in a fluid snapshot.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FluidField {
    /// Velocity [m/s], three components.
    Velocity,
    /// Pressure [Pa].
    Pressure,
    /// Density [kg/m3].
    Density,
    /// Number of the particle, constant during the run.
    Id,
}

impl FluidField {
    /// All fields, in their default order.
    pub const ALL: [Self; 4] = [Self::Velocity, Self::Pressure, Self::Density, Self::Id];

    /// Returns the name in case files and in ParaView.
    pub fn name(self) -> &'static str {
        match self {
            Self::Velocity => "velocity",
            Self::Pressure => "pressure",
            Self::Density => "density",
            Self::Id => "id",
        }
    }
}

/// When the run ends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StopFile {
    /// Longest simulated time [s], from the start of the particles.
    pub duration_s: f64,
    /// Rest criterion: ends the run earlier when all units are at rest.
    #[serde(default)]
    pub at_rest: Option<AtRestFile>,
}

/// Rest criterion: the run ends when all units have been at rest for `for_s`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AtRestFile {
    /// Largest speed of the centre and the tips of a unit at rest [m/s]. In water a unit at rest must also have moved
    /// by no more than this speed times `for_s`.
    pub speed_m_s: f64,
    /// Time for which all units must be at rest [s].
    pub for_s: f64,
    /// Earliest end of the run [s], from the start of the particles.
    pub not_before_s: f64,
}
