//! Motion of a wave paddle that generates regular waves.
//!
//! * Biesel & Suquet (1951), linear theory, in the form of Dean & Dalrymple (1984), section 6.3: the paddle moves by
//!   (S/2) f(z) sin(omega t). S is the stroke, and the shape f is 1 at still water level.
//! * Madsen (1971), "On the generation of long waves": a piston motion at twice the wave frequency generates a
//!   second-order wave of permanent form. Without this motion, the piston also generates a slower free wave of twice
//!   the frequency.
//!
//! A flap has no second-order motion.

use std::f64::consts::PI;

use crate::waves::theory::regular::RegularWave;

/// Shape f(z) of a paddle: its displacement as a function of the height z above the bed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PaddleShape {
    /// Uniform over the height.
    Piston,
    /// Proportional to the height above the hinge, zero below the hinge.
    Flap {
        /// Height of the hinge above the bed [m]; negative below the bed.
        hinge_m: f64,
    },
}

impl PaddleShape {
    /// Displacement at `z` [m] above the bed, divided by the displacement at still water level [-]; `depth` is the
    /// water depth [m].
    pub fn relative_displacement(&self, z: f64, depth: f64) -> f64 {
        match *self {
            Self::Piston => 1.0,
            Self::Flap { hinge_m } => ((z - hinge_m) / (depth - hinge_m)).max(0.0),
        }
    }

    /// Transfer function H/S: wave height per stroke at still water level [-], for wavenumber k [1/m] and depth d [m].
    /// H/S = 4 sinh kd / (sinh 2kd + 2kd) times the integral of k f(z) cosh kz from the bed to the surface, which is
    ///
    ///   sinh kd                                              for a piston,
    ///   sinh kd - (cosh kd - cosh k z_h) / (k (d - z_h))     for a flap with its hinge z_h above the bed; if the hinge
    ///                                                        lies below the bed, z_h = 0 in the second cosh.
    pub fn height_per_stroke(&self, k: f64, depth: f64) -> f64 {
        let kd = k * depth;
        let integral = match *self {
            Self::Piston => kd.sinh(),
            Self::Flap { hinge_m } => {
                let lowest = k * hinge_m.max(0.0);
                kd.sinh() - (kd.cosh() - lowest.cosh()) / (k * (depth - hinge_m))
            }
        };
        4.0 * kd.sinh() * integral / ((2.0 * kd).sinh() + 2.0 * kd)
    }
}

/// Motion, at still water level, of a paddle that generates regular waves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RegularMotion {
    /// Angular frequency [rad/s].
    omega: f64,
    /// Wavenumber [1/m].
    wavenumber: f64,
    /// Amplitude of the generated wave, half its height [m].
    amplitude_m: f64,
    /// First-order amplitude of the paddle at omega, half the stroke [m].
    first_m: f64,
    /// Second-order amplitude of the paddle at 2 omega [m].
    second_m: f64,
    /// Duration of the ramp [s].
    ramp_s: f64,
}

impl RegularMotion {
    /// Creates the motion; the stroke grows from zero over the first `ramp_periods` wave periods.
    pub fn new(wave: &RegularWave, shape: PaddleShape, ramp_periods: f64) -> Self {
        let (k, depth) = (wave.wavenumber_per_m(), wave.depth_m);
        let first_m = 0.5 * wave.height_m / shape.height_per_stroke(k, depth);
        let second_m = match shape {
            PaddleShape::Piston => second_order_m(wave.height_m, k, depth),
            PaddleShape::Flap { .. } => 0.0,
        };
        let (omega, amplitude_m) = (wave.angular_frequency(), 0.5 * wave.height_m);
        Self { omega, wavenumber: k, amplitude_m, first_m, second_m, ramp_s: ramp_periods * wave.period_s }
    }

    /// First-order stroke: twice the first-order amplitude of the paddle [m].
    pub fn stroke_m(&self) -> f64 {
        2.0 * self.first_m
    }

    /// Upper bound of the displacement from the rest position, seaward or shoreward [m].
    pub fn max_displacement_m(&self) -> f64 {
        self.first_m + self.second_m.abs()
    }

    /// Displacement r(t) (S/2 sin omega t + X2 sin 2 omega t) [m] at t [s] from the start, with the ramp r, the stroke
    /// S and the second-order amplitude X2. A crest passes the paddle when sin omega t crosses zero upwards.
    pub fn displacement_m(&self, t: f64) -> f64 {
        self.ramp(t)[0] * self.full_motion(t)[0]
    }

    /// Velocity [m/s], the time derivative of [`Self::displacement_m`].
    pub fn velocity_m_s(&self, t: f64) -> f64 {
        let ([share, rate], [x, v]) = (self.ramp(t), self.full_motion(t));
        rate * x + share * v
    }

    /// First-order elevation of the generated wave [m], `distance_m` in front of the paddle, at time t [s].
    pub fn elevation_m(&self, distance_m: f64, t: f64) -> f64 {
        let retarded_t = t - self.wavenumber * distance_m / self.omega;
        self.ramp(retarded_t)[0] * self.amplitude_m * (self.omega * retarded_t).cos()
    }

    /// Celerity [m/s].
    pub fn celerity_m_s(&self) -> f64 {
        self.omega / self.wavenumber
    }

    /// Paddle velocity per elevation of the generated wave [1/s].
    pub fn velocity_per_elevation(&self) -> f64 {
        self.omega * self.first_m / self.amplitude_m
    }

    /// Period [s].
    pub fn period_s(&self) -> f64 {
        2.0 * PI / self.omega
    }

    /// Displacement [m] and velocity [m/s] without the ramp.
    fn full_motion(&self, t: f64) -> [f64; 2] {
        let (one, two) = (self.omega * t, 2.0 * self.omega * t);
        let displacement = self.first_m * one.sin() + self.second_m * two.sin();
        let velocity = self.omega * (self.first_m * one.cos() + 2.0 * self.second_m * two.cos());
        [displacement, velocity]
    }

    /// Ramp factor r [-], a half cosine from 0 to 1, and its time derivative [1/s].
    fn ramp(&self, t: f64) -> [f64; 2] {
        if t <= 0.0 {
            return [0.0, 0.0];
        }
        if t >= self.ramp_s {
            return [1.0, 0.0];
        }
        let phase = PI * t / self.ramp_s;
        [0.5 * (1.0 - phase.cos()), 0.5 * PI / self.ramp_s * phase.sin()]
    }
}

/// Second-order amplitude of the piston at twice the wave frequency [m] (Madsen 1971):
/// X2 = H^2 / (32 d) (3 cosh kd / sinh^3 kd - 2 / m1), with m1 = H/S of the piston.
fn second_order_m(height: f64, k: f64, depth: f64) -> f64 {
    let kd = k * depth;
    let m1 = PaddleShape::Piston.height_per_stroke(k, depth);
    height * height / (32.0 * depth) * (3.0 * kd.cosh() / kd.sinh().powi(3) - 2.0 / m1)
}

#[cfg(test)]
mod tests {
    use super::*;

    const DEPTH: f64 = 0.4;

    fn wave() -> RegularWave {
        RegularWave { height_m: 0.1, period_s: 1.2, depth_m: DEPTH, gravity: 9.81 }
    }

    #[test]
    fn transfer_function_has_the_shallow_and_deep_water_limits() {
        let flap = PaddleShape::Flap { hinge_m: 0.0 };
        // In shallow water the volume of the wave equals the displaced volume: H/S = kd for a piston, kd/2 for a flap
        // hinged at the bed. The next term is of order (kd)^2.
        let k = 0.01 / DEPTH;
        assert!((PaddleShape::Piston.height_per_stroke(k, DEPTH) / 0.01 - 1.0).abs() < 1e-4);
        assert!((flap.height_per_stroke(k, DEPTH) / 0.005 - 1.0).abs() < 1e-4);
        // In deep water only the motion at the surface matters; H/S of a flap has the additional
        // factor 1 - 1/kd.
        let k = 20.0 / DEPTH;
        assert!((PaddleShape::Piston.height_per_stroke(k, DEPTH) - 2.0).abs() < 1e-12);
        assert!((flap.height_per_stroke(k, DEPTH) - 2.0 * (1.0 - 1.0 / 20.0)).abs() < 1e-6);
        // A flap with its hinge far below the bed moves like a piston.
        let far = PaddleShape::Flap { hinge_m: -1e6 };
        assert!((far.height_per_stroke(k, DEPTH) - PaddleShape::Piston.height_per_stroke(k, DEPTH)).abs() < 1e-5);
    }

    #[test]
    fn transfer_function_equals_the_integral_over_the_paddle() {
        let shapes = [-0.3, 0.0, 0.13].map(|hinge_m| PaddleShape::Flap { hinge_m });
        for shape in shapes.into_iter().chain([PaddleShape::Piston]) {
            for k in [0.3, 3.245, 9.0] {
                // The midpoint rule with n intervals has a relative error of 1e-7, because of the kink at the hinge.
                let n = 4000;
                let interval = |i: i32| {
                    let z = DEPTH * (f64::from(i) + 0.5) / f64::from(n);
                    k * shape.relative_displacement(z, DEPTH) * (k * z).cosh() * DEPTH / f64::from(n)
                };
                let integral: f64 = (0..n).map(interval).sum();
                let kd = k * DEPTH;
                let expected = 4.0 * kd.sinh() * integral / ((2.0 * kd).sinh() + 2.0 * kd);
                assert!((shape.height_per_stroke(k, DEPTH) / expected - 1.0).abs() < 1e-5, "{shape:?}, k = {k}");
            }
        }
    }

    #[test]
    fn second_order_motion_follows_the_water_in_shallow_water() {
        // In shallow water the piston moves by dX/dt = c eta / (d + eta). For Stokes' second-order elevation eta of
        // amplitude a, expansion in a/d and kd gives X2 = a^2 / (2 k d^2) (3 / (2 kd)^2 - 1/2); each further term
        // in the brackets is smaller by (kd)^2.
        let (height, kd) = (1e-3, 0.2);
        let (a, k) = (0.5 * height, kd / DEPTH);
        let expected = a * a / (2.0 * k * DEPTH * DEPTH) * (3.0 / (4.0 * kd * kd) - 0.5);
        assert!((second_order_m(height, k, DEPTH) / expected - 1.0).abs() < 1e-3);
        let flap = RegularMotion::new(&wave(), PaddleShape::Flap { hinge_m: 0.0 }, 2.0);
        assert_eq!(flap.second_m, 0.0);
    }

    #[test]
    fn ramp_is_smooth_and_velocity_is_the_derivative() {
        let motion = RegularMotion::new(&wave(), PaddleShape::Piston, 1.5);
        assert_eq!((motion.displacement_m(0.0), motion.velocity_m_s(0.0)), (0.0, 0.0));
        let h = 1e-5;
        for i in 1..100 {
            let t = 0.0317 * f64::from(i);
            let slope = (motion.displacement_m(t + h) - motion.displacement_m(t - h)) / (2.0 * h);
            // The error of the central difference, h^2 X''' / 6, is below 1e-9 m/s.
            assert!((slope - motion.velocity_m_s(t)).abs() < 1e-8);
        }
        // The velocity has no jump at the end of the ramp. It changes by less than 8 h within the time 2 h, because the
        // acceleration is at most 4 m/s2.
        let end = 1.5 * 1.2;
        assert!((motion.velocity_m_s(end + h) - motion.velocity_m_s(end - h)).abs() < 8.0 * h);
        let largest = (0..2000).map(|i| motion.displacement_m(0.005 * f64::from(i)).abs()).fold(0.0, f64::max);
        assert!(largest <= motion.max_displacement_m() && largest > 0.9 * motion.max_displacement_m());
    }
}
