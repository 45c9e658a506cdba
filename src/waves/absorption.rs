//! Active absorption: a piston that moves with the waves that come back to it, so that they do not go out again.
//!
//! Schaffer & Klopman (2000), "Review of multidirectional active wave absorption methods"; Altomare et al. (2017),
//! section 2.3. A gauge that moves with the piston shows the surface; what it shows beyond the wave that is being made
//! comes back, eta_in, or goes out wrongly, eta_out. The piston moves seaward at U = -(eta_in + eta_out) u/eta, with
//! u/eta = sqrt(g/d) for long waves; what goes out is then eta_out = eta_in + U eta/u = 0.
//!
//! The gauge stands a time a before the piston: it sees eta_in by a too early and eta_out by a too late. Readings,
//! which scatter by a twentieth of a particle distance, are smoothed, tau y' = eta_in(t + a) + eta_out(t - a) - y. With
//! eta_out = eta_in - y and slow waves that is y + (tau - a) y' / 2 = eta_in: for tau = a there is no lag, and the
//! loop is stable for any a, because the delayed term is not larger than the other.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use super::regular::linear_wavenumber_per_m;

/// How a piston absorbs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Absorption {
    /// Distance of the gauge from the piston [m].
    pub gauge_m: f64,
    /// Time that waves take from there to the piston [s].
    pub way_s: f64,
    /// Mean velocity of the water over the elevation [1/s].
    pub velocity_per_elevation: f64,
    /// How far it may carry the piston to either side of where its own motion has it [m].
    pub reach_m: f64,
    /// Time in which it is taken back, so that the piston does not drift away in periodic waves [s].
    pub return_s: Option<f64>,
}

/// Where absorption has carried the piston, and what the gauge has shown.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct AbsorptionState {
    /// Displacement beside the piston's own [m].
    pub displacement_m: f64,
    /// Velocity beside its own [m/s].
    pub velocity_m_s: f64,
    /// Smoothed elevation beyond that of the wave that is made [m].
    excess_m: f64,
}

/// Periods over which an absorbing piston in periodic waves is drawn back to where it would stand without absorption:
/// long enough that the velocity of absorption loses no more than 1 / (2 pi 10) = 1.6 % of itself, out of phase, and
/// short enough that the mass which waves carry does not push the piston away.
pub(super) const RETURN_PERIODS: f64 = 10.0;

impl Absorption {
    /// For a piston of full depth [m] in waves of a period [s], or in long ones without a period, with a gauge at a
    /// distance [m]; it goes no further than `reach_m` [m] from its own motion. By linear theory a piston that moves
    /// at U makes waves of eta = U 4 sinh^2(kd) / (omega (sinh 2kd + 2kd)) (Biesel 1951), long ones of U sqrt(d/g).
    pub fn of_piston(gauge_m: f64, depth_m: f64, period_s: Option<f64>, gravity: f64, reach_m: f64) -> Self {
        let long = (gravity * depth_m).sqrt();
        let (celerity, velocity_per_elevation) = period_s.map_or((long, long / depth_m), |period| {
            let omega = TAU / period;
            let number = linear_wavenumber_per_m(omega, depth_m, gravity);
            let kd = number * depth_m;
            (omega / number, omega * ((2.0 * kd).sinh() + 2.0 * kd) / (4.0 * kd.sinh().powi(2)))
        });
        Self {
            gauge_m,
            way_s: gauge_m / celerity,
            velocity_per_elevation,
            reach_m,
            return_s: period_s.map(|period| RETURN_PERIODS * period),
        }
    }

    /// Take a reading, the elevation beyond that of the wave that is made [m], and move over a step `dt` [s].
    pub fn advance(&self, state: &mut AbsorptionState, excess_m: f64, dt: f64) {
        state.excess_m += (1.0 - (-dt / self.way_s).exp()) * (excess_m - state.excess_m);
        let back = self.return_s.map_or(0.0, |time| state.displacement_m / time);
        let wanted = state.displacement_m - dt * (self.velocity_per_elevation * state.excess_m + back);
        let reached = wanted.clamp(-self.reach_m, self.reach_m);
        state.velocity_m_s = (reached - state.displacement_m) / dt;
        state.displacement_m = reached;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::waves::paddle_motion::{PaddleShape, RegularMotion};
    use crate::waves::regular::RegularWave;

    const DT: f64 = 0.001;
    const PISTON: Absorption =
        Absorption { gauge_m: 0.2, way_s: 0.1, velocity_per_elevation: 5.0, reach_m: 0.5, return_s: None };

    /// A wave that comes to the piston, and what goes out from it when it moves at U: eta_out = eta_in + U eta/u.
    #[test]
    fn a_long_wave_does_not_go_out_again() {
        let coming = |t: f64| 0.03 / (3.0 * (t - 3.0)).cosh().powi(2);
        let (mut state, mut out) = (AbsorptionState::default(), vec![0.0; 100]);
        for i in 0..6000 {
            let t = DT * f64::from(i);
            // The gauge sees what comes 0.1 s too early and what goes out 0.1 s too late.
            PISTON.advance(&mut state, coming(t + 0.1) + out[out.len() - 100], DT);
            out.push(coming(t) + state.velocity_m_s / 5.0);
        }
        let largest = out.iter().fold(0.0_f64, |most, eta| most.max(eta.abs()));
        // What is left at second order is a^2 eta'' / 4, 4.5 % of this crest; 5.2 % with the orders beyond.
        assert!(largest < 0.06 * 0.03, "{}", largest / 0.03);
        // It has gone back by the volume of the wave over its velocity: 5 (2/3) 0.03.
        assert!((state.displacement_m + 0.1).abs() < 0.002);
    }

    #[test]
    fn a_piston_of_rows_absorbs_as_a_rigid_one() {
        let wave = RegularWave { height_m: 0.02, period_s: 1.2, depth_m: 0.4, gravity: 9.81 };
        let rigid = RegularMotion::new(&wave, PaddleShape::Piston, 2.0);
        let rows = Absorption::of_piston(0.2, wave.depth_m, Some(wave.period_s), wave.gravity, 0.1);
        assert!((rows.velocity_per_elevation / rigid.velocity_per_elevation() - 1.0).abs() < 1e-9);
        assert!((rows.way_s * rigid.celerity_m_s() / 0.2 - 1.0).abs() < 1e-9);
        // Very long waves are as those without a period.
        let [long, without] = [Some(200.0), None].map(|period| Absorption::of_piston(0.2, 0.4, period, 9.81, 0.1));
        assert!((long.velocity_per_elevation / without.velocity_per_elevation - 1.0).abs() < 1e-4);
    }

    #[test]
    fn it_ends_at_its_reach() {
        let mut state = AbsorptionState::default();
        (0..10_000).for_each(|_| PISTON.advance(&mut state, 0.05, DT));
        assert_eq!((state.displacement_m, state.velocity_m_s), (-0.5, 0.0));
    }

    #[test]
    fn without_waves_it_returns() {
        let piston = Absorption { return_s: Some(1.0), ..PISTON };
        let mut state = AbsorptionState { displacement_m: 0.1, ..AbsorptionState::default() };
        (0..3000).for_each(|_| piston.advance(&mut state, 0.0, DT));
        assert!((state.displacement_m / 0.1 - (-3.0_f64).exp()).abs() < 1e-3);
    }
}
