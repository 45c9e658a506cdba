//! Validates a fracture case.

mod bodies;
mod boundary;
mod loads;
mod output;
mod places;

use std::path::Path;

use glam::DVec3;

use crate::case::file::FractureFile;
use crate::case::reading::check::{Checker, as_text, at_least, more_than};
use crate::case::reading::document::Document;
use crate::case::reading::error::CaseErrors;
use crate::case::reading::hash::fingerprint;
use crate::case::reading::identity::CaseIdentity;
use crate::femdem::mesh::{self, PreparedMesh};
use crate::femdem::setup::Setup;
pub(super) use bodies::validate_concrete;
pub use places::{Landmark, Plane};

/// Largest number of time steps of a run [-]. A run with more time steps would take years.
const MOST_STEPS: f64 = 1e10;

/// A validated fracture case; SI units.
#[derive(Debug, Clone)]
pub struct FractureCase {
    /// Title of the case in reports, one line.
    pub title: String,
    /// Assumptions of the case, which the report lists.
    pub assumptions: Vec<String>,
    /// Warnings about values that are allowed but probably not intended.
    pub warnings: Vec<String>,
    /// Fingerprint of case and mesh: 32 hexadecimal digits.
    pub hash: String,
    /// Identity of the case in checkpoints.
    pub identity: CaseIdentity,
    /// Text of the case file that the run writes into its folder, next to the file [`Self::MESH`].
    pub text: String,
    /// Content of the mesh file.
    pub mesh_file: Vec<u8>,
    /// Names of the bodies, in the same order as in `setup`.
    pub names: Vec<String>,
    /// The mesh, prepared for the solver.
    pub mesh: PreparedMesh,
    /// Bodies, constraints, loads and friction, as the solver uses them.
    pub setup: Setup,
    /// Time step / longest stable time step [-].
    pub step_share: f64,
    /// Time step that the case gives [s]; `None` if `step_share` determines the time step.
    pub dt: Option<f64>,
    /// Landmarks: boxes with names, for the report.
    pub landmarks: Vec<Landmark>,
    /// Cut plane in which the report shows the stresses.
    pub section: Plane,
    /// Interval between outputs of surfaces, cracks and cut plane [s]; `None` for no output.
    pub surfaces_interval: Option<f64>,
    /// Interval between snapshots of all tetrahedra [s]; `None` for no snapshots.
    pub tets_interval: Option<f64>,
    /// Interval between rows of the energy balance [s].
    pub energy_interval: f64,
    /// Interval between checkpoints [s]; `None` for no checkpoints.
    pub checkpoint_interval: Option<f64>,
    /// Simulated time after which the run ends [s].
    pub duration: f64,
}

impl FractureCase {
    /// Name of the mesh file in the run folder.
    pub const MESH: &str = "mesh.msh";

    /// Reads and validates a case file and its mesh.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, CaseErrors> {
        Self::from_document(&Document::read(path.as_ref())?)
    }

    /// Validates the text of a case file. `name` is the path of the case file; the path of the mesh is relative to its
    /// folder.
    pub fn from_str(text: &str, name: &str) -> Result<Self, CaseErrors> {
        Self::from_document(&Document::new(text, name)?)
    }

    /// Validates a document.
    pub fn from_document(document: &Document) -> Result<Self, CaseErrors> {
        let (case, warnings) = document.validate(validate)?;
        Ok(Self { warnings, ..case })
    }
}

fn validate(file: &FractureFile, document: &Document, check: &mut Checker) -> Option<FractureCase> {
    check.title(&file.title);
    let [surfaces_interval, tets_interval, checkpoint_interval] = output::validate(file, check);
    validate_numbers(file, check);
    let (mesh_file, mesh) = read_mesh(file, &document.name, check)?;
    let bodies = bodies::validate(file, &mesh, check)?;
    let mut setup = Setup::of_mesh(&mesh, bodies);
    setup.gravity = DVec3::from_array(file.gravity_m_s2);
    setup.friction = boundary::friction(file, &mesh, check);
    setup.constraints = boundary::constraints(file, &mesh, check);
    setup.loads = loads::validate(file, &mesh, check);
    warn_of_coarse_mesh(&setup, &mesh, check);
    warn_of_unused_strength(file, check);
    warn_of_ignored_cracks(&setup, &mesh, check);
    let mut kept = file.clone();
    kept.fracture.mesh = FractureCase::MESH.to_owned();
    let text = document.stored_text(file, &kept);
    let section = places::section(file, &setup, &mesh, check);
    Some(FractureCase {
        title: file.title.clone(),
        assumptions: file.assumptions.clone(),
        warnings: Vec::new(),
        identity: CaseIdentity::new(&kept, &mesh_file, &text),
        hash: fingerprint(&FractureFile { schema: None, ..kept }, &mesh_file),
        text,
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
    let advice = "with 1, a contact is eight times as stiff as the tetrahedron behind it";
    check.number("fracture.contact_penalty", method.contact_penalty, at_least(1e-3).up_to(1e3), "", advice);
    check.number(
        "fracture.step_share",
        method.step_share,
        more_than(0.0).up_to(1.0),
        "",
        "0.8 leaves a margin for large strains",
    );
    if let Some(penalty) = method.joint_penalty {
        check.number(
            "fracture.joint_penalty",
            penalty,
            at_least(0.1).up_to(1e4),
            "",
            "with 50, the joints reduce the stiffness of a body by 5 %",
        );
    }
    if let Some(dt) = method.dt_s {
        let shortest = at_least(file.stop.duration_s.max(0.0) / MOST_STEPS);
        let advice = "leave it out: step_share then determines the time step";
        check.number("fracture.dt_s", dt, shortest.up_to(1.0), "s", advice);
    }
    for (axis, g) in file.gravity_m_s2.into_iter().enumerate() {
        check.number(&format!("gravity_m_s2[{axis}]"), g, at_least(-1e3).up_to(1e3), "m/s2", "[0, 0, -9.8] on Earth");
    }
}

fn read_mesh(file: &FractureFile, name: &str, check: &mut Checker) -> Option<(Vec<u8>, PreparedMesh)> {
    let advice = "0.001 for a mesh in millimetres";
    if !check.number("fracture.scale", file.fracture.scale, more_than(0.0).up_to(1e3), "", advice) {
        return None;
    }
    let path = Path::new(name).parent().unwrap_or(Path::new("")).join(&file.fracture.mesh);
    let shown = format!("{:?}", path.display().to_string());
    let bytes = match std::fs::read(&path) {
        Ok(bytes) => bytes,
        Err(error) => {
            let advice = "paths are relative to the case file; tools/mesh/make.py makes the large meshes";
            check.reject("fracture.mesh", shown, format!("a file that can be read ({error})"), advice);
            return None;
        }
    };
    match mesh::parse(&bytes, &path, file.fracture.scale) {
        Ok(mesh) => validate_size(&mesh, file.fracture.scale, check).then_some((bytes, mesh)),
        Err(error) => {
            let advice = "docs/cases.md lists the requirements for a mesh";
            check.reject("fracture.mesh", shown, format!("a valid mesh ({error})"), advice);
            None
        }
    }
}

/// Refuses a mesh that is longer than 100 m, and warns of one that is longer than 20 m: it is probably in millimetres.
/// Prototype units are up to 10 m high, and model units in millimetres are more than 20 mm high.
fn validate_size(mesh: &PreparedMesh, scale: f64, check: &mut Checker) -> bool {
    let nodes = || mesh.mesh.nodes.iter().copied();
    let size = (nodes().fold(DVec3::MIN, DVec3::max) - nodes().fold(DVec3::MAX, DVec3::min)).max_element();
    let given = format!("a mesh of {} m with `fracture.scale` = {}", as_text(size), as_text(scale));
    if size > 100.0 {
        check.reject("fracture.mesh", given, "at most 100 m long", "for a mesh in millimetres, write `scale` 0.001");
    } else if size > 20.0 {
        check.warn(format!("fracture.mesh = {given}: for a mesh in millimetres, write `scale` 0.001"));
    }
    size <= 100.0
}

/// Warns of pre-cracks in bodies that cannot crack: they stay closed.
fn warn_of_ignored_cracks(setup: &Setup, mesh: &PreparedMesh, check: &mut Checker) {
    let can_crack = |tet: usize| setup.bodies.iter().any(|body| body.cohesion.is_some() && body.tets.contains(&tet));
    for set in &mesh.faces.cracks {
        let first_tet = |face: u32| mesh.faces.interfaces[face as usize].tets[0] as usize;
        let closed = set.faces.iter().filter(|face| !can_crack(first_tet(**face))).count();
        if closed > 0 {
            check.warn(format!(
                "fracture.mesh: {closed} of {} faces of the pre-crack {:?} stay closed, because their body cannot crack; \
                 write \"cracks\": true in this body, with `joints` that can break",
                set.faces.len(),
                set.name
            ));
        }
    }
}

/// Warns if a material has a strength but no body can crack.
fn warn_of_unused_strength(file: &FractureFile, check: &mut Checker) {
    let unused = file.materials.iter().filter(|material| material.strength.is_some());
    let cracks = |name: &str| file.bodies.iter().any(|body| body.material == name && body.cracks);
    for material in unused.filter(|material| !cracks(&material.name)) {
        check.warn(format!(
            "materials: {:?} has a strength, but no body of this material can crack; write \"cracks\": true in its bodies",
            material.name
        ));
    }
}

/// Warns if the mean edge of the elements is longer than a quarter of the characteristic length: E G_f / f_t^2 for
/// opening cracks, E G_fII / c^2 for shear cracks (with Young's modulus E and the symbols of
/// `StrengthFile`). Such elements do not resolve these cracks.
fn warn_of_coarse_mesh(setup: &Setup, mesh: &PreparedMesh, check: &mut Checker) {
    for (body, quality) in setup.bodies.iter().zip(&mesh.quality) {
        if let Some(warning) = quality.warning() {
            check.warn(warning);
        }
        let Some(cohesion) = &body.cohesion else { continue };
        let [opening, sliding] = cohesion.strength.characteristic_lengths(body.elastic.young_modulus).map(|l| 0.25 * l);
        let metres = |length: f64| as_text((length * 1e4).round() * 1e-4);
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
            check.reject(
                "fracture.joint_penalty",
                as_text(cohesion.penalty / body.elastic.young_modulus),
                format!(
                    "so large that joints with edges of {} m absorb less than G_f before the peak stress",
                    as_text(quality.edge_max)
                ),
                "refine the mesh, raise the joint penalty or use \"joints\": \"tied\"",
            );
        }
    }
}
