//! From the wavemaker to the particles: solitary and regular waves, the layered flume model, pistons and flaps.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`solitary`] | the piston's motion for a solitary wave, and the third-order wave |
//! | [`regular`] | regular waves as they are ordered; linear dispersion, highest waves |
//! | [`stream_function`] | regular waves of permanent form by Fourier approximation, short to cnoidal |
//! | [`irregular`] | a JONSWAP sea with random phases |
//! | [`incoming`] | any of these as an inflow at the end of the flume |
//! | [`paddle_motion`] | the motion of the paddle that makes regular waves |
//! | [`layered`] | the K-layer non-hydrostatic model: piston or inflow, wall, radiating end or sponge, friction, breaking |
//! | [`flume`] | one run of that model, from a set-up to a record |
//! | [`record`] | gauges, profiles and a window of the flow over time, to be asked at any (x, z, t) |
//! | [`ml_piston`] | a wavemaker for the particles whose rows follow the water |
//! | [`paddle`] | a rigid piston or flap that moves by theory |
//! | [`absorption`] | what a piston does about the waves that come back to it |
//! | [`wavemaker`] | either of these, as rows that move |
//! | [`velx`] | the piston's velocities as a DualSPHysics `_velx` file |
//! | [`external`] | the velocity at one place from files of other programs |
//!
//! SI units; x from the wavemaker at rest to the shore, z upwards from the bed profile's own datum.

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
