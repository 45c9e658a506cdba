//! Neighbour search.
//!
//! | file | contents |
//! | --- | --- |
//! | [`grid`] | cell list: bins, and the sort of particles into them |
//! | [`lists`] | clusters of particles and their neighbour lists |
//! | [`records`] | the data of a particle that its neighbours need |

pub mod grid;
pub mod lists;
pub mod records;
