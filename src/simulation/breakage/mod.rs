//! Breakage analysis: the hardest impacts of a run are re-run at prototype scale with units that deform and break.
//!
//! A laboratory unit never breaks, but a unit of the same concrete fifty times larger may. So impacts are re-run at
//! prototype scale ([`froude`]) in one of two ways. Either both bodies collide again from their poses and velocities
//! just before the impact ([`reenact`]), or the recorded forces act on the unit alone ([`load_history`]).
//!
//! | file | what it holds |
//! | --- | --- |
//! | [`froude`] | scale factors of lengths, velocities and forces; scaling of an impact |
//! | [`selection`] | which impacts are re-run |
//! | [`model`] | the units of the run and their nominal stresses |
//! | [`base`] | a block of the bed |
//! | [`blow`] | an impact at prototype scale: velocities, duration, mass, momentum and energy |
//! | [`reenact`], [`load_history`] | the two ways: meshes, bodies and loads of a fracture case |
//! | [`fracture_case`] | the case file of both ways |
//! | [`run`] | writes and runs the cases |
//! | [`results`] | results for each unit |

pub mod base;
pub mod blow;
pub mod fracture_case;
pub mod froude;
pub mod load_history;
pub mod model;
pub mod reenact;
pub mod results;
pub mod run;
pub mod selection;
