//! The program compared with published measurements. Run with `--release`.
//!
//! The tests read the measurements from `../shared/data` next to the crate; a test prints "skipped" and passes if they
//! are missing.

mod dam_break;
mod dam_break_3d;
mod data;
mod floating_box;
mod flume_bar;
mod flume_run_up;
mod three_cubes;
mod wall_pressure;
