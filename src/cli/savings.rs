//! What a case would save with open ends near the units, and with longer time steps.
//!
//! Coarser water far from the units is not among the proposals: open ends where it would begin save more, and change the
//! forces on the units less.

use std::path::Path;

use serde_json::{Value, json};

use crate::case::{Case, Wavemaker};
use crate::sweep::key::set;

/// Distance of open ends from the units, divided by the still water depth at the seaward end [-]. At 2.5 depths, the
/// forces on held units in the Fudo case of the 4.5 cm wave are the same within 1 % as at 6 depths; the rest is room for
/// units that move.
const ENDS: f64 = 3.5;

/// Number of steps in the search of the distance, from the units to the seaward end of the domain.
const STEPS: u32 = 240;

/// Largest Courant number that has been tested with waves and units; the default.
const LARGEST_COURANT: f64 = 0.4;

/// Smallest saving worth mentioning, as a share of the run time [-].
const LEAST: f64 = 0.05;

/// A change of a case, and what it saves.
pub(super) struct Saving {
    /// Share of the run time [-].
    pub share: f64,
    /// Changed keys with their values.
    pub keys: String,
}

type Change = Vec<(&'static str, Value)>;

/// Returns the changes that save time in the case, which was read from `path`; the last is all changes together.
pub(super) fn savings(case: &Case, path: &Path) -> Vec<Saving> {
    let Ok(text) = std::fs::read_to_string(path) else { return Vec::new() };
    let Ok(file) = serde_json::from_str::<Value>(&text) else { return Vec::new() };
    let before = case.estimate().evaluations;
    let share_of = |change: &Change| {
        let mut file = file.clone();
        change.iter().try_for_each(|(key, value)| set(&mut file, key, value.clone())).ok()?;
        // Changes that do not suit the case are refused by its validation.
        let changed = Case::from_str(&file.to_string(), &case.name).ok()?;
        Some(1.0 - changed.estimate().evaluations / before).filter(|share| *share >= LEAST)
    };
    let mut found: Vec<(f64, Change)> =
        changes(case).into_iter().filter_map(|change| Some((share_of(&change)?, change))).collect();
    let all: Change = found.iter().flat_map(|(_, change)| change.clone()).collect();
    if found.len() > 1
        && let Some(share) = share_of(&all)
    {
        found.push((share, Vec::new()));
    }
    found.into_iter().map(|(share, change)| Saving { share, keys: in_words(&change) }).collect()
}

fn in_words(change: &Change) -> String {
    if change.is_empty() {
        return "all of these".to_owned();
    }
    change.iter().map(|(key, value)| format!("{key} = {value}")).collect::<Vec<_>>().join(", ")
}

/// Returns the changes that can save time.
fn changes(case: &Case) -> Vec<Change> {
    let mut changes = Vec::new();
    if let Some(units) = &case.units {
        let (domain, height) = (&case.domain, units.tallest());
        let x = || units.placements.iter().map(|pose| pose.centre.x);
        let low = x().fold(f64::INFINITY, f64::min) - 0.5 * height;
        let high = x().fold(f64::NEG_INFINITY, f64::max) + 0.5 * height;
        let reach = distance_of_ends(case, low);
        // Round to centimetres for a depth of some decimetres, to metres for some decametres.
        let step = 10_f64.powf(domain.depth.log10().floor() - 1.0);
        let rounded = [((low - reach) / step).floor() * step, ((high + reach) / step).ceil() * step];
        // Remove the rounding error of the product.
        let [from, to] = rounded.map(|x| (x * 1e6).round() / 1e6);
        let x = [from.max(domain.x[0]), to.min(domain.x[1])];
        let mut open_ends = vec![("domain.x_m", json!(x))];
        if !matches!(case.wavemaker, Wavemaker::OpenEnds { .. }) {
            open_ends.insert(0, ("wavemaker", json!({ "kind": "open_ends" })));
        }
        changes.push(open_ends);
    }
    if case.numerics.cfl < LARGEST_COURANT {
        changes.push(vec![("numerics.cfl", json!(LARGEST_COURANT))]);
    }
    changes
}

/// Returns the distance of the seaward end from units that begin at x = `low` [m]: [`ENDS`] times the depth there.
fn distance_of_ends(case: &Case, low: f64) -> f64 {
    let longest = low - case.domain.x[0];
    let distances = (1..STEPS).map(|step| longest * f64::from(step) / f64::from(STEPS));
    let is_far = |distance: &f64| *distance >= ENDS * case.flume.still_depth(low - distance);
    distances.into_iter().find(is_far).unwrap_or(longest)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_file(name: &str) -> Vec<Saving> {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
        savings(&Case::load(&path).unwrap(), &path)
    }

    fn keys(savings: &[Saving]) -> Vec<&str> {
        savings.iter().map(|saving| saving.keys.split([' ', ',']).next().unwrap()).collect()
    }

    #[test]
    fn a_slice_saves_time_with_open_ends_near_the_units() {
        let found = of_file("fudo/H4.5-slice.json");
        assert_eq!(keys(&found), ["wavemaker"]);
        // The still water is 0.153 m deep at 38.41 m. The domain becomes 1.18 m instead of 4.5 m long, and its deepest
        // water 0.153 m instead of 0.217 m.
        assert!(found[0].keys.contains("[38.41,39.59]"), "{}", found[0].keys);
        assert!((0.70..0.85).contains(&found[0].share), "{}", found[0].share);
    }

    #[test]
    fn longer_time_steps_save_time() {
        let given = include_str!("../../cases/tutorial/wave-alone.json");
        let file = tempfile::NamedTempFile::new().unwrap();
        let with_courant = given.replacen('{', r#"{ "numerics": { "cfl": 0.2 },"#, 1);
        std::fs::write(file.path(), &with_courant).unwrap();
        let found = savings(&Case::from_str(&with_courant, "tank.json").unwrap(), file.path());
        assert_eq!(keys(&found), ["numerics.cfl"]);
        // Twice the Courant number needs half the time steps.
        assert!((found[0].share - 0.5).abs() < 0.01, "{}", found[0].share);
    }

    #[test]
    fn proposals_that_a_case_does_not_allow_are_left_out() {
        // Water without a wave has no open ends.
        let found = of_file("verification/still-water.json");
        assert!(found.is_empty());
    }
}
