//! The page: summary, table, figures, sensitivity, and the command that repeats a run.

use breakwater::{
    case::ReferenceWave,
    report::{
        compare::{Comparison, RunResult},
        plot::short,
    },
};

use crate::{
    change::{BED, COUNT, SCHEME, changes, open_ends},
    compared::{Compared, centimetres, millimetres},
    dependence, figures,
    friction::{self, Published},
    kept_run::KeptRun,
    markdown::{Page, joined, signed},
};

/// File name of the page.
pub const FILE: &str = "fudo.md";

/// Last generated line of the page. Text below this line is kept when the page is written again.
pub const END: &str = "<!-- Generated up to here; text below this line is kept. -->";

/// Largest deviation of a mean displacement that counts as agreement [%]. Repeated measurements scatter by less than
/// half as much.
const MISSED_PERCENT: f64 = 10.0;

/// Builds the page from the compared runs.
pub fn page(comparison: &Comparison, runs: &[KeptRun], frictions: &[Published]) -> Page {
    let case_of = |run: &RunResult| runs.iter().find(|kept| kept.name == run.name).map(|kept| &kept.case);
    let mut results: Vec<Compared> = Vec::new();
    for of_wave in &comparison.waves {
        let wave = &of_wave.reference;
        results.extend(of_wave.runs.iter().map(|run| Compared {
            wave,
            run,
            changes: case_of(run).map(changes).unwrap_or_default(),
            open_ends: case_of(run).and_then(open_ends),
        }));
    }
    let mut base: Vec<&Compared> = results.iter().filter(|result| result.changes.is_empty()).collect();
    // The slices with the default scheme; then the same together with the rows of fifteen units.
    let by_default_scheme = |result: &&Compared, with_rows: bool| {
        let mut keys = result.changes.iter().map(|change| change.key.as_str());
        keys.clone().any(|key| key == SCHEME)
            && keys.all(|key| [BED, SCHEME].contains(&key) || (with_rows && key == COUNT))
    };
    let [mut predicted, mut with_rows] = [false, true]
        .map(|with_rows| results.iter().filter(|result| by_default_scheme(result, with_rows)).collect::<Vec<_>>());
    for compared in [&mut base, &mut predicted, &mut with_rows] {
        compared.sort_by(|a, b| a.wave.height_m.total_cmp(&b.wave.height_m).then(b.dp_m().total_cmp(&a.dp_m())));
    }
    let waves: Vec<&ReferenceWave> = comparison.waves.iter().map(|wave| &wave.reference).collect();

    let mut page = Page::default();
    page.add(&format!("# Validation: {}", comparison.title));
    page.add(&verdict(&waves, &predicted));
    page.add(
        "The runs of breakwater with two units between periodic sides represent the inner units of the row of fifteen.\n\
         They use the default scheme, `low_dissipation`; none of its constants was chosen by a displacement.\n\
         The published runs were made with DualSPHysics and Project Chrono, for all fifteen units and the same particle spacing.\n\
         A unit is damaged when it has moved further than its height, 0.077 m.",
    );
    add_table(&mut page, &with_rows);
    figures::add(&mut page, &waves, &predicted);
    friction::add(&mut page, &waves, &results, frictions);
    if !base.is_empty() {
        page.add("## With the scheme of the published runs");
        page.add(
            "These runs use `numerics.scheme` = `mitsui_2023`. Their whole bed is PVC, like the mound. In the runs above, the \
             bed next to the mound is mortar, as in the experiment.",
        );
        add_table(&mut page, &base);
    }
    dependence::add(&mut page, &waves, &results);
    page.add("## Repeat a run");
    page.add(
        "The cases of all runs are in `tools/validation/runs`. The first command repeats a run; the second command adds its \
         results to this page:",
    );
    let name = base.last().map_or("RUN", |result| &result.run.name);
    page.add(&format!(
        "    cargo run --release -- run tools/validation/runs/{name}/case.json --out runs/{name}\n    \
         cargo run --release -p validation -- runs/{name}"
    ));
    page.add(END);
    page
}

/// Summary in words: deviations of the mean displacement at the published particle spacings, waves with a deviation of
/// more than [`MISSED_PERCENT`], and shares of damaged units.
fn verdict(waves: &[&ReferenceWave], predicted: &[&Compared]) -> String {
    let of_wave = |wave: &ReferenceWave| -> Vec<&Compared> {
        let is_published = |dp_m: f64| wave.convergence.iter().any(|other| (other.dp_m - dp_m).abs() < 1e-9);
        predicted.iter().filter(|result| result.wave == wave && is_published(result.dp_m())).copied().collect()
    };
    let (mut deviations, mut missed, mut damaged, mut measured) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for wave in waves {
        let results = of_wave(wave);
        let Some(finest) = results.last() else { continue };
        let percents: Vec<f64> = results.iter().map(|result| result.run.deviation_percent).collect();
        let word = |result: &&Compared| {
            format!("{} % ({} mm)", signed(result.run.deviation_percent), millimetres(result.dp_m()))
        };
        let words: Vec<String> = results.iter().map(word).collect();
        let name = format!("the {} cm wave", centimetres(wave));
        deviations.push(format!("by {} for {name}", joined(&words)));
        let side = match percents.iter().copied().reduce(|a, b| if a.abs() > b.abs() { a } else { b }) {
            Some(percent) if percent < -MISSED_PERCENT => Some(("unsafe", "less", -percent)),
            Some(percent) if percent > MISSED_PERCENT => Some(("safe", "more", percent)),
            _ => None,
        };
        missed.extend(side.map(|(side, than, percent)| {
            format!(
                "for {name}, breakwater is on the {side} side: the units move up to {} % {than} than measured",
                short(percent, 1)
            )
        }));
        damaged.push(short(100.0 * finest.run.damage_ratio, 0));
        measured.push(short(100.0 * wave.measured_damage_ratio(), 0));
    }
    if deviations.is_empty() {
        return "No run with the default scheme has a published particle spacing.".to_owned();
    }
    let missed = if missed.is_empty() {
        format!("no mean displacement deviates by more than {MISSED_PERCENT} %")
    } else {
        joined(&missed)
    };
    format!(
        "The mean displacement deviates from the measured mean {} (particle spacings in brackets).\n{}{}.\n\
         For these waves, each at its finest spacing, {} % of the units are damaged in breakwater, and {} % in the \
         experiment.",
        joined(&deviations),
        missed[..1].to_uppercase(),
        &missed[1..],
        joined(&damaged),
        joined(&measured)
    )
}

fn add_table(page: &mut Page, base: &[&Compared]) {
    let head = [
        "wave height [cm]",
        "particle spacing [mm]",
        "open ends at x [m]",
        "units",
        "measured [m]",
        "breakwater [m]",
        "deviation of breakwater [%]",
        "measured, inner units [m]",
        "deviation from the inner units [%]",
        "deviation of the published run [%]",
        "damaged, measured / breakwater [%]",
    ];
    let row = |result: &&Compared| {
        let (wave, run) = (result.wave, result.run);
        let published = wave.convergence.iter().find(|other| (other.dp_m - result.dp_m()).abs() < 1e-9);
        let percent = |ratio: f64| short(100.0 * ratio, 0);
        let of_slice = |text: String| if run.is_slice_of(wave) { text } else { String::new() };
        vec![
            centimetres(wave),
            millimetres(result.dp_m()),
            result.open_ends.map(|ends| ends.map(|x| format!("{x:.2}")).join(" to ")).unwrap_or_default(),
            run.summary.units.len().to_string(),
            format!("{:.3}", wave.measured_mean_m()),
            format!("{:.3}", run.mean_m),
            signed(run.deviation_percent),
            of_slice(format!("{:.3}", wave.measured_inner_mean_m())),
            of_slice(signed(run.inner_deviation_percent)),
            published.map(|published| signed(published.deviation_percent)).unwrap_or_default(),
            format!("{} / {}", percent(wave.measured_damage_ratio()), percent(run.damage_ratio)),
        ]
    };
    page.table(&head.map(str::to_owned), &base.iter().map(row).collect::<Vec<_>>());
    page.add(
        "Columns in m give mean displacements; deviations are relative to the measured mean. The inner units of the \
         experiment are those that do not stand at a side wall; only runs with two units are compared with them. There \
         are no published runs at 14 mm. Without open ends, the domain is from 36.5 to 41 m and has a wavemaker.",
    );
}
