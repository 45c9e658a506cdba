//! Porous parts of a structure: rubble, gravel or sand through which water flows.

use super::Room;
use crate::case::file::{DragSource, PorousFile};
use crate::case::flume::part::Part;
use crate::case::reading::check::{Checker, as_text, at_least, lower_limit, more_than};
use crate::sph::terms::porous::Medium;

/// D_n50 / D50 of quarry stone [-] (CIRIA, CUR & CETMEF 2007, The Rock Manual, section 3.4.3).
const NOMINAL: f64 = 0.84;
/// Range of the porosity of the media from which the coefficients come [-] (van Gent 1995; Jensen et al. 2014).
const MEASURED_POROSITY: [f64; 2] = [0.35, 0.50];
/// Range of the diameter of these media [m].
const MEASURED_DIAMETER: [f64; 2] = [0.002, 0.062];
/// Smallest thickness of a porous part, divided by the particle spacing [-]: its porosity changes over a smoothing
/// length on either side of its surface.
const THINNEST: f64 = 4.0;

/// Returns the coefficients alpha and beta of a source [-].
fn drag(source: DragSource) -> [f64; 2] {
    match source {
        DragSource::Jensen2014 => [500.0, 2.0],
        DragSource::VanGent1995 => [1000.0, 1.1],
        DragSource::Liu1999 => [200.0, 1.1],
    }
}

/// Validates a porous medium.
pub(super) fn validate(file: &PorousFile, check: &mut Checker) -> Option<Medium> {
    let before = check.count();
    let advice = "rubble has a porosity of 0.35 to 0.5";
    check.number(".porosity", file.porosity, at_least(0.05).below(1.0), "", advice);
    let size = more_than(1e-5).up_to(10.0);
    let diameter = match (file.d50_m, file.d_n50_m) {
        (Some(d), None) => {
            check.number(".d50_m", d, size, "m", "write the median diameter of the stones in metres");
            d
        }
        (None, Some(d)) => {
            check.number(".d_n50_m", d, size, "m", "write the nominal diameter of the stones in metres");
            d / NOMINAL
        }
        (given, _) => {
            let given = if given.is_some() { "both" } else { "neither" };
            check.reject(
                ".",
                format!("{given} of `d50_m` and `d_n50_m`"),
                "exactly one of them",
                "write the size of the stones",
            );
            return None;
        }
    };
    let [alpha, beta] = drag(file.coefficients);
    let (alpha, beta) = (file.alpha.unwrap_or(alpha), file.beta.unwrap_or(beta));
    check.number(".alpha", alpha, at_least(0.0).up_to(1e5), "", "200 to 1000 have been measured");
    check.number(".beta", beta, at_least(0.0).up_to(100.0), "", "1.1 to 2 have been measured");
    check.number(".added_mass", file.added_mass, at_least(0.0).up_to(10.0), "", "van Gent (1995) found 0.34");
    let keulegan_carpenter = file.keulegan_carpenter.unwrap_or(f64::INFINITY);
    if let Some(number) = file.keulegan_carpenter {
        check.number(".keulegan_carpenter", number, more_than(0.0).up_to(1e9), "", "leave the key out for steady flow");
    }
    if check.count() > before {
        return None;
    }
    let medium = Medium { porosity: file.porosity, diameter, alpha, beta, keulegan_carpenter, gamma: file.added_mass };
    for (what, value, [low, high], unit) in
        [("porosity", file.porosity, MEASURED_POROSITY, ""), ("D50", diameter, MEASURED_DIAMETER, " m")]
    {
        if !(low..=high).contains(&value) {
            let key = check.path(".");
            check.warn(format!(
                "{key}: a {what} of {}{unit} is outside {} to {}{unit}, where the drag coefficients were \
                 measured",
                as_text(value),
                as_text(low),
                as_text(high)
            ));
        }
    }
    Some(medium)
}

/// Checks the places of the porous parts.
pub(super) fn check_places(parts: &[Part], room: &Room, check: &mut Checker) {
    let Some(dp) = room.dp else { return };
    for (index, part) in parts.iter().enumerate().filter(|(_, part)| part.medium().is_some()) {
        let key = format!("structure[{index}]");
        let [low, high] = part.surface().bounds(room.width.unwrap_or(0.0));
        let given = |axis: usize| format!("{} to {} m", as_text(low[axis]), as_text(high[axis]));
        if high.x <= room.x[0] || low.x >= room.x[1] {
            let allowed = format!("partly within `domain.x_m`, {} to {} m", as_text(room.x[0]), as_text(room.x[1]));
            check.reject(&key, given(0), allowed, "move the part, or remove it");
        }
        let across = if part.polygon().is_some() { f64::INFINITY } else { high.y - low.y };
        let thinnest = (high.x - low.x).min(high.z - low.z).min(across);
        if thinnest < THINNEST * dp {
            check.reject(
                &key,
                format!("{:?}, {} m thick", part.name, as_text(thinnest)),
                format!("at least {} m thick, {THINNEST} particle spacings", lower_limit(THINNEST * dp)),
                format!("make the part thicker, or write `domain.dp_m` of at most {} m", as_text(thinnest / THINNEST)),
            );
        }
    }
}
