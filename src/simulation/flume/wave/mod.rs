//! The wave in the particle domain: its source, active absorption, and zones at the ends of the domain.

pub(crate) mod absorb;
pub mod incoming;
mod zones;
