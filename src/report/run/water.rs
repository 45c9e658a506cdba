//! Water particles of one vertical slice along the flume, drawn as dots coloured by speed.

use std::collections::BTreeSet;

use super::super::plot::Axis;
use super::window::{Window, label};
use crate::report::film::DENSE;

/// Colours from slow to fast water, dark at high speed.
const COLOURS: [&str; 10] = DENSE;
/// Half the thickness of the slab [particle spacings]. In still water, the slab contains one layer of particles; in
/// mixed water, it contains only a few more.
const HALF_SLAB: f64 = 0.75;
/// Diameter of a dot [particle spacings].
const DOT: f64 = 0.95;
/// Minimum distance between dots [px]. If particles are closer together, only one of them is drawn.
const LEAST_DISTANCE: f64 = 2.0;
/// Share of the particles whose speed is within the colour scale [-]. The faster particles get the last colour.
const SHARE_IN_SCALE: f64 = 0.995;

/// A water particle in the slab, drawn as a dot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dot {
    /// Position along the flume [m].
    pub x: f64,
    /// Elevation z [m].
    pub z: f64,
    /// Speed [m/s].
    pub speed: f64,
}

/// A vertical slab of water along the flume, 1.5 particle spacings thick.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slab {
    /// y of the middle plane of the slab [m].
    pub y: f64,
    /// Particle spacing [m].
    pub spacing: f64,
}

impl Slab {
    /// Returns the slab around the particle layer nearest to the middle of the flume. The first layer is half a
    /// particle spacing from the side y = 0.
    pub fn in_the_middle(width: f64, spacing: f64) -> Self {
        Self { y: ((0.5 * width / spacing).floor() + 0.5) * spacing, spacing }
    }

    /// Returns half the thickness of the slab [m].
    pub fn half(&self) -> f64 {
        HALF_SLAB * self.spacing
    }

    /// Returns the particles that are in the slab and between two positions along the flume, `x` [m].
    pub fn dots(&self, points_m: &[[f32; 3]], velocity_m_s: &[[f32; 3]], x: [f64; 2]) -> Vec<Dot> {
        let inside = |p: &[f64; 3]| (p[1] - self.y).abs() < self.half() && x[0] <= p[0] && p[0] <= x[1];
        (points_m.iter().zip(velocity_m_s))
            .map(|(point, velocity)| (point.map(f64::from), velocity.map(f64::from)))
            .filter(|(point, _)| inside(point))
            .map(|([x, _, z], v)| Dot { x, z, speed: v.iter().map(|c| c * c).sum::<f64>().sqrt() })
            .collect()
    }
}

/// Colour scale of the water speed: equal intervals from zero to a round number, one colour per interval.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedScale {
    top: f64,
}

impl SpeedScale {
    /// Returns a scale that covers the speeds of at least the share `SHARE_IN_SCALE` of the dots of each moment.
    pub fn holding<'a>(moments: impl IntoIterator<Item = &'a [Dot]>) -> Self {
        let fast = |dots: &[Dot]| {
            let mut speeds: Vec<f64> = dots.iter().map(|dot| dot.speed).filter(|speed| speed.is_finite()).collect();
            speeds.sort_by(f64::total_cmp);
            speeds.get((SHARE_IN_SCALE * speeds.len() as f64) as usize).copied().unwrap_or(0.0)
        };
        Self { top: round_up(moments.into_iter().map(fast).fold(0.0, f64::max)) }
    }

    fn level(&self, speed: f64) -> usize {
        ((speed / self.top * COLOURS.len() as f64) as usize).min(COLOURS.len() - 1)
    }

    /// Draws the dots inside the window, one SVG path per colour. Fast dots are drawn over slow dots.
    pub fn drawing(&self, dots: &[Dot], window: &Window, spacing: f64) -> String {
        let distance = spacing * window.scale;
        let cell = distance.max(LEAST_DISTANCE);
        let mut taken = BTreeSet::new();
        let mut levels: [BTreeSet<[i64; 3]>; COLOURS.len()] = Default::default();
        for dot in dots.iter().filter(|dot| window.holds(dot.x, dot.z)) {
            let [x, y] = window.at(dot.x, dot.z);
            let place = [(y / cell) as i64, (x / cell) as i64];
            if distance < LEAST_DISTANCE && !taken.insert(place) {
                continue;
            }
            // Coordinates are in tenths of a pixel. The dots are sorted by row, so that the steps between dots are
            // short.
            let [tx, ty] = [x, y].map(|c| (10.0 * c).round() as i64);
            levels[self.level(dot.speed)].insert([place[0], tx, ty]);
        }
        let paths = levels.iter().zip(COLOURS).filter(|(dots, _)| !dots.is_empty());
        let paths: String =
            paths.map(|(dots, colour)| format!("<path stroke=\"{colour}\" d=\"{}\"/>\n", steps(dots))).collect();
        let width = 10.0 * DOT * cell;
        format!(
            "<g fill=\"none\" stroke-linecap=\"round\" stroke-width=\"{width:.0}\" transform=\"scale(.1)\">\n{paths}</g>\n"
        )
    }

    /// Draws the legend of the scale, 46 px high; `[x, y]` is the upper left corner [px].
    pub fn legend(&self, [x, y]: [f64; 2], width: f64) -> String {
        let step = width / COLOURS.len() as f64;
        let axis = Axis::tight("", [0.0, self.top], 8);
        let mut svg = label(x, y + 11.0, "label", "water speed [m/s]");
        for (level, colour) in COLOURS.into_iter().enumerate() {
            let left = x + step * level as f64;
            svg += &format!(
                "<rect x=\"{left:.1}\" y=\"{:.1}\" width=\"{step:.1}\" height=\"11\" fill=\"{colour}\"/>",
                y + 17.0
            );
        }
        for tick in axis.ticks() {
            svg += &label(x + width * axis.share(tick), y + 42.0, "tick mid", &axis.number(tick));
        }
        svg + "\n"
    }
}

/// SVG path data of the dots: lines of zero length, each positioned relative to the previous dot. A dot is [row, x, y],
/// with x and y in tenths of a pixel.
fn steps(dots: &BTreeSet<[i64; 3]>) -> String {
    let (mut data, mut from) = (String::new(), [0, 0]);
    for [_, x, y] in dots {
        let (dx, dy) = (x - from[0], y - from[1]);
        // The minus sign of dy separates the two numbers, so that no blank is needed.
        data += &if dy < 0 { format!("m{dx}{dy}h0") } else { format!("m{dx} {dy}h0") };
        from = [*x, *y];
    }
    data
}

/// Rounds up to the next round number, for the end of a scale; returns at least 0.01.
pub fn round_up(value: f64) -> f64 {
    let value = value.max(0.01);
    let power = 10_f64.powf(value.log10().floor());
    let rounds = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    power * rounds.into_iter().find(|round| round * power >= value * (1.0 - 1e-9)).unwrap_or(10.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slab_contains_one_layer_of_particles_at_rest() {
        // There are 12 layers across 0.06 m, and the middle of the flume is between two layers.
        let slab = Slab::in_the_middle(0.06, 0.005);
        let layers = (0..12).map(|i| 0.005 * (f64::from(i) + 0.5));
        assert_eq!(layers.filter(|y| (y - slab.y).abs() < slab.half()).count(), 1);
    }

    #[test]
    fn dots_are_relative_steps_in_tenths_of_a_pixel() {
        let window = Window::new([0.0, 1.0], [0.0, 0.2]);
        let dot = |x: f64, speed: f64| Dot { x, z: 0.1, speed };
        let dots = [dot(0.5, 0.0), dot(0.52, 0.0), dot(0.54, 0.0), dot(0.56, 0.9), dot(7.0, 0.0)];
        let scale = SpeedScale::holding([&dots[..4]]);
        assert_eq!(scale.top, 1.0);
        let svg = scale.drawing(&dots, &window, 0.02);
        // The scale is 848 px per metre, so the distance of 0.02 m is 17 px.
        assert!(svg.contains(&format!("stroke=\"{}\" d=\"m4820 928h0m170 0h0m169 0h0\"", COLOURS[0])), "{svg}");
        assert!(svg.contains(COLOURS[9]) && svg.matches("h0").count() == 4);
        // Of two particles closer than two pixels, only one is drawn.
        assert_eq!(scale.drawing(&[dot(0.5, 0.0), dot(0.5005, 0.0)], &window, 5e-4).matches("h0").count(), 1);
    }

    #[test]
    fn the_speed_scale_ends_at_a_round_number() {
        for (value, expected) in [(0.0, 0.01), (0.113, 0.12), (1.0, 1.0), (1.3, 1.5), (0.91, 1.0)] {
            assert!((round_up(value) - expected).abs() < 1e-12, "{value}");
        }
    }
}
