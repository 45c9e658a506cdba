//! Pixel image with a depth buffer, in which triangles and lines are drawn.

use super::View;
use super::image;

/// A colour: red, green and blue, each 0 to 1.
pub type Colour = [f32; 3];

/// Number of samples per pixel in each direction; the mean of the samples gives smooth edges.
const SAMPLES_PER_PIXEL: usize = 2;

/// An image with a depth buffer. Positions in the image are in the pixels of a [`View`] of the same size.
#[derive(Debug, Clone)]
pub struct Canvas {
    columns: usize,
    rows: usize,
    /// Colour of each sample, row by row from the upper left corner.
    pub colour: Vec<Colour>,
    /// Distance from the viewer for each sample [m]; infinite where nothing is drawn.
    pub depth: Vec<f64>,
}

impl Canvas {
    /// Creates an image of the size of a view, filled with the background colour `ground`.
    pub fn new(view: &View, ground: Colour) -> Self {
        let [columns, rows] = view.size.map(|length| length.round().max(1.0) as usize * SAMPLES_PER_PIXEL);
        Self { columns, rows, colour: vec![ground; columns * rows], depth: vec![f64::INFINITY; columns * rows] }
    }

    /// Calls `visit` with the index and the depth [m] of every sample in a triangle. Each corner consists of distance
    /// from the left edge [px], distance from the upper edge [px] and depth [m].
    pub fn visit(&self, corners: [[f64; 3]; 3], mut visit: impl FnMut(usize, f64)) {
        let [a, b, c] = corners
            .map(|[x, y, depth]| [x * SAMPLES_PER_PIXEL as f64 - 0.5, y * SAMPLES_PER_PIXEL as f64 - 0.5, depth]);
        let double = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if double == 0.0 || !double.is_finite() {
            return;
        }
        let span = |axis: usize, end: usize| {
            let low = a[axis].min(b[axis]).min(c[axis]).ceil().max(0.0);
            let high = (a[axis].max(b[axis]).max(c[axis]).floor() + 1.0).clamp(0.0, end as f64);
            low as usize..high as usize
        };
        for row in span(1, self.rows) {
            for column in span(0, self.columns) {
                let (x, y) = (column as f64, row as f64);
                let share = |p: [f64; 3], q: [f64; 3]| ((p[0] - x) * (q[1] - y) - (p[1] - y) * (q[0] - x)) / double;
                let (of_a, of_b, of_c) = (share(b, c), share(c, a), share(a, b));
                if of_a >= 0.0 && of_b >= 0.0 && of_c >= 0.0 {
                    visit(row * self.columns + column, of_a * a[2] + of_b * b[2] + of_c * c[2]);
                }
            }
        }
    }

    /// Draws a triangle, except where the image already shows something nearer to the viewer.
    pub fn fill(&mut self, corners: [[f64; 3]; 3], colour: Colour) {
        let (mut colours, mut depths) = (std::mem::take(&mut self.colour), std::mem::take(&mut self.depth));
        self.visit(corners, |sample, depth| {
            if depth < depths[sample] {
                (depths[sample], colours[sample]) = (depth, colour);
            }
        });
        (self.colour, self.depth) = (colours, depths);
    }

    /// Draws a line that is `width` px wide, with the opacity `strength` (0 to 1). Nothing is drawn where the image
    /// shows something that is nearer to the viewer by more than `hidden` [m].
    pub fn line(&mut self, [a, b]: [[f64; 3]; 2], width: f64, colour: Colour, strength: f32, hidden: f64) {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let length = dx.hypot(dy);
        if length == 0.0 {
            return;
        }
        let (nx, ny) = (-0.5 * width * dy / length, 0.5 * width * dx / length);
        let at = |p: [f64; 3], side: f64| [p[0] + side * nx, p[1] + side * ny, p[2]];
        let mut colours = std::mem::take(&mut self.colour);
        for corners in [[at(a, 1.0), at(b, 1.0), at(b, -1.0)], [at(a, 1.0), at(b, -1.0), at(a, -1.0)]] {
            self.visit(corners, |sample, depth| {
                if depth < self.depth[sample] + hidden {
                    colours[sample] = mixed(colours[sample], colour, strength);
                }
            });
        }
        self.colour = colours;
    }

    /// Returns the image as a PNG data URI.
    pub fn data_uri(&self) -> String {
        let (width, height) = (self.columns / SAMPLES_PER_PIXEL, self.rows / SAMPLES_PER_PIXEL);
        let mut bytes = Vec::with_capacity(3 * width * height);
        for row in 0..height {
            for column in 0..width {
                let mut sum = [0.0_f32; 3];
                for sample in 0..SAMPLES_PER_PIXEL * SAMPLES_PER_PIXEL {
                    let (y, x) = (
                        SAMPLES_PER_PIXEL * row + sample / SAMPLES_PER_PIXEL,
                        SAMPLES_PER_PIXEL * column + sample % SAMPLES_PER_PIXEL,
                    );
                    let of_sample = self.colour[y * self.columns + x];
                    sum.iter_mut().zip(of_sample).for_each(|(sum, part)| *sum += part);
                }
                let mean = |sum: f32| {
                    (sum / (SAMPLES_PER_PIXEL * SAMPLES_PER_PIXEL) as f32 * 255.0).round().clamp(0.0, 255.0) as u8
                };
                bytes.extend(sum.map(mean));
            }
        }
        image::data_uri(width as u32, height as u32, &bytes)
    }
}

/// Mixes two colours: returns `one` for share 0 and `other` for share 1.
pub fn mixed(one: Colour, other: Colour, share: f32) -> Colour {
    [0, 1, 2].map(|k| one[k] + share * (other[k] - one[k]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn nearer_triangles_and_lines_hide_farther_ones() {
        let view = View::along(DVec3::Y, [DVec3::ZERO, DVec3::ONE], [10.0, 10.0], 0.0);
        let mut canvas = Canvas::new(&view, [1.0; 3]);
        let triangle = |depth: f64| [[0.0, 0.0, depth], [10.0, 0.0, depth], [0.0, 10.0, depth]];
        canvas.fill(triangle(2.0), [1.0, 0.0, 0.0]);
        canvas.fill(triangle(1.0), [0.0, 1.0, 0.0]);
        canvas.fill(triangle(3.0), [0.0, 0.0, 1.0]);
        assert_eq!(canvas.colour[0], [0.0, 1.0, 0.0]);
        assert_eq!(canvas.colour[399], [1.0; 3]);
        // The triangle covers half of the 400 samples. Some of the samples on the edge of the triangle count, too.
        let mut inside = 0;
        canvas.visit(triangle(0.0), |_, _| inside += 1);
        assert!((190..=210).contains(&inside), "{inside}");
        // A line behind the triangle is hidden, a line in front of it is visible.
        canvas.line([[0.0, 2.0, 5.0], [6.0, 2.0, 5.0]], 2.0, [0.0; 3], 1.0, 0.0);
        assert_eq!(canvas.colour[4 * 20 + 4], [0.0, 1.0, 0.0]);
        canvas.line([[0.0, 2.0, 0.5], [6.0, 2.0, 0.5]], 2.0, [0.0; 3], 1.0, 0.0);
        assert_eq!(canvas.colour[4 * 20 + 4], [0.0; 3]);
    }
}
