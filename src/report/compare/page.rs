//! The comparison as a page.

use super::super::plot::{BarChart, Bars, Line, LineChart, escape, short};
use super::published::{DAMAGE_DISTANCE_M, MEASURED, SERIES};
use super::{Comparison, WaveComparison};
use crate::report::page::page;

/// The whole page.
pub fn html(comparison: &Comparison) -> String {
    let mut body = String::from(
        "<h1>Runs beside the experiment</h1>\n<p class=\"lead\">Tetrapods in one row on a PVC mound under solitary waves, \
         Mitsui et al. (2023)</p>\n<p>Displacement is the horizontal distance seen from above; a unit counts as damaged when \
         it has moved further than 0.077 m. EXP1 to EXP3 are the three repetitions in the flume, SPH1 and SPH2 the two \
         published simulations, which differ in how the units were turned.</p>\n",
    );
    for wave in &comparison.waves {
        body += &section(wave);
    }
    page("Runs beside the experiment", &body)
}

fn section(wave: &WaveComparison) -> String {
    let mut html = format!("<section>\n<h2>Solitary wave H = {:.1} cm</h2>\n", 100.0 * wave.published.height_m);
    html += &format!("<div class=\"scroll\">{}</div>\n", means(wave));
    html += &format!("<figure>{}</figure>\n", units_chart(wave));
    html += &format!(
        "<figure>{}<figcaption>Mean displacement against the distance between particles; the measured mean as a dashed \
         line. The published values are from the resolution study; its errors are read as \
         (EXP &minus; SPH1) / EXP, the sign that agrees with the appendix at 5 mm. So read, the coarse runs move the units \
         too little.</figcaption></figure>\n",
        resolution_chart(wave)
    );
    let remarks: String = wave.remarks().iter().map(|r| format!("<li>{}</li>\n", escape(r))).collect();
    if !remarks.is_empty() {
        html += &format!("<ul>\n{remarks}</ul>\n");
    }
    html + "</section>\n"
}

/// Mean, damage ratio and deviation of every series.
fn means(wave: &WaveComparison) -> String {
    let published = &wave.published;
    let deviation = |percent: f64| format!("{percent:+.1}").replace('-', "\u{2212}");
    // Nothing was published about breakage: units of the flume do not break.
    let has_broken = wave.tells_breakage();
    let row = |name: &str, dp: String, units: usize, mean: f64, damage: f64, broken: Option<f64>, deviation: String| {
        let name = escape(name);
        let broken = match broken {
            Some(ratio) => format!("<td>{:.0}</td>", 100.0 * ratio),
            None if has_broken => "<td></td>".to_owned(),
            None => String::new(),
        };
        format!(
            "<tr><td>{name}</td><td>{units}</td><td>{dp}</td><td>{mean:.3}</td><td>{:.0}</td>{broken}<td>{deviation}</td></tr>\n",
            100.0 * damage
        )
    };
    let mut rows = String::new();
    for (series, name) in SERIES.into_iter().enumerate() {
        let (dp, percent) = if series < MEASURED {
            (String::new(), String::new())
        } else {
            ("5".to_owned(), deviation(100.0 * (published.mean_m(series) / published.measured_mean_m() - 1.0)))
        };
        let damage = published.damage_ratio(series);
        rows += &row(name, dp, published.units(), published.mean_m(series), damage, None, percent);
    }
    let ratio = published.measured_damage_ratio();
    let exp = "EXP, mean of the repetitions";
    rows += &row(exp, String::new(), published.units(), published.measured_mean_m(), ratio, None, String::new());
    for run in &wave.runs {
        let dp = short(1000.0 * run.summary.dp_m, 2);
        let percent = deviation(run.deviation_percent);
        let broken = run.breakage.as_ref().map(|breakage| breakage.broken_ratio);
        let line = row(&run.name, dp, run.summary.units.len(), run.mean_m, run.damage_ratio, broken, percent);
        rows += &line.replacen("<tr>", "<tr class=\"sum\">", 1);
    }
    let broken = if has_broken { "<th>Broken [%]</th>" } else { "" };
    format!(
        "<table>\n<thead><tr><th>Series</th><th>Units</th><th>Distance between particles [mm]</th><th>Mean displacement [m]</th>\
         <th>Damaged [%]</th>{broken}<th>Deviation from EXP [%]</th></tr></thead>\n<tbody>\n{rows}</tbody></table>\n"
    )
}

/// Displacement of each unit, published and computed.
pub fn units_chart(wave: &WaveComparison) -> String {
    let places = wave.places();
    let mut bars: Vec<Bars> = (SERIES.into_iter().enumerate())
        .map(|(series, name)| Bars {
            name: name.to_owned(),
            values: wave.published.displacement_m[series].clone(),
            colour: if series < MEASURED { 5 } else { 0 },
            hollow: true,
        })
        .collect();
    bars.extend(wave.runs.iter().enumerate().map(|(index, run)| Bars {
        name: run.name.clone(),
        values: places.iter().map(|place| wave.run_m(run, *place).unwrap_or(f64::NAN)).collect(),
        colour: run_colour(index),
        hollow: false,
    }));
    BarChart {
        title: "Displacement of each unit in experiment and simulation".to_owned(),
        x_label: "unit".to_owned(),
        y_label: "displacement [m]".to_owned(),
        groups: places.iter().map(ToString::to_string).collect(),
        bars,
        stacked: false,
        marks: vec![(DAMAGE_DISTANCE_M, format!("damage {DAMAGE_DISTANCE_M} m"))],
        size: [920.0, 340.0],
    }
    .svg()
}

/// Mean displacement against the distance between particles.
pub fn resolution_chart(wave: &WaveComparison) -> String {
    let measured = wave.published.measured_mean_m();
    let point = |dp_m: f64, percent: f64| [1000.0 * dp_m, measured * (1.0 + 0.01 * percent)];
    let published = wave.published.convergence.iter().map(|r| point(r.dp_m, r.deviation_percent)).collect();
    let mut lines =
        vec![Line { name: "published, SPH1".to_owned(), points: published, dots: true, colour: 0, ..Line::default() }];
    lines.extend(wave.runs.iter().enumerate().map(|(index, run)| Line {
        name: run.name.clone(),
        points: vec![[1000.0 * run.summary.dp_m, run.mean_m]],
        dots: true,
        colour: run_colour(index),
        ..Line::default()
    }));
    LineChart {
        title: "Mean displacement against the distance between particles".to_owned(),
        x_label: "distance between particles [mm]".to_owned(),
        y_label: "mean displacement [m]".to_owned(),
        lines,
        marks: vec![(measured, format!("EXP {measured:.3} m"))],
        size: [920.0, 280.0],
    }
    .svg()
}

/// Colours of the runs: those that published series do not use.
fn run_colour(index: usize) -> usize {
    [1, 2, 3, 4][index % 4]
}
