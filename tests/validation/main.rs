//! The program compared with published measurements. Run with `--release`.
//!
//! Every test compares with a short table of figures in `tests/validation/measured`. Where `../shared/data` lies next to
//! the repository, the tests also compare with the full series. The last line of a run counts the comparisons with full
//! series that were left out.

mod dam_break;
mod dam_break_3d;
mod data;
mod floating_box;
mod flume_bar;
mod flume_run_up;
mod three_cubes;
mod wall_pressure;
