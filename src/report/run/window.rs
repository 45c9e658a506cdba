//! Drawing of a part of the flume, with two axes at equal scale.

use super::super::plot::{Axis, escape, short};

/// Width of a drawing [px].
pub const WIDTH: f64 = 920.0;
/// Maximum height of a window [px].
const MAX_HEIGHT: f64 = 560.0;
/// Left margin, with the vertical axis, and right margin, with half of the last number of the horizontal axis [px].
const MARGINS: [f64; 2] = [58.0, 14.0];
/// Upper margin, with half of the last number of the vertical axis [px].
const TOP: f64 = 8.0;
/// Lower margin, with the horizontal axis [px].
const BELOW: f64 = 40.0;

/// A part of the flume, and the mapping from positions [m] to the drawing [px].
pub struct Window {
    /// Range of x along the flume [m].
    pub x: [f64; 2],
    /// Range of the vertical axis of the drawing: z or y [m].
    pub up: [f64; 2],
    /// Scale of both axes [px/m].
    pub scale: f64,
    left: f64,
}

impl Window {
    /// Creates the window for these ranges [m], with the largest scale at which the drawing fits.
    pub fn new(x: [f64; 2], up: [f64; 2]) -> Self {
        let room = WIDTH - MARGINS[0] - MARGINS[1];
        let scale = (room / (x[1] - x[0])).min(MAX_HEIGHT / (up[1] - up[0]));
        let left = MARGINS[0] + 0.5 * (room - scale * (x[1] - x[0]));
        Self { x, up, scale, left }
    }

    /// Maps a position in the flume [m] to the drawing [px].
    pub fn at(&self, x: f64, up: f64) -> [f64; 2] {
        [self.left + (x - self.x[0]) * self.scale, TOP + (self.up[1] - up) * self.scale]
    }

    /// Returns the left, top, right and bottom edge of the window in the drawing [px].
    pub fn edges(&self) -> [f64; 4] {
        let ([left, top], [right, bottom]) = (self.at(self.x[0], self.up[1]), self.at(self.x[1], self.up[0]));
        [left, top, right, bottom]
    }

    /// Returns true if a position [m] is in the window.
    pub fn holds(&self, x: f64, up: f64) -> bool {
        self.x[0] <= x && x <= self.x[1] && self.up[0] <= up && up <= self.up[1]
    }

    /// Height of the drawing with its axes [px].
    pub fn height(&self) -> f64 {
        self.edges()[3] + BELOW
    }

    /// Clips a drawing to the window and adds the axes. `id` names the clip path and must be unique on the page.
    pub fn framed(&self, id: &str, up_label: &str, drawing: &str) -> String {
        let [left, top, right, bottom] = self.edges();
        let (w, h) = (right - left, bottom - top);
        format!(
            "<clipPath id=\"{id}\"><rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{w:.1}\" height=\"{h:.1}\"/></clipPath>\
             <g clip-path=\"url(#{id})\">\n{drawing}</g>\n{}{}\n",
            self.axis_along(),
            self.axis_up(up_label)
        )
    }

    fn axis_along(&self) -> String {
        let [left, _, right, bottom] = self.edges();
        let axis = Axis::tight("", self.x, ((right - left) / 60.0) as usize);
        let mut svg = format!("<path class=\"axis\" d=\"M{left:.1} {bottom:.1}H{right:.1}\"/>");
        for tick in axis.ticks() {
            let x = self.at(tick, 0.0)[0];
            svg += &format!("<path class=\"axis\" d=\"M{x:.1} {bottom:.1}v5\"/>");
            svg += &label(x, bottom + 18.0, "tick mid", &axis.number(tick));
        }
        let words = "x along the flume [m], waves from the left";
        svg + &label(0.5 * (left + right), bottom + 35.0, "label mid", words)
    }

    fn axis_up(&self, words: &str) -> String {
        let [left, top, _, bottom] = self.edges();
        let axis = Axis::tight("", self.up, ((bottom - top) / 40.0) as usize);
        let mut svg = format!("<path class=\"axis\" d=\"M{left:.1} {top:.1}V{bottom:.1}\"/>");
        for tick in axis.ticks() {
            let y = self.at(0.0, tick)[1];
            svg += &format!("<path class=\"axis\" d=\"M{left:.1} {y:.1}h-5\"/>");
            svg += &label(left - 9.0, y + 4.0, "tick end", &axis.number(tick));
        }
        let (x, middle) = (left - 44.0, 0.5 * (top + bottom));
        let words = escape(words);
        svg + &format!(
            "<text class=\"label mid\" transform=\"translate({x:.1} {middle:.1}) rotate(-90)\">{words}</text>"
        )
    }
}

/// Returns a drawing of the full page width as an `<svg>` element.
pub fn svg(title: &str, height: f64, content: &str) -> String {
    let title = escape(title);
    format!(
        "<svg class=\"view\" viewBox=\"0 0 {WIDTH} {height:.0}\" role=\"img\" aria-label=\"{title}\"><title>{title}</title>\n\
         {content}</svg>\n"
    )
}

/// Returns a text label at x, y [px] for a drawing; `class` is its CSS class.
pub fn label(x: f64, y: f64, class: &str, words: &str) -> String {
    format!("<text class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\">{}</text>", escape(words))
}

/// Formats a point of the drawing [px] as SVG path data.
pub fn path_point([x, y]: [f64; 2]) -> String {
    format!("{} {}", short(x, 1).replace('\u{2212}', "-"), short(y, 1).replace('\u{2212}', "-"))
}
