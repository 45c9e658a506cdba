//! The parts of the program, and all of it, against answers known from mechanics. Run with `--release`.

mod conservation;
mod reproducibility;
mod rigid;
mod tanks;
mod wavemaker;
mod waves;
