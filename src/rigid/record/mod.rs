//! Records of contacts.
//!
//! | file | contents |
//! | --- | --- |
//! | `event` | start, peak and end of each contact |
//! | `force_history` | contact force against time |
//! | `impact_log` | the hardest impacts of each unit |
//! | `contact_records` | records of active contacts, stored when a contact ends |

mod contact_records;
mod event;
mod force_history;
mod impact_log;

pub use contact_records::{ContactRecords, ContactStart, ForceStep};
pub use event::{ContactEvent, EventLog};
pub use force_history::{ForceHistory, ForceSample};
pub use impact_log::{ImpactLog, RecordedContact};
