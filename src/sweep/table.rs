//! The results of all runs of a sweep as a table and a chart.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::{
    member::Outcome,
    plan::{Combine, Sweep, Varied, in_words, short},
};
use crate::output::{
    OutputError,
    plot::{BarChart, Bars, Line, LineChart, standalone},
    write_atomically,
};

/// Size of the chart [px].
const SIZE: [f64; 2] = [720.0, 420.0];

/// Write `sweep.csv`, a row a run, and `sweep.svg`, the mean displacement against the first key that is a number, or a bar
/// for each run if one value varies at a time; returns what was written.
///
/// # Errors
/// If a file cannot be written.
pub fn write(sweep: &Sweep, dir: &Path) -> Result<Vec<PathBuf>, OutputError> {
    let outcomes: Vec<Outcome> = sweep.members.iter().map(|member| member.outcome(dir)).collect();
    let csv = dir.join("sweep.csv");
    write_atomically(&csv, table(sweep, &outcomes).as_bytes())?;
    let mut written = vec![csv];
    let chart = match sweep.combine {
        Combine::All => chart(sweep, &outcomes).map(|chart| chart.svg()),
        Combine::OneAtATime => bars(sweep, &outcomes).map(|chart| chart.svg()),
    };
    if let Some(chart) = chart {
        let path = dir.join("sweep.svg");
        write_atomically(&path, standalone(&chart).as_bytes())?;
        written.push(path);
    }
    Ok(written)
}

fn table(sweep: &Sweep, outcomes: &[Outcome]) -> String {
    let keys = sweep.varied.iter().map(|one| quoted(&one.key));
    let columns = [
        "mean_displacement_m",
        "damage_ratio",
        "largest_displacement_m",
        "broken_ratio",
        "dp_m",
        "particles",
        "steps",
        "simulated_s",
        "wall_s",
        "device",
        "state",
    ];
    let head = ["run".to_owned()].into_iter().chain(keys).chain(columns.map(str::to_owned));
    let mut rows = vec![head.collect::<Vec<_>>()];
    for (member, outcome) in sweep.members.iter().zip(outcomes) {
        let mut row = vec![member.name.clone()];
        row.extend(member.values.iter().map(|value| quoted(&in_words(value))));
        let number = |value: Option<f64>| value.map_or_else(String::new, |value| value.to_string());
        match outcome {
            Outcome::Finished(summary) => {
                let largest = summary.units.iter().map(|unit| unit.displacement_m).reduce(f64::max);
                let broken = summary.breakage.as_ref().map(|breakage| breakage.broken_ratio);
                row.extend([
                    number(summary.mean_displacement_m),
                    number(summary.damage_ratio),
                    number(largest),
                    number(broken),
                    number(Some(summary.dp_m)),
                    summary.particles.to_string(),
                    summary.steps.to_string(),
                    number(Some(summary.simulated_s)),
                    number(Some(summary.execution.wall_s)),
                    quoted(summary.execution.device.as_deref().unwrap_or_default()),
                    "finished".to_owned(),
                ]);
            }
            Outcome::Missing | Outcome::Failed(_) => {
                row.extend(std::iter::repeat_n(String::new(), columns.len() - 1));
                row.push(match outcome {
                    Outcome::Failed(words) => quoted(words),
                    _ => "missing".to_owned(),
                });
            }
        }
        rows.push(row);
    }
    rows.iter().map(|row| row.join(",") + "\n").collect()
}

/// A field of a table.
fn quoted(text: &str) -> String {
    let special = text.contains([',', '"', '\n']);
    if special { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

/// Mean displacement against the first key whose values are numbers, a line for each combination of the others.
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

/// Mean displacement of each run, and as a mark that of the case as it is.
fn bars(sweep: &Sweep, outcomes: &[Outcome]) -> Option<BarChart> {
    let of = |outcome: &Outcome| match outcome {
        Outcome::Finished(summary) => summary.mean_displacement_m,
        Outcome::Missing | Outcome::Failed(_) => None,
    };
    let (runs, values): (Vec<String>, Vec<f64>) = (sweep.members.iter().zip(outcomes))
        .filter_map(|(member, outcome)| Some((member.number.to_string(), of(outcome)?)))
        .unzip();
    let as_given = outcomes.first().and_then(of);
    (!values.is_empty()).then(|| BarChart {
        title: sweep.title.clone(),
        x_label: "number of the run in sweep.csv".to_owned(),
        y_label: "mean displacement [m]".to_owned(),
        groups: runs,
        bars: vec![Bars { name: String::new(), values, colour: 1, hollow: false }],
        stacked: false,
        marks: as_given.map(|value| (value, "as given".to_owned())).into_iter().collect(),
        size: SIZE,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::Summary;

    #[test]
    fn one_value_at_a_time_is_a_bar_each_beside_the_case_as_it_is() {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/fudo/sensitivity-sweep.json");
        let sweep = Sweep::load(&file).unwrap();
        let moved = |mean: f64| {
            let summary = Summary { mean_displacement_m: Some(mean), ..Summary::default() };
            Outcome::Finished(Box::new(summary))
        };
        // Nobody has made the others yet.
        let outcomes: Vec<Outcome> = [moved(0.25), Outcome::Missing, moved(0.28)].into();
        let chart = bars(&sweep, &outcomes).unwrap();
        assert_eq!(
            (chart.groups, &chart.bars[0].values[..]),
            (vec!["1".to_owned(), "3".to_owned()], &[0.25, 0.28][..])
        );
        assert_eq!(chart.marks, [(0.25, "as given".to_owned())]);
        assert!(bars(&sweep, &[Outcome::Missing]).is_none());
    }
}
