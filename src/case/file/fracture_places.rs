//! Landmarks and the cut plane (section) of a fracture case, as the user writes them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A landmark: a box with a name, in the undeformed mesh. For each crack, the report names the landmark nearest to the
/// point where the crack starts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LandmarkFile {
    /// Name of the landmark in the report, for example "upper stem-fluke corner".
    pub name: String,
    /// Corner of the box with the smallest x, y and z [m].
    pub low_m: [f64; 3],
    /// Corner of the box with the largest x, y and z [m]; equal to `low_m` for a point.
    pub high_m: [f64; 3],
}

/// A section: a plane that cuts the bodies. The report shows the stresses in this plane.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SectionFile {
    /// A point of the undeformed mesh through which the plane passes [m].
    pub point_m: [f64; 3],
    /// Normal vector of the plane, of any length. The report views the plane along this vector.
    pub normal: [f64; 3],
}
