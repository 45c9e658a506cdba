//! breakwater answers two questions that coastal engineers ask before they build: *will this wave move the armour units,
//! and will the units break?*
//!
//! A case file describes flume, wave and units; a [`Case`] is that file, validated. A [`Simulation`] is a case in motion:
//! water particles (SPH), rigid units, their contact, and the wavemaker that couples the particles to a model of the
//! whole flume. [`run()`] takes a case to its end and writes everything into one folder.
//!
//! # A first loop
//!
//! ```
//! use std::sync::Arc;
//! use breakwater::{Case, Simulation};
//! use glam::DVec3;
//!
//! // Still water, 0.2 m deep, in a tank of 0.5 m; lengths in metres.
//! let case = Case::from_str(r#"{
//!     "title": "Still water",
//!     "flume": { "bed_m": [[0.0, 0.0], [0.5, 0.0]], "still_water_level_m": 0.2 },
//!     "domain": { "x_m": [0.0, 0.5], "sides": "two_dimensional", "top_z_m": 0.4, "dp_m": 0.02 },
//!     "stop": { "duration_s": 0.1 }
//! }"#, "still water")?;
//! let mut simulation = Simulation::new(Arc::new(case))?;
//! while simulation.time < 0.1 {
//!     simulation.step()?;
//! }
//!
//! // Once a time step is prepared, the water can be measured anywhere.
//! let mut now = simulation.begin_step()?;
//! let sample = now.sampler()?.sample(DVec3::new(0.25, 0.0, 0.1)).expect("water at mid-depth");
//! assert!((sample.pressure - 1000.0 * 9.81 * 0.1).abs() < 50.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! `examples/custom_loop.rs` reads a gauge and stops when its own condition is met; `examples/still_water.rs` loads a
//! case file. Errors are values that say what to do: [`case::CaseErrors`] lists everything that is wrong with a file,
//! [`simulation::flume::failure::Failure`] says where a state has become impossible.
//!
//! # The modules, from the top down
//!
//! A module uses only those below it.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`report`] | everything that a person reads: pages, charts, pictures, comparison with measurements |
//! | [`sweep`] | many runs of one case, on this machine or by Slurm |
//! | [`simulation`] | the runs: flume, dry tests, armour layers, fracture, breakage analysis |
//! | [`output`] | what a run leaves: records, their file formats, and the loop that every run shares |
//! | [`case`] | the case file as written, and the validated case |
//! | [`sph`] | weakly compressible water: one term of the equations per file |
//! | [`rigid`] | rigid units and their contact |
//! | [`waves`] | wave theories, the flume model, wavemakers, waves of other programs |
//! | [`femdem`] | deformable units that crack |
//! | [`geometry`] | solids, armour units, terrain |
//!
//! SI units throughout. Axes: x from the wavemaker to the shore, y across the flume, z upwards. On one machine a case
//! gives the same bits with any number of threads, and after a restart.

// Units stand in brackets in every description; rustdoc would read `[m]` as a link to something called m.
#![allow(rustdoc::broken_intra_doc_links)]

#[doc(hidden)]
pub mod bench;
pub mod case;
#[doc(hidden)]
pub mod cli;
pub mod femdem;
pub mod geometry;
pub mod mechanics;
pub mod output;
mod random;
pub mod report;
pub mod rigid;
pub mod simulation;
pub mod sph;
pub mod sweep;
pub mod waves;

pub use case::Case;
pub use simulation::flume::{
    Simulation,
    run::{RunOptions, run},
};
