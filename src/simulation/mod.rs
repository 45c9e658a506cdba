//! Runs: what breakwater computes for each kind of input file.
//!
//! | folder | run |
//! | --- | --- |
//! | [`flume`] | water, units and their contact: the coupled run |
//! | [`dry_test`] | units on a bed without water: tilt tests, drops, settling |
//! | [`armour_layer`] | units lowered one by one onto a slope |
//! | [`fracture`] | deformable bodies that crack |
//! | [`breakage`] | the hardest impacts of a run, re-run at prototype scale with breakable units |
//!
//! A run writes data into its folder; pages are written by [`crate::report`].

pub mod armour_layer;
pub mod bodies;
pub mod breakage;
pub mod dry_test;
pub mod flume;
pub mod fracture;
