//! The section `structure` as the user writes it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::BoxFile;

/// A part of a structure, for example a mound, a toe berm, a crown wall or a caisson. Give exactly one of
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
    /// Makes the part permeable. By default, no water flows through it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub porous: Option<PorousFile>,
}

/// Rubble, gravel or sand that does not move, and through which water flows. Give exactly one of `d50_m` and `d_n50_m`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PorousFile {
    /// Porosity: the share of the pores in the volume [-].
    pub porosity: f64,
    /// Median diameter D50 of the stones [m].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub d50_m: Option<f64>,
    /// Nominal diameter D_n50 of the stones [m]; D50 = D_n50 / 0.84.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub d_n50_m: Option<f64>,
    /// Source of the drag coefficients alpha and beta.
    #[serde(default)]
    pub coefficients: DragSource,
    /// Coefficient alpha of the linear drag [-]. By default, that of the source.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub alpha: Option<f64>,
    /// Coefficient beta of the quadratic drag [-]. By default, that of the source.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub beta: Option<f64>,
    /// Keulegan-Carpenter number U T / (n D50) of the oscillating flow in the pores [-]. By default, the flow is steady.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub keulegan_carpenter: Option<f64>,
    /// Coefficient gamma of the added mass gamma (1 - n) / n [-].
    #[serde(default = "default_added_mass")]
    pub added_mass: f64,
}

fn default_added_mass() -> f64 {
    0.34
}

/// Source of the coefficients of the drag in a porous medium.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
pub enum DragSource {
    /// Jensen et al. (2014): alpha = 500, beta = 2.
    #[default]
    #[serde(rename = "jensen_2014")]
    Jensen2014,
    /// Van Gent (1995): alpha = 1000, beta = 1.1.
    #[serde(rename = "van_gent_1995")]
    VanGent1995,
    /// Liu et al. (1999): alpha = 200, beta = 1.1.
    #[serde(rename = "liu_1999")]
    Liu1999,
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
