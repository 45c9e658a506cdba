//! Wave generation in the particle domain.
//!
//! | module | contents |
//! | --- | --- |
//! | [`wavemaker`] | multi-layer piston or paddle as moving rows of particles |
//! | [`ml_piston`] | multi-layer piston: particle rows that follow the water of a flume run |
//! | [`paddle`] | rigid piston or flap |
//! | [`paddle_motion`] | paddle motion that generates regular waves |
//! | [`absorption`] | active absorption of waves that return to a piston |
//! | [`velx`] | velocities of the rows of a piston in DualSPHysics' `_velx` format |

pub mod absorption;
pub mod ml_piston;
pub mod paddle;
pub mod paddle_motion;
pub mod velx;
pub mod wavemaker;
