//! From impact to crack: the hardest impacts of a run are computed again with units that deform and break.
//!
//! A laboratory unit never breaks; one fifty times larger, of the same concrete, may. So an impact is handed over at the
//! scale of the prototype ([`froude`]), either by letting both bodies collide again from the poses and velocities that
//! they had just before ([`reenact`]), or by letting the recorded forces act on the unit alone ([`load_history`]).
//!
//! | file | what it holds |
//! | --- | --- |
//! | [`froude`] | lengths, velocities, forces of the prototype; how a blow changes |
//! | [`selection`] | which impacts are handed over |
//! | [`model`] | what the impacts come from, and nominal stresses of the units |
//! | [`base`] | a block of the bed |
//! | [`blow`] | an impact in the prototype: speeds, duration, what is the same on both sides |
//! | [`reenact`], [`load_history`] | the two ways: meshes, bodies and loads of a fracture case |
//! | [`fracture_case`] | the case file of both |
//! | [`run`] | the cases written and computed |
//! | [`results`] | what came of it, a row for each unit |

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
