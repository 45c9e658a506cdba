//! Writes the results of all runs of a sweep as a table.

use std::path::{Path, PathBuf};

use super::{member::Outcome, plan::Sweep, values::in_words};
use crate::output::{OutputError, write_atomically};

/// Writes `sweep.csv`, one row per run; returns its path.
///
/// # Errors
/// If the file cannot be written.
pub fn write_table(sweep: &Sweep, outcomes: &[Outcome], dir: &Path) -> Result<PathBuf, OutputError> {
    let path = dir.join("sweep.csv");
    write_atomically(&path, table(sweep, outcomes).as_bytes())?;
    Ok(path)
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

/// Quotes a field for CSV.
pub(super) fn quoted(text: &str) -> String {
    let special = text.contains([',', '"', '\n']);
    if special { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}
