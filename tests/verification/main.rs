//! The parts of the program, and all of it, against answers known from mechanics. Run with `--release`.

mod buoyancy;
mod conservation;
mod regular_waves;
mod reproducibility;
mod rigid;
mod standing_wave;
mod still_water;
mod tanks;
mod viscous_flow;
mod wavemaker;
mod waves;
mod wedge;
