//! The file of a fracture case as the user writes it. In a fracture case, deformable bodies collide and crack.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::{LandmarkFile, SectionFile};

/// A fracture case: bodies meshed with tetrahedra, with their constraints, loads and strength.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FractureFile {
    /// Path of the JSON schema, for editors (`breakwater schema --fracture` prints it). The solver ignores it.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Title of the case in reports, one line.
    pub title: String,
    /// Assumptions: values that the user had to assume because no source gives them. The report lists the assumptions.
    #[serde(default)]
    pub assumptions: Vec<String>,
    /// Mesh and numerical method.
    pub fracture: MethodFile,
    /// Gravitational acceleration [x, y, z] [m/s2].
    #[serde(default)]
    pub gravity_m_s2: [f64; 3],
    /// Bodies: one entry for each physical volume of the mesh.
    pub bodies: Vec<FractureBodyFile>,
    /// Constraints: sets of mesh nodes that are fixed or move with a given velocity.
    #[serde(default)]
    pub constraints: Vec<ConstraintFile>,
    /// Loads on the bodies.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub loads: Vec<LoadFile>,
    /// Materials of the bodies.
    pub materials: Vec<FractureMaterialFile>,
    /// Friction between bodies. Pairs that are not listed have no friction.
    #[serde(default)]
    pub friction: Vec<BodyFrictionFile>,
    /// Landmarks: boxes with names. For each crack, the report names the landmark nearest to the start of the crack.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub landmarks: Vec<LandmarkFile>,
    /// Output files and their intervals.
    pub output: FractureOutputFile,
    /// Duration of the run.
    pub stop: FractureStopFile,
}

/// Mesh and numerical method.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MethodFile {
    /// Path of the mesh file (Gmsh format MSH 4.1), relative to the folder of the case file.
    pub mesh: String,
    /// Length unit of the mesh in metres: 1 for metres, 0.001 for millimetres.
    #[serde(default = "one")]
    pub scale: f64,
    /// Kind of the joints between tetrahedra before the material cracks.
    #[serde(default)]
    pub joints: Joints,
    /// Joint penalty [-]: stiffness p_0 of the joints / Young's modulus. Default: 50 for `intrinsic`, 10 for `tied`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub joint_penalty: Option<f64>,
    /// Rule that sets the softening range: the increase of the opening during which the stress decreases from its peak
    /// to zero.
    #[serde(default)]
    pub softening: Softening,
    /// Contact penalty [-]: stiffness p of the contacts / Young's modulus.
    #[serde(default = "one")]
    pub contact_penalty: f64,
    /// Time step / longest stable time step [-].
    #[serde(default = "default_step_share")]
    pub step_share: f64,
    /// Time step [s]. A value above the longest stable time step is refused. By default, `step_share` sets the time
    /// step.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dt_s: Option<f64>,
}

/// Kind of the joints between tetrahedra before the material cracks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Joints {
    /// Elastic joints between all tetrahedra from the start of the run (Guo, Latham and Xiang 2015).
    #[default]
    Intrinsic,
    /// Tetrahedra share their nodes until the stress reaches the strength. The joints do not soften the intact body,
    /// and the time step is longer than with `intrinsic`. Elements must be small compared with the fracture process
    /// zone; otherwise the computed strength is too high (docs/validation/fracture.md).
    Tied,
    /// No body cracks: an elastic run, for comparison.
    Unbreakable,
}

/// Rule that sets the softening range of a joint: the increase of the opening during which the stress decreases from
/// its peak to zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Softening {
    /// The range for which the joint dissipates the fracture energy G_f: the area under the stress-opening curve.
    #[default]
    Exact,
    /// The range max(2 delta_p, 3 G_f / f_t) of the published programs, with the opening delta_p at the peak stress,
    /// the fracture energy G_f and the tensile strength f_t. The joint then dissipates 1.16 G_f.
    Published,
}

/// A body of a fracture case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FractureBodyFile {
    /// Name of the body's physical volume in the mesh.
    pub name: String,
    /// Material of the body: a name in `materials`.
    pub material: String,
    /// true if the body can crack. Its material then needs the key `strength`.
    #[serde(default)]
    pub cracks: bool,
    /// true if the body is rigid and does not deform. A rigid body cannot crack.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub rigid: bool,
    /// Initial velocity [x, y, z] of the point `pivot_m` [m/s].
    #[serde(default)]
    pub velocity_m_s: [f64; 3],
    /// Initial angular velocity [x, y, z] of the body [rad/s].
    #[serde(default)]
    pub angular_velocity_rad_s: [f64; 3],
    /// A point [x, y, z] on the axis of the initial rotation [m].
    #[serde(default)]
    pub pivot_m: [f64; 3],
}

/// A constraint: a set of mesh nodes that is fixed or moves with a given velocity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConstraintFile {
    /// Name of the physical surface, curve or point of the mesh to which the nodes belong.
    pub set: String,
    /// Velocity of the nodes along x, y and z [m/s]: a number, rows [time [s], velocity [m/s]] for a velocity that
    /// varies, or `null` for a free direction. A constraint on nodes of a rigid body acts on the whole body.
    pub velocity_m_s: [Option<VelocityFile>; 3],
}

/// Velocity of a constraint in one direction [m/s].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "must be a velocity [m/s], rows [[time [s], velocity [m/s]], ...], or null")]
pub enum VelocityFile {
    /// Constant velocity [m/s].
    Constant(f64),
    /// Rows [time [s], velocity [m/s]]. The velocity is linear between rows and constant before the first and after the
    /// last row.
    History(Vec<[f64; 2]>),
}

/// A load on a body. A history is linear between its rows and constant before the first and after the last row.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum LoadFile {
    /// A traction (force per area) on faces, with a constant direction.
    Traction {
        /// Name of the loaded physical surface of the mesh.
        set: String,
        /// Force [x, y, z] per area of the undeformed faces [Pa].
        stress_pa: [f64; 3],
        /// Rows [time [s], factor [-]]. The factor multiplies `stress_pa`. By default, the factor is 1.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        history: Option<Vec<[f64; 2]>>,
    },
    /// A pressure, which acts normal to the faces.
    Pressure {
        /// Name of the loaded physical surface of the mesh.
        set: String,
        /// Pressure [Pa], positive in compression.
        pressure_pa: f64,
        /// Faces that determine area and direction of the pressure: deformed or undeformed.
        #[serde(default)]
        on: LoadedFaces,
        /// Rows [time [s], factor [-]]. The factor multiplies `pressure_pa`. By default, the factor is 1.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        history: Option<Vec<[f64; 2]>>,
    },
    /// A force, and optionally a moment, at a point of a body, for example the force of a recorded impact.
    Force {
        /// Name of the loaded body.
        body: String,
        /// Point [x, y, z] of the undeformed body at which the force acts [m].
        place_m: [f64; 3],
        /// Radius around `place_m` [m]. The force acts on all faces whose centre is within this radius. If there is no
        /// such face, it acts on the nearest face.
        #[serde(default)]
        radius_m: f64,
        /// Axes of the force and moment components in `history`.
        #[serde(default)]
        axes: LoadAxes,
        /// Rows [t, F_x, F_y, F_z] of time [s] and force [N], or rows [t, F_x, F_y, F_z, M_x, M_y, M_z] with the moment
        /// about `place_m` [N m].
        history: Vec<Vec<f64>>,
    },
}

/// Faces that determine area and direction of a pressure load.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LoadedFaces {
    /// The deformed faces, as for the pressure of a fluid.
    #[default]
    Deformed,
    /// The undeformed faces at the start of the run.
    Undeformed,
}

/// Axes of the components of force and moment in a load history.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LoadAxes {
    /// Fixed axes x, y, z.
    #[default]
    Space,
    /// Axes that are parallel to x, y, z at the start and rotate with the body.
    Body,
}

/// A material of the bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FractureMaterialFile {
    /// Name of the material. `bodies` refers to this name.
    pub name: String,
    /// Density [kg/m3].
    pub density_kg_m3: f64,
    /// Young's modulus [Pa].
    pub young_modulus_pa: f64,
    /// Poisson's ratio [-].
    pub poisson_ratio: f64,
    /// Viscosity of the solid material, which damps its vibrations [Pa s].
    #[serde(default)]
    pub viscosity_pa_s: f64,
    /// Strength and fracture energy. Required if a body of this material can crack.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub strength: Option<StrengthFile>,
}

/// Strength and fracture energy of a material.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StrengthFile {
    /// Tensile strength f_t [Pa].
    pub tensile_pa: f64,
    /// Cohesion c [Pa].
    pub cohesion_pa: f64,
    /// Angle of internal friction phi [degrees].
    pub friction_angle_deg: f64,
    /// Fracture energy G_f of opening cracks (mode I) [J/m2].
    pub fracture_energy_j_m2: f64,
    /// Fracture energy G_fII of shear cracks (mode II) [J/m2]. Default: `fracture_energy_j_m2`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sliding_energy_j_m2: Option<f64>,
}

/// Friction between two bodies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BodyFrictionFile {
    /// Names of the two bodies. For the crack faces of one body, write its name twice.
    pub between: [String; 2],
    /// Coulomb friction coefficient [-].
    pub coefficient: f64,
}

/// Output files of a fracture run and their intervals.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FractureOutputFile {
    /// Interval between outputs of body surfaces, cracks and section [s]; 0 for no output and no pictures in the
    /// report.
    pub surfaces_interval_s: f64,
    /// Interval between rows of the energy balance [s].
    pub energy_interval_s: f64,
    /// Interval between checkpoints, from which `breakwater resume` continues the run [s]; 0: a checkpoint is written
    /// only if the user stops the run. Default: a fiftieth of the duration.
    // Left out of the serialized case at its default, so that cases without this key keep their hash.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub checkpoint_interval_s: Option<f64>,
    /// Interval between snapshots of all tetrahedra with their stresses [s]; 0 (default) for no snapshots.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub tets_interval_s: f64,
    /// Plane in which the report shows the stresses. Default: the vertical plane along x through the centroid of the
    /// bodies that can crack.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub section: Option<SectionFile>,
}

/// Duration of a fracture run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FractureStopFile {
    /// Simulated time after which the run ends [s].
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
