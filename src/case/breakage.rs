//! Validates the breakage analysis: which impacts are re-run at prototype scale, and how.

use std::path::Path;

use super::file::{BaseFile, BreakageFile, BreakageMaterialFile, ImpactMeasure, Joints, RerunMethod};
use super::fracture::validate_concrete;
use super::reading::check::{Checker, as_text, at_least, more_than};
use super::units::Units;
use super::units::shape::UnitShape;
use crate::femdem::mesh;
use crate::femdem::mesh::UnitMesh;

/// Largest number of impacts that are computed at the same time.
const MOST_CORES: usize = 1024;

/// Settings of the breakage analysis; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct BreakageSettings {
    /// Length scale: prototype length / length in the case [-].
    pub scale: f64,
    /// Index of the group of units.
    pub group: usize,
    /// Mesh of one unit, scaled to the size of the units in the case.
    pub mesh: UnitMesh,
    /// Content of the mesh file.
    pub mesh_file: Vec<u8>,
    /// Concrete of the prototype units, without its density.
    pub material: BreakageMaterialFile,
    /// Material of bed and mound; `None` for the concrete of the units.
    pub base: Option<BaseFile>,
    /// Coulomb friction coefficient between unit and bed, between two units, and between crack faces [-].
    pub friction: f64,
    /// Method by which impacts are re-run.
    pub way: RerunMethod,
    /// Selection of the impacts that are re-run.
    pub select: Selection,
    /// Kind of the joints between tetrahedra before the concrete cracks.
    pub joints: Joints,
    /// Simulated time after first contact, at prototype scale [s]; `None` for the default.
    pub duration: Option<f64>,
    /// Number of impacts that are computed at the same time; `None` for the number of threads.
    pub cores: Option<usize>,
}

/// Selection of the impacts that are re-run at prototype scale.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Selection {
    /// Quantity by which the impacts are ranked, the hardest first.
    pub by: ImpactMeasure,
    /// Largest number of impacts that are re-run; `None` for all.
    pub worst: Option<usize>,
    /// Smallest value of the quantity `by` for a re-run, at the scale of the case [N, m/s or J].
    pub at_least: f64,
}

impl BreakageSettings {
    /// Name of the mesh file in the run folder.
    pub const MESH: &str = "unit_mesh.msh";

    /// Returns the entry `breakage` for the case file in the run folder. It refers to the file [`Self::MESH`].
    pub(super) fn entry(file: &BreakageFile) -> BreakageFile {
        BreakageFile { mesh: Self::MESH.to_owned(), ..file.clone() }
    }

    /// Returns the characteristic lengths of the concrete [m]: E G_f / f_t^2 (opening) and E G_fII / c^2 (shear), with
    /// Young's modulus E, fracture energies G_f and G_fII, tensile strength f_t and cohesion c.
    pub fn characteristic_lengths(&self) -> [f64; 2] {
        self.material.strength.to_strength().characteristic_lengths(self.material.young_modulus_pa)
    }
}

/// Returns the index of the group whose breakage is analysed.
fn group_of(file: &BreakageFile, units: &Units, check: &mut Checker) -> Option<usize> {
    let found = match &file.group {
        Some(name) => units.groups.iter().position(|group| group.name == *name),
        None => (units.groups.len() == 1).then_some(0),
    };
    if found.is_none() {
        let names: Vec<String> = units.groups.iter().map(|group| format!("{:?}", group.name)).collect();
        let given = file.group.as_ref().map_or("(missing)".to_owned(), |name| format!("{name:?}"));
        let advice = "the analysis includes the impacts of units of one group";
        check.reject("breakage.group", given, format!("one of {}", names.join(", ")), advice);
    }
    found
}

/// Validates the entry `breakage`. `name` is the path of the case file; the path of the mesh is relative to its folder.
pub(super) fn validate(
    file: &BreakageFile,
    units: &Units,
    name: &str,
    check: &mut Checker,
) -> Option<BreakageSettings> {
    let before = check.count();
    let index = group_of(file, units, check)?;
    let group = &units.groups[index];
    if group.models.len() > 1 {
        let advice = "name another group in `breakage.group`";
        check.reject("breakage", format!("for the rocks {:?}", group.name), "for units of one shape", advice);
        return None;
    }
    let advice = "50 for a 1:50 model, 1 for units at prototype scale";
    check.number("breakage.scale", file.scale, at_least(1e-2).up_to(1e3), "", advice);
    check.number("breakage.friction", file.friction, at_least(0.0).up_to(10.0), "", "rough concrete has 0.6");
    validate_concrete("breakage.material", &file.material, check);
    if let Some(base) = &file.base {
        let path = |key: &str| format!("breakage.base.{key}");
        check.number(&path("density_kg_m3"), base.density_kg_m3, at_least(1.0).up_to(1e5), "kg/m3", "rock has 2650");
        check.number(
            &path("young_modulus_pa"),
            base.young_modulus_pa,
            at_least(1e3).up_to(1e13),
            "Pa",
            "rock has 5e10",
        );
        check.number(&path("poisson_ratio"), base.poisson_ratio, at_least(0.0).up_to(0.45), "", "rock has 0.25");
    }
    if let Some(duration) = file.duration_s {
        check.number("breakage.duration_s", duration, more_than(0.0).up_to(100.0), "s", "leave it out for the default");
    }
    let least = file.select.at_least;
    check.number(
        "breakage.select.at_least",
        least,
        at_least(0.0).up_to(f64::MAX),
        "",
        "0 includes the weakest impacts",
    );
    if let Some(cores) = file.cores.filter(|cores| !(1..=MOST_CORES).contains(cores)) {
        let allowed = format!("between 1 and {MOST_CORES}");
        check.reject(
            "breakage.cores",
            cores,
            allowed,
            "leave it out to compute as many impacts at the same time as there are cores",
        );
    }
    if file.select.worst == Some(0) {
        check.reject("breakage.select.worst", 0, "at least 1", "leave out `breakage` to skip the analysis");
    }
    let (mesh_file, mesh) = read_mesh(file, group.shape(), name, check)?;
    if check.count() > before {
        return None;
    }
    let settings = BreakageSettings {
        scale: file.scale,
        group: index,
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
    warn_of_coarse_mesh(&settings, check);
    Some(settings)
}

fn read_mesh(file: &BreakageFile, shape: &UnitShape, name: &str, check: &mut Checker) -> Option<(Vec<u8>, UnitMesh)> {
    let path = Path::new(name).parent().unwrap_or(Path::new("")).join(&file.mesh);
    let shown = format!("{:?}", path.display().to_string());
    let mut refuse = |allowed: String, advice: &str| {
        check.reject("breakage.mesh", &shown, allowed, advice);
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

/// Warns if the mean edge of the elements at prototype scale is longer than a quarter of the characteristic length for
/// opening cracks. Such elements do not resolve cracks.
fn warn_of_coarse_mesh(settings: &BreakageSettings, check: &mut Checker) {
    let [opening, _] = settings.characteristic_lengths();
    let edge = settings.mesh.edge() * settings.scale;
    if edge > 0.25 * opening {
        check.warn(format!(
            "breakage.mesh: mean edge length {} m at prototype scale; only edges of up to {} m, a quarter of \
             E G_f / f_t^2, resolve cracks: the results show whether units crack, but not how cracks run",
            as_text((edge * 1e3).round() * 1e-3),
            as_text((250.0 * opening).round() * 1e-3)
        ));
    }
}
