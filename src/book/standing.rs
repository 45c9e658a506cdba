//! Forces of the water on units that stand: how much of their weight it carries, how hard it pushes before they go.

use super::{entry::Entry, markdown::Page};
use crate::{
    report::{
        compare::{RunResult, UNIT_HEIGHT_M},
        plot::short,
    },
    simulation::flume::branch::STILL,
};

/// A unit that has moved less than this stands still [m].
pub const STILL_M: f64 = STILL * UNIT_HEIGHT_M;
/// Forces of the water are means over this time [s]: one that lasts shorter does not move a unit by a millimetre.
pub const MEAN_OVER_S: f64 = 0.1;
/// Time from the start of the particles over which the water is taken to be still [s]: the units have been let go, the
/// wave is not there yet.
const STILL_WATER_S: [f64; 2] = [0.5, 1.0];
/// Most units of a run whose values are listed one by one.
const MOST_LISTED: usize = 4;

/// Forces of the water on a unit while it stands; towards the shore and upwards, its buoyancy included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standing {
    /// Upwards in still water [N].
    pub lift_in_still_water_n: f64,
    /// The largest push [N].
    pub largest_push_n: f64,
    /// Upwards at that moment [N].
    pub lift_then_n: f64,
    /// Push over what is left of the weight on the ground, where that is largest.
    pub mobilised: f64,
}

/// Each unit of a run; empty if the case does not say what a unit weighs or one of them moves at once.
pub fn of(entry: &Entry) -> Vec<Standing> {
    let Some(weight_n) = weight_n(entry) else { return Vec::new() };
    let of_unit = |unit: usize| {
        let column = |what: &str| entry.series.get(&format!("unit_{unit}_{what}"));
        while_it_stands(entry.series.get("time_s")?, [column("fx_n")?, column("fz_n")?], column("moved_m")?, weight_n)
    };
    // All or none: what is said of a unit goes by its place in the list.
    (1..=entry.summary.units.len()).map(of_unit).collect::<Option<Vec<_>>>().unwrap_or_default()
}

/// Weight of a unit in air [N].
fn weight_n(entry: &Entry) -> Option<f64> {
    let file = entry.case_file()?;
    Some(file.fluid.gravity_m_s2 * file.units?.mass_kg)
}

/// Largest means over [`MEAN_OVER_S`] until the unit moves; none if it moves before.
fn while_it_stands(times: &[f64], [fx, fz]: [&[f64]; 2], moved: &[f64], weight_n: f64) -> Option<Standing> {
    let standing = moved.iter().position(|moved| *moved >= STILL_M).unwrap_or(moved.len());
    let interval = (times.last()? - times[0]) / (times.len() - 1).max(1) as f64;
    let rows = (MEAN_OVER_S / interval).round().max(1.0) as usize;
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let windows = fx[..standing].windows(rows).zip(fz[..standing].windows(rows));
    let means: Vec<[f64; 2]> = windows.map(|(fx, fz)| [mean(fx), mean(fz)]).collect();
    let [push, lift] = means.iter().copied().max_by(|a, b| a[0].total_cmp(&b[0]))?;
    let mobilised = means.iter().map(|[push, lift]| push / (weight_n - lift)).reduce(f64::max)?;
    let [from, to] = STILL_WATER_S.map(|since| times.partition_point(|time| *time < times[0] + since).min(standing));
    let still = if from < to { mean(&fz[from..to]) } else { f64::NAN };
    Some(Standing { lift_in_still_water_n: still, largest_push_n: push, lift_then_n: lift, mobilised })
}

/// Adds what the water does to the units before they go.
pub fn add(page: &mut Page, runs: &[(&RunResult, &Entry)], centimetres: &str) {
    let known: Vec<(&RunResult, &Entry, Vec<Standing>)> =
        runs.iter().map(|&(run, entry)| (run, entry, of(entry))).filter(|(.., units)| !units.is_empty()).collect();
    if known.is_empty() {
        return;
    }
    page.heading(3, &format!("Forces of the water on units that stand, under the wave of {centimetres} cm"));
    let head = [
        "run",
        "still water: lift [N]",
        "still water: weight on the ground [N]",
        "largest push while they stand [N]",
        "lift then [N]",
        "friction mobilised",
        "moved in the end [m]",
    ];
    let row = |(run, entry, units): &(&RunResult, &Entry, Vec<Standing>)| {
        let each = |of: fn(&Standing) -> f64| listed(&units.iter().map(of).collect::<Vec<_>>(), 2);
        let weight_n = weight_n(entry).unwrap_or(f64::NAN);
        let on_ground: Vec<f64> = units.iter().map(|unit| weight_n - unit.lift_in_still_water_n).collect();
        let moved: Vec<f64> = run.summary.units.iter().map(|unit| unit.displacement_m).collect();
        vec![
            run.name.clone(),
            each(|unit| unit.lift_in_still_water_n),
            listed(&on_ground, 2),
            each(|unit| unit.largest_push_n),
            each(|unit| unit.lift_then_n),
            each(|unit| unit.mobilised),
            listed(&moved, 3),
        ]
    };
    page.table(&head.map(str::to_owned), &known.iter().map(row).collect::<Vec<_>>());
    let [from, to] = STILL_WATER_S;
    page.paragraph(&format!(
        "One value for each unit, or the least and the largest of more than {MOST_LISTED}. Push is the force of the water towards the shore, \
         lift that upwards with the buoyancy in it; means over {MEAN_OVER_S} s while a unit has moved less than {} mm, in still water \
         from {from} to {to} s after the particles began. Friction mobilised is push over what is left of the weight on the \
         ground, where it is largest.",
        short(1000.0 * STILL_M, 2)
    ));
}

/// Values one by one, or their range if they are many.
fn listed(values: &[f64], digits: usize) -> String {
    let words = |value: f64| format!("{value:.digits$}").replace('-', "\u{2212}");
    if values.len() <= MOST_LISTED {
        return values.iter().map(|value| words(*value)).collect::<Vec<_>>().join(", ");
    }
    let (least, most) = values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(*v), b.max(*v)));
    format!("{} to {}", words(least), words(most))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_lasting_force_before_the_unit_moves_counts() {
        let times: Vec<f64> = (0..200).map(|row| 16.0 + 0.01 * f64::from(row)).collect();
        // A steady 0.6 N for half a second, a blow of 3 N for one row, and 2 N once the unit has gone.
        let force = |row: usize| match row {
            20 => 3.0,
            101..=150 => 0.6,
            151.. => 2.0,
            _ => 0.0,
        };
        let fx: Vec<f64> = (0..200).map(force).collect();
        let fz: Vec<f64> = (0..200).map(|row| if row < 101 { 1.2 } else { 1.0 }).collect();
        let moved: Vec<f64> = (0..200).map(|row| if row > 150 { 0.1 } else { 0.0 }).collect();
        let unit = while_it_stands(&times, [&fx, &fz], &moved, 2.5).unwrap();
        assert!((unit.mobilised - 0.4).abs() < 1e-9 && (unit.largest_push_n - 0.6).abs() < 1e-9, "{unit:?}");
        assert!((unit.lift_then_n - 1.0).abs() < 1e-9 && (unit.lift_in_still_water_n - 1.2).abs() < 1e-9, "{unit:?}");
        assert_eq!(while_it_stands(&[0.0, 0.01], [&[0.1, 0.1], &[1.0, 1.0]], &[0.1, 0.1], 2.5), None);
    }

    #[test]
    fn few_values_are_listed_and_many_are_bounded() {
        assert_eq!(listed(&[-0.654, 1.2], 2), "\u{2212}0.65, 1.20");
        assert_eq!(listed(&[0.3, 0.1, 0.5, 0.2, 0.4], 1), "0.1 to 0.5");
    }
}
