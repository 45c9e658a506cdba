//! Page `wave.html` with charts of the wave in the flume model.

use std::path::{Path, PathBuf};

use super::plot::{Line, LineChart, escape, short};
use crate::{
    case::{Case, Quantity},
    waves::{external::surface::SurfaceSeries, flume_model::record::FlumeRecord, generation::ml_piston::MlPiston},
};
use crate::{
    output::{OutputError, write_atomically},
    report::page::page,
};

/// Writes `wave.html`: surface elevation at the gauges and along the flume, and motion of the multi-layer piston.
/// `beside` is the surface elevation at the gauges from another program, for comparison; it may be empty.
///
/// # Errors
/// If the file cannot be written.
pub fn write_wave_page(
    case: &Case,
    record: &FlumeRecord,
    piston: &MlPiston,
    beside: &[SurfaceSeries],
    dir: &Path,
) -> Result<PathBuf, OutputError> {
    let path = dir.join("wave.html");
    let lead = format!(
        "Flume model with {} layers; wavemaker of the particle domain at x = {} m, starting at flume time {} s",
        record.layers,
        short(piston.rest_x_m(), 3),
        short(piston.start_s(), 2)
    );
    let charts = [gauge_chart(case, record, beside), profile_chart(record), piston_chart(piston)];
    let figures: String = charts.iter().map(|chart| format!("<figure>{}</figure>\n", chart.svg())).collect();
    let body = format!("<h1>{}</h1>\n<p class=\"lead\">{lead}</p>\n{figures}", escape(&case.title));
    write_atomically(&path, page(&case.title, &body).as_bytes())?;
    Ok(path)
}

fn chart(title: &str, x_label: &str, y_label: &str, lines: Vec<Line>) -> LineChart {
    LineChart {
        title: title.to_owned(),
        x_label: x_label.to_owned(),
        y_label: y_label.to_owned(),
        lines,
        marks: Vec::new(),
        size: [860.0, 300.0],
    }
}

fn gauge_chart(case: &Case, record: &FlumeRecord, beside: &[SurfaceSeries]) -> LineChart {
    let gauges = case.gauges.iter().filter(|gauge| gauge.quantity == Quantity::Elevation);
    let mut lines: Vec<Line> = gauges
        .zip(&record.gauge_elevations_m)
        .enumerate()
        .map(|(colour, (gauge, eta))| Line {
            name: format!("{} at x = {} m", gauge.name, short(gauge.at[0], 2)),
            points: record.times_s().iter().zip(eta).map(|(t, eta)| [*t, *eta]).collect(),
            colour,
            ..Line::default()
        })
        .collect();
    lines.extend(beside.iter().enumerate().map(|(colour, series)| Line {
        name: if colour == 0 { "dashed lines: other program".to_owned() } else { String::new() },
        points: series.points().map(|[t, z]| [t, z - case.flume.still_water_level]).collect(),
        colour,
        dashed: true,
        ..Line::default()
    }));
    chart("Surface elevation at the gauges", "flume time [s]", "elevation \u{03b7} [m]", lines)
}

/// Chart of the surface elevation in the recorded part of the flume at five times: the time of the highest crest, and
/// 1 s and 2 s before and after this time.
fn profile_chart(record: &FlumeRecord) -> LineChart {
    let crest = |t: f64| record.window_x_m.iter().map(|&x| record.elevation(x, t)).fold(f64::MIN, f64::max);
    let highest = record.times_s().iter().copied().max_by(|a, b| crest(*a).total_cmp(&crest(*b))).unwrap_or(0.0);
    let moments = (-2..=2).map(|k| highest + f64::from(k)).filter(|t| (0.0..=record.end_s()).contains(t));
    let lines = moments.enumerate().map(|(colour, t)| Line {
        name: format!("{} s", short(t, 1)),
        points: record.window_x_m.iter().map(|&x| [x, record.elevation(x, t)]).collect(),
        colour,
        ..Line::default()
    });
    chart("Surface elevation along the flume", "x [m]", "elevation \u{03b7} [m]", lines.collect())
}

/// Chart of the displacement of three rows of the multi-layer piston: the lowest, a middle and the highest row.
fn piston_chart(piston: &MlPiston) -> LineChart {
    let heights = piston.row_heights_m();
    let samples = 200;
    let time = |k: i32| piston.start_s() + f64::from(k) / f64::from(samples) * (piston.end_s() - piston.start_s());
    let lines = [0, heights.len() / 2, heights.len() - 1].into_iter().enumerate().map(|(colour, row)| Line {
        name: format!("piston row at z = {} m", short(heights[row], 3)),
        points: (0..=samples).map(time).map(|t| [t, piston.displacement_m(row, t)]).collect(),
        colour,
        ..Line::default()
    });
    chart("Displacement of the multi-layer piston", "flume time [s]", "displacement [m]", lines.collect())
}
