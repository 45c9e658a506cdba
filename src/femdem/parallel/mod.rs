//! Work on several numbers at a time.
//!
//! | file | contents |
//! | --- | --- |
//! | `lanes` | SIMD lanes: four numbers in a register |
//! | `chunks` | chunks of work for the thread pool, and sums over them |

pub mod chunks;
pub mod lanes;
