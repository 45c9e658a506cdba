//! Fracture runs: the work of `breakwater fracture`.
//!
//! | file | what it does |
//! | --- | --- |
//! | [`run`] | a run from its case or checkpoint to its summary |
//! | [`recorder`] | tables, surfaces and cracks |
//! | [`checkpoint`] | state of a run, for resuming it |
//! | [`failure`] | messages for runs that fail |
//! | [`detail`] | table of failed faces, cut plane, tetrahedra |
//! | [`section`] | intersection of the cut plane with the tetrahedra |
//! | [`fragments`] | pieces into which the bodies broke |
//! | [`initiation`] | positions at which cracks began |
//! | [`summary`] | summary of a run |

pub mod checkpoint;
pub mod detail;
pub mod failure;
pub mod fragments;
pub mod initiation;
pub mod peak_stress;
pub mod recorder;
pub mod run;
pub mod section;
pub mod summary;
