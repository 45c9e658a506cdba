//! Active absorption: the piston moves with returning waves so that it does not reflect them.
//!
//! Schaffer & Klopman (2000), "Review of multidirectional active wave absorption methods"; Altomare et al. (2017),
//! section 2.3. A gauge that moves with the piston measures the elevation. The excess over the elevation of the
//! generated wave is the sum of the returning wave eta_in and the unwanted outgoing wave eta_out. A wave has the ratio
//! u/eta of depth-mean velocity and elevation; it is sqrt(g/d) for long waves in the depth d. The piston velocity
//! U = -(eta_in + eta_out) u/eta makes eta_out = eta_in + U eta/u = 0.
//!
//! Waves travel from the gauge to the piston in the time a. Therefore the gauge measures eta_in too early and eta_out
//! too late by a. The readings scatter by about 1/20 of the particle spacing. Smoothing with the time constant tau
//! gives y: tau dy/dt = eta_in(t + a) + eta_out(t - a) - y. For slow waves and eta_out = eta_in - y this becomes
//! y + (tau - a) (dy/dt) / 2 = eta_in, which has no lag for tau = a. The control loop is stable for any a, because the
//! coefficient of y(t - a) is not larger than the coefficient of y.
//!
//! Open ends use the velocity for waves of finite height, [`outward_velocity_m_s`], instead of y u/eta.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::waves::theory::regular::linear_wavenumber_per_m;

/// Parameters of the active absorption of a piston.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Absorption {
    /// Distance of the gauge from the piston [m].
    pub gauge_m: f64,
    /// Travel time of waves from the gauge to the piston [s].
    pub travel_time_s: f64,
    /// Depth-mean velocity of the water per surface elevation, u/eta [1/s].
    pub velocity_per_elevation: f64,
    /// Limit of the displacement that absorption adds to the generating motion, seaward or shoreward [m].
    pub max_displacement_m: f64,
    /// Time constant with which the added displacement decays to zero [s]; it prevents drift in periodic waves.
    /// `None` if the displacement does not decay.
    pub return_time_s: Option<f64>,
}

/// State of active absorption: added motion of the piston and smoothed gauge reading.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct AbsorptionState {
    /// Displacement added to the generating motion [m].
    pub displacement_m: f64,
    /// Velocity added to the generating motion [m/s].
    pub velocity_m_s: f64,
    /// Smoothed excess of the measured elevation over the generated wave [m].
    excess_m: f64,
}

/// Return time of an absorbing piston in periodic waves, in wave periods. It is short enough to stop drift by mass
/// transport. The return velocity is at most 1 / (2 pi 10) = 1.6 % of the absorbing velocity, and out of phase with it.
pub(super) const RETURN_PERIODS: f64 = 10.0;

impl AbsorptionState {
    /// Returns the smoothed excess of the measured elevation over the generated wave [m].
    pub fn excess_m(&self) -> f64 {
        self.excess_m
    }
}

impl Absorption {
    /// Creates the parameters of a full-depth piston: for waves of period `period_s`, or for long waves if it is
    /// `None`.
    ///
    /// In linear theory (Biesel 1951), a piston with velocity U generates eta = U 4 sinh^2(kd) / (omega (sinh 2kd +
    /// 2kd)), with wavenumber k, depth d and angular frequency omega; the long-wave limit is U sqrt(d/g).
    pub fn for_full_depth_piston(
        gauge_m: f64,
        depth_m: f64,
        period_s: Option<f64>,
        gravity: f64,
        max_displacement_m: f64,
    ) -> Self {
        let long_celerity = (gravity * depth_m).sqrt();
        let (celerity, velocity_per_elevation) = period_s.map_or((long_celerity, long_celerity / depth_m), |period| {
            let omega = TAU / period;
            let wavenumber = linear_wavenumber_per_m(omega, depth_m, gravity);
            let kd = wavenumber * depth_m;
            (omega / wavenumber, omega * ((2.0 * kd).sinh() + 2.0 * kd) / (4.0 * kd.sinh().powi(2)))
        });
        Self {
            gauge_m,
            travel_time_s: gauge_m / celerity,
            velocity_per_elevation,
            max_displacement_m,
            return_time_s: period_s.map(|period| RETURN_PERIODS * period),
        }
    }

    /// Advances the state by `dt` [s] with linear absorption; `excess_m` is the measured elevation minus the elevation of
    /// the generated wave [m].
    pub fn advance(&self, state: &mut AbsorptionState, excess_m: f64, dt: f64) {
        self.smooth(state, excess_m, dt);
        self.move_by(state, -self.velocity_per_elevation * state.excess_m, dt);
    }

    /// Updates the smoothed excess over `dt` [s] with the measured excess [m].
    pub fn smooth(&self, state: &mut AbsorptionState, excess_m: f64, dt: f64) {
        state.excess_m += (1.0 - (-dt / self.travel_time_s).exp()) * (excess_m - state.excess_m);
    }

    /// Adds the displacement of an absorbing velocity [m/s] over `dt` [s], within the limit.
    pub fn move_by(&self, state: &mut AbsorptionState, velocity_m_s: f64, dt: f64) {
        let return_velocity = self.return_time_s.map_or(0.0, |time| state.displacement_m / time);
        let target = state.displacement_m + dt * (velocity_m_s - return_velocity);
        let displacement = target.clamp(-self.max_displacement_m, self.max_displacement_m);
        state.velocity_m_s = (displacement - state.displacement_m) / dt;
        state.displacement_m = displacement;
    }
}

/// Returns the velocity out of the domain [m/s] that absorbs long waves of finite height at an end. `depth_m` is the
/// water depth in the generated wave, and `excess_m` the measured elevation minus the elevation of this wave.
///
/// The entering Riemann invariant of long waves, u + 2 sqrt(g d) at the seaward end, keeps the value of the generated
/// wave (Stoker 1957, section 10.2). An excess y therefore changes the velocity by -2 (sqrt(g (d + y)) - sqrt(g d)).
pub fn outward_velocity_m_s(depth_m: f64, excess_m: f64, gravity: f64) -> f64 {
    let [generated, measured] = [depth_m, depth_m + excess_m].map(|depth| (gravity * depth.max(0.0)).sqrt());
    2.0 * (measured - generated)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::waves::generation::paddle_motion::{PaddleShape, RegularMotion};
    use crate::waves::theory::regular::RegularWave;

    const DT: f64 = 0.001;
    const PISTON: Absorption = Absorption {
        gauge_m: 0.2,
        travel_time_s: 0.1,
        velocity_per_elevation: 5.0,
        max_displacement_m: 0.5,
        return_time_s: None,
    };

    /// A piston with the velocity U reflects eta_out = eta_in + U eta/u.
    #[test]
    fn piston_reflects_little_of_a_long_wave() {
        let incoming = |t: f64| 0.03 / (3.0 * (t - 3.0)).cosh().powi(2);
        let (mut state, mut out) = (AbsorptionState::default(), vec![0.0; 100]);
        for i in 0..6000 {
            let t = DT * f64::from(i);
            // The gauge sees the incoming wave 0.1 s too early and the outgoing wave 0.1 s too late.
            PISTON.advance(&mut state, incoming(t + 0.1) + out[out.len() - 100], DT);
            out.push(incoming(t) + state.velocity_m_s / 5.0);
        }
        let largest = out.iter().fold(0.0_f64, |most, eta| most.max(eta.abs()));
        // The reflected wave of second order, a^2 (d2 eta/dt2) / 4, is 4.5 % as high as the incoming wave; terms of
        // higher order raise it to 5.2 %.
        assert!(largest < 0.06 * 0.03, "{}", largest / 0.03);
        // The piston has retreated by u/eta times the integral of the elevation over time: 5 (2/3) 0.03 = 0.1 m.
        assert!((state.displacement_m + 0.1).abs() < 0.002);
    }

    #[test]
    fn full_depth_parameters_equal_those_of_a_rigid_piston() {
        let wave = RegularWave { height_m: 0.02, period_s: 1.2, depth_m: 0.4, gravity: 9.81 };
        let rigid = RegularMotion::new(&wave, PaddleShape::Piston, 2.0);
        let rows = Absorption::for_full_depth_piston(0.2, wave.depth_m, Some(wave.period_s), wave.gravity, 0.1);
        assert!((rows.velocity_per_elevation / rigid.velocity_per_elevation() - 1.0).abs() < 1e-9);
        assert!((rows.travel_time_s * rigid.celerity_m_s() / 0.2 - 1.0).abs() < 1e-9);
        // Very long waves tend to the long-wave limit.
        let [long, limit] =
            [Some(200.0), None].map(|period| Absorption::for_full_depth_piston(0.2, 0.4, period, 9.81, 0.1));
        assert!((long.velocity_per_elevation / limit.velocity_per_elevation - 1.0).abs() < 1e-4);
    }

    #[test]
    fn absorbing_velocity_keeps_the_entering_invariant() {
        let (gravity, depth) = (9.81, 0.2);
        for excess in [-0.05, 0.02, 0.1_f64] {
            let invariant = |velocity: f64, depth: f64| velocity + 2.0 * (gravity * depth).sqrt();
            let inward = 0.3 - outward_velocity_m_s(depth, excess, gravity);
            assert!((invariant(inward, depth + excess) - invariant(0.3, depth)).abs() < 1e-12);
        }
        // Very small waves tend to the linear limit.
        assert!((outward_velocity_m_s(depth, 1e-6, gravity) / (1e-6 * (gravity / depth).sqrt()) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn displacement_stops_at_its_limit() {
        let mut state = AbsorptionState::default();
        (0..10_000).for_each(|_| PISTON.advance(&mut state, 0.05, DT));
        assert_eq!((state.displacement_m, state.velocity_m_s), (-0.5, 0.0));
    }

    #[test]
    fn displacement_returns_to_zero_without_waves() {
        let piston = Absorption { return_time_s: Some(1.0), ..PISTON };
        let mut state = AbsorptionState { displacement_m: 0.1, ..AbsorptionState::default() };
        (0..3000).for_each(|_| piston.advance(&mut state, 0.0, DT));
        assert!((state.displacement_m / 0.1 - (-3.0_f64).exp()).abs() < 1e-3);
    }
}
