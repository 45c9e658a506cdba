//! The section `structure` as the user writes it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::BoxFile;

/// A solid part of a structure, for example a mound, a toe berm, a crown wall or a caisson. Give exactly one of
/// `polygon_m`, `box` and `stl`. Units can rest on it, and water flows around it.
///
/// A part that is the same across the flume, and that lies on the bed without vertical or overhanging faces, becomes
/// part of the bed, also in the flume model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PartFile {
    /// Name of the part in gauges and reports.
    pub name: String,
    /// Corner points [x, z] of the section of a part that is the same across the flume [m], in either direction.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub polygon_m: Option<Vec<[f64; 2]>>,
    /// A box with edges along the axes.
    #[serde(rename = "box", default, skip_serializing_if = "Option::is_none")]
    pub cuboid: Option<BoxFile>,
    /// A closed surface from an STL file, of any shape.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stl: Option<PartStlFile>,
    /// Material of the surface: a name in `materials`. By default, the material of the bed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub material: Option<String>,
}

/// A closed surface in an STL file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PartStlFile {
    /// Path of the STL file, relative to the folder of the case file.
    pub path: String,
    /// Metres per length unit of the file [-]: 0.001 for a file in millimetres.
    #[serde(default = "default_scale")]
    pub scale: f64,
    /// Position of the origin of the file in the flume [x, y, z] [m].
    #[serde(default)]
    pub origin_m: [f64; 3],
}

fn default_scale() -> f64 {
    1.0
}
