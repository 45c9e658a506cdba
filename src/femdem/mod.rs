//! Deformable bodies that crack: the combined finite-discrete element method (FEMDEM).
//!
//! Method: Guo, Latham and Xiang, *Numerical simulation of breakages of concrete armour units using a three-dimensional
//! fracture model*. Tetrahedra deform, joint elements between them soften and break, bodies and crack faces come into
//! contact. Equation numbers refer to this paper unless another source is named.
//!
//! A module imports only from the modules above it in this table.
//!
//! | module | contents |
//! | --- | --- |
//! | `mesh` | tetrahedral meshes: reading, checking, ordering, faces |
//! | `material` | elasticity, strength and cohesive law |
//! | `parallel` | SIMD lanes and chunks of work |
//! | `element` | the linear tetrahedron |
//! | `principal_stresses` | principal values of a stress tensor |
//! | `loads` | tractions, pressures, forces that act at a point; their change with time |
//! | `setup` | input of a world: mesh, bodies, constraints, loads |
//! | `assembly` | nodes and tetrahedra as arrays; node splitting |
//! | `deformation` | nodal forces of all tetrahedra |
//! | `joints` | joint elements between tetrahedra, intact and damaged |
//! | `contact` | contact between tetrahedra: detection, overlap, friction |
//! | `rigid` | rigid bodies |
//! | `world` | a world and its time step: the entry to this module |

pub mod assembly;
pub mod contact;
mod deformation;
pub mod element;
pub mod joints;
pub mod loads;
pub mod material;
pub mod mesh;
mod parallel;
pub mod principal_stresses;
pub mod rigid;
pub mod setup;
pub mod world;
