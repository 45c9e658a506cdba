//! Weakly compressible smoothed particle hydrodynamics (Mitsui et al. 2023, sections 2.1 and 2.2).
//!
//! | module | contents; each uses only those below it |
//! | --- | --- |
//! | [`device`] | choice of the processor (CPU) or a graphics card (GPU) |
//! | [`gpu`] | the time step on a graphics card |
//! | [`solver`] | the time step on the processor, time step limits, powers, sampling |
//! | [`pairs`] | sums over pairs of neighbours: rates and gradients |
//! | [`boundary`] | boundary particles from ghost nodes: density and velocity |
//! | [`neighbours`] | cell list, neighbour lists, particle records |
//! | [`particles`] | water, bed, walls and units as particles |
//! | [`parameters`] | constants of the scheme |
//! | [`terms`] | the equations, one per file |
//! | [`lanes`] | SIMD lanes |
//!
//! Each time step sorts the particles into the bins of a cell list. A cluster holds as many particles as there are SIMD
//! lanes and has one neighbour list; the pair sums add a neighbour to all members at once. Each particle gathers its
//! own sums in a fixed order, so results are bit-identical for any number of threads. A shader (`.wgsl`) lies beside
//! the Rust file of its stage.

pub mod boundary;
pub mod device;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod lanes;
pub mod neighbours;
pub mod pairs;
pub mod parameters;
pub mod particles;
pub mod solver;
pub mod terms;
