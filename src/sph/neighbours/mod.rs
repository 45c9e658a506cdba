//! Neighbour search.
//!
//! | file | contents |
//! | --- | --- |
//! | [`grid`] | cell list: rectangular bins, and sorting of particles into these bins |
//! | [`lists`] | clusters of particles and their neighbour lists |
//! | [`records`] | packed data of a particle, for the sums of its neighbours |

pub mod grid;
pub mod lists;
pub mod records;
