//! Validates the bodies of a fracture case and their materials.

use std::ops::Range as TetRange;

use glam::DVec3;

use crate::case::file::{
    BreakageMaterialFile, FractureBodyFile, FractureFile, FractureMaterialFile, Joints, Softening, StrengthFile,
};
use crate::case::reading::check::{Checker, at_least, more_than};
use crate::femdem::material::cohesive_law::{Cohesion, Range};
use crate::femdem::material::{Elastic, Strength};
use crate::femdem::mesh::PreparedMesh;
use crate::femdem::setup::Body;

/// Default joint penalties of intrinsic joints and of tied joints [-]. Published programs use 50 for intrinsic joints.
/// For tied joints 10 is enough, because only joints that have reached their strength are soft. When a tied joint
/// becomes soft, the body gains the energy of the joint spring. In the drop test of a Dolos (elements of 50 mm, impact
/// energy 680 J), the total gain is 54 J with a penalty of 2, 11 J with 10 and 4 J with 30. Penalties of 10 and more
/// give the same cracks.
const PENALTY: [f64; 2] = [50.0, 10.0];

/// Returns the bodies in the order of the mesh. Returns `None` if there are errors.
pub fn validate(file: &FractureFile, mesh: &PreparedMesh, check: &mut Checker) -> Option<Vec<Body>> {
    let before = check.count();
    let names: Vec<&str> = mesh.mesh.bodies.iter().map(|body| body.name.as_str()).collect();
    for (index, material) in file.materials.iter().enumerate() {
        if file.materials[..index].iter().any(|other| other.name == material.name) {
            let path = format!("materials[{index}].name");
            check.reject(&path, format!("{:?}", material.name), "different from the others", "rename one of them");
        }
        validate_material(&format!("materials[{index}]"), material, check);
    }
    for (index, body) in file.bodies.iter().enumerate() {
        if !names.contains(&body.name.as_str()) {
            let allowed = format!("one of {}", names.join(", "));
            let advice = "bodies are the physical volumes of the mesh";
            check.reject(&format!("bodies[{index}].name"), format!("{:?}", body.name), allowed, advice);
        }
        if file.bodies[..index].iter().any(|other| other.name == body.name) {
            let path = format!("bodies[{index}].name");
            check.reject(&path, format!("{:?}", body.name), "different from the others", "remove one of them");
        }
    }
    let mut bodies = Vec::new();
    for mesh_body in &mesh.mesh.bodies {
        match file.bodies.iter().position(|body| body.name == mesh_body.name) {
            Some(index) => {
                let body = &file.bodies[index];
                bodies.extend(validate_body(index, body, file, mesh_body.tets.clone(), check));
            }
            None => {
                let advice = "every physical volume of the mesh needs an entry";
                check.reject("bodies", "(missing)", format!("an entry named {:?}", mesh_body.name), advice);
            }
        }
    }
    (check.count() == before).then_some(bodies)
}

/// Validates the concrete of the breakage analysis. It has no density, which follows from the mass of the units.
pub(in crate::case) fn validate_concrete(path: &str, material: &BreakageMaterialFile, check: &mut Checker) {
    let material = FractureMaterialFile {
        name: String::new(),
        // A valid placeholder, because the entry has no density.
        density_kg_m3: 1.0,
        young_modulus_pa: material.young_modulus_pa,
        poisson_ratio: material.poisson_ratio,
        viscosity_pa_s: material.viscosity_pa_s,
        strength: Some(material.strength),
    };
    validate_material(path, &material, check);
}

fn validate_material(entry: &str, material: &FractureMaterialFile, check: &mut Checker) {
    let path = |key: &str| format!("{entry}.{key}");
    check.number(
        &path("density_kg_m3"),
        material.density_kg_m3,
        at_least(1.0).up_to(1e5),
        "kg/m3",
        "concrete has 2340",
    );
    check.number(
        &path("young_modulus_pa"),
        material.young_modulus_pa,
        at_least(1e3).up_to(1e13),
        "Pa",
        "concrete has 2.6e10",
    );
    check.number(&path("poisson_ratio"), material.poisson_ratio, at_least(0.0).up_to(0.45), "", "concrete has 0.2");
    check.number(&path("viscosity_pa_s"), material.viscosity_pa_s, at_least(0.0).up_to(1e9), "Pa s", "0 for none");
    let Some(strength) = &material.strength else { return };
    let path = |key: &str| format!("{entry}.strength.{key}");
    let StrengthFile { tensile_pa, cohesion_pa, friction_angle_deg, fracture_energy_j_m2, sliding_energy_j_m2 } =
        *strength;
    check.number(&path("tensile_pa"), tensile_pa, more_than(0.0).up_to(1e10), "Pa", "concrete has 3.3e6");
    check.number(
        &path("friction_angle_deg"),
        friction_angle_deg,
        at_least(0.0).below(90.0),
        "degrees",
        "concrete has 30",
    );
    let least = tensile_pa * friction_angle_deg.to_radians().tan();
    let advice =
        "more than tensile_pa x tan(friction_angle_deg): the shear strength must be positive at the tensile strength";
    check.number(&path("cohesion_pa"), cohesion_pa, more_than(least).up_to(1e11), "Pa", advice);
    check.number(
        &path("fracture_energy_j_m2"),
        fracture_energy_j_m2,
        more_than(0.0).up_to(1e7),
        "J/m2",
        "concrete has 50",
    );
    if let Some(energy) = sliding_energy_j_m2 {
        check.number(
            &path("sliding_energy_j_m2"),
            energy,
            more_than(0.0).up_to(1e7),
            "J/m2",
            "leave it out to use fracture_energy_j_m2",
        );
    }
}

fn validate_body(
    index: usize,
    body: &FractureBodyFile,
    file: &FractureFile,
    tets: TetRange<usize>,
    check: &mut Checker,
) -> Option<Body> {
    let Some(material) = file.materials.iter().find(|material| material.name == body.material) else {
        let allowed = "the name of one of `materials`";
        let path = format!("bodies[{index}].material");
        check.reject(&path, format!("{:?}", body.material), allowed, "add the material or correct the name");
        return None;
    };
    let motion = [body.velocity_m_s, body.angular_velocity_rad_s, body.pivot_m];
    for (values, key) in motion.iter().zip(["velocity_m_s", "angular_velocity_rad_s", "pivot_m"]) {
        for (axis, value) in values.iter().enumerate() {
            let path = format!("bodies[{index}].{key}[{axis}]");
            check.number(&path, *value, at_least(-1e4).up_to(1e4), "", "check the number and its unit");
        }
    }
    let elastic = Elastic {
        density: material.density_kg_m3,
        young_modulus: material.young_modulus_pa,
        poisson_ratio: material.poisson_ratio,
        viscosity: material.viscosity_pa_s,
    };
    if body.rigid && body.cracks {
        let path = format!("bodies[{index}].rigid");
        check.reject(&path, "true", "false for a body that cracks", "a rigid body cannot crack: remove one key");
    }
    let cracks = body.cracks && file.fracture.joints != Joints::Unbreakable;
    let cohesion = match &material.strength {
        Some(strength) if cracks => Some(cohesion(file, &elastic, strength)),
        None if body.cracks => {
            let advice = "give tensile strength, cohesion, friction angle and fracture energy";
            let path = format!("bodies[{index}].cracks");
            check.reject(&path, "true", format!("false, because {:?} has no strength", material.name), advice);
            None
        }
        _ => None,
    };
    Some(Body {
        cohesion,
        rigid: body.rigid,
        contact_penalty: file.fracture.contact_penalty * elastic.young_modulus,
        velocity: DVec3::from_array(body.velocity_m_s),
        angular_velocity: DVec3::from_array(body.angular_velocity_rad_s),
        pivot: DVec3::from_array(body.pivot_m),
        ..Body::at_rest(tets, elastic)
    })
}

fn cohesion(file: &FractureFile, elastic: &Elastic, strength: &StrengthFile) -> Cohesion {
    let tied = file.fracture.joints == Joints::Tied;
    let penalty = file.fracture.joint_penalty.unwrap_or(PENALTY[usize::from(tied)]);
    Cohesion {
        strength: strength.to_strength(),
        penalty: penalty * elastic.young_modulus,
        range: match file.fracture.softening {
            Softening::Exact => Range::Exact,
            Softening::Published => Range::Published,
        },
        tied,
    }
}

impl StrengthFile {
    /// Returns the strength in the form that the solver uses, with the tangent of the friction angle.
    pub(in super::super) fn to_strength(self) -> Strength {
        Strength {
            tensile: self.tensile_pa,
            cohesion: self.cohesion_pa,
            friction: self.friction_angle_deg.to_radians().tan(),
            opening_energy: self.fracture_energy_j_m2,
            sliding_energy: self.sliding_energy_j_m2.unwrap_or(self.fracture_energy_j_m2),
        }
    }
}
