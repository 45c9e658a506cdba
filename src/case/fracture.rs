//! A fracture case, validated.

mod output;

use std::path::Path;

use glam::DVec3;

use super::check::{Checker, above, from, show};
use super::error::CaseErrors;
use super::file::{BodyFrictionFile, FractureBodyFile, FractureFile, FractureMaterialFile, Joints, StrengthFile};
use super::fracture_places::{self, Landmark, Plane};
use super::hash::fingerprint;
use super::parse::parse;
use super::validate::read;
use crate::femdem::cohesive_law::{Cohesion, Range};
use crate::femdem::material::{Elastic, Strength};
use crate::femdem::mesh::{self, PreparedMesh};
use crate::femdem::setup::{Body, Constraint, Setup};

/// p_0 over E where the case does not give it [-]: the published practice for joints that hold from the start; tied ones
/// need little, for only joints that have come free are soft.
const PENALTY: [f64; 2] = [50.0, 2.0];

/// Steps of a run at most [-]: more take years.
const MOST_STEPS: f64 = 1e10;

/// A fracture case whose values make sense; SI units throughout.
#[derive(Debug, Clone)]
pub struct FractureCase {
    /// One line that names the case.
    pub title: String,
    /// What had to be assumed.
    pub assumptions: Vec<String>,
    /// What is allowed and probably not meant.
    pub warnings: Vec<String>,
    /// 32 hexadecimal digits that stay the same for the same case and mesh.
    pub hash: String,
    /// The case as a run keeps it, beside [`Self::MESH`].
    pub text: String,
    /// Content of the mesh file.
    pub mesh_file: Vec<u8>,
    /// Names of the bodies, in the order of the setup.
    pub names: Vec<String>,
    /// The mesh.
    pub mesh: PreparedMesh,
    /// What the world is made of.
    pub setup: Setup,
    /// Share of the longest stable step [-].
    pub step_share: f64,
    /// Time step [s], if the case gives it.
    pub dt: Option<f64>,
    /// Places with names.
    pub landmarks: Vec<Landmark>,
    /// Plane of the pictures of the stress.
    pub section: Plane,
    /// Interval of surfaces, cracks and cut plane [s].
    pub surfaces_interval: Option<f64>,
    /// Interval of all tetrahedra [s].
    pub tets_interval: Option<f64>,
    /// Interval of the energy book [s].
    pub energy_interval: f64,
    /// Interval of the checkpoints [s]; without it none is written.
    pub checkpoint_interval: Option<f64>,
    /// Simulated time [s].
    pub duration: f64,
}

impl FractureCase {
    /// Name of the mesh in a run's folder.
    pub const MESH: &str = "mesh.msh";

    /// Whether the text of a case file is that of a fracture case.
    pub fn is_one(text: &str) -> bool {
        // A case with water may hand its impacts over under the same key; it has a domain, too.
        serde_json::from_str::<serde_json::Value>(text)
            .is_ok_and(|value| value.get("fracture").is_some() && value.get("domain").is_none())
    }

    /// Read and validate a case file with its mesh.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, CaseErrors> {
        let (text, name) = read(path.as_ref())?;
        Self::from_str(&text, &name)
    }

    /// Validate the text of a case file; `name` is its name in messages, its folder that of the mesh.
    pub fn from_str(text: &str, name: &str) -> Result<Self, CaseErrors> {
        let file: FractureFile = parse(text, name)?;
        let mut check = Checker::new(name);
        match validate(&file, text, name, &mut check) {
            Some(case) if check.count() == 0 => Ok(Self { warnings: check.warnings, ..case }),
            _ => Err(check.into_errors()),
        }
    }
}

fn validate(file: &FractureFile, text: &str, name: &str, check: &mut Checker) -> Option<FractureCase> {
    if file.title.trim().is_empty() {
        check.refuse("title", format!("{:?}", file.title), "a line of text", "name the case");
    }
    let [surfaces_interval, tets_interval, checkpoint_interval] = output::validate(file, check);
    validate_numbers(file, check);
    let (mesh_file, mesh) = read_mesh(file, name, check)?;
    let bodies = validate_bodies(file, &mesh, check)?;
    let mut setup = Setup::of_mesh(&mesh, bodies);
    setup.gravity = DVec3::from_array(file.gravity_m_s2);
    setup.friction = friction(file, &mesh, check);
    setup.constraints = constraints(file, &mesh, check);
    warn_of_coarse_mesh(&setup, &mesh, check);
    let mut kept = file.clone();
    kept.fracture.mesh = FractureCase::MESH.to_owned();
    // Writing to memory cannot fail: every key is a string.
    let kept_text =
        if kept == *file { text.to_owned() } else { serde_json::to_string_pretty(&kept).unwrap_or_default() };
    let section = fracture_places::section(file, &setup, &mesh, check);
    Some(FractureCase {
        title: file.title.clone(),
        assumptions: file.assumptions.clone(),
        warnings: Vec::new(),
        hash: fingerprint(&FractureFile { schema: None, ..kept }, &mesh_file),
        text: kept_text,
        mesh_file,
        names: mesh.mesh.bodies.iter().map(|body| body.name.clone()).collect(),
        mesh,
        setup,
        step_share: file.fracture.step_share,
        dt: file.fracture.dt_s,
        landmarks: fracture_places::landmarks(file, check),
        section,
        surfaces_interval,
        tets_interval,
        energy_interval: file.output.energy_interval_s,
        checkpoint_interval,
        duration: file.stop.duration_s,
    })
}

fn validate_numbers(file: &FractureFile, check: &mut Checker) {
    let method = &file.fracture;
    let advice = "1 makes a contact eight times as stiff as the tetrahedron behind it";
    check.number("fracture.contact_penalty", method.contact_penalty, from(1e-3).up_to(1e3), "", advice);
    check.number(
        "fracture.step_share",
        method.step_share,
        above(0.0).up_to(1.0),
        "",
        "0.8 leaves room for large strains",
    );
    if let Some(penalty) = method.joint_penalty {
        check.number("fracture.joint_penalty", penalty, from(0.1).up_to(1e4), "", "50 costs 5 % of the stiffness");
    }
    if let Some(dt) = method.dt_s {
        let shortest = from(file.stop.duration_s.max(0.0) / MOST_STEPS);
        check.number("fracture.dt_s", dt, shortest.up_to(1.0), "s", "leave it out for the longest stable step");
    }
    for (axis, g) in file.gravity_m_s2.into_iter().enumerate() {
        check.number(&format!("gravity_m_s2[{axis}]"), g, from(-1e3).up_to(1e3), "m/s2", "[0, 0, -9.8] on earth");
    }
}

fn read_mesh(file: &FractureFile, name: &str, check: &mut Checker) -> Option<(Vec<u8>, PreparedMesh)> {
    let advice = "0.001 for a mesh in millimetres";
    if !check.number("fracture.scale", file.fracture.scale, above(0.0).up_to(1e3), "", advice) {
        return None;
    }
    let path = Path::new(name).parent().unwrap_or(Path::new("")).join(&file.fracture.mesh);
    let shown = format!("{:?}", path.display().to_string());
    let bytes = match std::fs::read(&path) {
        Ok(bytes) => bytes,
        Err(error) => {
            let advice = "paths are seen from the case file; tools/mesh/make.py makes the large meshes";
            check.refuse("fracture.mesh", shown, format!("a file that can be read ({error})"), advice);
            return None;
        }
    };
    match mesh::parse(&bytes, &path, file.fracture.scale) {
        Ok(mesh) => Some((bytes, mesh)),
        Err(error) => {
            let advice = "docs/cases.md tells what a mesh must be";
            check.refuse("fracture.mesh", shown, format!("a mesh that can be computed with ({error})"), advice);
            None
        }
    }
}

/// The bodies in the order of the mesh.
fn validate_bodies(file: &FractureFile, mesh: &PreparedMesh, check: &mut Checker) -> Option<Vec<Body>> {
    let before = check.count();
    let names: Vec<&str> = mesh.mesh.bodies.iter().map(|body| body.name.as_str()).collect();
    for (index, material) in file.materials.iter().enumerate() {
        validate_material(index, material, check);
    }
    for (index, body) in file.bodies.iter().enumerate() {
        if !names.contains(&body.name.as_str()) {
            let allowed = format!("one of {}", names.join(", "));
            let advice = "bodies are the physical volumes of the mesh";
            check.refuse(&format!("bodies[{index}].name"), format!("{:?}", body.name), allowed, advice);
        }
        if file.bodies[..index].iter().any(|other| other.name == body.name) {
            let path = format!("bodies[{index}].name");
            check.refuse(&path, format!("{:?}", body.name), "different from the others", "leave one out");
        }
    }
    let mut bodies = Vec::new();
    for of_mesh in &mesh.mesh.bodies {
        match file.bodies.iter().position(|body| body.name == of_mesh.name) {
            Some(index) => {
                let body = &file.bodies[index];
                bodies.extend(validate_body(index, body, file, of_mesh.tets.clone(), check));
            }
            None => {
                let advice = "every physical volume of the mesh needs its entry";
                check.refuse("bodies", "(missing)", format!("an entry named {:?}", of_mesh.name), advice);
            }
        }
    }
    (check.count() == before).then_some(bodies)
}

fn validate_material(index: usize, material: &FractureMaterialFile, check: &mut Checker) {
    let path = |key: &str| format!("materials[{index}].{key}");
    check.number(&path("density_kg_m3"), material.density_kg_m3, from(1.0).up_to(1e5), "kg/m3", "concrete has 2340");
    check.number(
        &path("young_modulus_pa"),
        material.young_modulus_pa,
        from(1e3).up_to(1e13),
        "Pa",
        "concrete has 2.6e10",
    );
    check.number(&path("poisson_ratio"), material.poisson_ratio, from(0.0).up_to(0.45), "", "concrete has 0.2");
    check.number(&path("viscosity_pa_s"), material.viscosity_pa_s, from(0.0).up_to(1e9), "Pa s", "0 for none");
    let Some(strength) = &material.strength else { return };
    let path = |key: &str| format!("materials[{index}].strength.{key}");
    let StrengthFile { tensile_pa, cohesion_pa, friction_angle_deg, fracture_energy_j_m2, sliding_energy_j_m2 } =
        *strength;
    check.number(&path("tensile_pa"), tensile_pa, above(0.0).up_to(1e10), "Pa", "concrete has 3.3e6");
    check.number(&path("friction_angle_deg"), friction_angle_deg, from(0.0).below(90.0), "degrees", "concrete has 30");
    let least = tensile_pa * friction_angle_deg.to_radians().tan();
    let advice = "at the tensile strength something must be left of the shear strength";
    check.number(&path("cohesion_pa"), cohesion_pa, above(least).up_to(1e11), "Pa", advice);
    check.number(&path("fracture_energy_j_m2"), fracture_energy_j_m2, above(0.0).up_to(1e7), "J/m2", "concrete has 50");
    if let Some(energy) = sliding_energy_j_m2 {
        check.number(
            &path("sliding_energy_j_m2"),
            energy,
            above(0.0).up_to(1e7),
            "J/m2",
            "leave it out for that in opening",
        );
    }
}

fn validate_body(
    index: usize,
    body: &FractureBodyFile,
    file: &FractureFile,
    tets: std::ops::Range<usize>,
    check: &mut Checker,
) -> Option<Body> {
    let Some(material) = file.materials.iter().find(|material| material.name == body.material) else {
        let allowed = "the name of one of `materials`";
        let path = format!("bodies[{index}].material");
        check.refuse(&path, format!("{:?}", body.material), allowed, "add the material or mend the name");
        return None;
    };
    let motion = [body.velocity_m_s, body.angular_velocity_rad_s, body.pivot_m];
    for (values, key) in motion.iter().zip(["velocity_m_s", "angular_velocity_rad_s", "pivot_m"]) {
        for (axis, value) in values.iter().enumerate() {
            let path = format!("bodies[{index}].{key}[{axis}]");
            check.number(&path, *value, from(-1e4).up_to(1e4), "", "a number of that size");
        }
    }
    let elastic = Elastic {
        density: material.density_kg_m3,
        young_modulus: material.young_modulus_pa,
        poisson_ratio: material.poisson_ratio,
        viscosity: material.viscosity_pa_s,
    };
    let cracks = body.cracks && file.fracture.joints != Joints::Unbreakable;
    let cohesion = match &material.strength {
        Some(strength) if cracks => Some(cohesion(file, &elastic, strength)),
        None if body.cracks => {
            let advice = "give tensile strength, cohesion, friction angle and fracture energy";
            let path = format!("bodies[{index}].cracks");
            check.refuse(&path, "true", format!("false, for {:?} has no strength", material.name), advice);
            None
        }
        _ => None,
    };
    Some(Body {
        cohesion,
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
        strength: Strength {
            tensile: strength.tensile_pa,
            cohesion: strength.cohesion_pa,
            friction: strength.friction_angle_deg.to_radians().tan(),
            opening_energy: strength.fracture_energy_j_m2,
            sliding_energy: strength.sliding_energy_j_m2.unwrap_or(strength.fracture_energy_j_m2),
        },
        penalty: penalty * elastic.young_modulus,
        range: Range::Exact,
        tied,
    }
}

/// Coefficients between the bodies, in the order of the mesh.
fn friction(file: &FractureFile, mesh: &PreparedMesh, check: &mut Checker) -> Vec<Vec<f64>> {
    let count = mesh.mesh.bodies.len();
    let mut table = vec![vec![0.0; count]; count];
    for (index, BodyFrictionFile { between, coefficient }) in file.friction.iter().enumerate() {
        let path = format!("friction[{index}].coefficient");
        check.number(&path, *coefficient, from(0.0).up_to(10.0), "", "concrete on concrete has 0.6");
        let numbers = between.each_ref().map(|name| mesh.mesh.bodies.iter().position(|body| body.name == *name));
        match numbers {
            [Some(a), Some(b)] => {
                table[a][b] = *coefficient;
                table[b][a] = *coefficient;
            }
            _ => check.refuse(
                &format!("friction[{index}].between"),
                format!("{between:?}"),
                "names of two bodies of the mesh",
                "the same one twice stands for its crack faces",
            ),
        }
    }
    table
}

/// Constraints of the sets; a node of several sets has the components of all of them.
fn constraints(file: &FractureFile, mesh: &PreparedMesh, check: &mut Checker) -> Vec<Constraint> {
    let mut of_node: Vec<[Option<f64>; 3]> = vec![[None; 3]; mesh.mesh.nodes.len()];
    for (index, constraint) in file.constraints.iter().enumerate() {
        let Some(set) = mesh.faces.boundaries.iter().find(|set| set.name == constraint.set) else {
            let names: Vec<&str> = mesh.faces.boundaries.iter().map(|set| set.name.as_str()).collect();
            let allowed = format!("one of {}", names.join(", "));
            let advice = "sets are the physical surfaces of the mesh";
            check.refuse(&format!("constraints[{index}].set"), format!("{:?}", constraint.set), allowed, advice);
            continue;
        };
        for (axis, velocity) in constraint.velocity_m_s.iter().enumerate() {
            let path = format!("constraints[{index}].velocity_m_s[{axis}]");
            let given = velocity.is_some_and(|v| check.number(&path, v, from(-1e4).up_to(1e4), "m/s", "0 holds it"));
            if !given {
                continue;
            }
            for face in &set.faces {
                let exterior = &mesh.faces.exteriors[*face as usize];
                for corner in exterior.nodes {
                    of_node[mesh.mesh.tets[exterior.tet as usize][usize::from(corner)] as usize][axis] = *velocity;
                }
            }
        }
    }
    let mut constraints: Vec<Constraint> = Vec::new();
    for (node, velocity) in of_node.into_iter().enumerate().filter(|(_, v)| v.iter().any(Option::is_some)) {
        match constraints.iter_mut().find(|constraint| constraint.velocity == velocity) {
            Some(constraint) => constraint.nodes.push(node as u32),
            None => constraints.push(Constraint { nodes: vec![node as u32], velocity }),
        }
    }
    constraints
}

/// A crack is trusted where elements are no larger than a quarter of the characteristic length.
fn warn_of_coarse_mesh(setup: &Setup, mesh: &PreparedMesh, check: &mut Checker) {
    for (body, quality) in setup.bodies.iter().zip(&mesh.quality) {
        if let Some(warning) = quality.warning() {
            check.warn(warning);
        }
        let Some(cohesion) = &body.cohesion else { continue };
        let largest = 0.25 * cohesion.strength.characteristic_length(body.elastic.young_modulus);
        if quality.edge_mean > largest {
            check.warn(format!(
                "{}: edges of {} m on average; cracks are resolved by edges of up to {} m, a quarter of E G_f / f_t^2",
                quality.body,
                show((quality.edge_mean * 1e4).round() * 1e-4),
                show((largest * 1e4).round() * 1e-4)
            ));
        }
        if quality.edge_max > cohesion.longest_edge() {
            check.refuse(
                "fracture.joint_penalty",
                show(cohesion.penalty / body.elastic.young_modulus),
                format!("so large that edges of {} m leave something of G_f", show(quality.edge_max)),
                "make the mesh finer or the joints stiffer, or tie them",
            );
        }
    }
}
