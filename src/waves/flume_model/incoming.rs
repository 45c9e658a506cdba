//! Incoming waves at the left end of the flume: elevation and velocity over time at one position.

use crate::waves::theory::irregular::IrregularWave;
use crate::waves::theory::solitary::ThirdOrderSolitary;
use crate::waves::theory::stream_function::StreamFunctionWave;

/// An incoming wave at the inflow boundary.
#[derive(Debug, Clone, PartialEq)]
pub enum IncomingWave {
    /// Third-order solitary wave.
    Solitary {
        /// The wave.
        wave: ThirdOrderSolitary,
        /// Time at which the crest passes the inflow [s].
        crest_at_s: f64,
    },
    /// Regular waves of permanent form.
    Regular {
        /// The wave; a crest passes the inflow at t = 0.
        wave: StreamFunctionWave,
        /// Duration of the ramp from still water [s].
        ramp_s: f64,
    },
    /// Irregular waves.
    Irregular {
        /// The wave components.
        wave: IrregularWave,
        /// Duration of the ramp from still water [s].
        ramp_s: f64,
    },
}

impl IncomingWave {
    /// Creates a solitary wave that enters the flume at t = 0 with its front, where the elevation is 1e-4 of the
    /// height.
    pub fn solitary(wave: ThirdOrderSolitary) -> Self {
        Self::Solitary { wave, crest_at_s: wave.half_length_m() / wave.celerity_m_s() }
    }

    /// Elevation above still water [m] at time t [s].
    pub fn elevation_m(&self, t: f64) -> f64 {
        match self {
            Self::Solitary { wave, crest_at_s } => wave.elevation_m(wave.celerity_m_s() * (crest_at_s - t)),
            Self::Regular { wave, ramp_s } => ramp(t, *ramp_s) * wave.elevation_m(wave.phase(0.0, t)),
            Self::Irregular { wave, ramp_s } => ramp(t, *ramp_s) * wave.elevation_m(t),
        }
    }

    /// Horizontal velocity [m/s] at z [m] above still water and time t [s].
    pub fn velocity_m_s(&self, z: f64, t: f64) -> f64 {
        match self {
            Self::Solitary { wave, crest_at_s } => wave.velocity_m_s(wave.celerity_m_s() * (crest_at_s - t), z),
            Self::Regular { wave, ramp_s } => ramp(t, *ramp_s) * wave.velocity_m_s(wave.phase(0.0, t), z),
            Self::Irregular { wave, ramp_s } => ramp(t, *ramp_s) * wave.velocity_m_s(z, t),
        }
    }

    /// Linear or harmonic components of the velocity at time t [s]: for each k d [-] and the velocity at still water level
    /// [m/s]. A solitary wave has none.
    pub fn harmonics(&self, t: f64) -> Box<dyn Iterator<Item = [f64; 2]> + '_> {
        let ramped = move |ramp_s: f64| move |[kd, velocity]: [f64; 2]| [kd, ramp(t, ramp_s) * velocity];
        match self {
            Self::Solitary { .. } => Box::new(std::iter::empty()),
            Self::Regular { wave, ramp_s } => Box::new(wave.harmonics(wave.phase(0.0, t)).map(ramped(*ramp_s))),
            Self::Irregular { wave, ramp_s } => Box::new(wave.harmonics(t).map(ramped(*ramp_s))),
        }
    }

    /// Still water depth for which the wave is defined [m].
    pub fn depth_m(&self) -> f64 {
        match self {
            Self::Solitary { wave, .. } => wave.depth_m,
            Self::Regular { wave, .. } => wave.parameters().depth_m,
            Self::Irregular { wave, .. } => wave.sea().depth_m,
        }
    }

    /// Maximum wave height [m]. For irregular waves: twice the significant wave height; 1 wave in 3,000 is higher.
    pub fn height_m(&self) -> f64 {
        match self {
            Self::Solitary { wave, .. } => wave.height_m,
            Self::Regular { wave, .. } => wave.parameters().height_m,
            Self::Irregular { wave, .. } => 2.0 * wave.sea().significant_height_m,
        }
    }
}

/// Half-cosine ramp from 0 to 1 over `duration` [s].
fn ramp(t: f64, duration: f64) -> f64 {
    if t >= duration { 1.0 } else { 0.5 - 0.5 * (std::f64::consts::PI * (t / duration).max(0.0)).cos() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solitary_wave_enters_from_still_water() {
        let wave = ThirdOrderSolitary { height_m: 0.064, depth_m: 0.8, gravity: 9.81 };
        let incoming = IncomingWave::solitary(wave);
        assert!(incoming.elevation_m(0.0) < 1.1e-4 * wave.height_m);
        let IncomingWave::Solitary { crest_at_s, .. } = incoming else { panic!("a solitary wave") };
        assert!((incoming.elevation_m(crest_at_s) - wave.height_m).abs() < 1e-12);
        assert_eq!((ramp(-1.0, 2.0), ramp(3.0, 2.0), ramp(0.0, 0.0)), (0.0, 1.0, 1.0));
        assert!((ramp(1.0, 2.0) - 0.5).abs() < 1e-15);
    }
}
