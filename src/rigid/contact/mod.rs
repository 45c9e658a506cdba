//! The data of a contact.
//!
//! | file | contents |
//! | --- | --- |
//! | `key` | identity of a contact: body, part and contact partner |
//! | `point` | a contact point, as the search finds it |
//! | `state` | an active contact with its history |

mod key;
mod point;
mod state;

pub use key::{ContactKey, Feature, MAX_FEATURES, WHOLE};
pub use point::ContactPoint;
pub use state::{Contact, Substep};
