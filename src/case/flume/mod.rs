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

pub(in crate::case) mod bed;
pub(in crate::case) mod domain;
mod obstacles;
pub(in crate::case) mod site;
pub(in crate::case) mod terrain;
pub(in crate::case) mod zones;
