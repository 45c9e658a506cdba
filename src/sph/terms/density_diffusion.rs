//! Equations 4 and 5: density diffusion of Fourtakas et al. (2019),
//! D_a = 2 delta h c sum_b (rho_ba^T - rho_ab^H) (r_ab . grad_a W_ab) / r_ab^2 V_b.
//!
//! delta is a coefficient, rho_ba^T the difference of the total densities, and rho_ab^H the hydrostatic difference.
//! [`terms`](super) defines the other symbols.
//!
//! Three details of this code differ from these printed equations. (1) With rho_ba = rho_b - rho_a and
//! r_ab = r_a - r_b, the sum is negative where neighbours are denser, so the printed sign would amplify density
//! differences. This code uses the opposite sign, as in Molteni & Colagrossi (2009). (2) The printed equation 5,
//! rho_ab^H = rho0 g z_ab, is a pressure. This code uses the density at this pressure from the equation of state,
//! rho_ab^H = rho0 [(1 + gamma rho0 g z_ab / (rho0 c0^2))^(1/gamma) - 1]. (3) For c, this code uses the constant c0.
//!
//! Under DBC, boundary particles repel the water by their excess density. As in DualSPHysics, density diffusion
//! excludes these particles and the water within their kernel support. If they took part, diffusion would remove the
//! excess density, and the water would sink into the wall.

use super::equation_of_state::Tait;
use crate::sph::lanes::Real;

/// Form of the density diffusion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DensityDiffusion {
    /// No density diffusion.
    None,
    /// Diffuses the total density (Molteni & Colagrossi 2009): rho_ab^H = 0.
    MolteniColagrossi,
    /// Diffuses the deviation from the hydrostatic density (Fourtakas et al. 2019).
    Fourtakas,
    /// Diffuses the part of the density difference that the renormalised gradients do not explain (Antuono et al.
    /// 2010): rho_b - rho_a - (grad rho_a + grad rho_b) . r_ba / 2.
    Antuono,
}

/// Constants of the diffusion term.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Diffusion {
    /// Form of the term.
    pub kind: DensityDiffusion,
    /// Strength of the diffusion, 2 delta h c0 [m2/s].
    strength: f32,
    /// Factor A = rho0 g / c0^2 of rho_ab^H = A z_ab (1 - B z_ab) [kg/m4]; zero for other forms than `Fourtakas`. These
    /// are the first two terms of the binomial series of rho_ab^H.
    hydrostatic: f32,
    /// Factor B = (gamma - 1) g / (2 c0^2) of the same formula [1/m].
    curvature: f32,
}

impl Diffusion {
    /// Creates the constants from delta [-], h [m], the equation of state and g [m/s2].
    pub fn new(kind: DensityDiffusion, delta: f64, h: f64, tait: &Tait, g: f64) -> Self {
        let Tait { rho0, c0, gamma } = *tait;
        let delta = if kind == DensityDiffusion::None { 0.0 } else { delta };
        let hydrostatic = if kind == DensityDiffusion::Fourtakas { rho0 * g / (c0 * c0) } else { 0.0 };
        Self {
            kind,
            strength: (2.0 * delta * h * c0) as f32,
            hydrostatic: hydrostatic as f32,
            curvature: ((gamma - 1.0) * g / (2.0 * c0 * c0)) as f32,
        }
    }

    /// Returns the factors A [kg/m4] and B [1/m] of rho_ab^H = A z_ab (1 - B z_ab).
    #[cfg(feature = "gpu")]
    pub(in crate::sph) fn hydrostatic(&self) -> [f32; 2] {
        [self.hydrostatic, self.curvature]
    }

    /// Returns constants that switch density diffusion off.
    pub fn none() -> Self {
        Self { kind: DensityDiffusion::None, strength: 0.0, hydrostatic: 0.0, curvature: 0.0 }
    }

    /// Returns rho_b - rho_a - rho_ab^H [kg/m3] for the height difference z_ab = z_a - z_b [m].
    #[inline(always)]
    pub fn excess<R: Real>(&self, rho_a: R, rho_b: R, z_ab: R) -> R {
        let slope = R::splat(self.hydrostatic * self.curvature).mul_add(z_ab, R::splat(-self.hydrostatic));
        slope.mul_add(z_ab, rho_b - rho_a)
    }

    /// Returns the factor of sum_b [`Self::excess`] G V_b in equation 4 [m2/s], where
    /// G = (r_ab . grad_a W_ab) / r_ab^2.
    #[inline(always)]
    pub fn factor(&self) -> f32 {
        -self.strength
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn series_of_the_hydrostatic_density_matches_the_exact_root() {
        let (rho0, c0, gamma, g) = (1000.0, 15.0, 7.0, 9.81);
        let tait = Tait { rho0, c0, gamma };
        let diffusion = Diffusion::new(DensityDiffusion::Fourtakas, 0.1, 0.02, &tait, g);
        for z in [-0.04, -0.01, 0.02, 0.04_f64] {
            let root = rho0 * ((1.0 + gamma * g * z / (c0 * c0)).powf(1.0 / gamma) - 1.0);
            // Limit 1e-4: the relative error is the neglected third term of the series,
            // (gamma - 1)(2 gamma - 1)/6 (g z / c0^2)^2, which is at most 4e-5.
            assert!((-diffusion.excess(0.0, 0.0, z) / root - 1.0).abs() < 1e-4);
        }
    }

    #[test]
    fn diffusion_carries_density_from_dense_to_light_particles() {
        let tait = Tait { rho0: 1000.0, c0: 15.0, gamma: 7.0 };
        let diffusion = Diffusion::new(DensityDiffusion::Fourtakas, 0.1, 0.02, &tait, 9.81);
        // G is negative inside the support.
        let g = -1e9;
        assert!(f64::from(diffusion.factor()) * diffusion.excess(0.0_f64, 1.0, 0.0) * g > 0.0);
        assert!(f64::from(diffusion.factor()) * diffusion.excess(1.0_f64, 0.0, 0.0) * g < 0.0);
    }
}
