//! What a reader looks for first: how near the runs are to the experiment, beside the published code with particles as
//! large, and what they cost.

use super::{
    assumed,
    entry::Entry,
    markdown::{Page, signed},
};
use crate::report::{
    compare::{Comparison, PublishedWave, Resolution, RunResult},
    page::clock,
    plot::{BarChart, Bars, short},
};

/// A run of a case as it is given, and what was published for its wave.
struct Given<'a> {
    published: &'a PublishedWave,
    run: &'a RunResult,
    entry: &'a Entry,
}

impl Given<'_> {
    /// The published run with particles as large.
    fn beside(&self) -> Option<&Resolution> {
        let as_large = |published: &&Resolution| (published.dp_m - self.run.summary.dp_m).abs() < 1e-9;
        self.published.convergence.iter().find(as_large)
    }
}

/// Runs of cases as they are given: by wave, coarsest first.
fn given<'a>(comparison: &'a Comparison, entries: &'a [Entry]) -> Vec<Given<'a>> {
    let mut known = Vec::new();
    for wave in &comparison.waves {
        let of = |run: &'a RunResult| {
            let entry = entries.iter().find(|entry| entry.name == run.name && assumed::is_as_given(entry))?;
            Some(Given { published: &wave.published, run, entry })
        };
        let mut runs: Vec<Given> = wave.runs.iter().filter_map(of).collect();
        runs.sort_by(|a, b| b.run.summary.dp_m.total_cmp(&a.run.summary.dp_m));
        known.append(&mut runs);
    }
    known
}

/// Adds the table and the two charts of means and damage; nothing if no case was run as it is given.
pub fn add(page: &mut Page, comparison: &Comparison, entries: &[Entry]) {
    let known = given(comparison, entries);
    if known.is_empty() {
        return;
    }
    page.heading(2, "At a glance");
    let head = [
        "wave [cm]",
        "particles every [mm]",
        "units",
        "measured [m]",
        "breakwater [m]",
        "breakwater, off by [%]",
        "published code, as fine, off by [%]",
        "damaged, measured [%]",
        "damaged, breakwater [%]",
        "breakwater took",
        "published code took",
    ];
    let row = |one: &Given| {
        let beside = one.beside();
        vec![
            short(100.0 * one.published.height_m, 1),
            short(1000.0 * one.run.summary.dp_m, 2),
            one.run.summary.units.len().to_string(),
            format!("{:.3}", one.published.measured_mean_m()),
            format!("{:.3}", one.run.mean_m),
            signed(one.run.deviation_percent),
            beside.map(|published| signed(published.deviation_percent)).unwrap_or_default(),
            short(100.0 * one.published.measured_damage_ratio(), 0),
            short(100.0 * one.run.damage_ratio, 0),
            clock(one.run.summary.execution.wall_s),
            beside.map(|published| clock(3600.0 * published.runtime_h)).unwrap_or_default(),
        ]
    };
    page.table(&head.map(str::to_owned), &known.iter().map(row).collect::<Vec<_>>());
    page.paragraph(
        "Mean displacement of the units. Breakwater's runs of two units are slices, those of fifteen the row between the\n\
         walls, on as many threads of a processor as the table of runs says; the published ones (Table 6) are all fifteen\n\
         units for 20 s on a graphics card (RTX 3080 Ti).",
    );
    let again = Entry::again(known.iter().map(|one| one.entry));
    for (file, quantity, chart) in [
        ("fudo-means.svg", "Mean displacement", means(comparison, &known)),
        ("fudo-damage.svg", "Share of damaged units", damage(comparison, &known)),
    ] {
        let caption = format!(
            "{quantity} under each wave (as Fig. 13 of the paper); hollow: published. A row turned either way is one bar, the mean."
        );
        page.figure(file, &chart, &caption, &again);
    }
}

/// Mean displacement of measurements, published simulations and runs, by wave.
fn means(comparison: &Comparison, known: &[Given]) -> String {
    bars(comparison, known, "mean displacement [m]", PublishedWave::mean_m, |run| run.mean_m)
}

/// Share of damaged units, the same way.
fn damage(comparison: &Comparison, known: &[Given]) -> String {
    let percent = |published: &PublishedWave, series| 100.0 * published.damage_ratio(series);
    bars(comparison, known, "damaged units [%]", percent, |run| 100.0 * run.damage_ratio)
}

fn bars(
    comparison: &Comparison,
    known: &[Given],
    quantity: &str,
    published: impl Fn(&PublishedWave, usize) -> f64,
    here: impl Fn(&RunResult) -> f64,
) -> String {
    let waves = || comparison.waves.iter().map(|wave| &wave.published);
    let mut bars: Vec<Bars> = (PublishedWave::SERIES.into_iter().enumerate())
        .map(|(series, name)| Bars {
            name: name.to_owned(),
            values: waves().map(|wave| published(wave, series)).collect(),
            colour: if PublishedWave::is_measured(series) { 5 } else { 0 },
            hollow: true,
        })
        .collect();
    // The finest slices stand last of theirs, then the rows.
    let kind = |one: &Given| (one.run.summary.units.len(), one.run.summary.dp_m);
    let mut kinds: Vec<(usize, f64)> = known.iter().map(kind).collect();
    kinds.sort_by(|a, b| a.0.cmp(&b.0).then(b.1.total_cmp(&a.1)));
    kinds.dedup();
    bars.extend(kinds.iter().enumerate().map(|(index, &(units, dp_m))| {
        let of_wave = |wave: &PublishedWave| {
            let is_one = |one: &&Given| one.published.height_m == wave.height_m && kind(one) == (units, dp_m);
            let values: Vec<f64> = known.iter().filter(is_one).map(|one| here(one.run)).collect();
            // Not a number, and no bar, where there is none.
            values.iter().sum::<f64>() / values.len() as f64
        };
        let distance = short(1000.0 * dp_m, 2);
        Bars {
            name: format!("breakwater, {units} units, every {distance} mm"),
            values: waves().map(of_wave).collect(),
            colour: 1 + index,
            hollow: false,
        }
    }));
    BarChart {
        title: quantity.to_owned(),
        x_label: "wave height [cm]".to_owned(),
        y_label: quantity.to_owned(),
        groups: waves().map(|wave| short(100.0 * wave.height_m, 1)).collect(),
        bars,
        size: [920.0, 300.0],
        ..BarChart::default()
    }
    .svg()
}
