//! breakwater: will this wave move the armour units, and will the units break?
//!
//! Data walks in at the top and out at the bottom:
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`case`] | the case file as written, and the validated [`case::Case`] that everything else reads |
//! | [`geometry`] | bed profile, closed surfaces, armour units, STL |
//! | [`particles`] | filling water, bed, walls and units with particles; normals for mDBC |
//! | [`waves`] | solitary-wave theory, the layered flume model, the multi-layer piston |
//! | [`sph`] | the weakly compressible SPH solver |
//! | [`rigid`] | rigid armour units and their contact |
//! | [`femdem`] | deformable units that crack |
//! | [`fracture`] | fracture runs: cases, outputs, summary |
//! | [`handover`] | impacts of a run, computed again with units that break |
//! | [`simulation`] | the coupled loop: water, units, outputs |
//! | [`dry`] | units without water: settling, drops, slope tests |
//! | [`placement`] | armour layers: units placed one by one and settled |
//! | [`output`] | ParaView files, tables, checkpoints, summary, report, comparison |
//! | [`bench`] | how fast the solver is on this machine |
//! | [`sweep`] | one case with keys that vary, every combination a run |
//! | [`cli`] | one file a subcommand |
//!
//! SI units throughout. Axes: x from the wavemaker to the shore, y across the flume, z upwards.

// Units stand in brackets in every description; rustdoc would read `[m]` as a link to something called m.
#![allow(rustdoc::broken_intra_doc_links)]

pub mod bench;
pub mod case;
pub mod cli;
pub mod femdem;
pub mod geometry;
pub mod output;
mod random;
pub mod report;
pub mod rigid;
pub mod simulation;
pub mod sph;
pub mod sweep;
pub mod waves;
