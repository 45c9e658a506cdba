//! Parameters of a [`super::LayeredFlume`].

use crate::geometry::profile::Profile;
use crate::waves::flume_model::incoming::IncomingWave;
use crate::waves::theory::solitary::SolitaryWave;

/// Parameters of a flume: bed, water, grid, ends and dissipation.
#[derive(Debug, Clone)]
pub struct LayeredParameters {
    /// Bed from the left end (the piston at rest) to the right end.
    pub profile: Profile,
    /// Still water level z [m].
    pub still_level_m: f64,
    /// Gravitational acceleration [m/s2].
    pub gravity_m_s2: f64,
    /// Number of layers K.
    pub layers: usize,
    /// Cell width [m]; use at least 1/20 of the depth, because a few layers do not resolve the shortest waves of a
    /// finer grid.
    pub cell_m: f64,
    /// Time step [s].
    pub step_s: f64,
    /// Left end.
    pub left_end: LeftEnd,
    /// Right end.
    pub right_end: RightEnd,
    /// Pressure model.
    pub pressure: Pressure,
    /// Bed friction.
    pub friction: Friction,
    /// Wave breaking.
    pub breaking: Breaking,
}

/// Seaward end of a flume.
#[derive(Debug, Clone, PartialEq)]
pub enum LeftEnd {
    /// A wall.
    Wall,
    /// A piston that generates a solitary wave; its stroke starts at t = 0.
    Piston {
        /// The wave; its depth is the still water depth at the piston.
        wave: SolitaryWave,
        /// Length in front of the piston over which the cells follow the piston [m].
        mapped_m: f64,
    },
    /// An inflow boundary: the wave enters and returning waves leave through it.
    Inflow(IncomingWave),
}

/// Shoreward end of a flume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RightEnd {
    /// A wall; the water may end at a dry shore in front of it.
    Wall,
    /// An open end through which long waves leave (see `ends`). The bed at this end must be under water.
    Radiating,
    /// A sponge layer in front of a wall (see `ends`).
    Sponge {
        /// Length of the sponge [m].
        length_m: f64,
    },
}

/// Pressure model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pressure {
    /// Pressure with the effect of vertical accelerations; waves are dispersive.
    NonHydrostatic,
    /// Shallow-water equations without dispersion, for comparison with their exact solutions.
    Hydrostatic,
}

/// Bed friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Friction {
    /// No friction.
    None,
    /// A hydraulically smooth bed, as in a laboratory flume; see `friction`.
    SmoothBed {
        /// Kinematic viscosity nu [m2/s]; 1e-6 for water.
        viscosity_m2_s: f64,
    },
    /// A rough bed with Manning's law; see `friction`.
    Manning {
        /// Manning's n [s m^(-1/3)]: 0.010 glass, 0.012 planed wood, 0.013 smooth concrete (Chow 1959, table 5-6).
        n_s_m13: f64,
    },
}

/// Breaking of fronts that become too steep for a single-valued surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Breaking {
    /// No breaking model: a front steepens until the grid no longer resolves it.
    Unlimited,
    /// Breaking fronts are hydrostatic and become bores (Smit, Zijlema & Stelling 2013).
    HydrostaticFront {
        /// Rate of rise of the surface, divided by sqrt(g H), above which a cell starts to break [-].
        onset: f64,
        /// Rate of rise, divided by sqrt(g H), above which a cell breaks if it or a neighbour broke in the previous
        /// time step [-].
        persistence: f64,
    },
}

impl Default for Breaking {
    /// The thresholds of Smit et al. (2013), section 3: 0.6 and 0.3.
    fn default() -> Self {
        Self::HydrostaticFront { onset: 0.6, persistence: 0.3 }
    }
}
