//! Line charts.

use super::{Axis, Frame, marks, text};

/// One line of a chart.
#[derive(Debug, Clone, Default)]
pub struct Line {
    /// Name in the legend; if it is empty, the legend has no entry.
    pub name: String,
    /// Points in the units of the axes; values that are not finite interrupt the line.
    pub points: Vec<[f64; 2]>,
    /// Index in the colour palette.
    pub colour: usize,
    /// True for a dashed line, false for a solid line.
    pub dashed: bool,
    /// True for a thin and pale line, for charts with many lines.
    pub faint: bool,
    /// True if each point has a dot.
    pub dots: bool,
    /// Half height of a shaded band around the line, in the unit of y, one value per point. If empty, there is no band.
    pub band: Vec<f64>,
}

/// A line chart. The vertical axis always includes zero.
#[derive(Debug, Clone, Default)]
pub struct LineChart {
    /// Title of the chart for screen readers; the title is not drawn.
    pub title: String,
    /// Label of the horizontal axis: quantity and unit.
    pub x_label: String,
    /// Label of the vertical axis: quantity and unit.
    pub y_label: String,
    /// The lines, drawn in this order.
    pub lines: Vec<Line>,
    /// Horizontal lines: value and label.
    pub marks: Vec<(f64, String)>,
    /// Width and height of the chart [px].
    pub size: [f64; 2],
}

impl LineChart {
    /// Returns the chart as an `<svg>` element.
    pub fn svg(&self) -> String {
        let [width, height] = self.size;
        let named = || self.lines.iter().filter(|line| !line.name.is_empty());
        let names: Vec<&str> = named().map(|line| line.name.as_str()).collect();
        let frame = Frame::new(self.size, &names, &self.marks);
        let points = || self.lines.iter().flat_map(|line| &line.points);
        let x = Axis::tight(&self.x_label, points().map(|p| p[0]), (width / 90.0) as usize);
        let with_band = self
            .lines
            .iter()
            .flat_map(|line| line.points.iter().zip(&line.band).flat_map(|(p, half)| [p[1] - half, p[1] + half]));
        let values = points().map(|p| p[1]).chain(with_band).chain(self.marks.iter().map(|m| m.0)).chain([0.0]);
        let y = Axis::round(&self.y_label, values, (height / 55.0) as usize);

        let mut svg = frame.open(&self.title);
        svg += &frame.vertical_axis(&y);
        svg += &frame.horizontal_axis(&x);
        for line in &self.lines {
            svg += &band(&frame, &x, &y, line);
        }
        for line in &self.lines {
            svg += &format!("<path class=\"{}\" d=\"{}\"/>\n", class(line), path(&frame, &x, &y, &line.points));
        }
        svg += &marks(&frame, &y, &self.marks);
        for line in self.lines.iter().filter(|line| line.dots) {
            for point in &line.points {
                let (px, py) = (frame.x(&x, point[0]), frame.y(&y, point[1]));
                let colour = line.colour % super::COLOURS;
                svg += &format!("<circle class=\"dot c{colour}\" cx=\"{px:.1}\" cy=\"{py:.1}\" r=\"4.5\"/>");
            }
        }
        let entries: Vec<(String, String)> = named().map(|line| (line.name.clone(), sample(line))).collect();
        svg += &frame.legend(&entries);
        if points().next().is_none() {
            svg += &text(0.5 * width, 0.5 * height, "note mid", "no values");
        }
        svg + "</svg>\n"
    }
}

/// Returns the SVG sample that the legend shows for a line.
fn sample(line: &Line) -> String {
    if line.points.len() == 1 && line.dots {
        return format!("<circle class=\"dot c{}\" cx=\"12\" cy=\"0\" r=\"4.5\"/>", line.colour % super::COLOURS);
    }
    format!("<path class=\"{}\" d=\"M0 0H22\"/>", class(line))
}

fn class(line: &Line) -> String {
    let dashed = if line.dashed { " dashed" } else { "" };
    let faint = if line.faint { " faint" } else { "" };
    format!("line c{}{dashed}{faint}", line.colour % super::COLOURS)
}

/// Path data of a line. In each column of half a pixel, only the first, lowest, highest and last point are kept.
fn path(frame: &Frame, x: &Axis, y: &Axis, points: &[[f64; 2]]) -> String {
    let mut data = String::new();
    for piece in points.split(|p| !(p[0].is_finite() && p[1].is_finite())).filter(|piece| !piece.is_empty()) {
        let pixels: Vec<[f64; 2]> = piece.iter().map(|p| [frame.x(x, p[0]), frame.y(y, p[1])]).collect();
        let mut command = 'M';
        for column in pixels.chunk_by(|a, b| (2.0 * a[0]).floor() == (2.0 * b[0]).floor()) {
            for [px, py] in thinned(column) {
                data += &format!("{command}{px:.1} {py:.1}");
                command = 'L';
            }
        }
    }
    data
}

fn thinned(column: &[[f64; 2]]) -> Vec<[f64; 2]> {
    if column.len() <= 4 {
        return column.to_vec();
    }
    let by_height = |a: &usize, b: &usize| column[*a][1].total_cmp(&column[*b][1]);
    let indices = 0..column.len();
    let lowest = indices.clone().min_by(by_height).unwrap_or(0);
    let highest = indices.max_by(by_height).unwrap_or(0);
    let mut kept = vec![0, lowest, highest, column.len() - 1];
    kept.sort_unstable();
    kept.dedup();
    kept.into_iter().map(|i| column[i]).collect()
}

/// Returns the shaded band around a line as SVG.
fn band(frame: &Frame, x: &Axis, y: &Axis, line: &Line) -> String {
    if line.band.is_empty() {
        return String::new();
    }
    let edge = |sign: f64| -> Vec<[f64; 2]> {
        line.points.iter().zip(&line.band).map(|(p, half)| [p[0], p[1] + sign * half]).collect()
    };
    let mut lower = edge(-1.0);
    lower.reverse();
    let outline = path(frame, x, y, &edge(1.0)) + &path(frame, x, y, &lower).replacen('M', "L", 1);
    format!("<path class=\"band c{}\" d=\"{outline}Z\"/>\n", line.colour % super::COLOURS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_line_is_thinned_but_keeps_its_peak() {
        let mut points: Vec<[f64; 2]> = (0..100_000).map(|i| [f64::from(i) * 1e-3, 0.0]).collect();
        points[54_321][1] = 7.0;
        let chart =
            LineChart { lines: vec![Line { points, ..Line::default() }], size: [600.0, 240.0], ..LineChart::default() };
        let svg = chart.svg();
        assert!(svg.len() < 60_000, "{}", svg.len());
        let frame = Frame::new([600.0, 240.0], &[], &[]);
        let peak = frame.y(&Axis::round("", [0.0, 7.0], 4), 7.0);
        assert!(svg.contains(&format!(" {peak:.1}L")), "the peak is drawn");
    }

    #[test]
    fn missing_values_interrupt_a_line() {
        let points = vec![[0.0, 1.0], [1.0, 2.0], [2.0, f64::NAN], [3.0, 1.0], [4.0, 0.0]];
        let chart =
            LineChart { lines: vec![Line { points, ..Line::default() }], size: [600.0, 240.0], ..LineChart::default() };
        let svg = chart.svg();
        let line = svg.lines().find(|l| l.contains("class=\"line")).unwrap();
        assert_eq!(line.matches('M').count(), 2);
        assert!(!svg.contains("NaN"));
    }
}
