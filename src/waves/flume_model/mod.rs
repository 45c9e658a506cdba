//! Layered non-hydrostatic model of the whole flume.
//!
//! | module | contents |
//! | --- | --- |
//! | `run` | one run of the flume model, from a [`FlumeSetup`] to a record; the entry point of this module |
//! | [`layered`] | K-layer non-hydrostatic flume model with its ends, friction and breaking |
//! | [`incoming`] | incoming wave of any wave theory at the left end of the flume |
//! | [`record`] | recorded gauges, surface profiles and flow, interpolated at any (x, z, t) |
//! | [`dispersion`] | wavelength and velocity profile of linear waves with K layers |
//! | `interpolation` | cubic interpolation, linear or constant next to dry points |

pub mod dispersion;
pub mod incoming;
mod interpolation;
pub mod layered;
pub mod record;
mod run;

pub use run::{FlumeError, FlumeSetup, MAX_LAYERS, WaveSource, run};
