//! Line, bar and tornado charts as SVG: inline in a page, which has the style sheet, or as files with style sheet.
//!
//! The CSS classes `c0` to `c5` are the colours of the palette. The palette suits colour-blind readers (Okabe & Ito
//! 2008) and differs between light and dark pages.

mod axis;
mod bar;
mod line;
mod tornado;

pub use axis::Axis;
pub use bar::{BarChart, Bars};
pub use line::{Line, LineChart};
pub use tornado::{TornadoChart, TornadoInput};

/// Style sheet of the charts, with the palettes for light and dark pages.
pub const CHART_STYLE: &str = include_str!("chart.css");
/// Number of colours in the palette.
pub const COLOURS: usize = 6;
/// Left edge of the plot area [px].
const LEFT: f64 = 58.0;
/// Estimated largest width of a letter [px].
const LETTER: f64 = 7.2;

/// Formats a number with at most `decimals` decimals, without trailing zeros and with the Unicode minus sign.
pub fn short(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.replace('-', "\u{2212}") }
}

/// Escapes text for HTML and SVG.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// Turns a chart into a self-contained SVG file with style sheet and background.
pub fn standalone(chart: &str) -> String {
    let letters = "\"Source Sans 3\", \"Segoe UI\", \"Helvetica Neue\", Helvetica, Arial, \"DejaVu Sans\", sans-serif";
    let style = format!(
        "<style>\n{CHART_STYLE}text {{ font-family: {letters}; }} .paper {{ fill: var(--paper); }}\n</style>\n\
         <rect class=\"paper\" width=\"100%\" height=\"100%\"/>\n"
    );
    let size = chart.split("viewBox=\"0 0 ").nth(1).and_then(|rest| rest.split('"').next()).unwrap_or("920 320");
    let (width, height) = size.split_once(' ').unwrap_or((size, size));
    let head = format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" ");
    let opened = chart.replacen("<svg ", &head, 1);
    opened.replacen("</title>\n", &format!("</title>\n{style}"), 1)
}

/// The plot area of a chart [px].
#[derive(Debug, Clone)]
struct Frame {
    width: f64,
    height: f64,
    left: f64,
    right: f64,
    top: f64,
    bottom: f64,
}

impl Frame {
    /// Creates a frame with space for the legend above the plot area and for the labels of `marks` to its right.
    fn new([width, height]: [f64; 2], legend: &[&str], marks: &[(f64, String)]) -> Self {
        let words = marks.iter().map(|(_, words)| words.chars().count()).max();
        let right = width - words.map_or(14.0, |letters| 18.0 + LETTER * letters as f64);
        let rows = legend_rows(width, legend);
        Self { width, height, left: LEFT, right, top: 14.0 + 20.0 * rows as f64, bottom: height - 42.0 }
    }

    fn x(&self, axis: &Axis, value: f64) -> f64 {
        self.left + (self.right - self.left) * axis.share(value)
    }

    fn y(&self, axis: &Axis, value: f64) -> f64 {
        self.bottom - (self.bottom - self.top) * axis.share(value)
    }

    fn open(&self, title: &str) -> String {
        let title = escape(title);
        let (w, h) = (self.width, self.height);
        format!(
            "<svg class=\"chart\" viewBox=\"0 0 {w} {h}\" role=\"img\" aria-label=\"{title}\"><title>{title}</title>\n"
        )
    }

    /// Draws the horizontal grid lines with their values, and the label of the vertical axis.
    fn vertical_axis(&self, axis: &Axis) -> String {
        let mut svg = String::new();
        for tick in axis.ticks() {
            let y = self.y(axis, tick);
            let class = if tick == 0.0 { "zero" } else { "grid" };
            svg += &format!("<path class=\"{class}\" d=\"M{:.1} {y:.1}H{:.1}\"/>", self.left, self.right);
            svg += &text(self.left - 7.0, y + 4.0, "tick end", &axis.number(tick));
        }
        let middle = 0.5 * (self.top + self.bottom);
        svg += &format!(
            "<text class=\"label mid\" transform=\"translate(14 {middle:.1}) rotate(-90)\">{}</text>\n",
            escape(&axis.label)
        );
        svg
    }

    /// Draws the horizontal axis with ticks, values and label.
    fn horizontal_axis(&self, axis: &Axis) -> String {
        let mut svg = format!("<path class=\"axis\" d=\"M{:.1} {:.1}H{:.1}\"/>", self.left, self.bottom, self.right);
        for tick in axis.ticks() {
            let x = self.x(axis, tick);
            svg += &format!("<path class=\"axis\" d=\"M{x:.1} {:.1}v5\"/>", self.bottom);
            svg += &text(x, self.bottom + 18.0, "tick mid", &axis.number(tick));
        }
        svg += &self.horizontal_label(&axis.label);
        svg
    }

    fn horizontal_label(&self, label: &str) -> String {
        text(0.5 * (self.left + self.right), self.height - 6.0, "label mid", label) + "\n"
    }

    /// Draws the legend entries from left to right above the plot area. An entry is a name and the SVG of its sample.
    /// The sample is up to 22 px wide and starts at x = 0.
    fn legend(&self, entries: &[(String, String)]) -> String {
        let (mut x, mut y, mut svg) = (self.left, 14.0, String::new());
        for (name, sample) in entries {
            let width = legend_width(name);
            if x + width > self.width && x > self.left {
                (x, y) = (self.left, y + 20.0);
            }
            svg += &format!("<g transform=\"translate({x:.1} {y:.1})\">{sample}</g>");
            svg += &text(x + 27.0, y + 4.0, "legend", name);
            x += width;
        }
        svg + "\n"
    }
}

/// Number of rows of the legend in a chart of this width [px].
fn legend_rows(width: f64, names: &[&str]) -> usize {
    let (mut x, mut rows) = (LEFT, usize::from(!names.is_empty()));
    for name in names {
        let needed = legend_width(name);
        if x + needed > width && x > LEFT {
            (x, rows) = (LEFT, rows + 1);
        }
        x += needed;
    }
    rows
}

/// Width of a legend entry [px], estimated from the number of letters.
fn legend_width(name: &str) -> f64 {
    44.0 + LETTER * name.chars().count() as f64
}

fn text(x: f64, y: f64, class: &str, words: &str) -> String {
    format!("<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\">{}</text>", escape(words))
}

/// Draws horizontal lines with labels to the right of the plot area. Labels that would overlap are moved apart.
fn marks(frame: &Frame, axis: &Axis, marks: &[(f64, String)]) -> String {
    let mut sorted: Vec<(f64, &str)> = marks.iter().map(|(v, words)| (frame.y(axis, *v), words.as_str())).collect();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut svg, mut free_from) = (String::new(), f64::NEG_INFINITY);
    for (y, words) in sorted {
        let at = y.max(free_from);
        free_from = at + 15.0;
        svg += &format!("<path class=\"mark\" d=\"M{:.1} {y:.1}H{:.1}\"/>", frame.left, frame.right + 4.0);
        svg += &text(frame.right + 8.0, at + 4.0, "note", words);
    }
    svg
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_have_no_trailing_zeros_and_text_is_escaped() {
        assert_eq!(short(0.2500, 3), "0.25");
        assert_eq!(short(-1.5, 1), "\u{2212}1.5");
        assert_eq!(short(-0.0001, 2), "0");
        assert_eq!(short(1200.0, 0), "1200");
        assert_eq!(escape("H < 0.1 & \"d\""), "H &lt; 0.1 &amp; &quot;d&quot;");
    }

    #[test]
    fn a_standalone_chart_contains_its_style_sheet() {
        let lines = vec![Line { name: "a".to_owned(), points: vec![[0.0, 1.0], [1.0, 2.0]], ..Line::default() }];
        let file = standalone(&LineChart { lines, size: [400.0, 300.0], ..LineChart::default() }.svg());
        assert!(
            file.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"400\" height=\"300\" class=\"chart\"")
        );
        assert!(file.contains("--c0:") && file.contains(".line {") && file.matches("<style>").count() == 1);
    }
}
