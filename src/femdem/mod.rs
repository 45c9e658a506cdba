//! Deformable bodies that crack: the combined finite-discrete element method (FEMDEM).
//!
//! Method: Guo, Latham and Xiang, *Numerical simulation of breakages of concrete armour units using a three-dimensional
//! fracture model*. Tetrahedra deform, joint elements between them soften and break, bodies and crack faces come into
//! contact. Equation numbers refer to this paper unless another source is named.
//!
//! | file | contents |
//! | --- | --- |
//! | `mesh` | tetrahedral meshes: reading, checking, ordering, faces |
//! | `material` | elasticity and strength |
//! | `element` | the linear tetrahedron |
//! | `softening`, `cohesive_law` | the cohesive law at an integration point of a joint |
//! | `joint` | the joint element between two tetrahedra |
//! | `whole_joint` | intact joints, four at a time |
//! | `joints` | all joints of a world |
//! | `lanes` | SIMD lanes: four numbers in a register |
//! | `deformation` | nodal forces of all tetrahedra |
//! | `setup` | input of a world: mesh, bodies, constraints, loads |
//! | `history` | values that change with time |
//! | `loads` | tractions, pressures, forces that act at a point |
//! | `rigid_body`, `rigid_hold`, `principal_axes` | rigid bodies |
//! | `assembly` | nodes and tetrahedra as arrays; node splitting |
//! | `contact` | contact between tetrahedra: detection, overlap, friction |
//! | `time_step` | the time step limit |
//! | `world` | one time step: the entry to this module |
//! | `release` | tied faces that become joints, joints that break |
//! | `motion` | motion of nodes and rigid bodies |
//! | `energy`, `book` | the energy balance, total and per body |
//! | `watch` | limits that stop an unstable run |
//! | `snapshot` | saves and restores the state |

pub mod assembly;
pub mod book;
pub mod cohesive_law;
pub mod contact;
mod deformation;
pub mod element;
pub mod energy;
pub mod history;
pub mod joint;
pub mod joints;
mod lanes;
pub mod loads;
pub mod material;
pub mod mesh;
mod motion;
pub mod principal_axes;
mod release;
pub mod rigid_body;
mod rigid_hold;
pub mod setup;
pub mod snapshot;
pub mod softening;
pub mod time_step;
pub mod watch;
mod whole_joint;
pub mod world;
