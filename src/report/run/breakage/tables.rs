//! Tables of the units and of the re-run impacts in the breakage section of the report.

use super::super::super::plot::{escape, short};
use super::super::folder::RunFolder;
use super::measure::Measure;
use crate::case::RerunMethod;
use crate::simulation::breakage::froude::Froude;
use crate::simulation::breakage::results::{Breakage, Found, Outcome, UnitBreakage};
use crate::simulation::breakage::run::FOLDER;

/// A smaller residual of the energy balance is shown as "below 0.01" [%].
const LEAST_RESIDUAL: f64 = 0.01;

/// Formats a stress [Pa] in megapascals.
fn megapascals(stress: f64) -> String {
    format!("{:.2}", stress * 1e-6 + 0.0)
}

/// Table of the units: displacement, peak impact force, stresses and breakage.
pub fn units(breakage: &Breakage) -> String {
    let force = Measure::of_forces(breakage.units.iter().map(|unit| unit.peak_force_n));
    let area = Measure::of_areas(breakage.units.iter().filter_map(|unit| unit.crack_area_m2));
    let row = |unit: &UnitBreakage| {
        let damaged = if unit.damaged { "<td class=\"yes\">yes</td>" } else { "<td>no</td>" };
        let nominal = unit.nominal_stress_pa.map_or("\u{2013}".to_owned(), megapascals);
        let found = match (unit.sigma_1_pa, unit.crack_area_m2, unit.pieces, unit.broken) {
            (Some(sigma_1), Some(cracks), Some(pieces), Some(broken)) => {
                let broken = if broken { "<td class=\"yes\">yes</td>" } else { "<td>no</td>" };
                format!("<td>{}</td><td>{}</td><td>{pieces}</td>{broken}", megapascals(sigma_1), area.show(cracks))
            }
            _ => "<td colspan=\"4\">not re-run</td>".to_owned(),
        };
        format!(
            "<tr><td>{}</td><td>{:.3}</td>{damaged}<td>{}</td><td>{nominal}</td>{found}</tr>\n",
            unit.unit,
            unit.displacement_m,
            force.show(unit.peak_force_n)
        )
    };
    let rows: String = breakage.units.iter().map(row).collect();
    let count = |is: fn(&UnitBreakage) -> bool| breakage.units.iter().filter(|unit| is(unit)).count();
    format!(
        "<div class=\"scroll\"><table>\n<thead><tr><th>Unit</th><th>Displace&shy;ment [m]</th><th>Damaged by movement</th>\
         <th>Peak impact force [{}]</th><th>Nominal stress [MPa]</th><th>\u{3c3}\u{2081} [MPa]</th><th>Crack area [{}]</th>\
         <th>Pieces</th><th>Broken</th></tr></thead>\n<tbody>\n{rows}\
         <tr class=\"sum\"><td>All</td><td></td><td>{} of {units}</td><td colspan=\"5\"></td><td>{} of {units}</td></tr>\n\
         </tbody></table></div>\n\
         <figcaption>Peak impact force: the largest force of all recorded impacts, from Hertz's law. Nominal stress: \
         the largest stress of all recorded impacts, from beam theory. \u{3c3}\u{2081} (first principal stress), crack \
         area and number of pieces are the largest values in the fracture runs of the unit.</figcaption>\n",
        force.name,
        area.name,
        count(|unit| unit.damaged),
        count(|unit| unit.broken == Some(true)),
        units = breakage.units.len()
    )
}

/// Table of the impacts that were re-run at prototype scale.
pub fn impacts(breakage: &Breakage, run: &RunFolder) -> String {
    if breakage.impacts.is_empty() {
        let words = "no impact meets the criteria in <code>breakage.select</code>";
        return format!("<p>No impact was re-run, because {words}.</p>\n");
    }
    let found = || breakage.impacts.iter().flat_map(|impact| &impact.found);
    let area = Measure::of_areas(found().map(|found| found.crack_area_m2));
    let prototype = Froude { scale: breakage.scale }.velocity();
    let row = |impact: &Outcome| {
        let results = if impact.failure.is_some() {
            "<td colspan=\"4\">not computed</td>".to_owned()
        } else {
            let both_units = |show: &dyn Fn(&Found) -> String| {
                impact.found.iter().map(show).collect::<Vec<_>>().join("&nbsp;|&nbsp;")
            };
            format!(
                "<td>{}</td><td>{}</td><td>{}</td><td>{}</td>",
                both_units(&|found| megapascals(found.sigma_1_pa)),
                both_units(&|found| area.show(found.crack_area_m2)),
                both_units(&|found| found.pieces.to_string()),
                impact.energy_residual_ratio.map_or("\u{2013}".to_owned(), percent)
            )
        };
        format!(
            "<tr><td>{}</td><td>{}</td><td>{:.3}</td><td>{:.3}</td><td>{:.3}</td><td class=\"words\">{}</td>{results}<td>{}</td></tr>\n",
            impact.unit,
            partner(impact).replace(' ', "&nbsp;"),
            impact.t_s,
            impact.approach_m_s,
            impact.approach_m_s * prototype,
            method(impact.way),
            link(impact, run)
        )
        .replace(">-", ">\u{2212}")
    };
    let rows: String = breakage.impacts.iter().map(row).collect();
    format!(
        "<p>Impacts that were re-run at prototype scale, the hardest first:</p>\n\
         <div class=\"scroll\"><table>\n<thead><tr><th>Unit</th><th>Hits</th><th>Flume time [s]</th><th>Approach velocity, run [m/s]</th>\
         <th>Approach velocity, prototype [m/s]</th><th class=\"words\">Method</th><th>\u{3c3}\u{2081} [MPa]</th><th>Crack area [{}]</th><th>Pieces</th>\
         <th>Energy residual [%]</th><th>Details</th></tr></thead>\n<tbody>\n{rows}</tbody></table></div>\n\
         <figcaption>Approach velocities scale with the square root of length (Froude). Method \"collision\": both \
         bodies start at their positions and velocities just before the impact and collide again. Method \"recorded \
         forces\": the recorded forces of contacts and water act on the unit, without other bodies. Two values in a \
         cell: the first is for the unit, the second for the unit that it hit. Energy residual: error of the energy \
         balance, relative to the largest kinetic energy.</figcaption>\n",
        area.name
    )
}

/// Returns the name of the body that the unit hit, for the table.
pub fn partner(impact: &Outcome) -> String {
    impact.partner.map_or("bed or wall".to_owned(), |unit| format!("unit {unit}"))
}

fn method(way: RerunMethod) -> &'static str {
    match way {
        RerunMethod::LoadHistory => "recorded forces",
        RerunMethod::ReEnact | RerunMethod::Both => "collision",
    }
}

fn percent(ratio: f64) -> String {
    let percent = 100.0 * ratio;
    if percent < LEAST_RESIDUAL { format!("below {LEAST_RESIDUAL}") } else { short(percent, 2) }
}

/// Returns a link to the report of an impact, or a dash if the report does not exist.
fn link(impact: &Outcome, run: &RunFolder) -> String {
    let path = format!("{FOLDER}/{}/report.html", impact.name);
    if run.has(&path) { format!("<a href=\"{}\">report</a>", escape(&path)) } else { "\u{2013}".to_owned() }
}
