//! Chart `sweep.svg` of the results of a sweep.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::plot::{Line, LineChart, TornadoChart, TornadoInput, standalone};
use crate::{
    output::{OutputError, write_atomically},
    sweep::{
        ensemble::{Ensemble, ensembles},
        key::{brief, short},
        member::Outcome,
        plan::{Combine, Sweep},
        values::{Varied, in_words},
    },
};

/// Size of the chart [px].
const SIZE: [f64; 2] = [720.0, 420.0];

/// Writes `sweep.svg` and returns its path; `None` if there is nothing to show. The chart shows the mean displacement
/// of the units against the first key with numeric values. If the keys vary one at a time, the chart shows for each
/// value how much the mean displacement differs from the base case. With random values, it shows the distribution of the
/// displacements.
///
/// # Errors
/// If the file cannot be written.
pub fn write_sweep_chart(sweep: &Sweep, outcomes: &[Outcome], dir: &Path) -> Result<Option<PathBuf>, OutputError> {
    let chart = match sweep.combine {
        _ if sweep.repetitions > 1 => distributions(&ensembles(sweep, outcomes), sweep).map(|chart| chart.svg()),
        Combine::All => chart(sweep, outcomes).map(|chart| chart.svg()),
        Combine::OneAtATime => tornado(sweep, outcomes).map(|chart| chart.svg()),
    };
    let Some(chart) = chart else { return Ok(None) };
    let path = dir.join("sweep.svg");
    write_atomically(&path, standalone(&chart).as_bytes())?;
    Ok(Some(path))
}

/// Charts the mean displacement against the first key with numeric values. Each combination of the other keys is one
/// line.
fn chart(sweep: &Sweep, outcomes: &[Outcome]) -> Option<LineChart> {
    let is_axis = |one: &Varied| one.values.len() > 1 && one.values.iter().all(Value::is_number);
    let along = sweep.varied.iter().position(is_axis)?;
    let mut lines: Vec<Line> = Vec::new();
    for (member, outcome) in sweep.members.iter().zip(outcomes) {
        let Outcome::Finished(summary) = outcome else { continue };
        let (Some(x), Some(y)) = (member.values[along].as_f64(), summary.mean_displacement_m) else { continue };
        let others = sweep.varied.iter().zip(&member.values).enumerate().filter(|(k, _)| *k != along);
        let name: Vec<String> =
            others.map(|(_, (one, value))| format!("{} {}", short(&one.key), in_words(value))).collect();
        let name = name.join(", ");
        match lines.iter_mut().find(|line| line.name == name) {
            Some(line) => line.points.push([x, y]),
            None => {
                lines.push(Line { name, points: vec![[x, y]], colour: lines.len(), dots: true, ..Line::default() });
            }
        }
    }
    lines.iter_mut().for_each(|line| line.points.sort_by(|a, b| a[0].total_cmp(&b[0])));
    (!lines.is_empty()).then(|| LineChart {
        title: sweep.title.clone(),
        x_label: sweep.varied[along].key.clone(),
        y_label: "mean displacement [m]".to_owned(),
        lines,
        size: SIZE,
        ..LineChart::default()
    })
}

/// Charts the share of units that moved less than a displacement, with one line for each combination.
fn distributions(ensembles: &[Ensemble], sweep: &Sweep) -> Option<LineChart> {
    let line = |(colour, one): (usize, &Ensemble)| {
        let count = one.displacements.len() as f64;
        let steps = one.displacements.iter().enumerate();
        let points = steps.flat_map(|(k, x)| [[*x, k as f64 / count], [*x, (k + 1) as f64 / count]]).collect();
        Line { name: one.name.clone(), points, colour, ..Line::default() }
    };
    (!ensembles.is_empty()).then(|| LineChart {
        title: sweep.title.clone(),
        x_label: "displacement [m]".to_owned(),
        y_label: "share of units that moved less".to_owned(),
        lines: ensembles.iter().enumerate().map(line).collect(),
        size: SIZE,
        ..LineChart::default()
    })
}

/// Charts how each value changes the mean displacement of the base case. The first run is the base case; `None` if this
/// run is not finished.
fn tornado(sweep: &Sweep, outcomes: &[Outcome]) -> Option<TornadoChart> {
    let mean = |outcome: &Outcome| match outcome {
        Outcome::Finished(summary) => summary.mean_displacement_m,
        Outcome::Missing | Outcome::Failed(_) => None,
    };
    let (base, base_mean) = (&sweep.members.first()?.values, mean(outcomes.first()?)?);
    let lever = |(k, one): (usize, &Varied)| TornadoInput {
        name: format!("{} {}", brief(&one.key), in_words(&base[k])).trim_end().to_owned(),
        values: (sweep.members.iter().zip(outcomes))
            .filter(|(member, _)| member.values[k] != base[k])
            .filter_map(|(member, outcome)| Some((in_words(&member.values[k]), mean(outcome)? - base_mean)))
            .collect(),
    };
    Some(TornadoChart {
        title: sweep.title.clone(),
        x_label: format!("change of the mean displacement [m]; base case {base_mean:.3} m"),
        levers: sweep.varied.iter().enumerate().map(lever).filter(|lever| !lever.values.is_empty()).collect(),
        width: SIZE[0],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::Summary;

    #[test]
    fn tornado_chart_shows_changes_from_the_base_case() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/fudo/sensitivity-sweep.json");
        let sweep = Sweep::load(&file).unwrap();
        let moved = |mean: f64| {
            let summary = Summary { mean_displacement_m: Some(mean), ..Summary::default() };
            Outcome::Finished(Box::new(summary))
        };
        // The second run has no result. The list ends after the third run, so the chart ignores all further runs.
        let outcomes: Vec<Outcome> = [moved(0.25), Outcome::Missing, moved(0.28)].into();
        let chart = tornado(&sweep, &outcomes).unwrap();
        let [lever] = &chart.levers[..] else { panic!("{:?}", chart.levers) };
        assert_eq!(lever.name, "mound.crest_width_m 0.32");
        let [(words, change)] = &lever.values[..] else { panic!("{lever:?}") };
        assert!(words == "0.36" && (change - 0.03).abs() < 1e-12, "{lever:?}");
        assert!(chart.x_label.ends_with("base case 0.250 m"), "{}", chart.x_label);
        assert!(tornado(&sweep, &[Outcome::Missing, moved(0.28)]).is_none());
    }
}
