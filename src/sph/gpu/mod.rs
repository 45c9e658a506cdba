//! The step on a graphics card, by wgpu: Vulkan, Metal or DirectX 12.
//!
//! | file | what it holds |
//! | --- | --- |
//! | [`card`] | finding and opening cards, buffers, reading back |
//! | [`constants`] | constants of the scheme as the shaders have them |
//! | [`state`] | places as bins and offsets, to and from the card |
//! | [`shaders`] | the shaders, each beside the Rust file of its stage |
//! | [`sort`] | the counting sort |
//! | `memory` | what lies on the card, and the kernels bound to it |
//! | `near` | the water near to surfaces |
//! | [`solver`] | the verbs of a step |
//!
//! The state of the water stays on the card, in single precision: a place is a bin and an offset in it, whose last bit
//! is a nanometre for bins of centimetres, so that slow particles do not stand still. Neighbours are found in the bins,
//! row by row, by every particle for itself: there are no lists.

pub mod card;
pub mod constants;
pub mod memory;
mod near;
pub mod shaders;
pub mod solver;
pub mod sort;
pub mod state;
