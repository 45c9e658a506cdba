//! Figures of the base cases: mean displacement, share of damaged units, convergence.

use breakwater::{
    case::{ReferenceWave, Series},
    report::{
        compare::RunResult,
        plot::{BarChart, Bars, Line, LineChart},
    },
};

use crate::{
    compared::{Compared, centimetres, millimetres},
    markdown::Page,
};

/// Adds the three figures to the page.
pub fn add(page: &mut Page, waves: &[&ReferenceWave], base: &[&Compared]) {
    let means = bars(waves, base, "mean displacement [m]", |_, series| series.mean_m(), |run| run.mean_m);
    let caption =
        "Mean displacement for each wave; hollow bars are values from the paper (experiment and published runs).";
    page.figure("fudo-means.svg", &means, caption);
    let damaged = |wave: &ReferenceWave, series: &Series| 100.0 * wave.damage_ratio(&series.displacement_m);
    let damage = bars(waves, base, "damaged units [%]", damaged, |run| 100.0 * run.damage_ratio);
    let caption =
        "Share of damaged units for each wave; hollow bars are values from the paper (experiment and published runs).";
    page.figure("fudo-damage.svg", &damage, caption);
    let caption = "Deviation of the mean displacement from the measured mean against the particle spacing.";
    page.figure("fudo-convergence.svg", &convergence(waves, base), caption);
}

fn bars(
    waves: &[&ReferenceWave],
    base: &[&Compared],
    quantity: &str,
    published: impl Fn(&ReferenceWave, &Series) -> f64,
    computed: impl Fn(&RunResult) -> f64,
) -> String {
    let series = waves.first().map_or(&[][..], |wave| &wave.series);
    let mut bars: Vec<Bars> = (series.iter().enumerate())
        .map(|(index, series)| Bars {
            name: series.name.clone(),
            values: waves.iter().map(|wave| published(wave, &wave.series[index])).collect(),
            colour: if series.is_measured() { 5 } else { 0 },
            hollow: true,
        })
        .collect();
    let mut spacings: Vec<f64> = base.iter().map(|result| result.dp_m()).collect();
    spacings.sort_by(|a, b| b.total_cmp(a));
    spacings.dedup();
    bars.extend(spacings.iter().enumerate().map(|(index, dp_m)| {
        let value = |wave: &&ReferenceWave| {
            let result = base.iter().find(|result| result.wave == *wave && result.dp_m() == *dp_m);
            result.map_or(f64::NAN, |result| computed(result.run))
        };
        Bars {
            name: format!("breakwater, {} mm", millimetres(*dp_m)),
            values: waves.iter().map(value).collect(),
            colour: 1 + index,
            hollow: false,
        }
    }));
    BarChart {
        title: quantity.to_owned(),
        x_label: "wave height [cm]".to_owned(),
        y_label: quantity.to_owned(),
        groups: waves.iter().map(|wave| centimetres(wave)).collect(),
        bars,
        size: [920.0, 300.0],
        ..BarChart::default()
    }
    .svg()
}

fn convergence(waves: &[&ReferenceWave], base: &[&Compared]) -> String {
    let mut lines = Vec::new();
    for (index, wave) in waves.iter().enumerate() {
        let height = centimetres(wave);
        let mut line = |name: &str, points: Vec<[f64; 2]>, dashed: bool| {
            let name = format!("{name}, {height} cm");
            lines.push(Line { name, points, colour: 1 + index, dashed, dots: true, ..Line::default() });
        };
        let results = base.iter().filter(|result| result.wave == *wave);
        line("breakwater", results.map(|one| [1000.0 * one.dp_m(), one.run.deviation_percent]).collect(), false);
        line(
            "published",
            wave.convergence.iter().map(|one| [1000.0 * one.dp_m, one.deviation_percent]).collect(),
            true,
        );
    }
    LineChart {
        title: "Deviation of the mean displacement against the particle spacing".to_owned(),
        x_label: "particle spacing [mm]".to_owned(),
        y_label: "deviation [%]".to_owned(),
        lines,
        marks: vec![(0.0, "measured".to_owned())],
        size: [920.0, 320.0],
    }
    .svg()
}
