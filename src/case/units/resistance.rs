//! Looks up friction and restitution of all pairs of surfaces that can touch.

use super::{Surroundings, UnitGroup, materials};
use crate::case::file::ContactLawName;
use crate::case::reading::check::Checker;
use crate::rigid::{MaterialPair, Resistance};

/// Returns friction and restitution of each pair of materials that can touch. `ground` lists the materials of bed and
/// structure. Fixed units touch only units that move.
pub(super) fn validate(
    groups: &[UnitGroup],
    ground: &[usize],
    around: &Surroundings,
    check: &mut Checker,
) -> Option<Vec<MaterialPair>> {
    let mut between: Vec<[usize; 2]> = Vec::new();
    for moving in groups.iter().filter(|group| !group.is_fixed) {
        for other in groups.iter().map(|group| group.material).chain(ground.iter().copied()) {
            let pair = [moving.material.min(other), moving.material.max(other)];
            if !between.contains(&pair) {
                between.push(pair);
            }
        }
    }
    // All pairs are looked up, so that the user sees all missing ones at once.
    let found: Vec<Option<MaterialPair>> = between
        .into_iter()
        .map(|between| Some(MaterialPair { between, resistance: lookup(between, around, check)? }))
        .collect();
    found.into_iter().collect()
}

fn lookup([a, b]: [usize; 2], around: &Surroundings, check: &mut Checker) -> Option<Resistance> {
    let found = materials::pair(&around.materials.friction, a, b);
    let (a, b) = (&around.materials.list[a], &around.materials.list[b]);
    if found.is_none() {
        let (a, b) = (&a.name, &b.name);
        check.reject(
            "friction",
            format!("no entry for {a:?} on {b:?}"),
            "complete for the pairs that can touch",
            format!("add {{ \"between\": [{a:?}, {b:?}], \"coefficient\": ... }}"),
        );
    }
    for material in [a, b] {
        if around.contact.law == ContactLawName::Linear && material.contact_stiffness.is_none() {
            check.reject(
                "materials",
                format!("no `contact_stiffness_n_m` of {:?}", material.name),
                "given for each material with the linear contact law",
                "add the measured stiffness, or use \"hertz_mindlin\"",
            );
        }
    }
    // A contact is two springs in series, one for each body. The measured contact has two bodies of the same
    // material, so the spring of each body is twice as stiff as the measured contact.
    let stiffness = a.contact_stiffness.zip(b.contact_stiffness).map(|(a, b)| 2.0 * a * b / (a + b));
    found.map(|pair| Resistance {
        static_friction: pair.coefficient,
        kinetic_friction: pair.kinetic,
        rolling: pair.rolling,
        restitution: pair.restitution,
        stiffness,
    })
}
