//! Pictures of the worst impact: cracked units and stress in the section plane, at the impact and at the end.

use super::super::super::plot::{escape, short};
use super::super::folder::RunFolder;
use super::tables::partner;
use crate::report::fracture::pictures_of_impact_and_end;
use crate::simulation::breakage::results::{Breakage, Found, Outcome};
use crate::simulation::breakage::run::FOLDER;

/// Returns the pictures of the worst impact, or a note if its folder has no surface files.
pub fn worst(breakage: &Breakage, run: &RunFolder) -> String {
    let Some(impact) = worst_impact(breakage) else { return String::new() };
    let words = format!(
        "<p><strong>Worst impact:</strong> unit {} hits {} at {} s. {}</p>\n",
        impact.unit,
        if impact.partner.is_some() { partner(impact) } else { format!("the {}", partner(impact)) },
        short(impact.t_s, 3),
        if largest_area_and_stress(impact)[0] > 0.0 {
            "This impact has the largest crack area in one unit."
        } else {
            "No unit cracked; this impact has the largest \u{3c3}\u{2081}."
        }
    );
    let pictures = match pictures_of_impact_and_end(&run.dir.join(FOLDER).join(&impact.name)) {
        Ok(Some(pictures)) => pictures,
        Ok(None) => "<p>No pictures of this impact: its folder has no surface files.</p>\n".to_owned(),
        // The report shows the error and continues, because its other sections do not need these files.
        Err(error) => format!("<p>No pictures of this impact: {}.</p>\n", escape(&error.to_string())),
    };
    words + &pictures
}

/// Returns the impact with the largest crack area in one unit, or with the largest sigma_1 if no unit cracked.
fn worst_impact(breakage: &Breakage) -> Option<&Outcome> {
    let computed = breakage.impacts.iter().filter(|impact| !impact.found.is_empty());
    // The order is reversed, because the hardest impact is first and `max_by` returns the last of equal impacts.
    computed.rev().max_by(|a, b| {
        let ([area_a, sigma_a], [area_b, sigma_b]) = (largest_area_and_stress(a), largest_area_and_stress(b));
        area_a.total_cmp(&area_b).then(sigma_a.total_cmp(&sigma_b))
    })
}

/// Returns the largest crack area [m2] and the largest first principal stress [Pa] of the units in an impact.
fn largest_area_and_stress(impact: &Outcome) -> [f64; 2] {
    // Adding zero removes the sign of a negative zero.
    let largest = |quantity: fn(&Found) -> f64| impact.found.iter().map(quantity).fold(0.0, f64::max) + 0.0;
    [largest(|found| found.crack_area_m2), largest(|found| found.sigma_1_pa)]
}
