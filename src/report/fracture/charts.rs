//! Charts of the energy balance and the crack area over time.

use super::folder::FractureFolder;
use super::moments::main_cracks;
use crate::report::plot::{Line, LineChart};

/// Size of a full-width chart [px].
const WIDE: [f64; 2] = [920.0, 380.0];
/// Size of a low full-width chart [px].
const LOW: [f64; 2] = [920.0, 220.0];

/// Terms of the energy balance: column of `energy.csv`, name in the legend, colour, true for a dashed line.
const TERMS: [(&str, &str, usize, bool); 10] = [
    ("kinetic_j", "kinetic", 0, false),
    ("strain_j", "elastic strain", 2, false),
    ("joints_j", "stored in joints", 2, true),
    ("contact_j", "stored in contacts", 5, false),
    ("gravity_j", "gravity", 5, true),
    ("viscous_j", "viscous dissipation", 4, false),
    ("fracture_j", "fracture dissipation", 1, false),
    ("friction_j", "friction dissipation", 3, false),
    ("work_j", "work of constraints and loads", 0, true),
    ("freed_j", "released by tied joints", 1, true),
];

/// Chart of all terms of the energy balance that are not always zero.
pub fn energy(run: &FractureFolder) -> String {
    chart(run, "Energy balance", "energy [J]", terms(run, |_| true), WIDE)
}

/// Chart of the dissipated energy and of the energy released by tied joints, with its own vertical scale.
pub fn losses(run: &FractureFolder) -> String {
    let is_loss = |column: &str| ["viscous_j", "fracture_j", "friction_j", "freed_j"].contains(&column);
    chart(run, "Dissipated energy", "energy [J]", terms(run, is_loss), LOW)
}

fn terms(run: &FractureFolder, is_shown: impl Fn(&str) -> bool) -> Vec<Line> {
    let shown = TERMS.into_iter().filter(|(column, ..)| is_shown(column));
    let lines = shown.filter_map(|(column, name, colour, dashed)| {
        let line = Line { name: name.to_owned(), colour, dashed, ..column_line(run, column)? };
        line.points.iter().any(|p| p[1] != 0.0).then_some(line)
    });
    lines.collect()
}

/// Chart of the residual of the energy balance.
pub fn residual(run: &FractureFolder) -> String {
    let lines = column_line(run, "residual_j").map(|line| Line { colour: 5, ..line });
    chart(run, "Residual of the energy balance", "residual [J]", lines.into_iter().collect(), LOW)
}

/// Chart of the crack area, with a dot at the start of each main crack.
pub fn crack_area(run: &FractureFolder) -> String {
    let Some(mut area) = column_line(run, "crack_area_m2") else { return String::new() };
    area.points.iter_mut().for_each(|point| point[1] *= 1e4);
    area.name = "crack area".to_owned();
    area.colour = 0;
    let area_at = |time: f64| area.points.iter().find(|p| p[0] >= time).map_or(0.0, |p| p[1]);
    let begins = main_cracks(&run.summary.initiation).into_iter().map(|number| {
        let time = run.clock_ms(run.summary.initiation[number - 1].t_s);
        [time, area_at(time)]
    });
    let dots = Line { name: String::new(), points: begins.collect(), colour: 1, dots: true, ..Line::default() };
    // Each dot is a separate `Line`, so that no line connects the dots.
    let dots = dots.points.iter().map(|point| Line { points: vec![*point], ..dots.clone() });
    let mut lines: Vec<Line> = vec![area.clone()];
    lines.extend(dots);
    if let Some(first) = lines.get_mut(1) {
        first.name = "start of a main crack".to_owned();
    }
    chart(run, "Crack area", "crack area [cm\u{b2}]", lines, LOW)
}

fn column_line(run: &FractureFolder, column: &str) -> Option<Line> {
    let table = run.energy.as_ref()?;
    let (times, values) = (table.get("time_s")?, table.get(column)?);
    let points = times.iter().zip(values).map(|(t, v)| [run.clock_ms(*t), *v]).collect();
    Some(Line { points, ..Line::default() })
}

fn chart(run: &FractureFolder, title: &str, y_label: &str, lines: Vec<Line>, size: [f64; 2]) -> String {
    if lines.is_empty() {
        return String::new();
    }
    LineChart {
        title: title.to_owned(),
        x_label: format!("{} [ms]", run.clock_name()),
        y_label: y_label.to_owned(),
        lines,
        marks: Vec::new(),
        size,
    }
    .svg()
}
