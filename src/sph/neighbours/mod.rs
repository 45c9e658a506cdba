//! Neighbour search.
//!
//! | file | contents |
//! | --- | --- |
//! | [`grid`] | cell list: bins, and sorting of particles into these bins |
//! | [`lists`] | clusters of particles and their neighbour lists |
//! | [`records`] | data of a particle that its neighbours need |

pub mod grid;
pub mod lists;
pub mod records;
