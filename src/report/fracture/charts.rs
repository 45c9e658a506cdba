//! Energy book and crack area against time.

use super::folder::FractureFolder;
use super::moments::main_cracks;
use crate::report::plot::{Line, LineChart};

/// A chart over the whole width [px].
const WIDE: [f64; 2] = [920.0, 380.0];
/// One below it [px].
const LOW: [f64; 2] = [920.0, 220.0];

/// Columns of the energy book: name in the legend, colour, dashed.
const TERMS: [(&str, &str, usize, bool); 10] = [
    ("kinetic_j", "motion", 0, false),
    ("strain_j", "strain", 2, false),
    ("joints_j", "in joints", 2, true),
    ("contact_j", "in contacts", 5, false),
    ("gravity_j", "height", 5, true),
    ("viscous_j", "lost by viscosity", 4, false),
    ("fracture_j", "lost by fracture", 1, false),
    ("friction_j", "lost by friction", 3, false),
    ("work_j", "given by what holds or moves", 0, true),
    ("freed_j", "released by faces that let go", 1, true),
];

/// All terms of the energy book; those that are zero throughout are left out.
pub fn energy(run: &FractureFolder) -> String {
    chart(run, "Energy book", "energy [J]", terms(run, |_| true), WIDE)
}

/// What was lost, on a scale of its own, with what faces released.
pub fn losses(run: &FractureFolder) -> String {
    let is_loss = |column: &str| ["viscous_j", "fracture_j", "friction_j", "freed_j"].contains(&column);
    chart(run, "Energy lost", "energy [J]", terms(run, is_loss), LOW)
}

fn terms(run: &FractureFolder, of: impl Fn(&str) -> bool) -> Vec<Line> {
    let shown = TERMS.into_iter().filter(|(column, ..)| of(column));
    let lines = shown.filter_map(|(column, name, colour, dashed)| {
        let line = Line { name: name.to_owned(), colour, dashed, ..of_column(run, column)? };
        line.points.iter().any(|p| p[1] != 0.0).then_some(line)
    });
    lines.collect()
}

/// What the energy book leaves unexplained.
pub fn residual(run: &FractureFolder) -> String {
    let lines = of_column(run, "residual_j").map(|line| Line { colour: 5, ..line });
    chart(run, "Residual of the energy book", "residual [J]", lines.into_iter().collect(), LOW)
}

/// Area of the cracks, with dots where the main ones began.
pub fn crack_area(run: &FractureFolder) -> String {
    let Some(mut area) = of_column(run, "crack_area_m2") else { return String::new() };
    area.points.iter_mut().for_each(|point| point[1] *= 1e4);
    area.name = "area of the cracks".to_owned();
    area.colour = 0;
    let at = |time: f64| area.points.iter().find(|p| p[0] >= time).map_or(0.0, |p| p[1]);
    let begins = main_cracks(&run.summary.initiation).into_iter().map(|number| {
        let time = run.clock_ms(run.summary.initiation[number - 1].t_s);
        [time, at(time)]
    });
    let dots = Line { name: String::new(), points: begins.collect(), colour: 1, dots: true, ..Line::default() };
    // Of a line of single dots nothing but the dots may be seen.
    let dots = dots.points.iter().map(|point| Line { points: vec![*point], ..dots.clone() });
    let mut lines: Vec<Line> = vec![area.clone()];
    lines.extend(dots);
    if let Some(first) = lines.get_mut(1) {
        first.name = "one of the main cracks begins".to_owned();
    }
    chart(run, "Area of the cracks", "crack area [cm\u{b2}]", lines, LOW)
}

fn of_column(run: &FractureFolder, column: &str) -> Option<Line> {
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
