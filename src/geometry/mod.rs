//! Geometry: bed profile, closed surfaces, convex parts, armour units, STL.

pub mod armour_unit;
pub mod convex_part;
pub mod profile;
pub mod solid;
pub mod stl;
pub mod tetrapod;
