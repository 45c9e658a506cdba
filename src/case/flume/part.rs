//! A solid part of a structure.

use glam::{DVec2, DVec3};

use super::body::BodyPart;
use crate::case::file::{BoxFile, PartFile, PartStlFile};
use crate::geometry::axis_box::AxisBox;
use crate::geometry::outline::polygon::Polygon;

/// A solid part of the structure.
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
}

impl Part {
    /// Returns the section of a part that is the same across the flume.
    pub fn polygon(&self) -> Option<&Polygon> {
        match &self.shape {
            PartShape::Bed(polygon) | PartShape::Section(polygon) => Some(polygon),
            PartShape::Box(_) | PartShape::Body(_) => None,
        }
    }

    /// Returns the box of a part that is one.
    pub fn as_box(&self) -> Option<&AxisBox> {
        match &self.shape {
            PartShape::Box(bounds) => Some(bounds),
            _ => None,
        }
    }

    /// Returns the body of a part of any other shape.
    pub fn as_body(&self) -> Option<&BodyPart> {
        match &self.shape {
            PartShape::Body(body) => Some(body),
            _ => None,
        }
    }

    /// Returns the section of a part that is the same across the flume but not part of the bed.
    pub fn section(&self) -> Option<&Polygon> {
        match &self.shape {
            PartShape::Section(polygon) => Some(polygon),
            _ => None,
        }
    }

    /// Returns x of the two ends [m].
    pub fn x(&self) -> [f64; 2] {
        match &self.shape {
            PartShape::Bed(polygon) | PartShape::Section(polygon) => polygon.bounds().map(|corner| corner.x),
            PartShape::Box(bounds) => [bounds.low.x, bounds.high.x],
            PartShape::Body(body) => body.terrain_x.unwrap_or(body.solid.bounds().map(|corner| corner.x)),
        }
    }

    /// Returns the middle of the box around the part, in a domain of the given width [m].
    pub fn middle(&self, width: f64) -> DVec3 {
        match &self.shape {
            PartShape::Bed(polygon) | PartShape::Section(polygon) => {
                let [low, high] = polygon.bounds();
                0.5 * DVec3::new(low.x + high.x, width, low.y + high.y)
            }
            PartShape::Box(bounds) => 0.5 * (bounds.low + bounds.high),
            PartShape::Body(body) => {
                let [low, high] = body.solid.bounds();
                0.5 * (low + high)
            }
        }
    }

    /// Returns the highest level of the part at (x, y) [m], if the part is there.
    pub fn level(&self, x: f64, y: f64) -> Option<f64> {
        if let PartShape::Body(body) = &self.shape {
            return body.surface.level(x, y);
        }
        let is_there = self.as_box().is_none_or(|bounds| (bounds.low.y..=bounds.high.y).contains(&y));
        self.highest_at(x).filter(|_| is_there)
    }

    /// Returns the highest level of the part at x [m], for all y, if the part is there.
    pub fn highest_at(&self, x: f64) -> Option<f64> {
        match &self.shape {
            PartShape::Bed(polygon) | PartShape::Section(polygon) => polygon.top(x),
            PartShape::Box(bounds) => (bounds.low.x..=bounds.high.x).contains(&x).then_some(bounds.high.z),
            PartShape::Body(body) => {
                let [low, high] = body.solid.bounds();
                (low.x..=high.x).contains(&x).then_some(high.z)
            }
        }
    }

    /// Returns the distance of a point from the part [m], negative inside; infinity for a part of the bed.
    pub fn distance(&self, point: DVec3) -> f64 {
        match &self.shape {
            PartShape::Bed(_) => f64::INFINITY,
            PartShape::Section(polygon) => polygon.distance(DVec2::new(point.x, point.z)),
            PartShape::Box(bounds) => bounds.locate(point).1,
            PartShape::Body(body) => body.solid.signed_distance(point),
        }
    }

    /// Returns name and content of the STL file that a run saves next to its case file, if the part needs one of its own.
    pub fn file(&self) -> Option<(&str, &[u8])> {
        let body = self.as_body().filter(|body| body.terrain_x.is_none())?;
        Some((body.file_name.as_str(), body.content.as_slice()))
    }

    /// Returns the entry for the case file in the run folder, which refers only to files in that folder.
    pub(in crate::case) fn entry(&self, file: &PartFile) -> PartFile {
        let polygon_m = self.polygon().map(|polygon| polygon.points().iter().map(DVec2::to_array).collect());
        let cuboid = self.as_box().map(|bounds| BoxFile { low_m: bounds.low.into(), high_m: bounds.high.into() });
        // A body refers to the copy of its file in the run folder.
        let stl = self.as_body().map(|body| PartStlFile {
            path: body.file_name.clone(),
            scale: body.scale,
            origin_m: body.origin.to_array(),
        });
        PartFile { polygon_m, cuboid, stl, ..file.clone() }
    }
}
