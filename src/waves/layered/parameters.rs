//! What a [`super::LayeredFlume`] is made of.

use crate::geometry::profile::Profile;
use crate::waves::incoming::IncomingWave;
use crate::waves::solitary::SolitaryWave;

/// The flume, its grid, its ends and what takes energy out of the water.
#[derive(Debug, Clone)]
pub struct LayeredParameters {
    /// Bed from the left end (the piston at rest) to the right end.
    pub profile: Profile,
    /// Still-water level z [m].
    pub still_level_m: f64,
    /// Gravity [m/s2].
    pub gravity_m_s2: f64,
    /// Number of layers K.
    pub layers: usize,
    /// Width of a cell [m]: not below a twentieth of the depth, where waves as short as the grid are no longer
    /// resolved by a few layers.
    pub cell_m: f64,
    /// Time step [s].
    pub step_s: f64,
    /// What stands at the left end.
    pub left_end: LeftEnd,
    /// What stands at the right end.
    pub right_end: RightEnd,
    /// Vertical accelerations.
    pub pressure: Pressure,
    /// Friction on the bed.
    pub friction: Friction,
    /// Breaking of waves.
    pub breaking: Breaking,
}

/// The seaward end of a flume.
#[derive(Debug, Clone, PartialEq)]
pub enum LeftEnd {
    /// A wall.
    Wall,
    /// A piston that makes a solitary wave; its stroke starts at t = 0.
    Piston {
        /// The wave, its depth that at the piston.
        wave: SolitaryWave,
        /// Length in front of the piston over which the cells follow it [m].
        mapped_m: f64,
    },
    /// Water that flows in and out with a wave; what comes back from the flume leaves through it.
    Inflow(IncomingWave),
}

/// The shoreward end of a flume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RightEnd {
    /// A wall; the shore may lie before it.
    Wall,
    /// Water that goes on: long waves leave, see `ends`. The end must stand in water.
    Radiating,
    /// A wall behind water whose motion is damped over this length [m], see `ends`.
    Sponge {
        /// Length of the damped water [m].
        length_m: f64,
    },
}

/// What the pressure answers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pressure {
    /// Weight and vertical accelerations: waves disperse.
    NonHydrostatic,
    /// Weight alone, the shallow-water equations, for comparison with their solutions.
    Hydrostatic,
}

/// Friction on the bed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Friction {
    /// None.
    None,
    /// A hydraulically smooth bed, as of a laboratory flume; see `friction`.
    SmoothBed {
        /// Kinematic viscosity nu [m2/s]; 1e-6 for water.
        viscosity_m2_s: f64,
    },
    /// A rough bed, by Manning's law; see `friction`.
    Manning {
        /// Manning's n [s m^(-1/3)]: 0.010 glass, 0.012 planed wood, 0.013 smooth concrete (Chow 1959, table 5-6).
        n_s_m13: f64,
    },
}

/// What happens where a front becomes too steep for a single-valued surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Breaking {
    /// Nothing: the front steepens as far as the grid resolves it.
    Unlimited,
    /// The front turns hydrostatic and becomes a bore (Smit, Zijlema & Stelling 2013).
    HydrostaticFront {
        /// Rate of rise over sqrt(g H) at which a front begins to break [-].
        starts: f64,
        /// The same at which it still breaks, next to a cell that does [-].
        lasts: f64,
    },
}

impl Default for Breaking {
    /// The thresholds of Smit et al. (2013), section 3: 0.6 and 0.3.
    fn default() -> Self {
        Self::HydrostaticFront { starts: 0.6, lasts: 0.3 }
    }
}
