//! The file of a fracture case as the user writes it: deformable bodies that touch and crack.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{LandmarkFile, SectionFile};

/// A fracture case: bodies of tetrahedra with their constraints, loads and strength.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FractureFile {
    /// Path of the JSON schema, for editors (`breakwater schema --fracture` prints it). The solver ignores it.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Name of the case in reports, one line.
    pub title: String,
    /// Assumptions: values that no source gives. The report lists them.
    #[serde(default)]
    pub assumptions: Vec<String>,
    /// Mesh and numerical method.
    pub fracture: MethodFile,
    /// Gravitational acceleration [x, y, z] [m/s2].
    #[serde(default)]
    pub gravity_m_s2: [f64; 3],
    /// The bodies: one entry for each physical volume of the mesh.
    pub bodies: Vec<FractureBodyFile>,
    /// Constraints: boundary sets of the mesh that are held or moved.
    #[serde(default)]
    pub constraints: Vec<ConstraintFile>,
    /// Loads on the bodies.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub loads: Vec<LoadFile>,
    /// Materials of the bodies.
    pub materials: Vec<FractureMaterialFile>,
    /// Friction between bodies; pairs that are not listed have none.
    #[serde(default)]
    pub friction: Vec<BodyFrictionFile>,
    /// Landmarks: named boxes. The report names the landmark nearest to the start of a crack.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub landmarks: Vec<LandmarkFile>,
    /// Output files and their intervals.
    pub output: FractureOutputFile,
    /// When the run ends.
    pub stop: FractureStopFile,
}

/// Mesh and numerical method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MethodFile {
    /// Path of the mesh (MSH 4.1), relative to the folder of the case file.
    pub mesh: String,
    /// Length unit of the mesh in metres: 1, or 0.001 for millimetres.
    #[serde(default = "one")]
    pub scale: f64,
    /// Joints between the tetrahedra before they crack.
    #[serde(default)]
    pub joints: Joints,
    /// Joint penalty: stiffness p_0 of the joints over Young's modulus [-]. Default: 50 for `intrinsic`, 10 for `tied`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint_penalty: Option<f64>,
    /// Opening over which a joint softens.
    #[serde(default)]
    pub softening: Softening,
    /// Contact penalty: stiffness p of the contacts over Young's modulus [-].
    #[serde(default = "one")]
    pub contact_penalty: f64,
    /// Time step as a share of the longest stable time step [-].
    #[serde(default = "default_step_share")]
    pub step_share: f64,
    /// Upper limit of the time step [s]; by default only `step_share` limits it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dt_s: Option<f64>,
}

/// Joints between the tetrahedra before they crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Joints {
    /// Elastic joints between all tetrahedra from the start (Guo, Latham and Xiang).
    #[default]
    Intrinsic,
    /// Tetrahedra share their nodes until the stress reaches the strength. The joints add no compliance and the time
    /// step is longer. Elements must be small compared with the fracture process zone, or the strength comes out too
    /// high (docs/validation/fracture.md).
    Tied,
    /// Nothing cracks: an elastic run, for comparison.
    Unbreakable,
}

/// Opening over which a joint softens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Softening {
    /// Such that the area under the softening curve is the fracture energy.
    #[default]
    Exact,
    /// max(2 delta_p, 3 G_f / f), as in the published programs: dissipates 1.16 G_f.
    Published,
}

/// A body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FractureBodyFile {
    /// Name of the body's physical volume in the mesh.
    pub name: String,
    /// Material of the body, one of `materials`.
    pub material: String,
    /// Whether the body can crack; its material then needs `strength`.
    #[serde(default)]
    pub cracks: bool,
    /// Whether the body is rigid: its nodes move together. A rigid body cannot crack.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub rigid: bool,
    /// Initial velocity of the point `pivot_m` [m/s].
    #[serde(default)]
    pub velocity_m_s: [f64; 3],
    /// Initial angular velocity [rad/s].
    #[serde(default)]
    pub angular_velocity_rad_s: [f64; 3],
    /// A point on the axis of rotation [m].
    #[serde(default)]
    pub pivot_m: [f64; 3],
}

/// A boundary set that is held or moved.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConstraintFile {
    /// Name of the physical surface, curve or point in the mesh.
    pub set: String,
    /// Velocity along x, y and z [m/s]; rows of time [s] and velocity [m/s] for a velocity that varies; `null` for a
    /// free direction. Holding nodes of a rigid body holds the whole body.
    pub velocity_m_s: [Option<VelocityFile>; 3],
}

/// Velocity of a constraint [m/s].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "must be a velocity [m/s], rows [[time [s], velocity [m/s]], ...], or null")]
pub enum VelocityFile {
    /// Constant velocity [m/s].
    Constant(f64),
    /// Rows of time [s] and velocity [m/s]: linear between rows, constant before the first and after the last row.
    History(Vec<[f64; 2]>),
}

/// A load. Histories are linear between rows, constant before the first and after the last row.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum LoadFile {
    /// A traction on undeformed faces, with a constant direction.
    Traction {
        /// Name of the physical surface in the mesh.
        set: String,
        /// Force per undeformed area [x, y, z] [Pa].
        stress_pa: [f64; 3],
        /// Rows of time [s] and load factor [-]; by default the load is constant.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        history: Option<Vec<[f64; 2]>>,
    },
    /// A pressure, normal to the faces.
    Pressure {
        /// Name of the physical surface in the mesh.
        set: String,
        /// Pressure [Pa], positive in compression.
        pressure_pa: f64,
        /// Configuration that gives area and normal of the faces.
        #[serde(default)]
        on: LoadedFaces,
        /// Rows of time [s] and load factor [-]; by default the load is constant.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        history: Option<Vec<[f64; 2]>>,
    },
    /// A force, and optionally a moment, at a point of a body: a recorded impact.
    Force {
        /// Name of the body.
        body: String,
        /// The point in the undeformed body [m].
        place_m: [f64; 3],
        /// Radius around the point [m]. The force acts on the faces whose centre lies within it, or on the nearest face
        /// if there is none.
        #[serde(default)]
        radius_m: f64,
        /// Axes of the components in `history`.
        #[serde(default)]
        axes: LoadAxes,
        /// Rows [t, F_x, F_y, F_z] of time [s] and force [N], or rows [t, F_x, F_y, F_z, M_x, M_y, M_z] with the moment
        /// about the point [N m].
        history: Vec<Vec<f64>>,
    },
}

/// Configuration that gives area and normal of the faces under a pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LoadedFaces {
    /// The deformed faces: pressure of a fluid.
    #[default]
    Deformed,
    /// The faces at the start.
    Undeformed,
}

/// Axes of the components of a force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LoadAxes {
    /// Fixed axes x, y, z.
    #[default]
    Space,
    /// Axes that are x, y, z at the start and rotate with the body.
    Body,
}

/// A material of bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FractureMaterialFile {
    /// Name used by `bodies`.
    pub name: String,
    /// Density [kg/m3].
    pub density_kg_m3: f64,
    /// Young's modulus [Pa].
    pub young_modulus_pa: f64,
    /// Poisson's ratio [-].
    pub poisson_ratio: f64,
    /// Viscosity of the material [Pa s].
    #[serde(default)]
    pub viscosity_pa_s: f64,
    /// Strength; required for bodies that can crack.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub strength: Option<StrengthFile>,
}

/// Strength of a material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StrengthFile {
    /// Tensile strength f_t [Pa].
    pub tensile_pa: f64,
    /// Cohesion c [Pa].
    pub cohesion_pa: f64,
    /// Angle of internal friction phi [degrees].
    pub friction_angle_deg: f64,
    /// Fracture energy G_f in opening (mode I) [J/m2].
    pub fracture_energy_j_m2: f64,
    /// Fracture energy in sliding (mode II) [J/m2]; by default equal to `fracture_energy_j_m2`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sliding_energy_j_m2: Option<f64>,
}

/// Friction between two bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodyFrictionFile {
    /// Names of the two bodies; the same name twice for the crack faces of a body.
    pub between: [String; 2],
    /// Coulomb friction coefficient [-].
    pub coefficient: f64,
}

/// Output files of a fracture run and their intervals.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FractureOutputFile {
    /// Interval of surfaces, cracks and section [s]; 0 for none, and the report then has no pictures.
    pub surfaces_interval_s: f64,
    /// Interval of the energy balance [s].
    pub energy_interval_s: f64,
    /// Interval of the checkpoints from which `breakwater resume` continues [s]; 0 for none. Default: a fiftieth of the
    /// duration.
    // Not written at its default, so that the hash of cases without this key does not change.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub checkpoint_interval_s: Option<f64>,
    /// Interval of the snapshots of all tetrahedra with their stresses [s]; 0, the default, for none.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub tets_interval_s: f64,
    /// Plane of the stress pictures; by default the vertical plane along x through the middle of the bodies that can
    /// crack.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub section: Option<SectionFile>,
}

/// When a fracture run ends.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FractureStopFile {
    /// Simulated time [s].
    pub duration_s: f64,
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

fn one() -> f64 {
    1.0
}

fn default_step_share() -> f64 {
    0.8
}
