//! The parts of the program, and all of it, against answers known from mechanics. Run with `--release`.

mod rigid;
mod waves;
