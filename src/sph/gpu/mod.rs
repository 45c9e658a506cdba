//! The time step on a graphics card with wgpu (Vulkan, Metal or DirectX 12).
//!
//! | file | contents |
//! | --- | --- |
//! | [`card`] | detects and opens cards, creates buffers, reads results |
//! | [`constants`] | constants of the scheme in the layout of the shaders (programs for the card) |
//! | [`state`] | state of the particles on the card, and its conversion |
//! | [`shaders`] | the shaders and their compilation |
//! | [`sort`] | the counting sort |
//! | `memory` | buffers on the card, and the shader functions bound to these buffers |
//! | `near` | search for the water particles near surfaces |
//! | [`solver`] | the operations of a time step |
//!
//! The water stays in the memory of the card, in single precision. A position is stored as a bin and an offset in this
//! bin. For bins of a few centimetres, the rounding error of an offset is only about a nanometre, so that slow
//! particles still move. The card has no neighbour lists: each particle searches the bins around it row by row.

pub mod card;
pub mod constants;
pub mod memory;
mod near;
pub mod shaders;
pub mod solver;
pub mod sort;
pub mod state;
