//! What hangs on what is assumed: runs that have something otherwise than the case as it is given.

use super::{
    entry::Entry,
    markdown::{Page, signed},
    variation::{Change, changes},
};
use crate::report::{
    compare::RunResult,
    plot::{Lever, TornadoChart, short},
};

/// Whether a run is that of a given case, at whatever distance between particles.
pub fn is_as_given(entry: &Entry) -> bool {
    changes(&entry.case).is_empty()
}

/// Adds the runs that are not of a case as it is given, beside those that are; nothing if there are none.
pub fn add(page: &mut Page, runs: &[(&RunResult, &Entry)], centimetres: &str) {
    let (given, changed): (Vec<_>, Vec<_>) = runs.iter().copied().partition(|(_, entry)| is_as_given(entry));
    if changed.is_empty() {
        return;
    }
    let is_like = |run: &RunResult, other: &RunResult| {
        (run.summary.dp_m, run.summary.units.len()) == (other.summary.dp_m, other.summary.units.len())
    };
    let beside = |run: &RunResult| given.iter().find(|(given, _)| is_like(run, given)).map(|(given, _)| given.mean_m);
    page.heading(3, &format!("What hangs on what is assumed, under the wave of {centimetres} cm"));
    let head = [
        "run",
        "has",
        "particles every [mm]",
        "mean displacement [m]",
        "(mean \u{2212} EXP) / EXP [%]",
        "against the case as given [%]",
        "damaged [%]",
    ];
    let row = |(run, entry): &(&RunResult, &Entry)| {
        let percent = |given: f64| signed(100.0 * (run.mean_m / given - 1.0));
        vec![
            run.name.clone(),
            changes(&entry.case).iter().map(Change::in_words).collect::<Vec<_>>().join(", "),
            short(1000.0 * run.summary.dp_m, 2),
            format!("{:.3}", run.mean_m),
            signed(run.deviation_percent),
            beside(run).map(percent).unwrap_or_default(),
            short(100.0 * run.damage_ratio, 0),
        ]
    };
    page.table(&head.map(str::to_owned), &changed.iter().map(row).collect::<Vec<_>>());
    let levers = levers(&changed, beside);
    let shown = given.iter().filter(|(run, _)| changed.iter().any(|(other, _)| is_like(run, other))).chain(&changed);
    if !levers.is_empty() {
        let chart = TornadoChart {
            title: "How much the mean displacement hangs on what is assumed".to_owned(),
            x_label: "mean displacement against the case as given [%]".to_owned(),
            levers,
            width: 920.0,
        };
        page.figure(
            &format!("fudo-{centimetres}-assumed.svg"),
            &chart.svg(),
            "How much the mean displacement hangs on what is assumed; at each bar the value that the run has instead.",
            &Entry::again(shown.map(|(_, entry)| *entry)),
        );
    }
}

/// Change of the mean displacement [%] by each key that a run has otherwise, beside the run as given with the same
/// particles; runs with several such keys go by their names.
fn levers<'a>(changed: &[(&'a RunResult, &'a Entry)], beside: impl Fn(&RunResult) -> Option<f64>) -> Vec<Lever> {
    let distance = |run: &RunResult| format!("{} mm", short(1000.0 * run.summary.dp_m, 2));
    let one_distance = changed.iter().all(|(run, _)| run.summary.dp_m == changed[0].0.summary.dp_m);
    let mut levers: Vec<Lever> = Vec::new();
    for &(run, entry) in changed {
        let Some(given) = beside(run) else { continue };
        let (mut name, value) = match &changes(&entry.case)[..] {
            [change] => (change.given_in_brief(), change.value_in_words()),
            _ => (run.name.clone(), String::new()),
        };
        if !one_distance {
            name += &format!(", {}", distance(run));
        }
        let value = (value, 100.0 * (run.mean_m / given - 1.0));
        match levers.iter_mut().find(|lever| lever.name == name) {
            Some(lever) => lever.values.push(value),
            None => levers.push(Lever { name, values: vec![value] }),
        }
    }
    levers
}
