//! Identity of a contact.

use serde::{Deserialize, Serialize};

/// Largest number of corners plus edges of a polyhedron: they are numbered from 0, below [`WHOLE`].
pub const MAX_FEATURES: usize = WHOLE as usize - 1;
/// Feature number of the whole polyhedron; corners are numbered from 0, followed by the edges.
pub const WHOLE: u16 = 1023;

/// The contact partner of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Feature {
    /// A part of another body (or of the same one), shifted by `image` flume widths. `part` is 1024 times the number of
    /// the part, plus the number of its corner or edge, or 1023 for the whole part.
    Unit { body: u32, image: i32, part: u16 },
    /// The ground: `place` is 2 k for strip k and 2 k + 1 for the convex corner after it.
    Ground { place: u32, end: u16 },
    /// A triangle surface: `place` is the number of the triangle, ridge or corner.
    Terrain { place: u32, end: u16 },
    /// A wall: 0 at y = 0, 1 at y = width, 2 seaward, 3 shoreward.
    Wall { wall: u8, end: u16 },
}

/// Identity of a contact: body, part and contact partner.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub struct ContactKey {
    /// Number of the body from 0.
    pub body: u32,
    /// Number of its part from 0; against another unit, encoded as in [`Feature::Unit`].
    pub part: u16,
    /// Contact partner.
    pub feature: Feature,
}
