//! Deformable bodies that crack: the combined finite-discrete element method (FEMDEM).
//!
//! Guo, Latham and Xiang, *Numerical simulation of breakages of concrete armour units using a three-dimensional fracture
//! model*: tetrahedra deform, joints between them soften and break, crack faces and bodies touch. Equations are theirs
//! unless another source is named.
//!
//! | file | what it holds |
//! | --- | --- |
//! | `mesh` | tetrahedral meshes: reading, checking, ordering, faces |
//! | `material` | elasticity and strength |
//! | `element` | the linear tetrahedron |
//! | `softening`, `cohesive_law` | the law of a joint at a point |
//! | `joint` | the joint between two tetrahedra |
//! | `whole_joint` | joints without a past, four at a time |
//! | `joints` | all joints of a world |
//! | `lanes` | four numbers in a SIMD register |
//! | `deformation` | the pass over the tetrahedra |
//! | `setup` | what a world is made of |
//! | `history` | values that change with time |
//! | `loads` | tractions, pressures and forces about a place |
//! | `rigid_body`, `rigid_hold`, `principal_axes` | bodies that are not deformed |
//! | `assembly` | nodes, tetrahedra and joints as arrays; how nodes come apart |
//! | `contact` | tetrahedra that touch: overlap, friction, who can |
//! | `time_step` | the longest stable step |
//! | `world` | the step: the entry to this module |
//! | `release` | faces that give way |
//! | `motion` | how nodes and rigid bodies move on |
//! | `energy`, `book` | the energy book, and each body's part of it |
//! | `watch` | when a step cannot be trusted |
//! | `snapshot` | what changes with time, taken down and put back |

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
