//! Validates the parts of a flume case or dry test that are needed to place armour layers.

use std::path::Path;

use glam::DVec3;

use super::file::{ArmourFile, ArmourOrientation, CaseFile, DryFile, HeapFile, UnitGroupsFile};
use super::flume::domain::StillWater;
use super::flume::part::Part;
use super::flume::{ground, site::Site};
use super::reading::check::{Checker, at_least, more_than};
use super::reading::document::{Document, InputKind};
use super::reading::error::CaseErrors;
use super::units::contact::{self, Contact};
use super::units::group::UnitGroup;
use super::units::materials::{self, GroundNames, Material};
use super::units::{self, MAX_UNITS, Surroundings, Units};
use super::{dry_test, flume_case};
use crate::geometry::outline::polygon::Polygon;

/// Distance between the centres of neighbouring units before they fall, divided by the largest distance of the surface
/// of a unit from its centre [-]: the diameter of the sphere around a unit, and 1 % of room.
const APART: f64 = 2.02;

/// Armour layers on a slope; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Armour {
    /// x of the seaward and of the shoreward end of the layers [m].
    pub x: [f64; 2],
    /// Number of layers.
    pub layers: u32,
    /// Packing density [-]: number of units in all layers per slope area of D_n^2, with the nominal diameter D_n.
    pub packing_density: f64,
    /// Rotation of the units before they are lowered onto the slope.
    pub orientation: ArmourOrientation,
    /// Seed of the random rotations.
    pub seed: u64,
}

/// Armour layers of one group of units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Layers {
    /// Group of the units, an index into the groups of [`LayerJob::units`].
    pub group: usize,
    /// Extent and packing of the layers.
    pub armour: Armour,
}

/// A heap of one group of units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Heap {
    /// Group of the units, an index into the groups of [`LayerJob::units`].
    pub group: usize,
    /// Lower and upper corner of the box from which the units fall [m].
    pub bounds: [DVec3; 2],
    /// Number of units.
    pub count: usize,
    /// Seed of the random rotations.
    pub seed: u64,
}

/// Units that have to be placed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Placing {
    /// Layers on a slope.
    Layers(Layers),
    /// A heap.
    Heap(Heap),
}

impl Placing {
    /// Group of the units, an index into the groups of [`LayerJob::units`].
    pub fn group(&self) -> usize {
        match self {
            Self::Layers(layers) => layers.group,
            Self::Heap(heap) => heap.group,
        }
    }
}

/// Armour layers and heaps that `breakwater place` has to place.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerJob {
    /// Title of the case.
    pub title: String,
    /// Ground and boundaries of the area in which units stand.
    pub site: Site,
    /// The units. The groups of [`Self::placings`] have no members yet; the others are in their places.
    pub units: Units,
    /// Layers and heaps, in the order in which they are placed.
    pub placings: Vec<Placing>,
    /// Materials; other structs contain indices into this list.
    pub materials: Vec<Material>,
    /// Contact between units, and between units and the bed.
    pub contact: Contact,
    /// Gravitational acceleration, positive [m/s2].
    pub gravity: f64,
    /// Still water in which the layers settle at the end; `None` for a dry test.
    pub still_water: Option<StillWater>,
}

impl LayerJob {
    /// Reads a flume case or dry test and validates the parts that are needed to place armour layers.
    pub fn load(path: impl AsRef<Path>) -> Result<Self, CaseErrors> {
        Self::from_document(&Document::read(path.as_ref())?)
    }

    /// Like [`Self::load`], but takes the text of a case file; `name` is the path of the case file.
    pub fn from_str(text: &str, name: &str) -> Result<Self, CaseErrors> {
        Self::from_document(&Document::new(text, name)?)
    }

    /// Like [`Self::load`], but takes a document. A document that is not a dry test is read as a flume case.
    pub fn from_document(document: &Document) -> Result<Self, CaseErrors> {
        let (job, _) = match document.kind() {
            InputKind::DryTest => document.validate(validate_dry_test)?,
            _ => document.validate(validate_flume_case)?,
        };
        Ok(job)
    }

    /// Returns the points (x, z) of the slope under layers: both ends and the corner points between them [m].
    pub fn slope(&self, layers: &Layers) -> Vec<[f64; 2]> {
        let [x0, x1] = layers.armour.x;
        let sections: Vec<&Polygon> = self.site.parts.iter().filter_map(Part::section).collect();
        let level =
            |x: f64| sections.iter().filter_map(|section| section.top(x)).fold(self.site.profile.z(x), f64::max);
        let of_sections = sections.iter().flat_map(|section| section.points()).map(|point| point.x);
        let corners = self.site.profile.points().iter().map(|point| point[0]).chain(of_sections);
        let mut x: Vec<f64> = corners.filter(|x| *x > x0 && *x < x1).chain([x0, x1]).collect();
        x.sort_by(f64::total_cmp);
        x.dedup();
        x.into_iter().map(|x| [x, level(x)]).collect()
    }

    /// Returns the group of units of layers.
    pub fn group(&self, layers: &Layers) -> &UnitGroup {
        &self.units.groups[layers.group]
    }

    /// Returns the distance between the centres of neighbouring units in the box of a heap [m]: units of any
    /// orientation do not touch.
    pub fn pitch(&self, heap: &Heap) -> f64 {
        APART * self.units.groups[heap.group].reach()
    }

    /// Returns the numbers of units along the edges of the box of a heap.
    pub fn lattice(&self, heap: &Heap) -> [usize; 3] {
        let [low, high] = heap.bounds;
        ((high - low) / self.pitch(heap)).to_array().map(|count| count as usize)
    }

    /// Returns the slope area under layers, divided by D_n^2 [-], with the nominal diameter D_n of a unit.
    pub fn area(&self, layers: &Layers) -> f64 {
        let length: f64 = self.slope(layers).windows(2).map(|p| (p[1][0] - p[0][0]).hypot(p[1][1] - p[0][1])).sum();
        length * self.site.width / self.group(layers).nominal_diameter.powi(2)
    }

    /// Returns the number of units to be placed.
    pub fn count_of(&self, placing: &Placing) -> usize {
        match placing {
            Placing::Layers(layers) => self.count(layers),
            Placing::Heap(heap) => heap.count,
        }
    }

    /// Returns the number of units in layers.
    pub fn count(&self, layers: &Layers) -> usize {
        (layers.armour.packing_density * self.area(layers)).round() as usize
    }
}

fn validate_dry_test(file: &DryFile, document: &Document, check: &mut Checker) -> Option<LayerJob> {
    let ground = dry_test::validate_ground(file, &document.name, check);
    validate_job(&file.title, &file.units, &ground.surroundings(&document.name), file.gravity_m_s2, None, check)
}

fn validate_flume_case(file: &CaseFile, document: &Document, check: &mut Checker) -> Option<LayerJob> {
    let names = GroundNames::new(file.flume.material.as_deref(), file.flume.mound.as_ref(), &file.structure);
    let materials = materials::validate(&file.materials, &file.friction, names, check);
    let (flume, domain) = ground::validate(file, &document.name, materials.of_ground(), check);
    let (flume, domain) = (flume?, domain?);
    let contact = contact::validate(&file.contact, check);
    let Some(units) = &file.units else {
        check.reject("units", "(missing)", "given", "there is nothing to place without units");
        return None;
    };
    let site = domain.site(&flume);
    let around = flume_case::surroundings(file, &document.name, Some(&site), &materials, contact);
    let still_water = domain.still_water(&flume, file.fluid.density_kg_m3);
    validate_job(&file.title, units, &around, file.fluid.gravity_m_s2, still_water, check)
}

fn validate_job(
    title: &str,
    file: &UnitGroupsFile,
    around: &Surroundings,
    gravity: f64,
    still_water: Option<StillWater>,
    check: &mut Checker,
) -> Option<LayerJob> {
    let before = check.count();
    let (mut groups, mut placements, mut placings) = (Vec::new(), Vec::new(), Vec::new());
    for (index, group) in file.groups().iter().enumerate() {
        check.in_section(&file.path(index), |check| {
            let unplaced = units::validate_unplaced(group, file, index, around, check);
            match (&group.armour, &group.heap) {
                (None, None) => groups.extend(units::placed(group, unplaced, &mut placements, around, check)),
                (armour, heap) => {
                    if let Some(armour) = armour {
                        if group.rock.is_some() && armour.orientation == ArmourOrientation::Alternating {
                            let advice = "rocks have no upright position: leave the key out";
                            check.reject(".armour.orientation", "\"alternating\"", "\"random\" for rocks", advice);
                        }
                        let armour = around.site.and_then(|site| validate(armour, site, check));
                        placings.extend(armour.map(|armour| Placing::Layers(Layers { group: index, armour })));
                    }
                    if let Some(heap) = heap {
                        if armour.is_some() {
                            check.reject(".heap", "given", "left out with `armour`", "keep one of the two keys");
                        }
                        let heap = around.site.and_then(|site| validate_heap(heap, index, site, check));
                        placings.extend(heap.map(Placing::Heap));
                    }
                    groups.extend(unplaced);
                }
            }
        });
    }
    if check.count() == before && placings.is_empty() {
        let advice = "write \"armour\": { \"x_m\": [from, to], \"packing_density\": 1.04 }, or a `heap`";
        check.reject(&format!("{}.armour", file.path(0)), "(missing)", "the armour layers to place", advice);
    }
    if check.count() > before {
        return None;
    }
    let (title, site, materials) = (title.to_owned(), around.site?.clone(), around.materials.list.clone());
    let units = units::with_ground(groups, placements, around, check)?;
    let job = LayerJob { title, site, units, placings, materials, contact: around.contact, gravity, still_water };
    for placing in &job.placings {
        let (path, count) = (file.path(placing.group()), job.count_of(placing));
        match placing {
            Placing::Layers(_) if !(1..=MAX_UNITS as usize).contains(&count) => {
                let advice = "change the length of the layers or the packing density";
                let allowed = format!("1 to {MAX_UNITS} units");
                check.reject(&format!("{path}.armour"), format!("{count} units"), allowed, advice);
            }
            Placing::Heap(heap) => {
                let most = job.lattice(heap).iter().product::<usize>().min(MAX_UNITS as usize);
                if !(1..=most).contains(&count) {
                    let pitch = job.pitch(heap);
                    let advice =
                        format!("the box has room for a unit every {pitch:.3} m along each edge: make it larger");
                    check.reject(&format!("{path}.heap.count"), count, format!("1 to {most}"), advice);
                }
            }
            Placing::Layers(_) => (),
        }
    }
    (check.count() == before).then_some(job)
}

fn validate(file: &ArmourFile, site: &Site, check: &mut Checker) -> Option<Armour> {
    let before = check.count();
    let [start, end] = site.x;
    let [x0, x1] = file.x_m;
    let advice = "the layers must lie inside the domain";
    check.number(".armour.x_m[0]", x0, at_least(start).below(end), "m", advice);
    check.number(".armour.x_m[1]", x1, more_than(x0).up_to(end), "m", advice);
    if !(1..=10).contains(&file.layers) {
        check.reject(".armour.layers", file.layers, "1 to 10", "two layers are usual");
    }
    let advice = "usual for two layers: Tetrapods 1.04, Dolosse 0.83, cubes 1.17";
    check.number(".armour.packing_density", file.packing_density, more_than(0.0).up_to(5.0), "", advice);
    let is_below = |part: &&Part| part.as_body().is_some() && part.x()[0] < x1 && part.x()[1] > x0;
    if let Some(part) = site.parts.iter().find(is_below) {
        let allowed = format!("clear of {:?} along x", part.name);
        let advice = "layers lie on the bed and on sections across the flume; write `poses` on other parts";
        check.reject(".armour.x_m", format!("[{x0}, {x1}]"), allowed, advice);
    }
    let ArmourFile { layers, packing_density, orientation, seed, .. } = *file;
    (check.count() == before).then_some(Armour { x: file.x_m, layers, packing_density, orientation, seed })
}

fn validate_heap(file: &HeapFile, group: usize, site: &Site, check: &mut Checker) -> Option<Heap> {
    let before = check.count();
    let HeapFile { low_m, high_m, count, seed } = *file;
    let advice = "the box must lie inside the domain";
    let allowed = [site.x, [0.0, site.width], [f64::NEG_INFINITY, f64::INFINITY]];
    for (axis, [first, last]) in allowed.into_iter().enumerate() {
        check.number(&format!(".heap.low_m[{axis}]"), low_m[axis], at_least(first).below(last), "m", advice);
        check.number(&format!(".heap.high_m[{axis}]"), high_m[axis], more_than(low_m[axis]).up_to(last), "m", advice);
    }
    let bounds = [low_m, high_m].map(DVec3::from_array);
    (check.count() == before).then_some(Heap { group, bounds, count: count as usize, seed })
}
