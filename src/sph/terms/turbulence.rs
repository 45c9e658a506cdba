//! Sub-particle-scale turbulence (Gotoh et al. 2001; Dalrymple & Rogers 2006) with Smagorinsky's eddy viscosity. The
//! stress is
//!
//!   tau = 2 nu_t rho (S - tr S / 3) - 2/3 rho C_I D^2 |S|^2,   nu_t = (C_s D)^2 |S|,   |S| = sqrt(2 S : S),
//!
//! where nu_t is the eddy viscosity, S the strain rate, tr S its trace, rho the density and D the filter width. C_s and
//! C_I are coefficients. The acceleration of a particle a by this stress is
//! sum_b m_b (tau_a / rho_a^2 + tau_b / rho_b^2) grad_a W_ab.

/// Constants of the turbulence model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Smagorinsky {
    /// Factor (C_s D)^2 of the eddy viscosity [m2].
    eddy: f64,
    /// Factor C_I D^2 of the isotropic stress [m2].
    isotropic: f64,
}

impl Smagorinsky {
    /// Creates the model with C_s = 0.12 and C_I = 0.0066; the filter width D is the particle spacing `dp` [m].
    pub fn new(dp: f64) -> Self {
        Self { eddy: (0.12 * dp).powi(2), isotropic: 0.0066 * dp * dp }
    }

    /// Returns tau / rho^2 [m5/(kg s2)] in the order xx, yy, zz, xy, xz, yz. `gradient` is d v_i / d x_j [1/s] with
    /// the row i and the column j, `rho` the density [kg/m3].
    pub fn specific_stress(&self, gradient: [[f64; 3]; 3], rho: f64) -> [f64; 6] {
        let strain = |i: usize, j: usize| 0.5 * (gradient[i][j] + gradient[j][i]);
        let square: f64 = (0..3).flat_map(|i| (0..3).map(move |j| (i, j))).map(|(i, j)| strain(i, j).powi(2)).sum();
        let magnitude = (2.0 * square).sqrt();
        let viscosity = 2.0 * self.eddy * magnitude / rho;
        let trace = (strain(0, 0) + strain(1, 1) + strain(2, 2)) / 3.0;
        let pressure = 2.0 / 3.0 * self.isotropic * magnitude * magnitude / rho;
        let normal = |i: usize| viscosity * (strain(i, i) - trace) - pressure;
        let shear = |i: usize, j: usize| viscosity * strain(i, j);
        [normal(0), normal(1), normal(2), shear(0, 1), shear(0, 2), shear(1, 2)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pure_shear_gives_smagorinskys_eddy_viscosity() {
        let (dp, rate, rho) = (0.01, 5.0, 1000.0);
        let mut gradient = [[0.0; 3]; 3];
        gradient[0][2] = rate;
        let stress = Smagorinsky::new(dp).specific_stress(gradient, rho);
        // In pure shear, |S| equals the shear rate du/dz, and tau_xz = rho nu_t du/dz.
        let expected = (0.12 * dp).powi(2) * rate * rate / rho;
        assert!((stress[4] / expected - 1.0).abs() < 1e-12);
        let isotropic = -2.0 / 3.0 * 0.0066 * dp * dp * rate * rate / rho;
        assert!(stress[..3].iter().all(|normal| (normal / isotropic - 1.0).abs() < 1e-12));
    }

    #[test]
    fn rigid_rotation_causes_no_stress() {
        let gradient = [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
        assert_eq!(Smagorinsky::new(0.01).specific_stress(gradient, 1000.0), [0.0; 6]);
    }
}
