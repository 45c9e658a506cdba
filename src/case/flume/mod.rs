//! Bed, still water level and particle domain.
//!
//! | file | contents |
//! | --- | --- |
//! | [`bed`] | bed, mound and still water level of the whole flume |
//! | [`domain`] | the part of the flume that is filled with particles |
//! | [`regions`] | regions of different particle spacing |
//! | [`zones`] | damping zone and relaxation zone |
//! | [`part`], [`body`], [`structure`] | parts of a structure, and obstacles |
//! | [`ground`] | bed, structure and domain together |
//! | [`terrain`] | triangle surface from an STL file on which units stand |
//! | [`bathymetry`] | terrain under water |
//! | [`site`] | ground and boundaries of the area in which units stand |

pub mod bathymetry;
pub mod bed;
pub mod body;
pub mod domain;
pub mod ground;
pub mod part;
pub mod regions;
pub mod site;
pub mod structure;
pub mod terrain;
pub mod zones;
