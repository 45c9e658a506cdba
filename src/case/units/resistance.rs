//! Looks up friction and restitution between two units, and between a unit and bed or mound.

use super::{Surroundings, materials};
use crate::case::file::ContactLawName;
use crate::case::reading::check::Checker;
use crate::rigid::Resistance;

/// Friction and restitution of the units.
pub(super) struct Resistances {
    /// Between two units.
    pub on_unit: Resistance,
    /// Between a unit and the bed.
    pub on_ground: Resistance,
    /// Between a unit and the mound.
    pub on_mound: Resistance,
}

/// Returns friction and restitution of the units. `material` is the index of their material.
pub(super) fn validate(material: Option<usize>, around: &Surroundings, check: &mut Checker) -> Option<Resistances> {
    let (unit, ground) = (material?, around.materials.ground?);
    let mound = around.materials.mound.unwrap_or(ground);
    let mut lookup = |a: usize, b: usize| {
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
    };
    let on_unit = lookup(unit, unit);
    let mut on = |surface: usize| if surface == unit { on_unit } else { lookup(unit, surface) };
    let on_ground = on(ground);
    let on_mound = if mound == ground { on_ground } else { on(mound) };
    Some(Resistances { on_unit: on_unit?, on_ground: on_ground?, on_mound: on_mound? })
}
