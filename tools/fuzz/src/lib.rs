//! Fuzz targets for every reader of a user's file. CONTRIBUTING.md has the commands.
//!
//! A target replaces one file of a small valid folder by mutated content, and runs `breakwater check` on the case that
//! reads this file.

pub mod cases;
pub mod damage;
pub mod folder;
pub mod json;
pub mod memory;
pub mod random;
pub mod schema;
pub mod text;
pub mod wave_tables;
