//! Geometry: bed profile, closed surfaces, convex parts, triangle surfaces of the ground, armour units, STL files, open
//! space.

pub mod armour_unit;
pub mod axis_box;
pub mod convex;
pub mod decomposition;
pub mod height_field;
pub mod open_space;
pub mod outline;
pub mod profile;
pub mod solid;
pub mod stl;
pub mod terrain;
