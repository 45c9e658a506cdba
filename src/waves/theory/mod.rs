//! Wave theories.
//!
//! | module | contents |
//! | --- | --- |
//! | [`solitary`] | piston motion for a solitary wave; third-order solitary wave |
//! | [`regular`] | parameters of regular waves; linear dispersion and breaking heights |
//! | [`stream_function`] | stream function wave theory for regular waves, from deep-water to cnoidal waves |
//! | [`irregular`] | JONSWAP sea with random phases |

pub mod irregular;
pub mod regular;
pub mod solitary;
pub mod stream_function;
