//! Records of contacts.
//!
//! | file | contents |
//! | --- | --- |
//! | `event` | start, peak and end of each contact |
//! | `force_history` | contact force against time |
//! | `impact_log` | the hardest impacts of each unit |
//! | `running_record` | the record of an active contact |
//! | `contact_records` | the records of all contacts |

mod contact_records;
mod event;
mod force_history;
mod impact_log;
mod running_record;

pub use contact_records::{ContactRecords, ContactStart};
pub use event::{ContactEvent, EventLog};
pub use force_history::{ForceHistory, ForceSample};
pub use impact_log::{ImpactLog, RecordedContact};
pub use running_record::{ForceStep, RunningRecord};
