//! Nodes and tetrahedra of a world as arrays.
//!
//! | file | contents |
//! | --- | --- |
//! | `nodes` | positions, velocities and masses of the nodes; the node copies |
//! | `tets` | vertices and shapes of the tetrahedra; their interfaces |
//! | `splitting` | which copies of a mesh node move together, and the splitting of nodes |

pub mod nodes;
pub mod splitting;
pub mod tets;
