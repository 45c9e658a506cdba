//! The results of all runs of a sweep as a table and a chart.

use std::path::{Path, PathBuf};

use serde_json::Value;

use super::{
    member::Outcome,
    plan::{Sweep, Varied, in_words, short},
};
use crate::output::{
    OutputError,
    plot::{Line, LineChart, standalone},
    write_atomically,
};

/// Size of the chart [px].
const SIZE: [f64; 2] = [720.0, 420.0];

/// Write `sweep.csv`, a row a run, and `sweep.svg`, the mean displacement against the first key that is a number; returns
/// what was written.
///
/// # Errors
/// If a file cannot be written.
pub fn write(sweep: &Sweep, dir: &Path) -> Result<Vec<PathBuf>, OutputError> {
    let outcomes: Vec<Outcome> = sweep.members.iter().map(|member| member.outcome(dir)).collect();
    let csv = dir.join("sweep.csv");
    write_atomically(&csv, table(sweep, &outcomes).as_bytes())?;
    let mut written = vec![csv];
    if let Some(chart) = chart(sweep, &outcomes) {
        let path = dir.join("sweep.svg");
        write_atomically(&path, standalone(&chart.svg()).as_bytes())?;
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
