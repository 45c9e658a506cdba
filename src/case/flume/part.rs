//! A part of a structure: solid, or a porous medium.

use glam::{DVec2, DVec3};

use super::body::BodyPart;
use crate::case::file::{BoxFile, PartFile, PartStlFile};
use crate::geometry::axis_box::AxisBox;
use crate::geometry::outline::polygon::Polygon;
use crate::sph::terms::porous::Medium;

/// A part of the structure.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Name.
    pub name: String,
    /// Shape and place.
    pub shape: PartShape,
    /// Material of the surface, an index into `Case::materials`; `None` if it is that of the bed.
    pub material: Option<usize>,
}

/// Shape and place of a part.
#[derive(Debug, Clone, PartialEq)]
pub enum PartShape {
    /// The same across the flume, and part of the bed profile.
    Bed(Polygon),
    /// The same across the flume, with vertical or overhanging faces, or above the bed.
    Section(Polygon),
    /// A box with edges along the axes.
    Box(AxisBox),
    /// Any other shape, from an STL file.
    Body(BodyPart),
    /// A medium through which water flows, with its shape. Units rest on it as on a solid part.
    Porous(Medium, Box<PartShape>),
}

impl Part {
    /// Returns the shape of the surface, whether water flows through the part or not.
    pub fn surface(&self) -> &PartShape {
        match &self.shape {
            PartShape::Porous(_, shape) => shape,
            shape => shape,
        }
    }

    /// Returns the medium, if water flows through the part.
    pub fn medium(&self) -> Option<&Medium> {
        match &self.shape {
            PartShape::Porous(medium, _) => Some(medium),
            _ => None,
        }
    }

    /// Returns the section of a part that is the same across the flume, solid or porous.
    pub fn polygon(&self) -> Option<&Polygon> {
        match self.surface() {
            PartShape::Bed(polygon) | PartShape::Section(polygon) => Some(polygon),
            _ => None,
        }
    }

    /// Returns the box of a solid part that is one.
    pub fn as_box(&self) -> Option<&AxisBox> {
        match &self.shape {
            PartShape::Box(bounds) => Some(bounds),
            _ => None,
        }
    }

    /// Returns the body of a solid part of any other shape.
    pub fn as_body(&self) -> Option<&BodyPart> {
        match &self.shape {
            PartShape::Body(body) => Some(body),
            _ => None,
        }
    }

    /// Returns the section of a solid part that is the same across the flume but not part of the bed.
    pub fn section(&self) -> Option<&Polygon> {
        match &self.shape {
            PartShape::Section(polygon) => Some(polygon),
            _ => None,
        }
    }

    /// Returns x of the two ends [m].
    pub fn x(&self) -> [f64; 2] {
        match self.surface() {
            PartShape::Body(BodyPart { terrain_x: Some(x), .. }) => *x,
            shape => shape.bounds(0.0).map(|corner| corner.x),
        }
    }

    /// Returns the middle of the box around the part, in a domain of the given width [m].
    pub fn middle(&self, width: f64) -> DVec3 {
        let [low, high] = self.surface().bounds(width);
        0.5 * (low + high)
    }

    /// Returns the highest level of the part at (x, y) [m], if the part is there.
    pub fn level(&self, x: f64, y: f64) -> Option<f64> {
        if let PartShape::Body(body) = self.surface() {
            return body.surface.level(x, y);
        }
        let [low, high] = self.surface().bounds(0.0);
        let is_there = self.polygon().is_some() || (low.y..=high.y).contains(&y);
        self.highest_at(x).filter(|_| is_there)
    }

    /// Returns the highest level of the part at x [m], for all y, if the part is there.
    pub fn highest_at(&self, x: f64) -> Option<f64> {
        if let Some(polygon) = self.polygon() {
            return polygon.top(x);
        }
        let [low, high] = self.surface().bounds(0.0);
        (low.x..=high.x).contains(&x).then_some(high.z)
    }

    /// Returns the distance of a point from the part [m], negative inside; infinity for a part of the bed.
    pub fn distance(&self, point: DVec3) -> f64 {
        match self.surface() {
            PartShape::Bed(_) => f64::INFINITY,
            shape => shape.distance(point),
        }
    }

    /// Returns name and content of the STL file that a run saves next to its case file, if the part needs one of its own.
    pub fn file(&self) -> Option<(&str, &[u8])> {
        match self.surface() {
            PartShape::Body(body) if body.terrain_x.is_none() => {
                Some((body.file_name.as_str(), body.content.as_slice()))
            }
            _ => None,
        }
    }

    /// Returns the entry for the case file in the run folder, which refers only to files in that folder.
    pub(in crate::case) fn entry(&self, file: &PartFile) -> PartFile {
        let polygon_m = self.polygon().map(|polygon| polygon.points().iter().map(DVec2::to_array).collect());
        let (mut cuboid, mut stl) = (None, None);
        match self.surface() {
            PartShape::Box(bounds) => {
                cuboid = Some(BoxFile { low_m: bounds.low.into(), high_m: bounds.high.into() });
            }
            // A body refers to the copy of its file in the run folder.
            PartShape::Body(BodyPart { file_name, scale, origin, .. }) => {
                stl = Some(PartStlFile { path: file_name.clone(), scale: *scale, origin_m: origin.to_array() });
            }
            _ => (),
        }
        PartFile { polygon_m, cuboid, stl, ..file.clone() }
    }
}

impl PartShape {
    /// Returns the box around the shape, in a domain of the given width [m].
    pub fn bounds(&self, width: f64) -> [DVec3; 2] {
        match self {
            Self::Bed(polygon) | Self::Section(polygon) => {
                let [low, high] = polygon.bounds();
                [DVec3::new(low.x, 0.0, low.y), DVec3::new(high.x, width, high.y)]
            }
            Self::Box(bounds) => [bounds.low, bounds.high],
            Self::Body(body) => body.solid.bounds(),
            Self::Porous(_, shape) => shape.bounds(width),
        }
    }

    /// Returns the distance of a point from the shape [m], negative inside.
    pub fn distance(&self, point: DVec3) -> f64 {
        match self {
            Self::Bed(polygon) | Self::Section(polygon) => polygon.distance(DVec2::new(point.x, point.z)),
            Self::Box(bounds) => bounds.locate(point).1,
            Self::Body(body) => body.solid.signed_distance(point),
            Self::Porous(_, shape) => shape.distance(point),
        }
    }
}
