//! Wave theories, wavemakers and the flume model that drives the particle domain.
//!
//! | module | contents |
//! | --- | --- |
//! | [`solitary`] | piston motion for a solitary wave; third-order solitary wave |
//! | [`regular`] | target regular waves; linear dispersion and breaking heights |
//! | [`stream_function`] | stream function wave theory for regular waves, from deep-water to cnoidal waves |
//! | [`irregular`] | JONSWAP sea with random phases |
//! | [`incoming`] | any of these waves as an inflow at the left end of the flume |
//! | [`paddle_motion`] | paddle motion that generates regular waves |
//! | [`layered`] | K-layer non-hydrostatic flume model with its ends, friction and breaking |
//! | [`flume`] | one run of the flume model, from a set-up to a record |
//! | [`record`] | recorded gauges, surface profiles and flow, interpolated at any (x, z, t) |
//! | [`ml_piston`] | multi-layer piston: particle rows that follow the water of a flume run |
//! | [`paddle`] | rigid piston or flap |
//! | [`absorption`] | active absorption of waves that return to a piston |
//! | [`wavemaker`] | multi-layer piston or paddle as moving rows of particles |
//! | [`velx`] | row velocities in DualSPHysics' `_velx` format |
//! | [`external`] | velocities and surface levels from files of other programs |
//!
//! SI units. x points from the wavemaker at rest to the shore, z upwards from the datum of the bed profile.

pub mod absorption;
pub mod external;
pub mod flume;
pub mod incoming;
mod interpolation;
pub mod irregular;
pub mod layered;
pub mod ml_piston;
pub mod paddle;
pub mod paddle_motion;
pub mod record;
pub mod regular;
pub mod solitary;
pub mod stream_function;
pub mod velx;
pub mod wavemaker;
