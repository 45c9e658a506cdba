//! Weakly compressible smoothed particle hydrodynamics (Mitsui et al. 2023, sections 2.1 and 2.2).
//!
//! | module | contents (a module uses only the modules below it) |
//! | --- | --- |
//! | [`device`] | choice between the processor (CPU) and a graphics card (GPU) |
//! | [`gpu`] | the time step on a graphics card |
//! | [`solver`] | the time step on the processor (operations, size), power balance of the water, sampling for gauges |
//! | [`surface`] | surface of the water as triangles, for films |
//! | [`pairs`] | sums over pairs of neighbours: rates and gradients |
//! | [`boundary`] | density and velocity of boundary particles, from ghost nodes |
//! | [`neighbours`] | cell list, neighbour lists, particle records |
//! | [`particles`] | water, bed, walls and units as particles |
//! | [`parameters`] | constants of the scheme |
//! | [`terms`] | the equations, one per file |
//! | [`lanes`] | SIMD lanes: one instruction computes 8 or 16 particles |
//!
//! In each time step the solver sorts the particles into the bins of a cell list. Consecutive particles form clusters,
//! with at most one particle per SIMD lane. The members of a cluster share one neighbour list, and the pair sums add
//! the contribution of a neighbour to all members at once. Each particle sums over its neighbours in a fixed order, so
//! results are bit-identical for any number of threads. Each shader (`.wgsl`, the program for graphics cards) is in the
//! folder of the Rust file with the same equations.

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
pub mod surface;
pub mod terms;
