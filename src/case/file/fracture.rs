//! A fracture case as written: deformable bodies that touch and crack.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{LandmarkFile, SectionFile};

/// A fracture case: tetrahedral bodies, what moves and holds them, how strong they are.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FractureFile {
    /// Where the JSON schema lies, for editors (`breakwater schema --fracture` prints it). Not used by the solver.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// One line that names the case.
    pub title: String,
    /// What had to be assumed because no source gives it.
    #[serde(default)]
    pub assumptions: Vec<String>,
    /// The mesh and how it is computed.
    pub fracture: MethodFile,
    /// Acceleration of gravity [m/s2].
    #[serde(default)]
    pub gravity_m_s2: [f64; 3],
    /// The bodies of the mesh, each once.
    pub bodies: Vec<FractureBodyFile>,
    /// Boundary sets of the mesh that are held or moved.
    #[serde(default)]
    pub constraints: Vec<ConstraintFile>,
    /// Loads on the bodies.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub loads: Vec<LoadFile>,
    /// Materials of the bodies.
    pub materials: Vec<FractureMaterialFile>,
    /// Friction between bodies; pairs that are not named are smooth.
    #[serde(default)]
    pub friction: Vec<BodyFrictionFile>,
    /// Places with names, to tell by where cracks begin.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub landmarks: Vec<LandmarkFile>,
    /// What is written, and how often.
    pub output: FractureOutputFile,
    /// When the run ends.
    pub stop: FractureStopFile,
}

/// The mesh and how it is computed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MethodFile {
    /// MSH 4.1 file, seen from the folder of the case file.
    pub mesh: String,
    /// Metres in a unit of length of the mesh.
    #[serde(default = "one")]
    pub scale: f64,
    /// How tetrahedra hold together before they crack.
    #[serde(default)]
    pub joints: Joints,
    /// Stiffness of the joints p_0 over Young's modulus [-]; 50 for `intrinsic`, 10 for `tied` joints.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint_penalty: Option<f64>,
    /// Range over which a joint softens.
    #[serde(default)]
    pub softening: Softening,
    /// Stiffness of contact p over Young's modulus [-].
    #[serde(default = "one")]
    pub contact_penalty: f64,
    /// Share of the longest stable step [-].
    #[serde(default = "default_step_share")]
    pub step_share: f64,
    /// Time step [s], if it is to be shorter than that.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dt_s: Option<f64>,
}

/// How tetrahedra hold together before they crack.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Joints {
    /// Joints between all of them from the start (Guo, Latham and Xiang).
    #[default]
    Intrinsic,
    /// They share their nodes until the strength is reached: no compliance of joints, a longer step; on elements that are
    /// not small against the crack's own zone they carry too much (docs/validation.md).
    Tied,
    /// Nothing cracks: the elastic twin of a run.
    Unbreakable,
}

/// Range over which a joint softens.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Softening {
    /// The area under the curve is the fracture energy.
    #[default]
    Exact,
    /// max(2 delta_p, 3 G_f / f) as the published programs have it: dissipates 1.16 G_f.
    Published,
}

/// A body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FractureBodyFile {
    /// Name of its physical volume in the mesh.
    pub name: String,
    /// Its material, one of `materials`.
    pub material: String,
    /// Whether it can crack; its material needs its strength then.
    #[serde(default)]
    pub cracks: bool,
    /// Whether it is not deformed: all its nodes move as one. It cannot crack then.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub rigid: bool,
    /// Velocity at the start [m/s], of the point `pivot_m`.
    #[serde(default)]
    pub velocity_m_s: [f64; 3],
    /// Angular velocity at the start [rad/s].
    #[serde(default)]
    pub angular_velocity_rad_s: [f64; 3],
    /// A point on the axis of that rotation [m].
    #[serde(default)]
    pub pivot_m: [f64; 3],
}

/// A boundary set that is held or moved.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConstraintFile {
    /// Name of the physical surface, curve or point in the mesh.
    pub set: String,
    /// Velocity along x, y, z [m/s], or rows of time [s] and velocity; `null` leaves it free. If nodes of a rigid body are
    /// held, the body is.
    pub velocity_m_s: [Option<VelocityFile>; 3],
}

/// Velocity of a constraint [m/s].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "must be a velocity [m/s], rows [[time [s], velocity [m/s]], ...], or null")]
pub enum VelocityFile {
    /// Always the same [m/s].
    Constant(f64),
    /// Rows of time [s] and velocity [m/s]; linear between, constant before the first and after the last.
    History(Vec<[f64; 2]>),
}

/// A load. Histories are linear between their rows, constant before the first and after the last.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum LoadFile {
    /// A stress vector on undeformed faces; it keeps its direction.
    Traction {
        /// Name of the physical surface in the mesh.
        set: String,
        /// Force over undeformed area [Pa].
        stress_pa: [f64; 3],
        /// Rows of time [s] and factor [-]; without it, the load is constant.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        history: Option<Vec<[f64; 2]>>,
    },
    /// A pressure normal to faces.
    Pressure {
        /// Name of the physical surface in the mesh.
        set: String,
        /// Pressure [Pa], positive where it presses.
        pressure_pa: f64,
        /// Faces whose area and normal count.
        #[serde(default)]
        on: LoadedFaces,
        /// Rows of time [s] and factor [-]; without it, the load is constant.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        history: Option<Vec<[f64; 2]>>,
    },
    /// A force, and perhaps a moment, about a place of a body: a recorded impact.
    Force {
        /// Name of the body.
        body: String,
        /// The place in the undeformed body [m].
        place_m: [f64; 3],
        /// The faces with their middle within this radius of the place take the force [m]; if there is none, the nearest
        /// face does.
        #[serde(default)]
        radius_m: f64,
        /// Axes of the components.
        #[serde(default)]
        axes: LoadAxes,
        /// Rows of time [s] and force [N], t, F_x, F_y, F_z; or of these and the moment about the place [N m], M_x, M_y, M_z.
        history: Vec<Vec<f64>>,
    },
}

/// Faces whose area and normal count for a pressure.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LoadedFaces {
    /// As they are at the moment: a fluid.
    #[default]
    Deformed,
    /// As they were at the start.
    Undeformed,
}

/// Axes of the components of a force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LoadAxes {
    /// Those of space.
    #[default]
    Space,
    /// Those of the body at the start, which turn with it.
    Body,
}

/// A material.
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
    /// Strength, for bodies that crack.
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
    /// Angle of internal friction [degrees].
    pub friction_angle_deg: f64,
    /// Fracture energy in opening G_f [J/m2].
    pub fracture_energy_j_m2: f64,
    /// Fracture energy in sliding [J/m2]; without it, that in opening.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sliding_energy_j_m2: Option<f64>,
}

/// Friction between two bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodyFrictionFile {
    /// The two bodies; the same one twice for its crack faces.
    pub between: [String; 2],
    /// Coulomb's coefficient [-].
    pub coefficient: f64,
}

/// What a fracture run writes, and how often.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FractureOutputFile {
    /// Interval of surfaces, cracks and cut plane [s]; 0 writes none, and the report has no pictures.
    pub surfaces_interval_s: f64,
    /// Interval of the energy book [s].
    pub energy_interval_s: f64,
    /// Interval of the state that `breakwater resume` goes on from [s]; 0 writes none. Without it, a fiftieth of the
    /// duration.
    // Left out at its default, so that cases that do not use it keep their hash.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub checkpoint_interval_s: Option<f64>,
    /// Interval of all tetrahedra with their stresses [s]; 0, as without it, writes none.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub tets_interval_s: f64,
    /// Plane of the pictures of the stress; without it, upright along x through the middle of the bodies that can crack.
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
