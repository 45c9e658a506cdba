//! Fracture runs: what `breakwater fracture` does with a case.
//!
//! | file | what it does |
//! | --- | --- |
//! | [`run`] | the loop with its outputs |
//! | [`recorder`] | tables, surfaces and cracks |
//! | [`checkpoint`] | the state of a run, to go on from |
//! | [`failure`] | why a run cannot go on, in words |
//! | [`detail`] | failed faces as a table, cut plane, tetrahedra |
//! | [`section`] | where the cut plane meets the tetrahedra |
//! | [`fragments`] | pieces that bodies have broken into |
//! | [`initiation`] | where cracks began, in order |
//! | [`summary`] | the run in a few numbers |

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
