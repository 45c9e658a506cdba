//! Fracture runs, which the command `breakwater fracture` starts.
//!
//! | file | what it does |
//! | --- | --- |
//! | [`run`] | a run from its case or checkpoint to its summary |
//! | [`recorder`] | tables, surfaces and cracks |
//! | [`run_state`] | state of a run in addition to the state of its solver |
//! | [`checkpoint`] | writes the state of a run, and reads it to resume the run |
//! | [`failure`] | messages for runs that fail |
//! | [`detail`] | outputs of failed faces, cut plane and tetrahedra |
//! | [`section`] | the cut plane: its intersection with the tetrahedra |
//! | [`fragments`] | pieces into which the bodies broke |
//! | [`initiation`] | positions at which cracks began |
//! | [`peak_stress`] | largest tension in each body |
//! | [`summary`] | summary of a run |

pub mod checkpoint;
pub mod detail;
pub mod failure;
pub mod fragments;
pub mod initiation;
pub mod peak_stress;
pub mod recorder;
pub mod run;
pub mod run_state;
pub mod section;
pub mod summary;
