//! Computes the power that the water receives at one moment, and the divergence of the water velocity.
//!
//! The energy of a water particle a is its kinetic energy plus its internal energy. The internal energy per mass
//! changes at the rate p_a / rho_a^2 d rho_a/dt. Pressure forces between water particles conserve the sum of the
//! energies of these particles. Therefore the sum over all water particles
//!
//!   sum_a m_a (v_a . dv_a/dt + p_a / rho_a^2 d rho_a/dt)     without viscosity and diffusion
//!
//! is the power of bed, walls, wavemaker and units. The power of viscosity is the same sum with only the rates caused
//! by viscosity, plus the power of the acoustic damping, which is a bulk viscosity. The power of diffusion is the sum
//! with only the rates caused by diffusion, plus the power of particle shifting. Gravity is omitted, because it only
//! converts kinetic energy to potential energy and back.

use glam::DVec3;

use super::step::Solver;
use crate::sph::{
    pairs::{gradients::Gradients, rate::Rate},
    parameters::Parameters,
    particles::{sums::sums, water::Water},
    terms::{density_diffusion::Diffusion, shifting::Shifting, viscosity::Viscosity},
};

/// Power received by the water [W].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Powers {
    /// Power of bed, walls, wavemaker and units through pressure.
    pub boundary: f64,
    /// Power of viscosity and acoustic damping. It is negative (dissipation), unless moving walls drag the water along.
    pub viscosity: f64,
    /// Power of density diffusion and of particle shifting, which both smooth the particle distribution.
    pub diffusion: f64,
    /// Power of the drag in porous media; negative.
    pub pores: f64,
    /// Root mean square of div v over the volume of the water [1/s]; div v = -(1 / rho) d rho/dt, without diffusion.
    pub divergence: f64,
    /// Volume of the water [m3].
    pub volume: f64,
}

impl Solver {
    /// Computes the powers for the last state for which rates were computed. `water` must be this state, in sorted
    /// order.
    pub fn powers(&self, water: &Water) -> Powers {
        let parameters = self.parameters;
        let pressure_only = self.rates_with(
            match parameters.viscosity {
                Viscosity::Artificial { .. } => Viscosity::Artificial { alpha: 0.0, beta: 0.0 },
                Viscosity::Laminar { .. } => Viscosity::Laminar { nu: 0.0, turbulence: None },
                Viscosity::MonaghanGingold { .. } => Viscosity::MonaghanGingold { nu: 0.0 },
            },
            Diffusion::none(),
        );
        let mut powers = Powers::of(water, &parameters, self.water_rates(), &pressure_only);
        powers.diffusion += self.shifting_power(water);
        let is_own = |a: usize| (parameters.own_x[0]..parameters.own_x[1]).contains(&water.position[a].x);
        let drag = |a: usize| if is_own(a) { -water.mass[a] * self.dissipation(a, water.velocity[a]) } else { 0.0 };
        [powers.pores] = sums(water.len(), |a| [drag(a)]);
        powers
    }

    /// Returns the power that the shifts of the particles give to the water without buffers [W].
    fn shifting_power(&self, water: &Water) -> f64 {
        let Parameters { shifting: Some(shifting), own_x: [from, to], tait, gravity, .. } = self.parameters else {
            return 0.0;
        };
        let mut gradients = Gradients::default();
        self.compute_order(&mut gradients);
        let [power] = sums(water.len(), |a| {
            if !(from..to).contains(&water.position[a].x) {
                return [0.0];
            }
            let disorder = shifting.disorder(&gradients.order(a));
            let velocity = shifting.velocity(f64::from(self.water_rates()[a].approach), disorder);
            let per_change = tait.pressure(water.density[a]) / water.density[a];
            [water.mass[a] * (gravity * velocity.z + per_change * Shifting::density_change(velocity, disorder))]
        });
        power
    }
}

impl Powers {
    /// Computes the powers of the sorted water without buffers. The rates `all` include viscosity and diffusion; the
    /// rates `pressure_only` do not.
    pub(in crate::sph) fn of(water: &Water, parameters: &Parameters, all: &[Rate], pressure_only: &[Rate]) -> Self {
        let (tait, [from, to]) = (&parameters.tait, parameters.own_x);
        let vector = |rate: &Rate| DVec3::from_array(rate.acceleration.map(f64::from));
        let [boundary, viscosity, diffusion, volume, squares] = sums(water.len(), |a| {
            if !(from..to).contains(&water.position[a].x) {
                return [0.0; 5];
            }
            let (all, pressure) = (&all[a], &pressure_only[a]);
            let (mass, density) = (water.mass[a], water.density[a]);
            // Power per mass and per d rho/dt: p / rho^2 [J m3/kg2].
            let per_rate = tait.pressure(density) / (density * density);
            let (of_all, of_pressure) = (f64::from(all.density), f64::from(pressure.density));
            let damping = parameters
                .acoustic_damping
                .map_or(0.0, |damping| damping.power_density(f64::from(all.compression), density) * mass / density);
            [
                mass * (water.velocity[a].dot(vector(pressure)) + per_rate * of_pressure),
                mass * water.velocity[a].dot(vector(all) - vector(pressure)) + damping,
                mass * per_rate * (of_all - of_pressure),
                mass / density,
                mass / density * (of_pressure / density).powi(2),
            ]
        });
        let divergence = if volume > 0.0 { (squares / volume).sqrt() } else { 0.0 };
        Self { boundary, viscosity, diffusion, pores: 0.0, divergence, volume }
    }

    /// Adds the powers of other water.
    pub fn add(&mut self, other: Self) {
        self.boundary += other.boundary;
        self.viscosity += other.viscosity;
        self.diffusion += other.diffusion;
        self.pores += other.pores;
        let squares = [*self, other].map(|powers| powers.volume * powers.divergence.powi(2));
        self.volume += other.volume;
        if self.volume > 0.0 {
            self.divergence = (squares.iter().sum::<f64>() / self.volume).sqrt();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn divergence_is_the_volume_average_without_diffusion() {
        let mut water = Water::default();
        for mass in [1.0, 3.0] {
            water.position.push(DVec3::ZERO);
            water.velocity.push(DVec3::ZERO);
            water.density.push(1000.0);
            water.mass.push(mass);
        }
        let rates = |density: [f32; 2]| density.map(|density| Rate { density, ..Rate::default() });
        let parameters = Parameters::published(0.1, 0.2, 15.0, 9.81, None);
        // div v is 0.2 / s in a quarter of the water and -0.1 / s in the rest. Diffusion adds 50 kg/(m3 s) to every
        // d rho/dt and must not affect the divergence.
        let powers = Powers::of(&water, &parameters, &rates([-150.0, 150.0]), &rates([-200.0, 100.0]));
        let expected = (0.25 * 0.2_f64.powi(2) + 0.75 * 0.1_f64.powi(2)).sqrt();
        assert!((powers.divergence - expected).abs() < 1e-12);
        assert_eq!(Powers::of(&Water::default(), &parameters, &[], &[]).divergence, 0.0);
    }
}
