//! Geometry: bed profile, closed surfaces, armour units.

pub mod profile;
