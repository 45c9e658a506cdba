//! What a case would save with open ends, with coarser water far from the units, and with longer time steps.

use std::path::Path;

use serde_json::{Value, json};

use crate::case::{Case, Wavemaker};
use crate::sweep::key::set;

/// Distance of open ends from the units, divided by the largest still water depth of the domain [-]. At this distance,
/// the mean displacement in the Fudo case of the 4.5 cm wave is the same within 1 % as in a domain twice as long.
const ENDS: f64 = 5.0;

/// Distance of the ends of the fine water from the units [dp]: what [`Case::load`] requires, and one for rounding.
const FINE_MARGIN: f64 = 21.0;

/// Length of the fine water seaward and shoreward of the units, divided by their height [-].
const ROOM: [f64; 2] = [2.0, 4.0];

/// Largest Courant number that has been tested with waves and units; the default.
const LARGEST_COURANT: f64 = 0.4;

/// Smallest saving worth mentioning, as a share of the run time [-].
const LEAST: f64 = 0.05;

/// Key of the coarse water far from the units.
pub(super) const COARSE_WATER: &str = "domain.fine_x_m";

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
        let (domain, height) = (&case.domain, units.shape.height());
        let x = || units.placements.iter().map(|pose| pose.centre.x);
        let low = x().fold(f64::INFINITY, f64::min) - 0.5 * height;
        let high = x().fold(f64::NEG_INFINITY, f64::max) + 0.5 * height;
        let step = 10_f64.powf(domain.depth.log10().floor() - 1.0);
        let around = |below: f64, above: f64| {
            let rounded = [((low - below) / step).floor() * step, ((high + above) / step).ceil() * step];
            // Remove the rounding error of the product.
            rounded.map(|x| (x * 1e6).round() / 1e6)
        };
        let reach = ENDS * domain.depth;
        let [from, to] = around(reach, reach);
        if !matches!(case.wavemaker, Wavemaker::OpenEnds { .. }) {
            let x = [from.max(domain.x[0]), to.min(domain.x[1])];
            changes.push(vec![("wavemaker", json!({ "kind": "open_ends" })), ("domain.x_m", json!(x))]);
        }
        if domain.regions.len() == 1 {
            let [seaward, shoreward] = ROOM.map(|room| FINE_MARGIN * domain.dp + room * height);
            changes.push(vec![(COARSE_WATER, json!([around(seaward, shoreward)]))]);
        }
    }
    if case.numerics.cfl < LARGEST_COURANT {
        changes.push(vec![("numerics.cfl", json!(LARGEST_COURANT))]);
    }
    changes
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
    fn a_slice_saves_time_in_two_ways() {
        let found = of_file("fudo/H4.5-slice.json");
        assert_eq!(keys(&found), ["wavemaker", "domain.fine_x_m", "all"]);
        // Shares of the time multiply at most.
        let kept: f64 = found[..2].iter().map(|saving| 1.0 - saving.share).product();
        let kept_with_all = 1.0 - found[2].share;
        assert!(kept_with_all >= kept && kept_with_all < 1.0 - found[0].share, "{kept_with_all}");
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
        // The slice is too narrow for coarse water at this spacing.
        let found = of_file("fudo/quick-look.json");
        assert!(found.iter().all(|saving| !saving.keys.contains("fine_x_m")));
        assert!(!found.is_empty());
    }
}
