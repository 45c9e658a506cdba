//! Ground, water level and particle domain.
//!
//! | file | what it holds |
//! | --- | --- |
//! | [`bed`] | bed, mound and still water level of the whole flume |
//! | [`domain`] | the part of the flume that is filled with particles |
//! | [`zones`] | damping zone and relaxation zone |
//! | [`obstacles`] | fixed boxes in the water |
//! | [`terrain`] | a triangulated ground of dry tests |
//! | [`site`] | ground and limits of the area where units stand |

pub mod bed;
pub mod domain;
mod obstacles;
pub mod site;
pub mod terrain;
pub mod zones;
