//! Validates a fracture case.

mod bodies;
mod boundary;
mod loads;
mod output;
mod places;

use std::path::Path;

use glam::DVec3;

use super::check::{Checker, above, from, show};
use super::error::CaseErrors;
use super::file::FractureFile;
use super::hash::fingerprint;
use super::parse::parse;
use super::validate::read;
use crate::femdem::mesh::{self, PreparedMesh};
use crate::femdem::setup::Setup;
pub(super) use bodies::validate_concrete;
pub use places::{Landmark, Plane};

/// Largest number of time steps of a run [-]; more would take years.
const MOST_STEPS: f64 = 1e10;

/// A validated fracture case; SI units.
#[derive(Debug, Clone)]
pub struct FractureCase {
    /// One line that names the case.
    pub title: String,
    /// Assumptions listed in the case file.
    pub assumptions: Vec<String>,
    /// Values that are allowed but probably not intended.
    pub warnings: Vec<String>,
    /// Fingerprint of case and mesh: 32 hexadecimal digits.
    pub hash: String,
    /// Case text that is saved with the run, next to [`Self::MESH`].
    pub text: String,
    /// Content of the mesh file.
    pub mesh_file: Vec<u8>,
    /// Names of the bodies, in the order of the setup.
    pub names: Vec<String>,
    /// The mesh.
    pub mesh: PreparedMesh,
    /// Bodies, constraints, loads and friction, as the solver uses them.
    pub setup: Setup,
    /// Time step over the longest stable time step [-].
    pub step_share: f64,
    /// Time step [s], if the case gives it.
    pub dt: Option<f64>,
    /// Named positions.
    pub landmarks: Vec<Landmark>,
    /// Cut plane of the stress pictures.
    pub section: Plane,
    /// Output interval of surfaces, cracks and cut plane [s].
    pub surfaces_interval: Option<f64>,
    /// Output interval of all tetrahedra [s].
    pub tets_interval: Option<f64>,
    /// Output interval of the energy balance [s].
    pub energy_interval: f64,
    /// Checkpoint interval [s]; `None` for no checkpoints.
    pub checkpoint_interval: Option<f64>,
    /// Simulated time [s].
    pub duration: f64,
}

impl FractureCase {
    /// Name of the mesh file in the run folder.
    pub const MESH: &str = "mesh.msh";

    /// Returns whether the text of a case file describes a fracture case.
    pub fn is_one(text: &str) -> bool {
        // Other cases use the same key for the breakage analysis, but they also have a domain.
        serde_json::from_str::<serde_json::Value>(text)
            .is_ok_and(|value| value.get("fracture").is_some() && value.get("domain").is_none())
    }

    /// Reads and validates a case file and its mesh.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, CaseErrors> {
        let (text, name) = read(path.as_ref())?;
        Self::from_str(&text, &name)
    }

    /// Validates the text of a case file. `name` is its name in messages; the mesh path is relative to its folder.
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
    let bodies = bodies::validate(file, &mesh, check)?;
    let mut setup = Setup::of_mesh(&mesh, bodies);
    setup.gravity = DVec3::from_array(file.gravity_m_s2);
    setup.friction = boundary::friction(file, &mesh, check);
    setup.constraints = boundary::constraints(file, &mesh, check);
    setup.loads = loads::validate(file, &mesh, check);
    warn_of_coarse_mesh(&setup, &mesh, check);
    let mut kept = file.clone();
    kept.fracture.mesh = FractureCase::MESH.to_owned();
    // Serializing to a string cannot fail: every key is a string.
    let kept_text =
        if kept == *file { text.to_owned() } else { serde_json::to_string_pretty(&kept).unwrap_or_default() };
    let section = places::section(file, &setup, &mesh, check);
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
        landmarks: places::landmarks(file, check),
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
        "0.8 leaves a margin for large strains",
    );
    if let Some(penalty) = method.joint_penalty {
        check.number("fracture.joint_penalty", penalty, from(0.1).up_to(1e4), "", "50 reduces the stiffness by 5 %");
    }
    if let Some(dt) = method.dt_s {
        let shortest = from(file.stop.duration_s.max(0.0) / MOST_STEPS);
        check.number("fracture.dt_s", dt, shortest.up_to(1.0), "s", "leave it out for the longest stable time step");
    }
    for (axis, g) in file.gravity_m_s2.into_iter().enumerate() {
        check.number(&format!("gravity_m_s2[{axis}]"), g, from(-1e3).up_to(1e3), "m/s2", "[0, 0, -9.8] on Earth");
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
            let advice = "paths are relative to the case file; tools/mesh/make.py makes the large meshes";
            check.refuse("fracture.mesh", shown, format!("a file that can be read ({error})"), advice);
            return None;
        }
    };
    match mesh::parse(&bytes, &path, file.fracture.scale) {
        Ok(mesh) => Some((bytes, mesh)),
        Err(error) => {
            let advice = "docs/cases.md lists the requirements for a mesh";
            check.refuse("fracture.mesh", shown, format!("a valid mesh ({error})"), advice);
            None
        }
    }
}

/// Warns of elements larger than a quarter of the characteristic length: these do not resolve cracks.
fn warn_of_coarse_mesh(setup: &Setup, mesh: &PreparedMesh, check: &mut Checker) {
    for (body, quality) in setup.bodies.iter().zip(&mesh.quality) {
        if let Some(warning) = quality.warning() {
            check.warn(warning);
        }
        let Some(cohesion) = &body.cohesion else { continue };
        let [opening, sliding] = cohesion.strength.characteristic_lengths(body.elastic.young_modulus).map(|l| 0.25 * l);
        let metres = |length: f64| show((length * 1e4).round() * 1e-4);
        let edges = format!("{}: mean edge length {} m", quality.body, metres(quality.edge_mean));
        if quality.edge_mean > opening {
            let most = metres(opening);
            check.warn(format!("{edges}; only edges of up to {most} m, a quarter of E G_f / f_t^2, resolve cracks"));
        }
        if quality.edge_mean > sliding && sliding < 0.5 * opening {
            let most = metres(sliding);
            check.warn(format!(
                "{edges}; only edges of up to {most} m, a quarter of E G_fII / c^2, resolve shear cracks: on this mesh \
                 crushed zones shatter; for concrete sliding_energy_j_m2 is about 25 times fracture_energy_j_m2"
            ));
        }
        if quality.edge_max > cohesion.longest_edge() {
            check.refuse(
                "fracture.joint_penalty",
                show(cohesion.penalty / body.elastic.young_modulus),
                format!("so large that joints with edges of {} m store less than G_f", show(quality.edge_max)),
                "refine the mesh, raise the joint penalty or use \"joints\": \"tied\"",
            );
        }
    }
}
