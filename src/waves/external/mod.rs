//! The velocity of a wave at one place from files of other programs, and written back for them.
//!
//! | module | what it holds |
//! | --- | --- |
//! | [`table`] | velocity over height and time, which every reader gives, and the checks it must pass |
//! | [`velx`] | `_velx` files of DualSPHysics |
//! | [`error`] | what can be wrong with such files |

pub mod error;
pub mod table;
pub mod velx;

