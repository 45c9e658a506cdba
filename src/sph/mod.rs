//! sph
