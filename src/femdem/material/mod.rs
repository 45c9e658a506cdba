//! Materials of deformable bodies: elasticity and strength.
//!
//! | file | contents |
//! | --- | --- |
//! | `cohesive_law` | the cohesive law at an integration point of a joint |
//! | `softening` | the softening curve of concrete |

pub mod cohesive_law;
mod softening;

/// Elasticity, viscosity and density of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elastic {
    /// Density rho [kg/m3].
    pub density: f64,
    /// Young's modulus E [Pa].
    pub young_modulus: f64,
    /// Poisson's ratio nu [-].
    pub poisson_ratio: f64,
    /// Viscosity eta [Pa s]; the viscous stress is eta D, with the strain rate D.
    pub viscosity: f64,
}

impl Elastic {
    /// Returns Lamé's first constant lambda [Pa].
    pub fn lambda(&self) -> f64 {
        let nu = self.poisson_ratio;
        self.young_modulus * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))
    }

    /// Returns the shear modulus mu [Pa].
    pub fn mu(&self) -> f64 {
        self.young_modulus / (2.0 * (1.0 + self.poisson_ratio))
    }

    /// Returns the celerity of longitudinal waves, sqrt((lambda + 2 mu) / rho) [m/s].
    pub fn celerity(&self) -> f64 {
        ((self.lambda() + 2.0 * self.mu()) / self.density).sqrt()
    }
}

/// Strength of a body that can crack (Guo, Latham and Xiang, section 2.2.2).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Strength {
    /// Tensile strength f_t [Pa].
    pub tensile: f64,
    /// Cohesion c [Pa].
    pub cohesion: f64,
    /// Tangent of the angle of internal friction phi [-].
    pub friction: f64,
    /// Fracture energy in opening G_f [J/m2].
    pub opening_energy: f64,
    /// Fracture energy in sliding G_fII [J/m2].
    pub sliding_energy: f64,
}

impl Strength {
    /// Returns the shear strength f_s [Pa] at the normal stress sigma_n [Pa] (tension positive), by eq. 1: Mohr-Coulomb
    /// with a tension cut-off.
    pub fn shear(&self, sigma_n: f64) -> f64 {
        (self.cohesion - sigma_n.min(self.tensile) * self.friction).max(0.0)
    }

    /// Returns the least stress that can break the material [Pa]: the smaller of the tensile strength f_t and the shear
    /// strength at the normal stress f_t.
    pub fn least(&self) -> f64 {
        self.tensile.min(self.shear(self.tensile))
    }

    /// Returns the characteristic lengths [m]: Hillerborg's E G_f / f_t^2 for opening and E G_fII / c^2 for sliding.
    /// A mesh resolves a crack if its elements are at most a quarter of these lengths.
    pub fn characteristic_lengths(&self, young_modulus: f64) -> [f64; 2] {
        let length = |energy: f64, strength: f64| young_modulus * energy / (strength * strength);
        [length(self.opening_energy, self.tensile), length(self.sliding_energy, self.cohesion)]
    }
}
