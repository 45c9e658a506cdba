//! What a film shows: meshes and rigid bodies over time.

use serde::Serialize;

use super::Mesh;

/// Colours from low to high values: colour map `dense` of cmocean (Thyng et al. 2016), perceptually uniform.
pub const DENSE: [&str; 10] =
    ["#c4e0e6", "#9ecbe2", "#80b3e3", "#7498e4", "#767bdb", "#795dc4", "#7642a5", "#6d2b7f", "#5c1956", "#421130"];
/// Colours of the units from low to high values: colour map `YlOrRd` of ColorBrewer (Harrower & Brewer 2003).
pub const WARM: [&str; 7] = ["#ffffb2", "#fed976", "#feb24c", "#fd8d3c", "#fc4e2a", "#e31a1c", "#b10026"];
/// Colours for no and yes.
pub const NO_YES: [&str; 2] = ["#9aa2aa", "#d55e00"];

/// A film.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Unit and format of the times.
    pub clock: Clock,
    /// Times of the frames [units of the clock].
    pub times: Vec<f64>,
    /// Index of the frame that is shown first.
    pub start: usize,
    /// Lower and upper corner of the box that is shown first [m].
    pub corners: [[f32; 3]; 2],
    /// Meshes and dots. Transparent ones are drawn in this order.
    pub series: Vec<Series>,
    /// The units; `None` without units.
    pub bodies: Option<Bodies>,
}

/// Unit and format of the time.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Clock {
    /// Unit of the times: `s` or `ms`.
    pub unit: &'static str,
    /// Number of these units in a second.
    pub per_second: f64,
    /// Number of decimals.
    pub digits: usize,
}

/// A mesh, or dots, with one frame for each time of the film or one frame for all times.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Name.
    pub name: &'static str,
    /// Colour without a field.
    pub plain: &'static str,
    /// Opacity: 1 for opaque.
    pub opacity: f32,
    /// Diameter of a dot [m]; 0 for triangles.
    pub dot: f32,
    /// Sides from which the triangles are seen.
    pub seen: Seen,
    /// True if neighbouring triangles have no visible edge between them.
    pub smooth: bool,
    /// Fields by which the series can be coloured.
    pub fields: Vec<Field>,
    /// The frames; each mesh has one list of values per field.
    pub frames: Vec<Mesh>,
}

/// Sides of a surface from which it is seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Seen {
    /// From both sides.
    Both,
    /// From inside only. A wall between viewer and scene is then not drawn.
    Inside,
}

impl Series {
    /// Creates a series of triangles without fields.
    pub fn new(name: &'static str, plain: &'static str, opacity: f32, frames: Vec<Mesh>) -> Self {
        Self { name, plain, opacity, dot: 0.0, seen: Seen::Both, smooth: false, fields: Vec::new(), frames }
    }
}

/// A quantity with its colours.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Field {
    /// Name.
    pub name: &'static str,
    /// Unit; `None` for a quantity whose values are labels.
    pub unit: Option<&'static str>,
    /// Values at the two ends of the colour scale.
    pub range: [f32; 2],
    /// Colours of equal parts of the scale, at most ten.
    pub colours: Vec<String>,
    /// Labels of the colours; `None` for numbers.
    pub labels: Option<Vec<&'static str>>,
}

impl Field {
    /// Returns a field of numbers.
    pub fn numbers(name: &'static str, unit: &'static str, range: [f32; 2], colours: &[&str]) -> Self {
        let colours = colours.iter().map(|colour| (*colour).to_owned()).collect();
        Self { name, unit: Some(unit), range, colours, labels: None }
    }

    /// Returns a field whose values 0, 1, 2 ... have a label and a colour each.
    pub fn labels(name: &'static str, list: impl IntoIterator<Item = (&'static str, String)>) -> Self {
        let (labels, colours): (Vec<_>, Vec<_>) = list.into_iter().unzip();
        let range = [-0.5, labels.len() as f32 - 0.5];
        Self { name, unit: None, range, colours, labels: Some(labels) }
    }

    /// Returns the place of a value on the colour scale: 0 to 1.
    pub fn share(&self, value: f32) -> f32 {
        let [low, high] = self.range;
        let share = (value - low) / (high - low).max(f32::MIN_POSITIVE);
        if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.0 }
    }
}

/// Returns the indices of at most `most` of `count` recorded times: the first, the last, and others at about equal
/// distances.
pub fn thinned(count: usize, most: usize) -> Vec<usize> {
    let kept = count.min(most.max(2));
    (0..kept).map(|index| index * (count - 1) / (kept - 1).max(1)).collect()
}

/// Rigid bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Bodies {
    /// Name.
    pub name: &'static str,
    /// The shapes, relative to the position of a body [m].
    pub meshes: Vec<Mesh>,
    /// Positions at all times, those of all bodies at the first time first [m].
    pub position: Vec<[f32; 3]>,
    /// Orientations at all times, as quaternions x, y, z, w.
    pub orientation: Vec<[f32; 4]>,
    /// Quantities with their values at all times, in the same order.
    pub fields: Vec<(Field, Vec<f32>)>,
    /// The bodies.
    pub list: Vec<Body>,
}

/// One body.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Body {
    /// Number, from 1.
    pub number: u32,
    /// Shape, an index into [`Bodies::meshes`].
    pub mesh: usize,
    /// Names and values that the reader sees when he chooses the body.
    pub facts: Vec<(&'static str, String)>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_are_thinned_evenly_and_keep_both_ends() {
        assert_eq!(thinned(5, 10), [0, 1, 2, 3, 4]);
        assert_eq!(thinned(11, 6), [0, 2, 4, 6, 8, 10]);
        assert_eq!(thinned(10, 5), [0, 2, 4, 6, 9]);
        assert_eq!((thinned(1, 5), thinned(2, 1), thinned(0, 5)), (vec![0], vec![0, 1], Vec::new()));
    }

    #[test]
    fn labels_and_numbers_have_their_place_on_the_scale() {
        let field = Field::labels("mode", [("no", "#000000".to_owned()), ("yes", "#ffffff".to_owned())]);
        assert_eq!((field.share(0.0), field.share(1.0)), (0.25, 0.75));
        let field = Field::numbers("speed", "m/s", [0.0, 2.0], &DENSE);
        assert_eq!([-1.0, 0.5, 9.0, f32::NAN].map(|value| field.share(value)), [0.0, 0.25, 1.0, 0.0]);
    }
}
