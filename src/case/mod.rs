//! Case files: as written, validated, and what is wrong with them.

pub mod file;
