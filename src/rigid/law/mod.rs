//! Contact laws.
//!
//! | file | contents |
//! | --- | --- |
//! | `parameters` | materials, resistance and the choice of the law |
//! | `contact_law` | the contact law of a pair of surfaces, a pure function |
//! | `hertz_mindlin`, `linear` | stiffness and damping of the contact laws |

mod contact_law;
mod hertz_mindlin;
mod linear;
mod parameters;

pub use contact_law::{ContactLaw, Rolling};
pub use hertz_mindlin::{effective_young_modulus, impact_overlap};
pub use parameters::{ContactModel, Material, Resistance};
