//! Quantities that a flume run measures or accumulates. The accumulated quantities are part of the checkpoint.

pub mod balance;
pub mod energy;
pub mod extremes;
pub mod gauge_means;
pub mod mean_loads;
pub mod part_faces;
pub mod rest;
pub mod rocking;
pub mod statistics;
pub mod water_at_impacts;
