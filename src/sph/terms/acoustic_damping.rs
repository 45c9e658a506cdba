//! Acoustic damping: a bulk viscosity that damps sound and leaves incompressible flow unchanged (acoustic damper term,
//! Sun et al. 2023). It adds the pressure
//!
//!   q_a = -alpha_2 h c0 rho_a div v_a
//!
//! to the pressure p_a of equation 1. alpha_2 is a coefficient; [`terms`](super) defines the other symbols. A sound
//! wave with the wave number k decays at the rate alpha_2 h c0 k^2 / 2. The total force in equation 1 contains the sum
//! q_a + q_b, so damping conserves momentum and angular momentum. Its power is -sum_a V_a alpha_2 h c0 rho_a (div
//! v_a)^2, which is never positive.
//!
//! rho_a div v_a is minus the compression, the sum of equation 2 without density diffusion. The rates at the half step
//! need q_a first. Therefore q_a follows from the compression at the start of the time step. The rates at the start
//! contain no damping: they serve only the predictor.

/// Constants of the acoustic damping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AcousticDamping {
    /// Bulk viscosity divided by the density, alpha_2 h c0 [m2/s].
    strength: f32,
}

impl AcousticDamping {
    /// Creates the constants from alpha_2 [-], h [m] and c0 [m/s].
    pub fn new(alpha_2: f64, h: f64, c0: f64) -> Self {
        Self { strength: (alpha_2 * h * c0) as f32 }
    }

    /// Returns q_a [Pa] from the compression [kg/(m3 s)].
    pub fn pressure(&self, compression: f32) -> f32 {
        self.strength * compression
    }

    /// Returns the power of the damping per volume [W/m3], from the compression [kg/(m3 s)] and the density rho_a
    /// [kg/m3].
    pub fn power_density(&self, compression: f64, density: f64) -> f64 {
        -f64::from(self.strength) * compression * compression / density
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn damping_resists_compression_and_takes_energy() {
        let damping = AcousticDamping::new(0.5, 0.02, 20.0);
        // rho div v = -100 kg/(m3 s): the water is compressed.
        assert!((damping.pressure(100.0) - 20.0).abs() < 1e-5);
        for compression in [100.0, -100.0] {
            // Power per volume -q div v = -20 Pa * 0.1 / s.
            assert!((damping.power_density(compression, 1000.0) + 2.0).abs() < 1e-6);
        }
    }
}
