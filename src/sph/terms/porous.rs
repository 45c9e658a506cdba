//! Flow through a porous medium: rubble, gravel or sand that does not move.
//!
//! The volume-averaged equations (Liu et al. 1999; Jensen et al. 2014), for the velocity u of the water in the pores
//! (seepage velocity), with the porosity n, the density rho of the water itself and the pressure p:
//!
//!   d rho/dt = -(rho / n) div(n u)
//!   (1 + c_A) du/dt = -(1 / rho) grad p + g - A u - B |u| u
//!   A = alpha (1 - n)^2 nu / (n^2 D^2),   B = beta (1 + 7.5 / KC) (1 - n) / (n D)
//!
//! with the median diameter D of the stones, the kinematic viscosity nu and the coefficients alpha, beta and c_A. A
//! water particle with the mass m fills the bulk volume m / (n rho). With this volume and the velocity n u in the record
//! of a particle, the sums over pairs of the open water are those of the porous medium:
//!
//!   d rho_a/dt = (rho_a / n_a) sum_b V_b (n_a u_a - n_b u_b) . grad_a W_ab
//!
//! so that a jump of the porosity changes neither the pressure at rest nor a steady flow. The powers of the pressure
//! still cancel in pairs: the energy is conserved as in open water.

use glam::DVec3;

/// Numerator of the dependence on the Keulegan-Carpenter number, van Gent (1995) [-].
const OSCILLATION: f64 = 7.5;

/// A porous medium.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Medium {
    /// Porosity n [-].
    pub porosity: f64,
    /// Median diameter D50 of the stones [m].
    pub diameter: f64,
    /// Coefficient alpha of the linear drag [-].
    pub alpha: f64,
    /// Coefficient beta of the quadratic drag [-].
    pub beta: f64,
    /// Keulegan-Carpenter number KC = U T / (n D) of an oscillating flow [-]; infinite for steady flow.
    pub keulegan_carpenter: f64,
    /// Coefficient gamma of the added mass c_A = gamma (1 - n) / n [-].
    pub gamma: f64,
}

/// What the water at one point feels of the porous media around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pores {
    /// Porosity n [-]; 1 in open water.
    pub porosity: f64,
    /// Linear drag A [1/s].
    pub linear: f64,
    /// Quadratic drag B [1/m].
    pub quadratic: f64,
    /// Coefficient c_A of the added mass [-].
    pub added_mass: f64,
}

impl Medium {
    /// Returns the pores of this medium, for water with the kinematic viscosity `nu` [m2/s].
    pub fn pores(&self, nu: f64) -> Pores {
        let Self { porosity: n, diameter: d, alpha, beta, keulegan_carpenter, gamma } = *self;
        Pores {
            porosity: n,
            linear: alpha * ((1.0 - n) / (n * d)).powi(2) * nu,
            quadratic: beta * (1.0 + OSCILLATION / keulegan_carpenter) * (1.0 - n) / (n * d),
            added_mass: gamma * (1.0 - n) / n,
        }
    }
}

impl Pores {
    /// Open water.
    pub const NONE: Self = Self { porosity: 1.0, linear: 0.0, quadratic: 0.0, added_mass: 0.0 };

    /// Returns the velocity [m/s] after a time `dt` [s] with the given acceleration of pressure, viscosity and gravity
    /// [m/s2]. The drag is that of the velocity at the end: the exact root of the implicit step, stable for any `dt`.
    pub fn velocity_after(&self, dt: f64, start: DVec3, acceleration: DVec3) -> DVec3 {
        let step = dt / (1.0 + self.added_mass);
        let free = start + step * acceleration;
        let (q, r) = (1.0 + step * self.linear, step * self.quadratic);
        free * (2.0 / (q + (q * q + 4.0 * r * free.length()).sqrt()))
    }

    /// Power per mass of water that the drag takes from a flow [W/kg].
    pub fn dissipation(&self, velocity: DVec3) -> f64 {
        let speed = velocity.length();
        (self.linear + self.quadratic * speed) * speed * speed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The rock of Liu et al. (1999) with the coefficients of Jensen et al. (2014).
    const ROCK: Medium = Medium {
        porosity: 0.49,
        diameter: 0.0159,
        alpha: 500.0,
        beta: 2.0,
        keulegan_carpenter: f64::INFINITY,
        gamma: 0.34,
    };

    #[test]
    fn coefficients_of_crushed_rock() {
        let pores = ROCK.pores(1e-6);
        // A = 500 (0.51 / (0.49 * 0.0159))^2 1e-6, B = 2 * 0.51 / (0.49 * 0.0159), c_A = 0.34 * 0.51 / 0.49.
        assert!((pores.linear - 2.1425).abs() < 1e-3 && (pores.quadratic - 130.92).abs() < 0.01, "{pores:?}");
        assert!((pores.added_mass - 0.35388).abs() < 1e-4);
        let waves = Medium { keulegan_carpenter: 7.5, ..ROCK }.pores(1e-6);
        assert!((waves.quadratic / pores.quadratic - 2.0).abs() < 1e-12);
    }

    #[test]
    fn a_constant_gradient_drives_the_velocity_of_forchheimer() {
        let pores = ROCK.pores(1e-6);
        let (a, b, drive) = (pores.linear, pores.quadratic, 0.5 * 9.81);
        let expected = ((a * a + 4.0 * b * drive).sqrt() - a) / (2.0 * b);
        for dt in [1e-4, 1e-2, 1.0] {
            let mut velocity = DVec3::ZERO;
            for _ in 0..20_000 {
                velocity = pores.velocity_after(dt, velocity, DVec3::X * drive);
            }
            // The steady velocity does not depend on dt. Limit: rounding.
            assert!((velocity.x / expected - 1.0).abs() < 1e-12, "{dt}: {}", velocity.x);
        }
        assert!((pores.dissipation(DVec3::X * expected) / (drive * expected) - 1.0).abs() < 1e-12);
        assert_eq!(Pores::NONE.velocity_after(0.1, DVec3::X, DVec3::Y), DVec3::new(1.0, 0.1, 0.0));
    }
}
