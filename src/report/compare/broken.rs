//! Lists the broken units of a run.

use super::super::plot::short;
use crate::simulation::breakage::results::{Breakage, UnitBreakage};

/// Broken, unbroken and other units of a run by their numbers.
pub fn in_words(breakage: &Breakage) -> String {
    let those = |broken: Option<bool>| -> Vec<&UnitBreakage> {
        breakage.units.iter().filter(|unit| unit.broken == broken).collect()
    };
    let told = |what: &str, units: Vec<&UnitBreakage>| match units.as_slice() {
        [] => format!("no unit {what}"),
        [unit] => format!("unit {} {what}", unit.unit),
        units => {
            let numbers: Vec<String> = units.iter().map(|unit| unit.unit.to_string()).collect();
            format!("units {} {what}", numbers.join(", "))
        }
    };
    let mut words =
        format!("in a prototype {} times as large, {}", short(breakage.scale, 3), told("broke", those(Some(true))));
    let unbroken = those(Some(false));
    if !unbroken.is_empty() {
        words += &format!("; {}", told("did not break", unbroken));
    }
    let others = those(None).len();
    if others > 0 {
        words += &format!("; {others} of {} not analysed, counted as not broken", breakage.units.len());
    }
    words + "."
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_are_told_by_their_numbers() {
        let unit = |(index, broken): (usize, &Option<bool>)| UnitBreakage {
            unit: index + 1,
            displacement_m: 0.1,
            damaged: false,
            peak_force_n: 0.0,
            nominal_stress_pa: None,
            sigma_1_pa: None,
            crack_area_m2: None,
            pieces: None,
            heaviest_share: None,
            broken: *broken,
        };
        let told = |broken: &[Option<bool>]| {
            let units = broken.iter().enumerate().map(unit).collect();
            in_words(&Breakage { scale: 50.0, damaged_ratio: 0.0, broken_ratio: 0.0, units, impacts: Vec::new() })
        };
        assert_eq!(
            told(&[Some(true), None, Some(false), Some(true)]),
            "in a prototype 50 times as large, units 1, 4 broke; unit 3 did not break; 1 of 4 not analysed, \
             counted as not broken."
        );
        assert_eq!(told(&[Some(false)]), "in a prototype 50 times as large, no unit broke; unit 1 did not break.");
    }
}
