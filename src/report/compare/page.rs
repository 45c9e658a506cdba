//! The comparison with measurements as an HTML page.

use super::super::plot::{BarChart, Bars, Line, LineChart, escape, short};
use super::{Comparison, WaveComparison};
use crate::{case::Series, report::page::page};

/// Returns the complete HTML page of a comparison.
pub fn html(comparison: &Comparison) -> String {
    let title = "Runs compared with measurements";
    let mut body = format!("<h1>{title}</h1>\n<p class=\"lead\">{}</p>\n", escape(&comparison.title));
    body += "<p>Displacement is the horizontal distance between initial and final position of a unit.</p>\n";
    comparison.waves.iter().for_each(|wave| body += &section(wave));
    body += &list(&comparison.notes);
    page(title, &body)
}

fn section(wave: &WaveComparison) -> String {
    let mut html = format!("<section>\n<h2>{}</h2>\n", wave.title());
    html += &format!("<div class=\"scroll\">{}</div>\n", means(wave));
    html += &format!("<figure>{}</figure>\n", units_chart(wave));
    html += &format!(
        "<figure>{}<figcaption>Mean displacement against the particle spacing. Dashed line: measured mean.\
         </figcaption></figure>\n",
        resolution_chart(wave)
    );
    html + &list(&wave.remarks()) + "</section>\n"
}

/// Returns the sentences as an HTML list, or an empty string without sentences.
fn list(sentences: &[String]) -> String {
    let items: String = sentences.iter().map(|sentence| format!("<li>{}</li>\n", escape(sentence))).collect();
    if items.is_empty() { items } else { format!("<ul>\n{items}</ul>\n") }
}

/// Table of mean displacement, damage ratio and deviation of every series and run.
fn means(wave: &WaveComparison) -> String {
    let reference = &wave.reference;
    let deviation = |percent: f64| format!("{percent:+.1}").replace('-', "\u{2212}");
    let spacing = |dp_m: f64| short(1000.0 * dp_m, 2);
    // Measurements have no value for breakage, because the units of a physical model do not break.
    let has_broken = wave.has_breakage();
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
    for series in &reference.series {
        let dp = series.dp_m.map(spacing).unwrap_or_default();
        let percent = wave.published_deviation_percent(series).map(deviation).unwrap_or_default();
        let damage = reference.damage_ratio(&series.displacement_m);
        rows += &row(&series.name, dp, reference.units(), series.mean_m(), damage, None, percent);
    }
    let (mean, ratio) = (reference.measured_mean_m(), reference.measured_damage_ratio());
    rows += &row("Mean of the measurements", String::new(), reference.units(), mean, ratio, None, String::new());
    for run in &wave.runs {
        let (dp, percent) = (spacing(run.summary.dp_m), deviation(run.deviation_percent));
        let broken = run.breakage.as_ref().map(|breakage| breakage.broken_ratio);
        let line = row(&run.name, dp, run.summary.units.len(), run.mean_m, run.damage_ratio, broken, percent);
        rows += &line.replacen("<tr>", "<tr class=\"sum\">", 1);
    }
    let broken = if has_broken { "<th>Broken [%]</th>" } else { "" };
    format!(
        "<table>\n<thead><tr><th>Series</th><th>Units</th><th>Particle spacing [mm]</th><th>Mean displacement [m]</th>\
         <th>Damaged [%]</th>{broken}<th>Deviation from the measured mean [%]</th></tr></thead>\n<tbody>\n{rows}</tbody></table>\n"
    )
}

/// Chart of the displacement of each unit: measured, published and computed.
fn units_chart(wave: &WaveComparison) -> String {
    let units = wave.units();
    let reference = |series: &Series| Bars {
        name: series.name.clone(),
        values: series.displacement_m.clone(),
        colour: if series.is_measured() { 5 } else { 0 },
        hollow: true,
    };
    let mut bars: Vec<Bars> = wave.reference.series.iter().map(reference).collect();
    bars.extend(wave.runs.iter().enumerate().map(|(index, run)| Bars {
        name: run.name.clone(),
        values: units.iter().map(|unit| wave.run_m(run, *unit).unwrap_or(f64::NAN)).collect(),
        colour: run_colour(index),
        hollow: false,
    }));
    let damage_distance_m = wave.reference.damage_distance_m;
    BarChart {
        title: "Displacement of each unit in experiment and simulation".to_owned(),
        x_label: "unit".to_owned(),
        y_label: "displacement [m]".to_owned(),
        groups: units.iter().map(ToString::to_string).collect(),
        bars,
        stacked: false,
        marks: vec![(damage_distance_m, format!("damage {damage_distance_m} m"))],
        size: [920.0, 340.0],
    }
    .svg()
}

/// Chart of the mean displacement against the particle spacing.
fn resolution_chart(wave: &WaveComparison) -> String {
    let measured = wave.reference.measured_mean_m();
    let point = |dp_m: f64, percent: f64| [1000.0 * dp_m, measured * (1.0 + 0.01 * percent)];
    let convergence = &wave.reference.convergence;
    let points: Vec<[f64; 2]> = convergence.iter().map(|r| point(r.dp_m, r.deviation_percent)).collect();
    let name = if points.is_empty() { "" } else { "published" };
    let mut lines = vec![Line { name: name.to_owned(), points, dots: true, colour: 0, ..Line::default() }];
    lines.extend(wave.runs.iter().enumerate().map(|(index, run)| Line {
        name: run.name.clone(),
        points: vec![[1000.0 * run.summary.dp_m, run.mean_m]],
        dots: true,
        colour: run_colour(index),
        ..Line::default()
    }));
    LineChart {
        title: "Mean displacement against the particle spacing".to_owned(),
        x_label: "particle spacing [mm]".to_owned(),
        y_label: "mean displacement [m]".to_owned(),
        lines,
        marks: vec![(measured, format!("measured {measured:.3} m"))],
        size: [920.0, 280.0],
    }
    .svg()
}

/// Returns the colour of a run; published series use other colours.
fn run_colour(index: usize) -> usize {
    [1, 2, 3, 4][index % 4]
}
