//! Statistics over runs that differ only in their random values.

use std::path::{Path, PathBuf};

use super::{member::Outcome, plan::Sweep, table::quoted};
use crate::output::{OutputError, UnitSummary, write_atomically};

/// A unit whose displacement is smaller than this share of the damage distance counts as not moved [-]. A displacement
/// of a millimetre can hardly be measured in a laboratory.
const AT_REST: f64 = 0.01;

/// Quantile of the normal distribution for an interval with a confidence of 95 %.
const QUANTILE: f64 = 1.96;

/// Statistics over the finished repetitions of one combination of the varied keys.
#[derive(Debug, Clone, PartialEq)]
pub struct Ensemble {
    /// The keys that are not random, with their values, as in `height_m=0.045`; empty if all keys are random.
    pub name: String,
    /// Number of finished runs.
    pub runs: usize,
    /// Displacements of all units in all runs, in increasing order [m].
    pub displacements: Vec<f64>,
    /// Mean displacement [m].
    pub mean: f64,
    /// Standard deviation of the displacement between units [m].
    pub deviation: f64,
    /// Standard deviation of the mean displacement between runs [m]; NaN with a single run.
    pub deviation_of_runs: f64,
    /// Share of units that did not move [-].
    pub at_rest: f64,
    /// Share of damaged units [-].
    pub damage: f64,
    /// Interval that contains the true damage ratio with a confidence of 95 % [-] (Wilson 1927); each run counts as
    /// one observation.
    pub damage_interval: [f64; 2],
}

/// Returns the statistics for each combination with finished runs; empty if the sweep has no random values.
pub fn ensembles(sweep: &Sweep, outcomes: &[Outcome]) -> Vec<Ensemble> {
    if sweep.repetitions < 2 {
        return Vec::new();
    }
    let runs = sweep.members.chunks(sweep.repetitions).zip(outcomes.chunks(sweep.repetitions));
    runs.filter_map(|(members, outcomes)| {
        let regular = sweep.varied.iter().zip(&members[0].values).filter(|(one, _)| !one.is_random);
        let name: Vec<String> = regular.map(|(one, value)| one.with(value)).collect();
        let finished = outcomes.iter().filter_map(|outcome| match outcome {
            Outcome::Finished(summary) => Some((&summary.units[..], summary.damage_distance_m?)),
            Outcome::Missing | Outcome::Failed(_) => None,
        });
        ensemble(name.join(" "), &finished.collect::<Vec<_>>())
    })
    .collect()
}

/// Returns the statistics over the units of each run, with the damage distance [m] of each run; `None` without units.
fn ensemble(name: String, runs: &[(&[UnitSummary], f64)]) -> Option<Ensemble> {
    let units = || runs.iter().flat_map(|(units, _)| *units);
    let mut displacements: Vec<f64> = units().map(|unit| unit.displacement_m).collect();
    if displacements.is_empty() {
        return None;
    }
    displacements.sort_by(f64::total_cmp);
    let count = displacements.len() as f64;
    let mean_of = |units: &[UnitSummary]| units.iter().map(|u| u.displacement_m).sum::<f64>() / units.len() as f64;
    let means: Vec<f64> = runs.iter().map(|(units, _)| mean_of(units)).collect();
    let rests = |(units, distance): &(&[UnitSummary], f64)| {
        units.iter().filter(|unit| unit.displacement_m < AT_REST * distance).count()
    };
    let damage = units().filter(|unit| unit.damaged).count() as f64 / count;
    Some(Ensemble {
        name,
        runs: runs.len(),
        mean: displacements.iter().sum::<f64>() / count,
        deviation: deviation(&displacements),
        deviation_of_runs: deviation(&means),
        at_rest: runs.iter().map(rests).sum::<usize>() as f64 / count,
        damage,
        damage_interval: interval(damage, runs.len()),
        displacements,
    })
}

/// Returns the standard deviation of a sample; NaN for a single value.
fn deviation(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / (values.len() as f64 - 1.0)).sqrt()
}

/// Returns the Wilson score interval of a share observed in n runs (Wilson 1927). The units of a run meet the same wave
/// and push each other, so a run counts as one observation, however many units it has.
fn interval(share: f64, runs: usize) -> [f64; 2] {
    let n = runs as f64;
    let z2 = QUANTILE * QUANTILE / n;
    let centre = (share + 0.5 * z2) / (1.0 + z2);
    let half = (z2 * (share * (1.0 - share) + 0.25 * z2)).sqrt() / (1.0 + z2);
    [(centre - half).max(0.0), (centre + half).min(1.0)]
}

/// Writes `ensemble.csv`, one row per combination; returns its path.
///
/// # Errors
/// If the file cannot be written.
pub fn write_ensembles(sweep: &Sweep, ensembles: &[Ensemble], dir: &Path) -> Result<PathBuf, OutputError> {
    let path = dir.join("ensemble.csv");
    write_atomically(&path, table(sweep, ensembles).as_bytes())?;
    Ok(path)
}

fn table(sweep: &Sweep, ensembles: &[Ensemble]) -> String {
    let mut text = format!(
        "combination,runs_of_{},units,mean_displacement_m,deviation_of_units_m,deviation_of_runs_m,least_m,greatest_m,\
         not_moved_ratio,damage_ratio,damage_ratio_low,damage_ratio_high\n",
        sweep.repetitions
    );
    for one in ensembles {
        let number = |value: f64| if value.is_nan() { String::new() } else { value.to_string() };
        let units = &one.displacements;
        let numbers = [
            one.mean,
            one.deviation,
            one.deviation_of_runs,
            units[0],
            units[units.len() - 1],
            one.at_rest,
            one.damage,
            one.damage_interval[0],
            one.damage_interval[1],
        ];
        let mut row = vec![quoted(&one.name), one.runs.to_string(), units.len().to_string()];
        row.extend(numbers.map(number));
        text += &(row.join(",") + "\n");
    }
    text
}

impl Ensemble {
    /// Describes the statistics in one line.
    pub fn in_words(&self) -> String {
        let name = if self.name.is_empty() { "all runs" } else { &self.name };
        let percent = |share: f64| format!("{:.0}", 100.0 * share);
        format!(
            "{name}: {} runs, {} units: mean displacement {:.3} m, standard deviation {:.3} m; not moved {} %; damaged \
             {} % (95 % confidence: {} to {} %)",
            self.runs,
            self.displacements.len(),
            self.mean,
            self.deviation,
            percent(self.at_rest),
            percent(self.damage),
            percent(self.damage_interval[0]),
            percent(self.damage_interval[1])
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_of_two_runs() {
        let unit = |displacement_m: f64| UnitSummary {
            displacement_m,
            damaged: displacement_m > 0.1,
            ..UnitSummary::moved(1, [0.0; 3], [0.0; 3], 0.0, 0.1)
        };
        let runs = [[0.0, 0.2].map(unit), [0.1, 0.3].map(unit)];
        let of = ensemble(String::new(), &runs.each_ref().map(|run| (&run[..], 0.1))).unwrap();
        assert_eq!((of.runs, of.displacements.len(), of.at_rest, of.damage), (2, 4, 0.25, 0.5));
        // Deviations by hand: units 0.15 -+ 0.15, 0.05; means of the runs 0.1 and 0.2. Tolerance: rounding.
        assert!((of.mean - 0.15).abs() < 1e-12 && (of.deviation - (0.05f64 / 3.0).sqrt()).abs() < 1e-12);
        assert!((of.deviation_of_runs - 0.1 / 2f64.sqrt()).abs() < 1e-12);
        assert!(of.in_words().starts_with("all runs: 2 runs, 4 units: mean displacement 0.150 m"), "{}", of.in_words());
        assert!(ensemble(String::new(), &[]).is_none());
    }

    #[test]
    fn intervals_are_those_of_wilson() {
        // Published example: no event in n = 10 gives 0 to 0.278 (Brown, Cai & DasGupta 2001, equation 4).
        let [low, high] = interval(0.0, 10);
        assert!(low < 1e-12 && (high - 0.2775).abs() < 1e-3, "{low} {high}");
        let [low, high] = interval(0.5, 20);
        assert!((low + high - 1.0).abs() < 1e-12 && (low - 0.2993).abs() < 1e-3, "{low}");
    }
}
