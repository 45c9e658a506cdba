//! Validates the breakage analysis: which impacts are re-run at prototype scale, and how.

use std::path::Path;

use super::check::{Checker, above, from, show};
use super::file::{BaseFile, HandoverFile, HandoverMaterialFile};
pub use super::file::{HandoverWay, Hardness};
use super::fracture::validate_concrete;
use super::unit_shape::UnitShape;
use crate::case::file::Joints;
use crate::femdem::mesh;
use crate::femdem::mesh::UnitMesh;

/// Largest number of impacts computed at the same time.
const MOST_CORES: usize = 1024;

/// Settings of the breakage analysis; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Handover {
    /// Prototype length over case length [-].
    pub scale: f64,
    /// Mesh of one unit, at the size of the case.
    pub mesh: UnitMesh,
    /// Content of the mesh file.
    pub mesh_file: Vec<u8>,
    /// Concrete of the prototype.
    pub material: HandoverMaterialFile,
    /// Material of bed and mound; `None` for the concrete of the units.
    pub base: Option<BaseFile>,
    /// Friction coefficient [-].
    pub friction: f64,
    /// How an impact is re-run.
    pub way: HandoverWay,
    /// Which impacts are re-run.
    pub select: Selection,
    /// How tetrahedra are joined before they crack.
    pub joints: Joints,
    /// Time that is simulated after first contact, in the prototype [s]; `None` for the default.
    pub duration: Option<f64>,
    /// Number of impacts computed at the same time; `None` for the default.
    pub cores: Option<usize>,
}

/// Which impacts are re-run at prototype scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Selection {
    /// Quantity by which impacts are ranked.
    pub by: Hardness,
    /// Largest number of impacts; `None` for all.
    pub worst: Option<usize>,
    /// Smallest value of the quantity [N, m/s or J].
    pub at_least: f64,
}

impl Handover {
    /// Name of the mesh file in the run folder.
    pub const MESH: &str = "unit_mesh.msh";

    /// Returns the entry for the case file that is saved with the run.
    pub(super) fn entry(file: &HandoverFile) -> HandoverFile {
        HandoverFile { mesh: Self::MESH.to_owned(), ..file.clone() }
    }

    /// Returns the characteristic lengths E G_f / f_t^2 and E G_fII / c^2 [m].
    pub fn characteristic_lengths(&self) -> [f64; 2] {
        self.material.strength.of_material().characteristic_lengths(self.material.young_modulus_pa)
    }
}

/// Validates the entry. `name` is the case file; the mesh path is relative to its folder.
pub(super) fn validate(file: &HandoverFile, shape: &UnitShape, name: &str, check: &mut Checker) -> Option<Handover> {
    let before = check.count();
    let advice = "50 for a 1:50 model, 1 for units at prototype scale";
    check.number("fracture.scale", file.scale, from(1e-2).up_to(1e3), "", advice);
    check.number("fracture.friction", file.friction, from(0.0).up_to(10.0), "", "rough concrete has 0.6");
    validate_concrete("fracture.material", &file.material, check);
    if let Some(base) = &file.base {
        let path = |key: &str| format!("fracture.base.{key}");
        check.number(&path("density_kg_m3"), base.density_kg_m3, from(1.0).up_to(1e5), "kg/m3", "rock has 2650");
        check.number(&path("young_modulus_pa"), base.young_modulus_pa, from(1e3).up_to(1e13), "Pa", "rock has 5e10");
        check.number(&path("poisson_ratio"), base.poisson_ratio, from(0.0).up_to(0.45), "", "rock has 0.25");
    }
    if let Some(duration) = file.duration_s {
        check.number("fracture.duration_s", duration, above(0.0).up_to(100.0), "s", "leave it out for the default");
    }
    let least = file.select.at_least;
    check.number("fracture.select.at_least", least, from(0.0).up_to(f64::MAX), "", "0 includes the weakest impacts");
    if let Some(cores) = file.cores.filter(|cores| !(1..=MOST_CORES).contains(cores)) {
        let allowed = format!("between 1 and {MOST_CORES}");
        check.refuse("fracture.cores", cores, allowed, "leave it out for one impact per thread");
    }
    if file.select.worst == Some(0) {
        check.refuse("fracture.select.worst", 0, "at least 1", "leave out `fracture` to skip the analysis");
    }
    let (mesh_file, mesh) = read_mesh(file, shape, name, check)?;
    if check.count() > before {
        return None;
    }
    let handover = Handover {
        scale: file.scale,
        mesh,
        mesh_file,
        material: file.material.clone(),
        base: file.base.clone(),
        friction: file.friction,
        way: file.way,
        select: Selection { by: file.select.by, worst: file.select.worst, at_least: least },
        joints: file.joints,
        duration: file.duration_s,
        cores: file.cores,
    };
    warn_of_coarse_mesh(&handover, check);
    Some(handover)
}

fn read_mesh(file: &HandoverFile, shape: &UnitShape, name: &str, check: &mut Checker) -> Option<(Vec<u8>, UnitMesh)> {
    let path = Path::new(name).parent().unwrap_or(Path::new("")).join(&file.mesh);
    let shown = format!("{:?}", path.display().to_string());
    let mut refuse = |allowed: String, advice: &str| {
        check.refuse("fracture.mesh", &shown, allowed, advice);
        None
    };
    let bytes = match std::fs::read(&path) {
        Ok(bytes) => bytes,
        Err(error) => {
            let advice = "paths are relative to the case file; tools/mesh/make.py makes meshes of the catalogue units";
            return refuse(format!("a file that can be read ({error})"), advice);
        }
    };
    let prepared = match mesh::parse(&bytes, &path, 1.0) {
        Ok(prepared) => prepared,
        Err(error) => {
            return refuse(format!("a valid mesh ({error})"), "docs/cases.md lists the requirements for a mesh");
        }
    };
    match UnitMesh::fit(prepared, shape.unit()) {
        Ok(mesh) => Some((bytes, mesh)),
        Err(why) => {
            refuse(format!("a mesh of the unit ({why})"), "tools/mesh/make.py makes meshes of the catalogue units")
        }
    }
}

/// Warns of elements larger than a quarter of the characteristic length: these do not resolve cracks.
fn warn_of_coarse_mesh(handover: &Handover, check: &mut Checker) {
    let [opening, _] = handover.characteristic_lengths();
    let edge = handover.mesh.edge() * handover.scale;
    if edge > 0.25 * opening {
        check.warn(format!(
            "fracture.mesh: mean edge length {} m at prototype scale; only edges of up to {} m, a quarter of \
             E G_f / f_t^2, resolve cracks: the results show whether units crack, but not how cracks run",
            show((edge * 1e3).round() * 1e-3),
            show((250.0 * opening).round() * 1e-3)
        ));
    }
}
