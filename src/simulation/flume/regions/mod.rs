//! Regions of different particle spacing along the flume, coupled through buffers (variable resolution).
//!
//! Each region is a simulation of its own, with its own solver and time step. Beyond an end where another region
//! continues, a region has a [`Buffer`]: water particles that do not move by their own rates, but by the velocity,
//! acceleration and density rate of the water of the neighbouring region, as in Ricci et al. (2024). A water particle
//! that crosses the interface changes from water to buffer or back. New buffer particles enter at the outer edge of the
//! buffer with the flow of the neighbouring region (Tafuni et al. 2018).
//!
//! | entry | what it does |
//! | --- | --- |
//! | [`buffer`] | the buffer of a region: its particles, and its state in checkpoints |
//! | `coupling` | buffers take their state from the neighbouring region |
//! | `source` | the water of the neighbouring region, as a buffer sees it |
//! | `lattice` | its velocity, density and their rates on a lattice of points |
//! | `inflow` | particles enter and leave a buffer at its outer edge; mass that crosses the interface |

pub mod buffer;
mod coupling;
mod inflow;
mod lattice;
mod source;
