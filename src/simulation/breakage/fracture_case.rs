//! The fracture case of a scene: a file that `breakwater fracture` runs and that users can edit.

use std::path::Path;

use glam::DVec3;

use super::blow::Blow;
use crate::case::file::{
    BodyFrictionFile, ConstraintFile, FractureBodyFile, FractureFile, FractureMaterialFile, FractureOutputFile,
    FractureStopFile, LoadFile, MethodFile, Softening, VelocityFile,
};
use crate::femdem::mesh::unit_mesh::UnitMesh;
use crate::femdem::mesh::{Mesh, msh};
use crate::output::{OutputError, write_atomically};

/// Number of times at which a run writes its surfaces.
const PICTURES: f64 = 20.0;

/// Number of rows of its energy balance.
const ROWS: f64 = 400.0;

/// Bodies, loads and duration of an impact that is re-run; positions are relative to the contact point.
#[derive(Debug, Clone)]
pub struct Scene {
    /// Mesh of all bodies.
    pub mesh: Mesh,
    /// Motion of each body.
    pub parts: Vec<Part>,
    /// Loads on the bodies.
    pub loads: Vec<LoadFile>,
    /// Simulated time [s].
    pub duration: f64,
}

/// A body of a scene.
#[derive(Debug, Clone)]
pub struct Part {
    /// Name in the mesh.
    pub name: &'static str,
    /// Velocity of its centre of mass [m/s].
    pub velocity: DVec3,
    /// Angular velocity [rad/s].
    pub angular_velocity: DVec3,
    /// Centre of mass [m].
    pub pivot: DVec3,
    /// Fixed set of a block of the bed; `None` for a unit, which is free and can crack.
    pub held: Option<&'static str>,
}

impl Part {
    /// Returns a block of the bed, fixed at a set of faces.
    pub fn held(name: &'static str, set: &'static str) -> Self {
        let still = DVec3::ZERO;
        Self { name, velocity: still, angular_velocity: still, pivot: still, held: Some(set) }
    }
}

/// Returns the case of a scene; `mesh` is the name of its mesh file.
pub fn file(blow: &Blow, scene: &Scene, title: String, mesh: &str) -> FractureFile {
    let handover = blow.handover;
    let units = handover.material.clone();
    let concrete = FractureMaterialFile {
        name: "unit".to_owned(),
        density_kg_m3: blow.density(),
        young_modulus_pa: units.young_modulus_pa,
        poisson_ratio: units.poisson_ratio,
        viscosity_pa_s: units.viscosity_pa_s,
        strength: Some(units.strength),
    };
    let base = match &handover.base {
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
                friction.push(BodyFrictionFile { between, coefficient: handover.friction });
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
            joints: handover.joints,
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
            surfaces_interval_s: scene.duration / PICTURES,
            energy_interval_s: scene.duration / ROWS,
            checkpoint_interval_s: None,
            tets_interval_s: 0.0,
            section: None,
        },
        stop: FractureStopFile { duration_s: scene.duration },
    }
}

fn assumptions(blow: &Blow) -> Vec<String> {
    let mut assumptions = vec![format!(
        "Froude's law at the scale {}: lengths by the scale, velocities and times by its root, masses by its cube; \
         gravity and density as in the model. Contact follows from the prototype's concrete, not from scaled forces.",
        blow.froude.scale
    )];
    let [opening, _] = blow.handover.characteristic_lengths();
    let edge = blow.handover.mesh.edge() * blow.froude.length();
    if edge > 0.25 * opening {
        assumptions.push(format!(
            "Elements of {edge:.2} m are larger than {:.3} m, a quarter of E G_f / f_t^2: the results show whether and \
             where the unit cracks, but not how cracks run.",
            0.25 * opening
        ));
    }
    assumptions
}

/// Writes case and mesh into a folder; `name` is the file name without extension.
///
/// # Errors
/// If a file cannot be written.
pub fn write(blow: &Blow, scene: &Scene, title: String, dir: &Path, name: &str) -> Result<(), OutputError> {
    let mesh = format!("{name}.msh");
    write_atomically(&dir.join(&mesh), &msh::write(&scene.mesh, true))?;
    let path = dir.join(format!("{name}.json"));
    let mut text = serde_json::to_string_pretty(&file(blow, scene, title, &mesh)).map_err(OutputError::json(&path))?;
    text.push('\n');
    write_atomically(&path, text.as_bytes())
}

/// Returns whether a body of a case is a unit.
pub fn is_unit(name: &str) -> bool {
    name == UnitMesh::NAME || name == super::reenact::PARTNER
}
