//! The program against published measurements. Run with `--release`.
//!
//! The measurements are read in place, from `../shared/data` beside the crate; where they are missing a test says so
//! and skips.

mod dam_break;
mod dam_break_3d;
mod data;
mod floating_box;
mod flume_bar;
mod flume_run_up;
mod three_cubes;
mod wall_pressure;
