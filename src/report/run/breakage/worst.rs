//! The worst impact in pictures: units with their cracks, and the stress in the cut plane, at the impact and at the end.

use super::super::super::plot::{escape, short};
use super::super::folder::RunFolder;
use super::tables::partner;
use crate::report::fracture::pictures_of_impact_and_end;
use crate::simulation::breakage::results::{Breakage, Found, Outcome};
use crate::simulation::breakage::run::FOLDER;

/// Pictures of the impact that cracked its units most; words where there are none.
pub fn worst(breakage: &Breakage, run: &RunFolder) -> String {
    let Some(impact) = worst_impact(breakage) else { return String::new() };
    let words = format!(
        "<p><strong>The worst impact in pictures:</strong> unit {} on {} at {} s. {}</p>\n",
        impact.unit,
        if impact.partner.is_some() { partner(impact) } else { format!("the {}", partner(impact)) },
        short(impact.t_s, 3),
        if most(impact)[0] > 0.0 {
            "It has the largest area of cracks."
        } else {
            "Nothing cracked; it has the largest \u{3c3}\u{2081}."
        }
    );
    let pictures = match pictures_of_impact_and_end(&run.dir.join(FOLDER).join(&impact.name)) {
        Ok(Some(pictures)) => pictures,
        Ok(None) => "<p>There are no pictures of it: its surfaces are not in the folder.</p>\n".to_owned(),
        // The rest of the page does not depend on these files.
        Err(error) => format!("<p>There are no pictures of it: {}.</p>\n", escape(&error.to_string())),
    };
    words + &pictures
}

/// The impact with the largest area of cracks in one unit; where nothing cracked, with the largest sigma_1.
fn worst_impact(breakage: &Breakage) -> Option<&Outcome> {
    let computed = breakage.impacts.iter().filter(|impact| !impact.found.is_empty());
    // The hardest comes first, and stays among equals.
    computed.rev().max_by(|a, b| {
        let ([area_a, sigma_a], [area_b, sigma_b]) = (most(a), most(b));
        area_a.total_cmp(&area_b).then(sigma_a.total_cmp(&sigma_b))
    })
}

/// Largest area of cracks [m2] and largest first principal stress [Pa] of the units in an impact.
fn most(impact: &Outcome) -> [f64; 2] {
    // No area may have a minus sign.
    let largest = |of: fn(&Found) -> f64| impact.found.iter().map(of).fold(0.0, f64::max) + 0.0;
    [largest(|found| found.crack_area_m2), largest(|found| found.sigma_1_pa)]
}
