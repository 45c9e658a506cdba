//! Deformable bodies that crack: the combined finite-discrete element method (FEMDEM).
//!
//! Method: Guo, Latham and Xiang, *Numerical simulation of breakages of concrete armour units using a three-dimensional
//! fracture model*. Tetrahedra deform. Joint elements between the tetrahedra soften and break. Bodies come into contact
//! with each other, and the two faces of a crack with each other. Equation numbers refer to this paper unless another
//! source is named.
//!
//! A module imports only from the modules above it in this table.
//!
//! | module | contents |
//! | --- | --- |
//! | `mesh` | tetrahedral meshes: reading, checking, ordering, faces |
//! | `material` | elasticity, strength and cohesive law |
//! | `parallel` | SIMD lanes (four numbers in a register), and chunks of work for threads |
//! | `element` | the linear tetrahedron |
//! | `principal_stresses` | principal values of a stress tensor |
//! | `loads` | tractions, pressures and point loads, as time series |
//! | `setup` | input from which a world is built: mesh, bodies, constraints, loads |
//! | `assembly` | nodes and tetrahedra as arrays; splitting of nodes at cracks |
//! | `deformation` | nodal forces of all tetrahedra |
//! | `joints` | joint elements between tetrahedra, intact and damaged |
//! | `contact` | contact between tetrahedra: detection, overlap, friction |
//! | `rigid` | rigid bodies |
//! | `world` | all bodies, joints and contacts of a run, and their time step: the entry to `femdem` |

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
