//! Charts as inline SVG: a frame with axes, lines or bars in it, colours from the page's style sheet.
//!
//! Colours are the classes `c0` to `c5`; the style sheet gives them a palette that colour-blind readers can tell apart
//! (Okabe & Ito 2008) and that differs between light and dark pages.

mod axis;
mod bar;
mod line;

pub use axis::Axis;
pub use bar::{BarChart, Bars};
pub use line::{Line, LineChart};

/// Number of colours in the palette.
pub const COLOURS: usize = 6;

/// A length with at most `decimals` figures after the point, without trailing zeros, with a true minus sign.
pub fn short(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.replace('-', "\u{2212}") }
}

/// Text that may stand in HTML and SVG.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// The plot area inside the picture [px], and the two axes that map into it.
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
    fn new(width: f64, height: f64, legend_rows: usize) -> Self {
        let top = 14.0 + 20.0 * legend_rows as f64;
        Self { width, height, left: 58.0, right: width - 14.0, top, bottom: height - 42.0 }
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

    /// Horizontal grid lines with their numbers, and the label of the vertical axis above them.
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

    /// Numbers and label of the horizontal axis.
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

    /// Legend entries from left to right above the plot area; each is a name and the SVG of its sample, drawn to the
    /// right of the origin within 22 px.
    fn legend(&self, entries: &[(String, String)]) -> String {
        let (mut x, mut y, mut svg) = (self.left, 14.0, String::new());
        for (name, sample) in entries {
            let width = legend_width(name);
            if x + width > self.right + 10.0 && x > self.left {
                (x, y) = (self.left, y + 20.0);
            }
            svg += &format!("<g transform=\"translate({x:.1} {y:.1})\">{sample}</g>");
            svg += &text(x + 27.0, y + 4.0, "legend", name);
            x += width;
        }
        svg + "\n"
    }

    /// Rows that a legend needs in a picture of this width.
    fn legend_rows(width: f64, names: &[&str]) -> usize {
        let (left, right) = (58.0, width - 14.0);
        let (mut x, mut rows) = (left, usize::from(!names.is_empty()));
        for name in names {
            let width = legend_width(name);
            if x + width > right + 10.0 && x > left {
                (x, rows) = (left, rows + 1);
            }
            x += width;
        }
        rows
    }
}

/// Width of a legend entry [px], estimated from the number of letters.
fn legend_width(name: &str) -> f64 {
    44.0 + 6.9 * name.chars().count() as f64
}

fn text(x: f64, y: f64, class: &str, words: &str) -> String {
    format!("<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\">{}</text>", escape(words))
}

/// A horizontal line at `value` with words at its right end.
fn mark(frame: &Frame, axis: &Axis, value: f64, words: &str) -> String {
    let y = frame.y(axis, value);
    format!("<path class=\"mark\" d=\"M{:.1} {y:.1}H{:.1}\"/>", frame.left, frame.right)
        + &text(frame.right, y - 5.0, "note end halo", words)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short_and_text_is_safe() {
        assert_eq!(short(0.2500, 3), "0.25");
        assert_eq!(short(-1.5, 1), "\u{2212}1.5");
        assert_eq!(short(-0.0001, 2), "0");
        assert_eq!(short(1200.0, 0), "1200");
        assert_eq!(escape("H < 0.1 & \"d\""), "H &lt; 0.1 &amp; &quot;d&quot;");
    }
}
