//! Writes an impact as a fracture case: a file that `breakwater fracture` runs and that users can edit.

use std::path::Path;

use glam::DVec3;

use super::blow::ScaledImpact;
use crate::case::file::{
    BodyFrictionFile, ConstraintFile, FractureBodyFile, FractureFile, FractureMaterialFile, FractureOutputFile,
    FractureStopFile, LoadFile, MethodFile, Softening, VelocityFile,
};
use crate::femdem::mesh::unit_mesh::UnitMesh;
use crate::femdem::mesh::{Mesh, msh};
use crate::output::{OutputError, write_atomically};

/// Name of the second unit of an impact, if two units collide, as a body of the fracture case.
pub const PARTNER: &str = "partner";

/// Number of times at which the fracture run writes the surfaces of the bodies.
const SURFACE_OUTPUTS: f64 = 20.0;

/// Number of rows that the fracture run writes to `energy.csv`.
const ENERGY_ROWS: f64 = 400.0;

/// Bodies, loads and duration of an impact that is re-run; positions are relative to the contact point.
#[derive(Debug, Clone)]
pub struct ImpactScene {
    /// Mesh of all bodies.
    pub mesh: Mesh,
    /// Name and initial motion of each body.
    pub parts: Vec<Part>,
    /// Loads on the bodies.
    pub loads: Vec<LoadFile>,
    /// Simulated time [s].
    pub duration: f64,
}

/// Name and initial motion of one body of an [`ImpactScene`].
#[derive(Debug, Clone)]
pub struct Part {
    /// Name of the body in the mesh.
    pub name: &'static str,
    /// Velocity of the centre of mass [m/s].
    pub velocity: DVec3,
    /// Angular velocity [rad/s].
    pub angular_velocity: DVec3,
    /// Centre of rotation, which is the centre of mass [m].
    pub pivot: DVec3,
    /// Name of the set of fixed faces, for a block of the bed; `None` for a unit, which moves freely and can crack.
    pub held: Option<&'static str>,
}

impl Part {
    /// Returns a block of the bed that is fixed at the faces of `set`.
    pub fn held(name: &'static str, set: &'static str) -> Self {
        let still = DVec3::ZERO;
        Self { name, velocity: still, angular_velocity: still, pivot: still, held: Some(set) }
    }
}

/// Returns the fracture case of the impact `blow` with the bodies of `scene`; `mesh` is the name of the mesh file.
pub fn file(blow: &ScaledImpact, scene: &ImpactScene, title: String, mesh: &str) -> FractureFile {
    let settings = blow.settings;
    let units = settings.material.clone();
    let concrete = FractureMaterialFile {
        name: "unit".to_owned(),
        density_kg_m3: blow.density(),
        young_modulus_pa: units.young_modulus_pa,
        poisson_ratio: units.poisson_ratio,
        viscosity_pa_s: units.viscosity_pa_s,
        strength: Some(units.strength),
    };
    let base = match &settings.base {
        Some(base) => FractureMaterialFile {
            density_kg_m3: base.density_kg_m3,
            young_modulus_pa: base.young_modulus_pa,
            poisson_ratio: base.poisson_ratio,
            ..concrete.clone()
        },
        None => concrete.clone(),
    };
    let base = FractureMaterialFile { name: "base".to_owned(), strength: None, ..base };
    let has_base = scene.parts.iter().any(|part| part.held.is_some());
    let body = |part: &Part| FractureBodyFile {
        name: part.name.to_owned(),
        material: if part.held.is_some() { "base" } else { "unit" }.to_owned(),
        cracks: part.held.is_none(),
        rigid: false,
        velocity_m_s: part.velocity.to_array(),
        angular_velocity_rad_s: part.angular_velocity.to_array(),
        pivot_m: part.pivot.to_array(),
    };
    let constraint = |set: &str| ConstraintFile {
        set: set.to_owned(),
        velocity_m_s: [const { Some(VelocityFile::Constant(0.0)) }; 3],
    };
    let mut friction = Vec::new();
    for (index, part) in scene.parts.iter().enumerate() {
        for other in &scene.parts[index..] {
            if part.held.is_none() {
                let between = [part.name, other.name].map(str::to_owned);
                friction.push(BodyFrictionFile { between, coefficient: settings.friction });
            }
        }
    }
    FractureFile {
        schema: None,
        title,
        assumptions: assumptions(blow),
        fracture: MethodFile {
            mesh: mesh.to_owned(),
            scale: 1.0,
            joints: settings.joints,
            joint_penalty: None,
            softening: Softening::default(),
            contact_penalty: 1.0,
            step_share: 0.8,
            dt_s: None,
        },
        gravity_m_s2: [0.0, 0.0, -blow.model.gravity],
        bodies: scene.parts.iter().map(body).collect(),
        constraints: scene.parts.iter().filter_map(|part| part.held).map(constraint).collect(),
        loads: scene.loads.clone(),
        materials: if has_base { vec![concrete, base] } else { vec![concrete] },
        friction,
        landmarks: Vec::new(),
        output: FractureOutputFile {
            surfaces_interval_s: scene.duration / SURFACE_OUTPUTS,
            energy_interval_s: scene.duration / ENERGY_ROWS,
            checkpoint_interval_s: None,
            tets_interval_s: 0.0,
            section: None,
        },
        stop: FractureStopFile { duration_s: scene.duration },
    }
}

fn assumptions(blow: &ScaledImpact) -> Vec<String> {
    let mut assumptions = vec![format!(
        "Froude's law at the scale {}: lengths are multiplied by the scale, velocities and times by its square root, \
         masses by its cube; gravity and density are the same as in the model. If bodies collide, the contact forces \
         follow from Young's modulus of the prototype concrete.",
        blow.froude.scale
    )];
    let [opening, _] = blow.settings.characteristic_lengths();
    let edge = blow.settings.mesh.edge() * blow.froude.length();
    if edge > 0.25 * opening {
        assumptions.push(format!(
            "The mesh size of {edge:.2} m is larger than {:.3} m, a quarter of E G_f / f_t^2 (E: Young's modulus, G_f: \
             fracture energy, f_t: tensile strength). The results show whether and where the unit cracks, but not the \
             path of the cracks.",
            0.25 * opening
        ));
    }
    assumptions
}

/// Writes the case and its mesh into the folder `dir`; `name` is the name of both files without extension.
///
/// # Errors
/// If a file cannot be written.
pub fn write(
    blow: &ScaledImpact,
    scene: &ImpactScene,
    title: String,
    dir: &Path,
    name: &str,
) -> Result<(), OutputError> {
    let mesh = format!("{name}.msh");
    write_atomically(&dir.join(&mesh), &msh::write(&scene.mesh, true))?;
    let path = dir.join(format!("{name}.json"));
    let mut text = serde_json::to_string_pretty(&file(blow, scene, title, &mesh)).map_err(OutputError::json(&path))?;
    text.push('\n');
    write_atomically(&path, text.as_bytes())
}

/// Returns true if the body called `name` is a unit, and false for a block of the bed.
pub fn is_unit(name: &str) -> bool {
    name == UnitMesh::NAME || name == PARTNER
}
