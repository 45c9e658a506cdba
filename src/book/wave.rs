//! The section of the page on one wave height.

use super::{
    assumed,
    entry::Entry,
    friction,
    markdown::{Page, signed},
    standing,
};
use crate::report::{
    compare::{PublishedWave, RunResult, WaveComparison},
    plot::{Line, LineChart, short},
};

/// Size of a chart [px].
const SIZE: [f64; 2] = [920.0, 320.0];

/// Adds what a wave did in the experiment, in the published simulations and in the runs.
pub fn add_section(page: &mut Page, wave: &WaveComparison, entries: &[Entry]) {
    let centimetres = format!("{:.1}", 100.0 * wave.published.height_m);
    let of = |run: &RunResult| entries.iter().find(|entry| entry.name == run.name);
    let all: Vec<(&RunResult, &Entry)> = wave.runs.iter().filter_map(|run| Some((run, of(run)?))).collect();
    // What moves with something else than the experiment had is no test against what was measured.
    let runs: Vec<_> = all.iter().copied().filter(|(_, entry)| assumed::is_as_given(entry)).collect();
    let as_given = runs.iter().map(|(run, _)| (*run).clone()).collect();
    let wave = &WaveComparison { published: wave.published.clone(), runs: as_given };
    let again = Entry::again(runs.iter().map(|(_, entry)| *entry));
    page.heading(2, &format!("Solitary wave of {centimetres} cm"));
    add_means(page, wave);
    add_units(page, wave, &centimetres, &again);
    let file = format!("fudo-{centimetres}-resolution.svg");
    page.figure(
        &file,
        &wave.resolution_chart(),
        "Mean displacement against the distance between particles; the published study (Tables 5 and 6, Fig. 16 of the paper) and \
         the runs, the measured mean dashed. The paper does not say which sign its errors have: here they are taken such that \
         they agree with its appendix at 5 mm, which means that its coarse runs move the units too little.",
        &again,
    );
    if let Some((run, entry)) = runs.iter().min_by(|a, b| a.0.summary.dp_m.total_cmp(&b.0.summary.dp_m)) {
        add_series(page, run, entry, &centimetres);
    }
    friction::add(page, &wave.published, &all, &centimetres);
    let of_friction: Vec<_> = all.iter().copied().filter(|(_, entry)| friction::is_measured(entry)).collect();
    assumed::add(page, &of_friction, &centimetres);
    standing::add(page, &all, &centimetres);
}

/// Means, damage ratios and deviations: Tables 3, 4 and 6 of the paper.
fn add_means(page: &mut Page, wave: &WaveComparison) {
    let head = [
        "series",
        "units",
        "particles every [mm]",
        "mean displacement [m]",
        "damaged [%]",
        "(mean \u{2212} EXP) / EXP [%]",
        "the same for the 13 inner units [%]",
    ];
    let published = &wave.published;
    let percent = |value: f64| short(100.0 * value, 0);
    let mut rows = Vec::new();
    for (series, name) in PublishedWave::SERIES.into_iter().enumerate() {
        let deviation = 100.0 * (published.mean_m(series) / published.measured_mean_m() - 1.0);
        let is_measured = PublishedWave::is_measured(series);
        rows.push(vec![
            name.to_owned(),
            published.units().to_string(),
            if is_measured { String::new() } else { "5".to_owned() },
            format!("{:.3}", published.mean_m(series)),
            percent(published.damage_ratio(series)),
            if is_measured { String::new() } else { signed(deviation) },
            String::new(),
        ]);
    }
    rows.push(vec![
        "EXP, mean of the three".to_owned(),
        published.units().to_string(),
        String::new(),
        format!("{:.3}", published.measured_mean_m()),
        percent(published.measured_damage_ratio()),
        String::new(),
        String::new(),
    ]);
    for run in &wave.runs {
        rows.push(vec![
            run.name.clone(),
            run.summary.units.len().to_string(),
            short(1000.0 * run.summary.dp_m, 2),
            format!("{:.3}", run.mean_m),
            percent(run.damage_ratio),
            signed(run.deviation_percent),
            if run.is_slice_of(published) { signed(run.inner_deviation_percent) } else { String::new() },
        ]);
    }
    page.table(&head.map(str::to_owned), &rows);
}

/// Displacement of every unit: Tables A1 to A3 and Fig. 12.
fn add_units(page: &mut Page, wave: &WaveComparison, centimetres: &str, again: &str) {
    page.figure(
        &format!("fudo-{centimetres}-units.svg"),
        &wave.units_chart(),
        "Displacement of each unit (Tables A1 to A3, Fig. 12 of the paper); hollow: published.",
        again,
    );
    let mut head = vec!["unit".to_owned()];
    head.extend(PublishedWave::SERIES.map(str::to_owned));
    head.extend(wave.runs.iter().map(|run| run.name.clone()));
    page.table(&head, &wave.displacement_rows());
}

/// Water at the gauges and force on the units of the finest run: Figs. 8 and 14.
fn add_series(page: &mut Page, run: &RunResult, entry: &Entry, centimetres: &str) {
    let chart = |title: &str, y_label: &str, lines: Vec<Line>| {
        let (title, y_label) = (title.to_owned(), y_label.to_owned());
        LineChart { title, x_label: "flume time [s]".to_owned(), y_label, lines, size: SIZE, ..LineChart::default() }
            .svg()
    };
    let again = Entry::again([entry]);
    let line = |name: String, column: &str, colour: usize, dashed: bool| {
        Some(Line { name, points: entry.points(column)?, colour, dashed, ..Line::default() })
    };
    let in_domain = |gauge: &str| {
        entry.points(&format!("{gauge}_eta_m")).is_some_and(|points| points.iter().any(|point| point[1].is_finite()))
    };
    let gauges = || entry.gauges().filter(|gauge| in_domain(gauge)).enumerate();
    let water: Vec<Line> = gauges()
        .filter_map(|(colour, gauge)| line(gauge.to_owned(), &format!("{gauge}_eta_m"), colour, false))
        .chain(gauges().filter_map(|(colour, gauge)| {
            line(format!("{gauge}, flume model"), &format!("{gauge}.flume_eta_m"), colour, true)
        }))
        .collect();
    if !water.is_empty() {
        page.figure(
            &format!("fudo-{centimetres}-gauges.svg"),
            &chart("Water level at the gauges", "above still water [m]", water),
            &format!(
                "Water level at the gauges of `{}`, dashed by the model of the flume, in which no units lie. (Fig. 8 of the paper \
                 has the measured series, which were not published as numbers.)",
                run.name
            ),
            &again,
        );
    }
    let of_units = |what: &str| -> Vec<Line> {
        let units = 1..=run.summary.units.len();
        units.filter_map(|k| line(format!("unit {k}"), &format!("unit_{k}_{what}"), k - 1, false)).collect()
    };
    page.figure(
        &format!("fudo-{centimetres}-forces.svg"),
        &chart("Force of the water on the units", "force towards the shore [N]", of_units("fx_n")),
        &format!(
            "Force of the water on the units of `{}` towards the shore (as Fig. 14 of the paper), means over the interval of the \
             series.",
            run.name
        ),
        &again,
    );
    page.figure(
        &format!("fudo-{centimetres}-moved.svg"),
        &chart("Displacement of the units", "displacement [m]", of_units("moved_m")),
        &format!("Displacement of the units of `{}`.", run.name),
        &again,
    );
}
