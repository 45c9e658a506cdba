//! Geometry: bed profile, closed surfaces, convex parts, triangle surfaces of the ground, armour units, STL files.

pub mod armour_unit;
pub mod axis_box;
pub mod convex_part;
pub mod core_loc;
pub mod cuboid;
pub mod decomposition;
pub mod dolos;
pub mod gmsh;
pub mod grooved_cube;
pub mod half_space;
pub mod member;
pub mod polyhedron;
pub mod profile;
pub mod section;
pub mod solid;
pub mod stl;
pub mod terrain;
pub mod tetrapod;
pub mod union;
