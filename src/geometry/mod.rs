//! Geometry: bed profile, closed surfaces, convex parts, armour units, STL.

pub mod armour_unit;
pub mod axis_box;
pub mod convex_part;
pub mod cuboid;
pub mod profile;
pub mod solid;
pub mod stl;
pub mod tetrapod;
