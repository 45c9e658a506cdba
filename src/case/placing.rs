//! Validates the parts of a flume case or dry test that the placing of armour layers needs.

use std::path::Path;

use super::check::{Checker, above, from};
use super::dry::{self, DryCase};
use super::error::CaseErrors;
use super::file::{ArmourFile, ArmourOrientation, CaseFile, DryFile, UnitsFile};
use super::materials::{self, Material};
use super::parse::parse;
use super::run::{self, Contact};
use super::site::Site;
use super::units::{self, MOST_UNITS, Surroundings, Units};
use super::validate::read;
use super::{domain, flume};

/// Armour layers on a slope; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Armour {
    /// Seaward and shoreward end [m].
    pub x: [f64; 2],
    /// Number of layers.
    pub layers: u32,
    /// Number of units in all layers per area D_n^2 of the slope [-].
    pub packing_density: f64,
    /// Orientation of the units.
    pub orientation: ArmourOrientation,
    /// Seed of the random numbers.
    pub seed: u64,
}

/// Armour layers to be placed.
#[derive(Debug, Clone, PartialEq)]
pub struct PlacementJob {
    /// Title of the case.
    pub title: String,
    /// Ground and walls.
    pub site: Site,
    /// The units, not yet placed.
    pub units: Units,
    /// The layers.
    pub armour: Armour,
    /// Elastic constants.
    pub materials: Vec<Material>,
    /// Contact parameters.
    pub contact: Contact,
    /// Acceleration of gravity [m/s2].
    pub gravity: f64,
}

impl PlacementJob {
    /// Reads a flume case or dry test and validates what the placing needs.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, CaseErrors> {
        let (text, name) = read(path.as_ref())?;
        Self::from_str(&text, &name)
    }

    /// Like [`Self::load`], from the text of a case file; `name` is its name in messages.
    pub fn from_str(text: &str, name: &str) -> Result<Self, CaseErrors> {
        let mut check = Checker::new(name);
        let job = if DryCase::is_one(text) {
            validate_dry_test(&parse::<DryFile>(text, name)?, name, &mut check)
        } else {
            validate_flume_case(&parse::<CaseFile>(text, name)?, name, &mut check)
        };
        match job {
            Some(job) if check.count() == 0 => Ok(job),
            _ => Err(check.into_errors()),
        }
    }

    /// Returns the corners (x, z) of the slope under the layers, including both ends [m].
    pub fn slope(&self) -> Vec<[f64; 2]> {
        let [x0, x1] = self.armour.x;
        let inner = self.site.profile.points().iter().copied().filter(|p| p[0] > x0 && p[0] < x1);
        let end = |x: f64| [x, self.site.profile.z(x)];
        [end(x0)].into_iter().chain(inner).chain([end(x1)]).collect()
    }

    /// Returns the slope area under the layers over D_n^2 [-].
    pub fn area(&self) -> f64 {
        let length: f64 = self.slope().windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1])).sum();
        length * self.site.width / self.units.shape.nominal_diameter().powi(2)
    }

    /// Returns the number of units in all layers.
    pub fn count(&self) -> usize {
        (self.armour.packing_density * self.area()).round() as usize
    }
}

fn validate_dry_test(file: &DryFile, name: &str, check: &mut Checker) -> Option<PlacementJob> {
    let materials = materials::validate_materials(&file.materials, check);
    let ground = materials::find(&materials, &file.flume.material, "flume.material", check);
    let site = dry::validate_site(file, name, ground, check);
    let contact = run::validate_contact(&file.contact, check);
    let friction = materials::validate_friction(&file.friction, &materials, check);
    let around = Surroundings {
        name,
        site: site.as_ref(),
        dp: None,
        obstacles: 0,
        materials: &materials,
        friction: &friction,
        ground_material: ground,
        ground_key: "flume.material",
        ground_named: true,
        rho0: None,
        rounding_share: contact.rounding_share,
        law: contact.law,
    };
    validate_job(&file.title, &file.units, &around, contact, file.gravity_m_s2, check)
}

fn validate_flume_case(file: &CaseFile, name: &str, check: &mut Checker) -> Option<PlacementJob> {
    let materials = materials::validate_materials(&file.materials, check);
    let key = "flume.material";
    let ground = file.flume.material.as_deref().and_then(|name| materials::find(&materials, name, key, check));
    let flume = flume::validate(&file.flume, ground, check)?;
    let domain = domain::validate(&file.domain, Some(&flume), file.numerics.smoothing_factor, check)?;
    let contact = run::validate_contact(&file.contact, check);
    let friction = materials::validate_friction(&file.friction, &materials, check);
    let Some(units) = &file.units else {
        check.refuse("units", "(missing)", "given", "there is nothing to place without units");
        return None;
    };
    let around = Surroundings {
        name,
        site: Some(&domain.site(&flume)),
        dp: Some(file.domain.dp_m),
        obstacles: file.domain.obstacles.len(),
        materials: &materials,
        friction: &friction,
        ground_material: ground,
        ground_key: key,
        ground_named: file.flume.material.is_some(),
        rho0: Some(file.fluid.density_kg_m3),
        rounding_share: contact.rounding_share,
        law: contact.law,
    };
    validate_job(&file.title, units, &around, contact, file.fluid.gravity_m_s2, check)
}

fn validate_job(
    title: &str,
    file: &UnitsFile,
    around: &Surroundings,
    contact: Contact,
    gravity: f64,
    check: &mut Checker,
) -> Option<PlacementJob> {
    let units = units::validate_unplaced(file, around, check);
    let Some(armour) = &file.armour else {
        let advice = "write \"armour\": { \"x_m\": [from, to], \"packing_density\": 1.04 }";
        check.refuse("units.armour", "(missing)", "the armour layers to place", advice);
        return None;
    };
    let armour = validate(armour, around.site?, check)?;
    let (title, site, materials) = (title.to_owned(), around.site?.clone(), around.materials.to_vec());
    let job = PlacementJob { title, site, units: units?, armour, materials, contact, gravity };
    let count = job.count();
    if !(1..=MOST_UNITS as usize).contains(&count) {
        let advice = "change the length of the layers or the packing density";
        check.refuse("units.armour", format!("{count} units"), format!("1 to {MOST_UNITS} units"), advice);
    }
    Some(job)
}

fn validate(file: &ArmourFile, site: &Site, check: &mut Checker) -> Option<Armour> {
    let before = check.count();
    let [start, end] = site.x;
    let [x0, x1] = file.x_m;
    let advice = "the layers must lie inside the domain";
    check.number("units.armour.x_m[0]", x0, from(start).below(end), "m", advice);
    check.number("units.armour.x_m[1]", x1, above(x0).up_to(end), "m", advice);
    if !(1..=10).contains(&file.layers) {
        check.refuse("units.armour.layers", file.layers, "1 to 10", "two layers are usual");
    }
    let advice = "usual for two layers: Tetrapods 1.04, Dolosse 0.83, cubes 1.17";
    check.number("units.armour.packing_density", file.packing_density, above(0.0).up_to(5.0), "", advice);
    let ArmourFile { layers, packing_density, orientation, seed, .. } = *file;
    (check.count() == before).then_some(Armour { x: file.x_m, layers, packing_density, orientation, seed })
}
