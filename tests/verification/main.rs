//! The parts of the program, and all of it, against answers known from mechanics. Run with `--release`.

mod buoyancy;
mod conservation;
mod reproducibility;
mod rigid;
mod still_water;
mod tanks;
mod wavemaker;
mod waves;
