//! Report section of the breakage analysis: impacts that were re-run at prototype scale with breakable units.
//!
//! | file | content |
//! | --- | --- |
//! | `measure` | units of measurement for forces and areas |
//! | `tables` | table of the units, table of the impacts |
//! | `worst` | pictures of the worst impact |

mod measure;
mod tables;
mod worst;

use super::super::plot::{escape, short};
use super::folder::RunFolder;
use crate::simulation::breakage::results::{BROKEN, Breakage, UnitBreakage};

/// Returns the content of the report section; empty without a breakage analysis.
pub fn breakage(run: &RunFolder) -> String {
    let Some(breakage) = &run.breakage else { return String::new() };
    let mut html = introduction(breakage);
    html += &tables::units(breakage);
    html += &tables::impacts(breakage, run);
    html += &failures(breakage);
    html + &worst::worst(breakage, run)
}

/// Returns the introduction: scale, damage by movement and by breakage, and the definition of a broken unit.
fn introduction(breakage: &Breakage) -> String {
    let count = |is: fn(&UnitBreakage) -> bool| breakage.units.iter().filter(|unit| is(unit)).count();
    let (units, analysed) = (breakage.units.len(), count(|unit| unit.broken.is_some()));
    let size = if breakage.scale == 1.0 {
        "At the scale of the run".to_owned()
    } else {
        format!("At prototype scale, {} times the size of the run", short(breakage.scale, 3))
    };
    // The report mentions these units, because a deep crack may split a unit after the end of the fracture run.
    let cracked = count(|unit| unit.broken == Some(false) && unit.crack_area_m2 > Some(0.0));
    let cracked = match cracked {
        0 => String::new(),
        1 => " One other unit has cracks but is not broken.".to_owned(),
        more => format!(" {more} other units have cracks but are not broken."),
    };
    let rest = if analysed < units {
        format!(
            " Impacts of {analysed} of the {units} units were re-run at prototype scale; the other units count as not broken."
        )
    } else {
        String::new()
    };
    format!(
        "<p>{size}, {} % of the units are damaged by movement ({} of {units}) and {} % by breakage ({} of {units}).{cracked}{rest}</p>\n\
         <p>The hardest impacts were re-run at prototype scale with breakable units. Displacements are at the scale of the run; \
         forces, stresses and cracks are at prototype scale. A unit counts as broken when its heaviest piece has less than \
         {} % of its mass.</p>\n",
        short(100.0 * breakage.damaged_ratio, 0),
        count(|unit| unit.damaged),
        short(100.0 * breakage.broken_ratio, 0),
        count(|unit| unit.broken == Some(true)),
        short(100.0 * BROKEN, 0)
    )
}

/// Returns the list of the failed fracture runs with their errors, or an empty string.
fn failures(breakage: &Breakage) -> String {
    let failed = breakage.impacts.iter().filter_map(|impact| Some((&impact.name, impact.failure.as_ref()?)));
    let items: String =
        failed.map(|(name, why)| format!("<li><code>{}</code>: {}</li>\n", escape(name), escape(why))).collect();
    let words = "<p>The fracture runs of these impacts failed. Their effect on the units is not in the tables.</p>\n";
    if items.is_empty() { items } else { format!("{words}<ul>\n{items}</ul>\n") }
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;

    use super::*;
    use crate::case::RerunMethod;
    use crate::simulation::breakage::blow::Balance;
    use crate::simulation::breakage::results::{Found, Outcome};
    use crate::{output::Summary, report::run::write_report};

    fn unit(unit: usize, broken: Option<bool>) -> UnitBreakage {
        UnitBreakage {
            unit,
            displacement_m: 0.1,
            damaged: unit == 1,
            peak_force_n: 1.25e6,
            nominal_stress_pa: Some(2.5e6),
            sigma_1_pa: broken.map(|_| 4.5e6),
            crack_area_m2: broken.map(|_| 1.75),
            pieces: broken.map(|_| 3),
            heaviest_share: broken.map(|broken| if broken { 0.6 } else { 1.0 }),
            broken,
        }
    }

    fn impact(name: &str, failure: Option<&str>) -> Outcome {
        let found = Found {
            unit: 1,
            sigma_1_pa: 4.5e6,
            crack_area_m2: 1.75,
            pieces: 3,
            heaviest_share: 0.6,
            impulse_n_s: [0.0; 3],
        };
        Outcome {
            name: name.to_owned(),
            way: RerunMethod::ReEnact,
            unit: 1,
            partner: None,
            t_s: 12.345,
            approach_m_s: 0.5,
            peak_force_n: 10.0,
            prototype_force_n: 1.25e6,
            blow_s: 0.02,
            balance: Balance { mass_kg: [1.0; 2], momentum: [[0.0; 3]; 2], kinetic_j: [1.0; 2] },
            found: if failure.is_none() { vec![found] } else { Vec::new() },
            energy_residual_ratio: failure.is_none().then_some(1e-6),
            failure: failure.map(str::to_owned),
        }
    }

    fn page(dir: &Path) -> String {
        Summary::default().write(dir).unwrap();
        fs::read_to_string(write_report(dir).unwrap()).unwrap()
    }

    #[test]
    fn the_report_lists_the_broken_units() {
        let folder = tempfile::tempdir().unwrap();
        let breakage = Breakage {
            scale: 25.0,
            damaged_ratio: 1.0 / 3.0,
            broken_ratio: 1.0 / 3.0,
            units: vec![unit(1, Some(true)), unit(2, None), unit(3, Some(false))],
            impacts: vec![impact("impact-01-unit-01", None), impact("impact-02-unit-01", Some("a tetrahedron < 0"))],
        };
        breakage.write(folder.path()).unwrap();
        let report = folder.path().join("impacts/impact-01-unit-01");
        fs::create_dir_all(&report).unwrap();
        fs::write(report.join("report.html"), "").unwrap();
        let html = page(folder.path());
        let expected = [
            "<h2>Breakage of the units</h2>",
            "At prototype scale, 25 times the size of the run, 33 % of the units are damaged by movement (1 of 3) and 33 % by \
             breakage (1 of 3). One other unit has cracks but is not broken. Impacts of 2 of the 3 units",
            "<td>3</td><td class=\"yes\">yes</td></tr>",
            "not re-run",
            "Peak impact force [MN]",
            "<td>0.500</td><td>2.500</td>",
            "href=\"impacts/impact-01-unit-01/report.html\"",
            "<code>impact-02-unit-01</code>: a tetrahedron &lt; 0",
            "No pictures of this impact",
        ];
        for words in expected {
            assert!(html.contains(words), "{words} in\n{html}");
        }
        assert!(!html.contains("href=\"impacts/impact-02-unit-01"));
    }

    #[test]
    fn without_a_breakage_analysis_there_is_no_breakage_section() {
        let folder = tempfile::tempdir().unwrap();
        let html = page(folder.path());
        assert!(!html.contains("Breakage of the units") && !html.contains("breakage.csv"));
    }
}
