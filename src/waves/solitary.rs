//! Solitary waves: the piston that makes them and a reference profile.
//!
//! * Goring & Raichlen (1980), "The generation of long waves in the laboratory": the piston follows the water.
//! * Guizien & Barthelemy (2002), "Accuracy of solitary wave generation by a piston wave maker": Rayleigh's outskirt.
//! * Grimshaw (1971), Fenton (1972): third-order solitary wave.

/// Newton steps for the phase: the first guess is within 1e-2, five steps reach rounding.
const NEWTON_STEPS: usize = 5;
/// Phase at which the piston starts and stops; sech^2(3.8) = 0.002 of the crest.
const END_PHASE: f64 = 3.8;

/// What a piston follows to make a solitary wave.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PistonTheory {
    /// Goring & Raichlen (1980).
    Boussinesq,
    /// Guizien & Barthelemy (2002); nearer to the exact wave.
    Rayleigh,
}

/// A solitary wave made by a piston in still water.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolitaryWave {
    /// Height H above the still water [m].
    pub height_m: f64,
    /// Still depth d at the piston [m].
    pub depth_m: f64,
    /// Gravity g [m/s2].
    pub gravity: f64,
    /// Shape of the wave.
    pub theory: PistonTheory,
}

impl SolitaryWave {
    /// Outskirt (decay) coefficient k [1/m]: Boussinesq sqrt(3H / 4d^3), Rayleigh sqrt(3H / 4d^2(d+H)).
    pub fn outskirt_per_m(&self) -> f64 {
        let (height, d) = (self.height_m, self.depth_m);
        match self.theory {
            PistonTheory::Boussinesq => (3.0 * height / (4.0 * d.powi(3))).sqrt(),
            PistonTheory::Rayleigh => (3.0 * height / (4.0 * d * d * (d + height))).sqrt(),
        }
    }

    /// Speed of the crest c = sqrt(g (d + H)) [m/s].
    pub fn celerity_m_s(&self) -> f64 {
        (self.gravity * (self.depth_m + self.height_m)).sqrt()
    }

    /// Stroke of the piston S = 2H / (k d) [m].
    pub fn stroke_m(&self) -> f64 {
        2.0 * self.height_m / (self.outskirt_per_m() * self.depth_m)
    }

    /// Duration of the stroke T = 2 (3.8 + H/d) / (k c) [s].
    pub fn duration_s(&self) -> f64 {
        2.0 * (END_PHASE + self.height_m / self.depth_m) / (self.outskirt_per_m() * self.celerity_m_s())
    }

    /// Piston displacement X(t) [m], t [s] from the start of the stroke; 0 before it, constant after it.
    /// X = (H / k d) (tanh theta - tanh theta(0)).
    pub fn piston_displacement_m(&self, t: f64) -> f64 {
        let reach = self.height_m / (self.outskirt_per_m() * self.depth_m);
        reach * (self.phase(t.clamp(0.0, self.duration_s())).tanh() - self.phase(0.0).tanh())
    }

    /// Piston velocity dX/dt = c eta / (d + eta) [m/s], eta = H sech^2 theta; 0 outside the stroke.
    pub fn piston_velocity_m_s(&self, t: f64) -> f64 {
        if t < 0.0 || t > self.duration_s() {
            return 0.0;
        }
        let eta = self.height_m * sech2(self.phase(t));
        self.celerity_m_s() * eta / (self.depth_m + eta)
    }

    /// Elevation of the wave at the piston [m]: that by which the water there has its velocity.
    pub fn elevation_at_piston_m(&self, t: f64) -> f64 {
        let u = self.piston_velocity_m_s(t);
        self.depth_m * u / (self.celerity_m_s() - u)
    }

    /// Phase theta at the piston, from -3.8 to 3.8 over the stroke: the root of
    /// theta + (H/d) tanh theta = k c (t - T/2), by Newton's method. (tanh 3.8 = 0.999: the ends are met to 1e-4.)
    fn phase(&self, t: f64) -> f64 {
        let e = self.height_m / self.depth_m;
        let right = self.outskirt_per_m() * self.celerity_m_s() * (t - 0.5 * self.duration_s());
        let mut theta = right / (1.0 + e);
        for _ in 0..NEWTON_STEPS {
            theta -= (theta + e * theta.tanh() - right) / (1.0 + e * sech2(theta));
        }
        theta
    }
}

/// The third-order solitary wave of Grimshaw (1971) and Fenton (1972), within 1e-3 of the exact one for H/d < 0.2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThirdOrderSolitary {
    /// Height H above the still water [m].
    pub height_m: f64,
    /// Still depth d [m].
    pub depth_m: f64,
    /// Gravity g [m/s2].
    pub gravity: f64,
}

impl ThirdOrderSolitary {
    /// Speed of the crest c [m/s]: c^2 / (g d) = 1 + e - e^2/20 - 3 e^3/70.
    pub fn celerity_m_s(&self) -> f64 {
        let e = self.height_m / self.depth_m;
        (self.gravity * self.depth_m * (1.0 + e - e * e / 20.0 - 3.0 * e.powi(3) / 70.0)).sqrt()
    }

    /// Distance from the crest at which the surface has come down to 1e-4 of the height [m]: sech^2(5.3) = 1e-4.
    pub fn half_length_m(&self) -> f64 {
        5.3 * self.depth_m / self.decay()
    }

    /// Surface elevation above still water [m] at x [m] from the crest.
    pub fn elevation_m(&self, x: f64) -> f64 {
        let e = self.height_m / self.depth_m;
        let (s2, t2) = self.sech2_tanh2(x);
        let third = 0.625 * s2 * t2 - 101.0 / 80.0 * s2 * s2 * t2;
        self.depth_m * (e * s2 - 0.75 * e * e * s2 * t2 + e.powi(3) * third)
    }

    /// Horizontal velocity [m/s] at x [m] from the crest and z [m] from the still water.
    pub fn velocity_m_s(&self, x: f64, z: f64) -> f64 {
        let e = self.height_m / self.depth_m;
        let (s2, _) = self.sech2_tanh2(x);
        let (s4, s6) = (s2 * s2, s2 * s2 * s2);
        let y2 = ((z + self.depth_m) / self.depth_m).powi(2);
        let second = -0.25 * s2 + s4 + y2 * (1.5 * s2 - 2.25 * s4);
        let third = 19.0 / 40.0 * s2 + 0.2 * s4 - 1.2 * s6
            + y2 * (-1.5 * s2 - 3.75 * s4 + 7.5 * s6)
            + y2 * y2 * (-0.375 * s2 + 45.0 / 16.0 * s4 - 45.0 / 16.0 * s6);
        (self.gravity * self.depth_m).sqrt() * (e * s2 - e * e * second - e.powi(3) * third)
    }

    /// a = sqrt(3e/4) (1 - 5e/8 + 71 e^2/128) [-].
    fn decay(&self) -> f64 {
        let e = self.height_m / self.depth_m;
        (0.75 * e).sqrt() * (1.0 - 0.625 * e + 71.0 / 128.0 * e * e)
    }

    /// sech^2 and tanh^2 of a x / d.
    fn sech2_tanh2(&self, x: f64) -> (f64, f64) {
        let s2 = sech2(self.decay() * x / self.depth_m);
        (s2, 1.0 - s2)
    }
}

/// sech^2.
fn sech2(theta: f64) -> f64 {
    theta.cosh().powi(-2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wave(height_m: f64, theory: PistonTheory) -> SolitaryWave {
        SolitaryWave { height_m, depth_m: 0.8, gravity: 9.81, theory }
    }

    #[test]
    fn outskirt_celerity_stroke_and_duration_in_0_8_m() {
        // H, k and S of Boussinesq and Rayleigh, c, T of Boussinesq: hand values, so half a unit of the last digit.
        let table = [
            (0.026, 0.19516, 0.19206, 2.8466, 0.3331, 0.3384, 13.80),
            (0.045, 0.25674, 0.24982, 2.8791, 0.4382, 0.4503, 10.43),
            (0.064, 0.30619, 0.29463, 2.9113, 0.5226, 0.5431, 8.71),
        ];
        for (height, k_b, k_r, c, s_b, s_r, duration) in table {
            let (b, r) = (wave(height, PistonTheory::Boussinesq), wave(height, PistonTheory::Rayleigh));
            assert!((b.outskirt_per_m() - k_b).abs() < 6e-6 && (r.outskirt_per_m() - k_r).abs() < 6e-6);
            assert!((b.celerity_m_s() - c).abs() < 6e-5);
            assert!((b.stroke_m() - s_b).abs() < 6e-5 && (r.stroke_m() - s_r).abs() < 6e-5);
            assert!((b.duration_s() - duration).abs() < 6e-3);
        }
    }

    #[test]
    fn piston_runs_its_stroke_and_its_velocity_is_the_derivative() {
        for theory in [PistonTheory::Boussinesq, PistonTheory::Rayleigh] {
            let w = wave(0.064, theory);
            let end = w.duration_s();
            // The stroke is cut at theta = 3.8, where 1 - tanh = 1e-3.
            assert!((w.piston_displacement_m(end) / w.stroke_m() - 1.0).abs() < 2e-3);
            assert_eq!(w.piston_displacement_m(0.0), 0.0);
            for i in 1..20 {
                let (t, h) = (end * f64::from(i) / 20.0, 1e-4);
                let slope = (w.piston_displacement_m(t + h) - w.piston_displacement_m(t - h)) / (2.0 * h);
                // Central difference: h^2 X''' / 6 is below 1e-8.
                assert!((slope - w.piston_velocity_m_s(t)).abs() < 1e-7);
            }
            assert_eq!(w.piston_velocity_m_s(end + 1.0), 0.0);
        }
    }

    #[test]
    fn third_order_wave_has_its_height_and_speed() {
        let w = ThirdOrderSolitary { height_m: 0.064, depth_m: 0.8, gravity: 9.81 };
        assert!((w.elevation_m(0.0) - 0.064).abs() < 1e-12);
        // Exact Froude numbers of the three waves; third order is good to 1e-5 at these heights.
        for (height_m, froude) in [(0.026, 1.016093), (0.045, 1.027659), (0.064, 1.039065)] {
            let c = ThirdOrderSolitary { height_m, ..w }.celerity_m_s();
            assert!((c / (9.81f64 * 0.8).sqrt() - froude).abs() < 1e-5);
        }
    }
}
