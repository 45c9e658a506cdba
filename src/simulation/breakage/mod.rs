//! Breakage analysis: the hardest impacts of a run are re-run at prototype scale with units that deform and break.
//!
//! A small unit in a laboratory does not break, but a unit of the same concrete that is fifty times as large can break.
//! Therefore impacts are re-run at prototype scale ([`froude`]) by one of two methods. Either both bodies collide again
//! from their poses and velocities just before the impact ([`reenact`]), or the recorded forces act on the unit alone
//! ([`load_history`]).
//!
//! | file | content |
//! | --- | --- |
//! | [`froude`] | scale factors of lengths, velocities and forces; scaling of an impact |
//! | [`selection`] | selection of the impacts to re-run |
//! | [`model`] | properties of the units in the run |
//! | `nominal_stress` | nominal stresses of the units by beam theory |
//! | [`base`] | block that represents the bed under an impact |
//! | [`blow`] | an impact at prototype scale: velocities, duration, mass, momentum and energy |
//! | [`reenact`], [`load_history`] | the two methods: meshes, bodies and loads of a fracture case |
//! | [`fracture_case`] | file of the fracture case, for both methods |
//! | [`run`] | writes the fracture cases and runs them |
//! | [`results`] | results for each unit |

pub mod base;
pub mod blow;
pub mod fracture_case;
pub mod froude;
pub mod load_history;
pub mod model;
mod nominal_stress;
pub mod reenact;
pub mod results;
pub mod run;
pub mod selection;
