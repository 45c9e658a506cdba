//! Parallel computation: SIMD lanes, and chunks of work for threads.
//!
//! | file | contents |
//! | --- | --- |
//! | `lanes` | SIMD lanes: four numbers in a register |
//! | `chunks` | chunks of work for the thread pool, and sums over chunks |

pub mod chunks;
pub mod lanes;
