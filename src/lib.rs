//! breakwater answers two questions that coastal engineers ask before they build: *will this wave move the armour
//! units, and will the units break?*
//!
//! A case file describes the flume, the wave and the armour units. A [`Case`] is a validated case file. A
//! [`Simulation`] advances a case in time steps: water particles (SPH), rigid units and their contact, and the
//! wavemaker, which couples the particles to a model of the whole flume. [`run()`] simulates a case to its end and
//! writes the results to one folder.
//!
//! # A first simulation loop
//!
//! ```
//! use std::sync::Arc;
//! use breakwater::{Case, Simulation};
//! use glam::DVec3;
//!
//! // Still water, 0.2 m deep, in a tank 0.5 m long; the keys are in metres.
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
//! // `begin_step` evaluates the current state. Then the water can be sampled at any point.
//! let mut now = simulation.begin_step()?;
//! let sample = now.sampler()?.sample(DVec3::new(0.25, 0.0, 0.1)).expect("water at mid-depth");
//! // Limit 50 Pa: 5 % of the hydrostatic pressure at mid-depth, 981 Pa.
//! assert!((sample.pressure - 1000.0 * 9.81 * 0.1).abs() < 50.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! `examples/custom_loop.rs` samples a pressure and stops when the water reaches a wall. `examples/still_water.rs`
//! loads a case file and reads its gauges. Error messages say what to do: [`case::CaseErrors`] lists all errors of a
//! case file, and [`simulation::flume::failure::Failure`] gives the cause and the position of a failed time step.
//!
//! # The modules, from the top down
//!
//! A module uses only modules below it in this table.
//!
//! | module | content |
//! | --- | --- |
//! | [`report`] | everything that a person reads: pages, charts, pictures, comparison with measurements |
//! | [`sweep`] | many runs of one case, on this machine or by Slurm |
//! | [`simulation`] | the runs: flume, dry tests, armour layers, fracture, breakage analysis |
//! | [`output`] | output files of a run and their formats; the run loop that all kinds of runs share |
//! | [`case`] | reading of case files, and the validated case |
//! | [`sph`] | weakly compressible water: one file per term of the equations |
//! | [`rigid`] | rigid units and their contact |
//! | [`waves`] | wave theories, the flume model, wavemakers, waves of other programs |
//! | [`femdem`] | deformable units that crack |
//! | [`geometry`] | solids, armour units, terrain |
//! | [`mechanics`] | motion of a rigid body, and the loads on it |
//!
//! All quantities are in SI units. Axes: x from the wavemaker to the shore, y across the flume, z upwards. On one
//! machine, the results of a case are bitwise identical for any number of threads and after a restart.

// Descriptions give units in brackets. Without this line, rustdoc would read `[m]` as a broken link to an item m.
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
