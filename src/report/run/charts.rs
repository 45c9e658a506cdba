//! Charts in the report of a flume run.

use super::super::plot::{BarChart, Bars, Line, LineChart, escape, short};
use super::folder::RunFolder;
use super::motion::{UnitMotion, mean_and_deviation};
use crate::output::Table;

/// Size of a full-width chart [px].
const WIDE: [f64; 2] = [920.0, 300.0];
/// Size of a chart with half the width of the page, so that two charts are side by side [px].
const HALF: [f64; 2] = [452.0, 250.0];
/// If a chart has at most this number of units, each unit has its own colour. Otherwise all odd units have one colour
/// and all even units another colour.
const COLOURED_UNITS: usize = 6;
/// If a chart has more units, it shows their mean and their extremes instead of one line per unit.
const MOST_LINES: usize = 40;

/// Bar chart of the displacement of each unit, with damage distance and mean displacement.
pub fn displacements(run: &RunFolder) -> String {
    let summary = &run.summary;
    if summary.units.is_empty() {
        return String::new();
    }
    let heights = |damaged: bool| -> Vec<f64> {
        summary.units.iter().map(|u| if u.damaged == damaged { u.displacement_m } else { f64::NAN }).collect()
    };
    let mut marks = Vec::new();
    if let Some(distance) = summary.damage_distance_m {
        marks.push((distance, format!("damage distance {} m", short(distance, 3))));
    }
    if let Some(mean) = summary.mean_displacement_m {
        marks.push((mean, format!("mean {} m", short(mean, 3))));
    }
    let bar_set = |name: &str, damaged: bool, colour: usize| Bars {
        name: name.to_owned(),
        values: heights(damaged),
        colour,
        ..Bars::default()
    };
    BarChart {
        title: "Displacement of each unit".to_owned(),
        x_label: "unit".to_owned(),
        y_label: "displacement [m]".to_owned(),
        groups: summary.units.iter().map(|u| u.unit.to_string()).collect(),
        bars: vec![bar_set("damaged", true, 1), bar_set("not damaged", false, 0)],
        stacked: true,
        marks,
        size: WIDE,
    }
    .svg()
}

/// Line chart of the shoreward displacement of each unit over time.
pub fn paths(run: &RunFolder) -> String {
    let shoreward = |motion: &UnitMotion| -> Vec<[f64; 2]> {
        let start = motion.position_m.first().map_or(0.0, |p| p[0]);
        motion.time_s.iter().zip(&motion.position_m).map(|(t, p)| [*t, p[0] - start]).collect()
    };
    let lines = if run.motions.len() > MOST_LINES {
        mean_and_extremes(&run.motions, shoreward)
    } else {
        unit_lines(&run.motions, shoreward)
    };
    line_chart("Shoreward displacement of the units", "x \u{2212} x(0) [m]", lines, WIDE)
}

/// Returns the mean over the units with a band of the standard deviation, and the two units that end furthest apart.
fn mean_and_extremes(motions: &[UnitMotion], points: impl Fn(&UnitMotion) -> Vec<[f64; 2]>) -> Vec<Line> {
    let all: Vec<Vec<[f64; 2]>> = motions.iter().map(points).collect();
    let end = |points: &[[f64; 2]]| points.last().map_or(0.0, |point| point[1]);
    let number = |index: usize| format!("unit {}", motions[index].unit);
    let order = |a: &usize, b: &usize| end(&all[*a]).total_cmp(&end(&all[*b]));
    let extremes = [(0..all.len()).min_by(order), (0..all.len()).max_by(order)];
    let mut lines: Vec<Line> = (extremes.into_iter().flatten().zip([2, 1]))
        .map(|(index, colour)| Line { name: number(index), points: all[index].clone(), colour, ..Line::default() })
        .collect();
    let values: Vec<Vec<f64>> = all.iter().map(|points| points.iter().map(|point| point[1]).collect()).collect();
    let (mean, band) = mean_and_deviation(&values);
    let points = all.first().into_iter().flatten().zip(mean).map(|(point, value)| [point[0], value]).collect();
    lines.push(Line { name: "mean of all units".to_owned(), points, colour: 0, band, ..Line::default() });
    lines
}

/// Returns one line per unit, with colours as described at [`COLOURED_UNITS`].
fn unit_lines(motions: &[UnitMotion], points: impl Fn(&UnitMotion) -> Vec<[f64; 2]>) -> Vec<Line> {
    let few = motions.len() <= COLOURED_UNITS;
    let mut lines: Vec<Line> = Vec::new();
    for (index, motion) in motions.iter().enumerate() {
        let odd = motion.unit % 2 == 1;
        let name = match (few, index) {
            (true, _) => format!("unit {}", motion.unit),
            (false, 0 | 1) => if odd { "odd units" } else { "even units" }.to_owned(),
            (false, _) => String::new(),
        };
        let colour = if few { index } else { usize::from(!odd) };
        lines.push(Line { name, points: points(motion), colour, ..Line::default() });
    }
    lines
}

/// Charts of the horizontal water force, the vertical water force and the contact force. Each shows the mean over the
/// units and, if there are few units, each unit. If there are many, a band shows the standard deviation.
pub fn forces(run: &RunFolder) -> [String; 3] {
    let force = |title: &str, label: &str, colour: usize, histories: Vec<Vec<f64>>, size| {
        let Some(first) = run.motions.first() else { return String::new() };
        let with_time = |values: &[f64]| first.time_s.iter().zip(values).map(|(t, v)| [*t, *v]).collect::<Vec<_>>();
        let (mean, deviation) = mean_and_deviation(&histories);
        let mut lines = Vec::new();
        if histories.len() > 1 && histories.len() <= COLOURED_UNITS {
            lines.extend(histories.iter().map(|h| Line {
                points: with_time(h),
                colour: 5,
                faint: true,
                ..Line::default()
            }));
            lines[0].name = "individual units".to_owned();
        }
        let name = if histories.len() > 1 { "mean of all units" } else { "unit" };
        let band = if histories.len() > COLOURED_UNITS { deviation } else { Vec::new() };
        lines.push(Line { name: name.to_owned(), points: with_time(&mean), colour, band, ..Line::default() });
        line_chart(title, label, lines, size)
    };
    let change = |component: usize| run.motions.iter().map(|m| m.fluid_change_n(component)).collect::<Vec<_>>();
    [
        force("Horizontal force of the water", "\u{0394}Fx [N]", 0, change(0), HALF),
        force("Vertical force of the water", "\u{0394}Fz [N]", 2, change(2), HALF),
        force(
            "Contact force",
            "contact force [N]",
            1,
            run.motions.iter().map(UnitMotion::contact_size_n).collect(),
            WIDE,
        ),
    ]
}

/// Returns one chart per elevation gauge (particles and flume model), then one chart per pressure or velocity gauge.
pub fn gauges(run: &RunFolder) -> Vec<String> {
    let mut names: Vec<&str> = Vec::new();
    for table in [&run.gauges, &run.flume_gauges].into_iter().flatten() {
        for name in table.names().iter().filter(|n| n.ends_with("_eta_m")) {
            if !names.contains(&name.as_str()) {
                names.push(name);
            }
        }
    }
    let position = |gauge: &str| run.summary.gauges.iter().find(|g| g.name == gauge).map(|g| g.x_m);
    let mut charts: Vec<String> = Vec::new();
    for name in names {
        let gauge = name.trim_end_matches("_eta_m");
        let mut lines = Vec::new();
        let particles = column_line(run.gauges.as_ref(), name, "particles", 0, false);
        let shown = shown_time(run.gauges.as_ref(), particles.is_some());
        lines.extend(column_line(run.flume_gauges.as_ref(), name, "flume model", 5, true).map(|mut line| {
            line.points.retain(|p| shown[0] <= p[0] && p[0] <= shown[1]);
            line
        }));
        lines.extend(particles);
        let at = position(gauge).map_or(String::new(), |x| format!(" at x = {} m", short(x, 3)));
        let chart = line_chart(&format!("{gauge}{at}"), "elevation \u{03b7} [m]", lines, HALF);
        charts.push(format!("<figure><figcaption>{}{at}</figcaption>{chart}</figure>", escape(gauge)));
    }
    charts.extend(other_gauges(run.gauges.as_ref()));
    charts
}

/// Time range in which a gauge chart shows the flume model [s]: the time range of the particles, extended by half its
/// length on both sides. If the gauge is outside the particle domain: all times before the end of the run.
fn shown_time(particles: Option<&Table>, at_gauge: bool) -> [f64; 2] {
    let times = particles.and_then(|table| table.get("time_s")).unwrap_or_default();
    let (Some(start), Some(end)) = (times.first(), times.last()) else { return [f64::MIN, f64::MAX] };
    let extension = 0.5 * (end - start);
    if at_gauge { [start - extension, end + extension] } else { [f64::MIN, *end] }
}

/// Charts of the pressure and velocity gauges.
fn other_gauges(table: Option<&Table>) -> Vec<String> {
    let Some(table) = table else { return Vec::new() };
    let mut charts = Vec::new();
    let figure =
        |chart: String, name: &str| format!("<figure><figcaption>{}</figcaption>{chart}</figure>", escape(name));
    for column in table.names() {
        if let Some(gauge) = column.strip_suffix("_p_pa") {
            let mean = column_line(Some(table), &format!("{gauge}_p_mean_pa"), "mean since the last row", 1, false);
            let lines = column_line(Some(table), column, "at the time", 0, false).into_iter().chain(mean).collect();
            charts.push(figure(line_chart(gauge, "pressure [Pa]", lines, HALF), gauge));
        } else if let Some(gauge) = column.strip_suffix("_fx_n") {
            let lines =
                [("along the flume", "fx", 0), ("upwards", "fz", 2)].into_iter().filter_map(|(name, part, colour)| {
                    column_line(Some(table), &format!("{gauge}_{part}_n"), name, colour, false)
                });
            charts.push(figure(line_chart(gauge, "force of the water [N]", lines.collect(), HALF), gauge));
        } else if let Some(gauge) = column.strip_suffix("_u_m_s") {
            let lines = [("u", 0), ("v", 2), ("w", 1)].into_iter().filter_map(|(component, colour)| {
                column_line(Some(table), &format!("{gauge}_{component}_m_s"), component, colour, false)
            });
            charts.push(figure(line_chart(gauge, "velocity [m/s]", lines.collect(), HALF), gauge));
        }
    }
    charts
}

fn column_line(table: Option<&Table>, column: &str, name: &str, colour: usize, dashed: bool) -> Option<Line> {
    let table = table?;
    let (times, values) = (table.get("time_s")?, table.get(column)?);
    let points = times.iter().zip(values).map(|(t, v)| [*t, *v]).collect();
    Some(Line { name: name.to_owned(), points, colour, dashed, ..Line::default() })
}

/// Chart of the change of each energy in `energy.csv` since the start, over time.
pub fn energy(run: &RunFolder) -> String {
    let Some(table) = &run.energy else { return String::new() };
    let lines: Vec<Line> = (table.names().iter().filter(|n| n.ends_with("_j")).enumerate())
        .filter_map(|(index, column)| {
            let name = column.trim_end_matches("_j").replace('_', " ");
            let mut line = column_line(Some(table), column, &name, index, false)?;
            let first = line.points.first().map_or(0.0, |p| p[1]);
            line.points.iter_mut().for_each(|p| p[1] -= first);
            Some(line)
        })
        .collect();
    line_chart("Change in energy", "change in energy [J]", lines, WIDE)
}

fn line_chart(title: &str, y_label: &str, lines: Vec<Line>, size: [f64; 2]) -> String {
    LineChart {
        title: title.to_owned(),
        x_label: "flume time [s]".to_owned(),
        y_label: y_label.to_owned(),
        lines,
        marks: Vec::new(),
        size,
    }
    .svg()
}
