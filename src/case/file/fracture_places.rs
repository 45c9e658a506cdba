//! Places that a fracture case names: landmarks of the units, and the plane that they are cut by for pictures.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A place with a name: a box about it, in the mesh as it stands at the start. Where cracks begin is told by these.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LandmarkFile {
    /// Its name in words, such as "upper stem-fluke corner".
    pub name: String,
    /// Lowest corner of the box [m].
    pub low_m: [f64; 3],
    /// Highest corner of the box [m]; that of a point is its lowest, too.
    pub high_m: [f64; 3],
}

/// A plane that the bodies are cut by.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SectionFile {
    /// A point in it [m], in the mesh as it stands at the start.
    pub point_m: [f64; 3],
    /// Its normal, of any length; it is looked at along this direction.
    pub normal: [f64; 3],
}
