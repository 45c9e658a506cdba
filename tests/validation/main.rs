//! Tests that compare breakwater with published results. Run them with `--release`.
//!
//! The tests compare with short tables of numbers in `tests/validation/measured`. If the folder `../shared/data` exists
//! next to the repository, the tests also compare with the full series. The last line of a test run states how many
//! comparisons with full series were left out.

mod box_impact;
mod box_records;
mod dam_break;
mod dam_break_3d;
mod data;
mod floating_box;
mod flume_bar;
mod flume_run_up;
mod porous_dam;
mod sliding_row;
mod three_cubes;
mod towed_bodies;
mod towed_rows;
mod wall_pressure;
