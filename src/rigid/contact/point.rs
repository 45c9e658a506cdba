//! Contact points, as the search finds them.

use glam::DVec3;

use super::key::ContactKey;

/// A contact point: two surfaces overlap or are near each other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactPoint {
    /// Identity of the contact.
    pub key: ContactKey,
    /// Middle of the overlap [m], at the first body.
    pub position: DVec3,
    /// Normal from the partner into the first body.
    pub normal: DVec3,
    /// Overlap d [m]; negative for a gap.
    pub overlap: f64,
    /// Shift of the partner's periodic image [m].
    pub shift: DVec3,
    /// Nearest point of the partner's core, in the partner's axes [m]; for a fixed surface, the foot point on it.
    pub core: DVec3,
}
