//! The case file as the user writes it: one struct per JSON object, nothing derived.
//!
//! Keys carry their unit. Unknown keys are refused, so that a misspelt one is never ignored.
//! `Case` is the validated form that the solvers see.

mod dry;
mod fracture;
mod fracture_places;
mod handover;
mod numerics;
mod objects;
mod reference;
mod wave_source;
mod waves;

pub use dry::{DropFile, DryDomainFile, DryFile, DryFlumeFile, DryOutputFile, DryTestFile, TerrainFile, TiltFile};
pub use fracture::{
    BodyFrictionFile, ConstraintFile, FractureBodyFile, FractureFile, FractureMaterialFile, FractureOutputFile,
    FractureStopFile, Joints, LoadAxes, LoadFile, LoadedFaces, MethodFile, Softening, StrengthFile, VelocityFile,
};
pub use fracture_places::{LandmarkFile, SectionFile};
pub use handover::{BaseFile, HandoverFile, HandoverMaterialFile, HandoverWay, Hardness, SelectFile};
pub use numerics::{Boundary, DensityDiffusion, NumericsFile, Viscosity, WallSlip};
pub use objects::{
    ArmourFile, ArmourOrientation, ContactFile, ContactLawName, ElevationFile, FrictionFile, GaugeFile, MaterialFile,
    Orientation, PlacementFile, PointFile, PoseFile, Shape, StlFile, UnitsFile,
};
pub use reference::{ReferenceFile, ReferenceWaveFile, ReferenceWaveKind, SeriesFile, SeriesRole};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
pub use wave_source::{GivenWaveFile, OpenfoamFile, SwashFile, SwashTableFile, UpFile, VelxFile, WaveSourceFile};
pub use waves::{
    FlapFile, IrregularFile, PistonFile, RegularFile, SolitaryFile, SolitaryTheory, WaveFile, WavemakerFile,
};

/// A breakwater case: a flume, the water in it, the wave and the armour units.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CaseFile {
    /// Where the JSON schema lies, for editors (`breakwater schema` prints it). Not used by the solver.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// One line that names the case in reports.
    pub title: String,
    /// What had to be assumed because no source gives it; listed in the report.
    #[serde(default)]
    pub assumptions: Vec<String>,
    /// Folder of a `reference.json` with measured displacements, seen from the case file: `breakwater compare` compares
    /// the run with them.
    // Not part of the fingerprint: it changes no result.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<String>,
    /// The whole flume: bed, mound and still water.
    pub flume: FlumeFile,
    /// The part of the flume that is filled with particles.
    pub domain: DomainFile,
    /// Water and its artificial compressibility.
    #[serde(default)]
    pub fluid: FluidFile,
    /// Constants of the SPH scheme.
    #[serde(default)]
    pub numerics: NumericsFile,
    /// The wave.
    #[serde(default)]
    pub wave: WaveFile,
    /// What makes the wave in the particles, at the seaward end of the domain.
    // Left out at its default, so that cases that do not use it keep their hash.
    #[serde(default, skip_serializing_if = "WavemakerFile::is_default")]
    pub wavemaker: WavemakerFile,
    /// The armour units; none for a flume with water alone.
    #[serde(default)]
    pub units: Option<UnitsFile>,
    /// Elastic constants by material name.
    #[serde(default)]
    pub materials: Vec<MaterialFile>,
    /// Friction of each pair of materials that can touch.
    #[serde(default)]
    pub friction: Vec<FrictionFile>,
    /// Contact between units and with the bed.
    #[serde(default)]
    pub contact: ContactFile,
    /// What is done with the hardest impacts of the units: are they broken?
    // Left out where it is not used, so that such cases keep their hash.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub fracture: Option<HandoverFile>,
    /// Points at which the water is measured.
    #[serde(default)]
    pub gauges: Vec<GaugeFile>,
    /// What is written, and how often.
    #[serde(default)]
    pub output: OutputFile,
    /// When the run ends.
    pub stop: StopFile,
}

/// Bed, mound and still water of the whole flume; x runs from the wavemaker to the shore, z upwards.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FlumeFile {
    /// Corner points [x, z] of the bed [m], x rising, from the wavemaker to the shore.
    pub bed_m: Vec<[f64; 2]>,
    /// Level of the still water [m], in the z of `bed_m`.
    pub still_water_level_m: f64,
    /// A trapezoidal mound on the bed.
    #[serde(default)]
    pub mound: Option<MoundFile>,
    /// Material of bed and mound, one of `materials`; needed when there are units.
    #[serde(default)]
    pub material: Option<String>,
    /// Layers of the flume model, 1 to 8.
    #[serde(default = "default_layers")]
    pub layers: u32,
    /// Cell of the flume model [m].
    #[serde(default = "default_cell_m")]
    pub cell_m: f64,
    /// Manning's n of the bed in the flume model [s m^(-1/3)]: 0.010 glass, 0.013 smooth concrete; without it there is
    /// no friction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub manning_s_m13: Option<f64>,
    /// What stands at the shoreward end of the flume model.
    #[serde(default, skip_serializing_if = "RightEndFile::is_wall")]
    pub right_end: RightEndFile,
}

impl FlumeFile {
    /// Ground alone, for units without water.
    pub(super) fn dry(bed_m: Vec<[f64; 2]>, mound: Option<MoundFile>) -> Self {
        let cell_m = default_cell_m();
        let (layers, right_end) = (default_layers(), RightEndFile::default());
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

/// What stands at the shoreward end of the flume model.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum RightEndFile {
    /// A wall; the shore may lie before it.
    Wall {},
    /// Water that goes on: long waves leave. The bed must end under water.
    Radiating {},
    /// A wall behind water in which waves are damped.
    Sponge(SpongeFile),
}

impl Default for RightEndFile {
    fn default() -> Self {
        Self::Wall {}
    }
}

impl RightEndFile {
    /// The default; not written, so that the fingerprint of a case without this key stays what it was.
    fn is_wall(&self) -> bool {
        matches!(self, Self::Wall {})
    }
}

/// Water in which waves are damped, in front of the end wall.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpongeFile {
    /// Length [m]; two wave lengths take a wave.
    pub length_m: f64,
}

/// A trapezoidal mound.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MoundFile {
    /// Middle of the crest [m].
    pub centre_x_m: f64,
    /// Width of the crest [m].
    pub crest_width_m: f64,
    /// Level of the crest [m], in the z of `bed_m`.
    pub crest_z_m: f64,
    /// Horizontal run for one unit of rise, seaward side [-].
    pub seaward_run_per_rise: f64,
    /// Horizontal run for one unit of rise, lee side [-].
    pub lee_run_per_rise: f64,
}

/// The part of the flume that is filled with particles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DomainFile {
    /// Seaward and shoreward end [m]. The wavemaker (or a wall) stands at the first, a wall at the second.
    pub x_m: [f64; 2],
    /// Width across the flume [m]; left out in two dimensions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width_m: Option<f64>,
    /// What closes the domain across the flume.
    pub sides: Sides,
    /// Top of the walls [m]; a particle that rises above it by one wall height has escaped.
    pub top_z_m: f64,
    /// Distance between particles [m].
    pub dp_m: f64,
    /// Where the water stands at the start.
    #[serde(default)]
    pub water: WaterFile,
    /// Time of the flume model at which the particles start [s]; without it, when the velocity at the wavemaker's place
    /// reaches `start_at_share` of its maximum.
    #[serde(default)]
    pub start_s: Option<f64>,
    /// Share of the largest velocity at which the particles start [-].
    #[serde(default = "default_start_share")]
    pub start_at_share: f64,
    /// Where the water is slowed down, so that waves do not come back from the end of the domain.
    // Left out at its default, so that cases that do not use it keep their hash.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping_zone: Option<DampingZoneFile>,
    /// Where the water before the wavemaker is led to the velocity of the flume model, so that what comes back from the
    /// structure is not sent back once more.
    // Left out at its default, so that cases that do not use it keep their hash.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relaxation_zone: Option<RelaxationZoneFile>,
    /// Fixed boxes in the water.
    // Left out at its default, so that cases that do not use it keep their hash.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub obstacles: Vec<BoxFile>,
}

pub(super) fn default_start_share() -> f64 {
    0.03
}

/// A zone in which the velocity v of the water decays, dv/dt = -f v. The rate f grows as the square of the distance
/// from 0 at the seaward end of the zone to `coefficient_per_s` at its shoreward end, and keeps that value beyond.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DampingZoneFile {
    /// Seaward and shoreward end of the zone [m].
    pub x_m: [f64; 2],
    /// Rate at the shoreward end [1/s].
    #[serde(default = "default_damping_per_s")]
    pub coefficient_per_s: f64,
}

fn default_damping_per_s() -> f64 {
    10.0
}

/// A zone in which the velocity v of the water goes over to that of the flume model, dv/dt = -f (v - v_flume). The
/// rate f falls as the square of the distance from `coefficient_per_s` at the wavemaker to 0 at the end of the zone.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RelaxationZoneFile {
    /// Shoreward end of the zone [m].
    pub end_x_m: f64,
    /// Rate at the wavemaker [1/s].
    #[serde(default = "default_damping_per_s")]
    pub coefficient_per_s: f64,
}

/// A fixed box along the axes that the water flows round. Where it reaches the bed or an end of the domain it stands
/// there without a gap.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxFile {
    /// Lower corner [x, y, z] [m].
    pub low_m: [f64; 3],
    /// Upper corner [x, y, z] [m].
    pub high_m: [f64; 3],
}

/// What closes the domain across the flume.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Sides {
    /// What leaves on one side enters on the other.
    Periodic,
    /// Solid walls at y = 0 and y = width.
    Walls,
    /// Nothing changes across the flume: a layer one particle thick, computed in two dimensions. Units are cuboids then,
    /// which move along x and z and turn about y.
    TwoDimensional,
}

/// Where the water stands at the start.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum WaterFile {
    /// Up to the still water level (and, once the wave has entered, to the level that the flume model gives).
    StillLevel {},
    /// A block of water between two x, from the bed to a level: a dam about to break.
    Block(BlockFile),
}

impl Default for WaterFile {
    fn default() -> Self {
        Self::StillLevel {}
    }
}

/// A block of water between two x, from the bed to a level.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BlockFile {
    /// Seaward and shoreward face of the block [m].
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
    /// Speed of sound as a multiple of sqrt(g d), d the largest still depth in the domain [-]. Ten keeps the changes of
    /// density below one per cent as long as the water is slower than a long wave; fifteen keeps the weight of the
    /// compressed water within a quarter of a per cent.
    pub sound_speed_factor: f64,
    /// Polytropic exponent gamma of Tait's equation [-].
    pub tait_exponent: f64,
}

impl Default for FluidFile {
    fn default() -> Self {
        Self { density_kg_m3: 1000.0, gravity_m_s2: 9.81, sound_speed_factor: 15.0, tait_exponent: 7.0 }
    }
}

/// What is written, and how often.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct OutputFile {
    /// Interval of the fluid snapshots [s]; 0 writes none.
    pub fluid_interval_s: f64,
    /// Interval of the moving surfaces of the units [s]; 0 writes none.
    pub units_interval_s: f64,
    /// Interval of gauges, unit motion, unit forces and energy [s].
    pub series_interval_s: f64,
    /// Interval of the checkpoints in simulated time [s]; 0 writes one at the end only.
    pub checkpoint_interval_s: f64,
    /// What the fluid snapshots hold of each water particle besides its place; each at most once. The report draws the
    /// water only if `velocity` is among them.
    // Left out at its default, so that cases that do not use it keep their hash.
    #[serde(skip_serializing_if = "is_every_field")]
    pub fluid_fields: Vec<FluidField>,
    /// Two opposite corners [[x, y, z], [x, y, z]] of a box [m], the lower first: the fluid snapshots hold the water
    /// particles inside it only.
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

/// What a fluid snapshot can hold of each water particle.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FluidField {
    /// Velocity [m/s], three numbers.
    Velocity,
    /// Pressure [Pa].
    Pressure,
    /// Density [kg/m3].
    Density,
    /// Number that the particle keeps throughout the run.
    Id,
}

impl FluidField {
    /// All of them, in the order in which they are written by default.
    pub const ALL: [Self; 4] = [Self::Velocity, Self::Pressure, Self::Density, Self::Id];

    /// Name in case files and in ParaView.
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
    /// Simulated time at most [s], counted from the start of the particles.
    pub duration_s: f64,
    /// End earlier when every unit has been at rest for a while.
    #[serde(default)]
    pub at_rest: Option<AtRestFile>,
}

/// End the run when the units have moved and come to rest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AtRestFile {
    /// A unit is at rest whose centre and tips are slower than this and have got on by no more than this over `for_s`
    /// [m/s]; without water, one that was never faster.
    pub speed_m_s: f64,
    /// For how long all must be at rest [s].
    pub for_s: f64,
    /// Not before this simulated time [s], counted from the start of the particles.
    pub not_before_s: f64,
}
