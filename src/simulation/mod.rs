//! The computations: one folder for each kind of run.
//!
//! | folder | run |
//! | --- | --- |
//! | [`flume`] | flume runs: water, units and their contact |
//! | [`dry_test`] | dry tests: units tilted, dropped or settling, without water |
//! | [`armour_layer`] | armour layers: units lowered one by one onto a slope |
//! | [`fracture`] | fracture runs: deformable bodies that crack |
//! | [`breakage`] | breakage analyses: the hardest impacts of a run, re-run at prototype scale with breakable units |
//!
//! A run writes data files into its folder. [`crate::report`] writes the HTML pages from these files.

pub mod armour_layer;
pub mod bodies;
pub mod breakage;
pub mod dry_test;
pub mod flume;
pub mod fracture;
pub mod settling;
