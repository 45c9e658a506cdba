//! Validates materials and the friction between them.

use crate::case::file::{FrictionFile, MaterialFile, MoundFile, PartFile};
use crate::case::flume::ground::GroundMaterials;
use crate::case::reading::check::{Checker, as_text, at_least, more_than};
use crate::case::reading::error::nearest;

const RESTITUTION_ADVICE: &str = "with 1, a collision keeps the normal speed; with 0.5, it halves this speed";

/// Largest number of materials in one case.
const MOST_MATERIALS: usize = 100;

/// Contact properties of a material; SI units.
#[derive(Debug, Clone, PartialEq)]
pub struct Material {
    /// Name in the case file.
    pub name: String,
    /// Young's modulus of the contacts [Pa].
    pub young_modulus: f64,
    /// Poisson's ratio [-].
    pub poisson_ratio: f64,
    /// Coefficient of restitution [-].
    pub restitution: f64,
    /// Measured stiffness of a contact between two bodies of this material [N/m], if given.
    pub contact_stiffness: Option<f64>,
}

/// Friction, rolling resistance and restitution between two materials.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrictionPair {
    /// Indices of the two materials in `Case::materials`, the smaller index first.
    pub between: [usize; 2],
    /// Static friction coefficient [-].
    pub coefficient: f64,
    /// Kinetic friction coefficient [-].
    pub kinetic: f64,
    /// Rolling resistance coefficient [-]; 0 for none.
    pub rolling: f64,
    /// Coefficient of restitution [-]; `None` if the smaller of the values of the two materials applies.
    pub restitution: Option<f64>,
}

/// Materials and friction of a case.
#[derive(Debug, Clone, PartialEq)]
pub struct Materials {
    /// The materials.
    pub list: Vec<Material>,
    /// Friction of each pair of materials in the file.
    pub friction: Vec<FrictionPair>,
    /// Material of the bed, an index into `list`; `None` if the file names no material or an unknown one.
    pub ground: Option<usize>,
    /// Material of the mound, an index into `list`; `None` if the file names no material of its own or an unknown one.
    pub mound: Option<usize>,
    /// Material of each part of the structure, an index into `list`; `None` if the part has that of the bed.
    pub parts: Vec<Option<usize>>,
}

impl Materials {
    /// Returns the materials of the ground.
    pub fn of_ground(&self) -> GroundMaterials<'_> {
        GroundMaterials { bed: self.ground, mound: self.mound, parts: &self.parts }
    }
}

/// Names of the materials of the ground in a case file.
#[derive(Debug, Clone, Copy, Default)]
pub struct GroundNames<'a> {
    /// Material of the bed.
    pub bed: Option<&'a str>,
    /// Material of the mound; `None` if it is that of the bed.
    pub mound: Option<&'a str>,
    /// Parts of the structure.
    pub parts: &'a [PartFile],
}

impl<'a> GroundNames<'a> {
    /// Collects the names of bed and mound.
    pub fn new(bed: Option<&'a str>, mound: Option<&'a MoundFile>, parts: &'a [PartFile]) -> Self {
        Self { bed, mound: mound.and_then(|mound| mound.material.as_deref()), parts }
    }
}

/// Validates materials and friction, and looks up the materials of the ground.
pub fn validate(
    materials: &[MaterialFile],
    friction: &[FrictionFile],
    ground: GroundNames,
    check: &mut Checker,
) -> Materials {
    let list = validate_materials(materials, check);
    let friction = validate_friction(friction, &list, check);
    let mound = ground.mound.and_then(|name| find(&list, name, "flume.mound.material", check));
    let of_part = |(index, part): (usize, &PartFile)| {
        part.material.as_ref().and_then(|name| find(&list, name, &format!("structure[{index}].material"), check))
    };
    let parts = ground.parts.iter().enumerate().map(of_part).collect();
    let ground = ground.bed.and_then(|name| find(&list, name, "flume.material", check));
    Materials { list, friction, ground, mound, parts }
}

/// Validates the materials. The result also has entries for invalid materials, so that indices follow the file.
fn validate_materials(file: &[MaterialFile], check: &mut Checker) -> Vec<Material> {
    if file.len() > MOST_MATERIALS {
        check.reject("materials", file.len(), format!("at most {MOST_MATERIALS} materials"), "remove some materials");
        return Vec::new();
    }
    for (index, material) in file.iter().enumerate() {
        let path = |key: &str| format!("materials[{index}].{key}");
        if material.name.trim().is_empty() {
            check.reject(&path("name"), "\"\"", "a name", "write e.g. \"mortar\"");
        }
        if file[..index].iter().any(|other| other.name == material.name) {
            check.reject(&path("name"), format!("{:?}", material.name), "different from the others", "rename one");
        }
        check.number(
            &path("young_modulus_pa"),
            material.young_modulus_pa,
            at_least(1e5).up_to(1e12),
            "Pa",
            "concrete has 3e10; about 1e8 is stiff enough in small-scale models and allows a longer time step",
        );
        check.number(
            &path("poisson_ratio"),
            material.poisson_ratio,
            more_than(-1.0).below(0.5),
            "",
            "concrete has 0.2",
        );
        check.number(&path("restitution"), material.restitution, more_than(0.0).up_to(1.0), "", RESTITUTION_ADVICE);
        if let Some(stiffness) = material.contact_stiffness_n_m {
            let advice = "write the contact force divided by the overlap of two bodies in contact";
            check.number(&path("contact_stiffness_n_m"), stiffness, at_least(1.0).up_to(1e12), "N/m", advice);
        }
    }
    let validated = |material: &MaterialFile| Material {
        name: material.name.clone(),
        young_modulus: material.young_modulus_pa,
        poisson_ratio: material.poisson_ratio,
        restitution: material.restitution,
        contact_stiffness: material.contact_stiffness_n_m,
    };
    file.iter().map(validated).collect()
}

/// Returns the index of the material `name`. Adds an error for the key `path` if there is no such material.
pub(super) fn find(materials: &[Material], name: &str, path: &str, check: &mut Checker) -> Option<usize> {
    let found = materials.iter().position(|material| material.name == name);
    if found.is_none() {
        let names: Vec<&str> = materials.iter().map(|material| material.name.as_str()).collect();
        let guess = nearest(name, names.iter().copied());
        let advice = match guess {
            Some(guess) => format!("did you mean \"{guess}\"?"),
            None => "add it to `materials`".to_owned(),
        };
        let allowed = if names.is_empty() { "a name in `materials`, which is empty".to_owned() } else { list(&names) };
        check.reject(path, format!("{name:?}"), allowed, advice);
    }
    found
}

fn list(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("{name:?}")).collect();
    format!("one of {}", quoted.join(", "))
}

/// Validates the friction entries. Returns one entry for each pair of known materials.
fn validate_friction(file: &[FrictionFile], materials: &[Material], check: &mut Checker) -> Vec<FrictionPair> {
    let mut pairs: Vec<FrictionPair> = Vec::new();
    // At most one entry per pair of materials.
    let most = MOST_MATERIALS * (MOST_MATERIALS + 1) / 2;
    if file.len() > most {
        check.reject("friction", file.len(), format!("at most {most} pairs"), "write each pair once");
        return pairs;
    }
    for (index, friction) in file.iter().enumerate() {
        let coefficient = friction.coefficient;
        check.number(
            &format!("friction[{index}].coefficient"),
            coefficient,
            at_least(0.0).up_to(2.0),
            "",
            "write the tangent of the angle at which sliding starts, e.g. 0.6",
        );
        let path = |side: usize| format!("friction[{index}].between[{side}]");
        let first = find(materials, &friction.between[0], &path(0), check);
        let second = find(materials, &friction.between[1], &path(1), check);
        let (Some(first), Some(second)) = (first, second) else { continue };
        let between = [first.min(second), first.max(second)];
        if let Some(other) = pairs.iter().find(|pair| pair.between == between) {
            check.reject(
                &format!("friction[{index}].between"),
                format!("{:?}", friction.between),
                format!(
                    "a pair that is listed only once (its first entry has the coefficient {})",
                    as_text(other.coefficient)
                ),
                "keep one of the two entries",
            );
            continue;
        }
        let kinetic = validate_pair(index, friction, check);
        let (rolling, restitution) = (friction.rolling_coefficient.unwrap_or(0.0), friction.restitution);
        pairs.push(FrictionPair { between, coefficient, kinetic, rolling, restitution });
    }
    pairs
}

/// Validates kinetic friction, rolling resistance and restitution of a pair. Returns the kinetic friction coefficient.
fn validate_pair(index: usize, file: &FrictionFile, check: &mut Checker) -> f64 {
    let path = |key: &str| format!("friction[{index}].{key}");
    let kinetic = file.kinetic_coefficient.unwrap_or(file.coefficient);
    let advice = "kinetic friction must not exceed static friction";
    check.number(&path("kinetic_coefficient"), kinetic, at_least(0.0).up_to(file.coefficient.max(0.0)), "", advice);
    if let Some(rolling) = file.rolling_coefficient {
        let advice = "write the tangent of the slope angle at which a ball begins to roll";
        check.number(&path("rolling_coefficient"), rolling, at_least(0.0).up_to(2.0), "", advice);
    }
    if let Some(restitution) = file.restitution {
        check.number(&path("restitution"), restitution, more_than(0.0).up_to(1.0), "", RESTITUTION_ADVICE);
    }
    kinetic
}

/// Returns the entry for the materials with indices `a` and `b`, if the list has one.
pub(super) fn pair(pairs: &[FrictionPair], a: usize, b: usize) -> Option<&FrictionPair> {
    pairs.iter().find(|pair| pair.between == [a.min(b), a.max(b)])
}
