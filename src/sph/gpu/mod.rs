//! The time step on a graphics card with wgpu (Vulkan, Metal or DirectX 12).
//!
//! | file | contents |
//! | --- | --- |
//! | [`card`] | detecting and opening cards, buffers, reading back |
//! | [`constants`] | constants of the scheme in the layout of the shaders |
//! | [`state`] | positions as bins and offsets, to and from the card |
//! | [`shaders`] | the shaders, each next to the Rust file of its stage |
//! | [`sort`] | the counting sort |
//! | `memory` | buffers on the card, and the kernels bound to them |
//! | `near` | the water near surfaces |
//! | [`solver`] | the operations of a time step |
//!
//! The water stays on the card in single precision. A position is a bin and an offset in it; for bins of centimetres
//! the last bit of the offset is a nanometre, so that slow particles still move. There are no neighbour lists: each
//! particle searches the bins row by row.

pub mod card;
pub mod constants;
pub mod memory;
mod near;
pub mod shaders;
pub mod solver;
pub mod sort;
pub mod state;
