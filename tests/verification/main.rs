//! The parts of the program, and all of it, against answers known from mechanics. Run with `--release`.

mod absorption;
mod blocks;
mod buoyancy;
mod conservation;
mod convergence;
mod diffusion;
mod flume_ends;
mod flume_order;
mod flume_shore;
mod fudo_waves;
mod given_waves;
mod incoming_waves;
mod lattice;
mod operators;
mod regular_waves;
mod reproducibility;
mod returning_waves;
mod rigid;
mod solitary_wave;
mod standing_wave;
mod still_water;
mod tanks;
mod viscous_flow;
mod wavemaker;
mod waves;
mod wedge;
