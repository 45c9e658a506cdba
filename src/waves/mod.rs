//! From the wavemaker to the particles: solitary and regular waves, the layered flume model, pistons and flaps.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`solitary`] | the piston's motion for a solitary wave, and the third-order wave as a reference |
//! | [`regular`] | regular waves and the motion of the paddle that makes them |
//! | [`layered`] | the K-layer non-hydrostatic model of a flume with a moving piston |
//! | [`flume`] | one run of that model, from a set-up to a record |
//! | [`record`] | gauges and a window of the flow over time, to be asked at any (x, z, t) |
//! | [`ml_piston`] | a wavemaker for the particles whose rows follow the water |
//! | [`paddle`] | a rigid piston or flap that moves by theory |
//! | [`wavemaker`] | either of these, as rows that move |
//! | [`velx`] | the piston's velocities as a DualSPHysics `_velx` file |
//!
//! SI units; x from the wavemaker at rest to the shore, z upwards from the bed profile's own datum.

pub mod flume;
mod interpolation;
pub mod layered;
pub mod ml_piston;
pub mod paddle;
pub mod record;
pub mod regular;
pub mod solitary;
pub mod velx;
pub mod wavemaker;
