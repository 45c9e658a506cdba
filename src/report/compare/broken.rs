//! Describes in words which units of a run broke.

use super::super::plot::short;
use crate::simulation::breakage::results::{Breakage, UnitBreakage};

/// Lists the numbers of the broken and unbroken units of a run, and the number of units that were not analysed.
pub fn in_words(breakage: &Breakage) -> String {
    let units_with = |broken: Option<bool>| -> Vec<&UnitBreakage> {
        breakage.units.iter().filter(|unit| unit.broken == broken).collect()
    };
    let listed = |what: &str, units: Vec<&UnitBreakage>| match units.as_slice() {
        [] => format!("no unit {what}"),
        [unit] => format!("unit {} {what}", unit.unit),
        units => {
            let numbers: Vec<String> = units.iter().map(|unit| unit.unit.to_string()).collect();
            format!("units {} {what}", numbers.join(", "))
        }
    };
    let broken = listed("broke", units_with(Some(true)));
    let mut words = format!("in a prototype {} times as large, {broken}", short(breakage.scale, 3));
    let unbroken = units_with(Some(false));
    if !unbroken.is_empty() {
        words += &format!("; {}", listed("did not break", unbroken));
    }
    let others = units_with(None).len();
    if others > 0 {
        words += &format!("; {others} of {} units had no re-run impact and count as not broken", breakage.units.len());
    }
    words + "."
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn broken_and_unbroken_units_are_listed_by_number() {
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
        let words = |broken: &[Option<bool>]| {
            let units = broken.iter().enumerate().map(unit).collect();
            in_words(&Breakage { scale: 50.0, damaged_ratio: 0.0, broken_ratio: 0.0, units, impacts: Vec::new() })
        };
        assert_eq!(
            words(&[Some(true), None, Some(false), Some(true)]),
            "in a prototype 50 times as large, units 1, 4 broke; unit 3 did not break; 1 of 4 units had no \
             re-run impact and count as not broken."
        );
        assert_eq!(words(&[Some(false)]), "in a prototype 50 times as large, no unit broke; unit 1 did not break.");
    }
}
