//! What hangs on what is assumed: runs that have something otherwise than the case as it is given.

use super::{
    entry::Entry,
    markdown::{Page, signed},
    variation::{Change, changes},
};
use crate::output::{
    RunResult,
    plot::{BarChart, Bars, short},
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
    let beside = |run: &RunResult| {
        let of_its_distance = given.iter().find(|(given, _)| given.summary.dp_m == run.summary.dp_m);
        of_its_distance.map(|(given, _)| given.mean_m)
    };
    page.heading(3, &format!("What hangs on what is assumed, under the wave of {centimetres} cm"));
    let head = [
        "number",
        "run",
        "has",
        "particles every [mm]",
        "mean displacement [m]",
        "(mean \u{2212} EXP) / EXP [%]",
        "against the case as given [%]",
        "damaged [%]",
    ];
    let row = |(number, (run, entry)): (usize, &(&RunResult, &Entry))| {
        let percent = |given: f64| format!("{:+.0}", 100.0 * (run.mean_m / given - 1.0)).replace('-', "\u{2212}");
        vec![
            (number + 1).to_string(),
            run.name.clone(),
            changes(&entry.case).iter().map(Change::in_words).collect::<Vec<_>>().join(", "),
            short(1000.0 * run.summary.dp_m, 2),
            format!("{:.3}", run.mean_m),
            signed(run.deviation_percent),
            beside(run).map(percent).unwrap_or_default(),
            short(100.0 * run.damage_ratio, 0),
        ]
    };
    page.table(&head.map(str::to_owned), &changed.iter().enumerate().map(row).collect::<Vec<_>>());
    let mut marks: Vec<(f64, String)> = (given.iter())
        .filter(|(given, _)| changed.iter().any(|(run, _)| run.summary.dp_m == given.summary.dp_m))
        .map(|(run, _)| (run.mean_m, format!("as given, {} mm", short(1000.0 * run.summary.dp_m, 2))))
        .collect();
    marks.dedup_by(|a, b| a.1 == b.1);
    let chart = BarChart {
        title: "Mean displacement where something is not as given".to_owned(),
        x_label: "number in the table".to_owned(),
        y_label: "mean displacement [m]".to_owned(),
        groups: (1..=changed.len()).map(|number| number.to_string()).collect(),
        bars: vec![Bars { values: changed.iter().map(|(run, _)| run.mean_m).collect(), colour: 1, ..Bars::default() }],
        marks,
        size: [920.0, 300.0],
        ..BarChart::default()
    };
    page.figure(
        &format!("fudo-{centimetres}-assumed.svg"),
        &chart.svg(),
        "Mean displacement where something is not as given, by the numbers of the table.",
        &Entry::again(changed.iter().map(|(_, entry)| *entry)),
    );
}
