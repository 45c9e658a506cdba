//! Landmarks and the section of a fracture case as the user writes them.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A landmark: a named box in the undeformed mesh. The report uses it to say where cracks begin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LandmarkFile {
    /// Name in words, such as "upper stem-fluke corner".
    pub name: String,
    /// Lower corner of the box [m].
    pub low_m: [f64; 3],
    /// Upper corner of the box [m]; equal to `low_m` for a point.
    pub high_m: [f64; 3],
}

/// A section: a plane that cuts the bodies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SectionFile {
    /// A point in the plane [m], in the undeformed mesh.
    pub point_m: [f64; 3],
    /// Normal of the plane, of any length. The pictures look along it.
    pub normal: [f64; 3],
}
