//! Wave theories, wavemakers and the flume model that drives the particle domain.
//!
//! | module | contents |
//! | --- | --- |
//! | [`theory`] | solitary, regular and irregular waves |
//! | [`flume_model`] | layered non-hydrostatic model of the whole flume, and its record |
//! | [`generation`] | wavemakers of the particle domain: multi-layer piston, paddle, active absorption |
//! | [`external`] | velocities and surface levels from files of other programs |
//!
//! SI units. x points from the wavemaker at rest to the shore, z upwards from the datum of the bed profile.

pub mod external;
pub mod flume_model;
pub mod generation;
pub mod theory;
