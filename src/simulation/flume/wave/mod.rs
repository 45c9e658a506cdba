//! The wave in the particle domain: its source, wavemaker and open ends, and zones at the ends of the domain.

pub mod ends;
pub mod incoming;
mod zones;
