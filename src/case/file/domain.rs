//! The section `domain` of a flume case as the user writes it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Particle domain: the part of the flume that is filled with particles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DomainFile {
    /// x of the seaward and of the shoreward end [m]. The wavemaker stands at the seaward end, or a wall if the case
    /// has no wave. A wall stands at the shoreward end. With the wavemaker `open_ends`, both ends are open.
    pub x_m: [f64; 2],
    /// Width of the domain across the flume [m]. Leave this key out in two dimensions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width_m: Option<f64>,
    /// Boundaries at the two sides of the flume.
    pub sides: Sides,
    /// Level of the top of the walls [m]. The space above the walls for splashing water is as high as the walls are
    /// above the lowest ground. If a particle rises higher, the run stops with an error.
    pub top_z_m: f64,
    /// Particle spacing dp [m].
    pub dp_m: f64,
    /// Ranges of x with fine water, from the innermost to the outermost, at most two [m]. Inside the first range, the
    /// particle spacing is `dp_m`. Outside the first range it is 2 `dp_m`, and outside the second range 4 `dp_m`. The
    /// ranges follow the units.
    // Left out of the serialized case at its default, so that cases without this key keep their hash.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub fine_x_m: Vec<[f64; 2]>,
    /// Region that is filled with water at the start.
    #[serde(default)]
    pub water: WaterFile,
    /// Time of the flume model, or of the wave files, at which the particle simulation starts [s]. By default,
    /// `start_at_share` determines the start.
    #[serde(default)]
    pub start_s: Option<f64>,
    /// The particle simulation starts when the depth-averaged velocity of the water at the wavemaker first reaches this
    /// fraction of its maximum [-]. The velocity is taken from the flume model or from the wave files.
    #[serde(default = "default_start_share")]
    pub start_at_share: f64,
    /// Damping zone: slows the water down in front of the shoreward end, so that the end reflects no waves.
    // Left out of the serialized case at its default, so that cases without this key keep their hash.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub damping_zone: Option<DampingZoneFile>,
    /// Relaxation zone: forces the water near the wavemaker towards the velocity of the flume model. The zone absorbs
    /// waves that the structure reflects, so that the wavemaker does not reflect them again.
    // Left out of the serialized case at its default, so that cases without this key keep their hash.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub relaxation_zone: Option<RelaxationZoneFile>,
    /// Obstacles: fixed boxes in the water.
    // Left out of the serialized case at its default, so that cases without this key keep their hash.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub obstacles: Vec<BoxFile>,
}

pub(crate) fn default_start_share() -> f64 {
    0.03
}

/// A zone in which the velocity v of the water decays, dv/dt = -f v. The rate f is 0 at the seaward end of the zone and
/// `coefficient_per_s` at its shoreward end and beyond. In the zone, f is proportional to the square of the distance
/// from the seaward end.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DampingZoneFile {
    /// x of the seaward and of the shoreward end of the zone [m].
    pub x_m: [f64; 2],
    /// Rate f at the shoreward end [1/s].
    #[serde(default = "default_damping_per_s")]
    pub coefficient_per_s: f64,
}

fn default_damping_per_s() -> f64 {
    10.0
}

/// A zone in which the velocity v of the water relaxes to the velocity of the flume model, dv/dt = -f (v - v_flume).
/// The rate f is `coefficient_per_s` at the wavemaker and 0 at the end of the zone. Between these positions it is
/// proportional to the square of the distance from the end of the zone.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RelaxationZoneFile {
    /// x of the shoreward end of the zone [m].
    pub end_x_m: f64,
    /// Rate f at the wavemaker [1/s].
    #[serde(default = "default_damping_per_s")]
    pub coefficient_per_s: f64,
}

/// A fixed box with edges along the axes, around which water flows. Where the box touches the bed or an end of the
/// domain, there is no gap for water.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoxFile {
    /// Lower corner [x, y, z] [m].
    pub low_m: [f64; 3],
    /// Upper corner [x, y, z] [m].
    pub high_m: [f64; 3],
}

/// Boundaries at the two sides of the flume.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Sides {
    /// Periodic sides: water and units that leave the domain at one side enter it at the opposite side.
    Periodic,
    /// Solid walls at y = 0 and y = width.
    Walls,
    /// Two dimensions: one layer of particles, without variation across the flume. Units must be cuboids, which move
    /// along x and z and rotate about y.
    TwoDimensional,
}

/// Region that is filled with water at the start.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "kind", deny_unknown_fields)]
pub enum WaterFile {
    /// Water fills the domain up to the still water level, or up to the free surface of the flume model where the wave
    /// has already entered the domain.
    StillLevel {},
    /// Water fills a block between two x coordinates, from the bed up to a level, for a dam break.
    Block(BlockFile),
}

impl Default for WaterFile {
    fn default() -> Self {
        Self::StillLevel {}
    }
}

/// A block of water between two x coordinates, from the bed up to a level.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BlockFile {
    /// x of the seaward and of the shoreward face of the block [m].
    pub x_m: [f64; 2],
    /// Level z of the top of the block [m].
    pub top_z_m: f64,
    /// Level z of the shallower water in the rest of the domain [m]. By default, the rest is dry.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub around_z_m: Option<f64>,
}
