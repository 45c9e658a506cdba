//! Energy of water and units.

use crate::simulation::flume::Simulation;
use crate::sph::{
    parameters::Parameters,
    particles::{porosity::PorousField, sums::sums, water::Water},
    terms::porous::Pores,
};

/// Energy of water and units [J]; potential energy is zero at z = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Energies {
    /// Kinetic energy of the water.
    pub kinetic: f64,
    /// Potential energy of the water.
    pub potential: f64,
    /// Internal energy of the water, by compression.
    pub internal: f64,
    /// Kinetic energy of the units.
    pub units_kinetic: f64,
    /// Potential energy of the units.
    pub units_potential: f64,
}

impl Energies {
    /// Returns the sum of all energies [J].
    pub fn total(&self) -> f64 {
        self.kinetic + self.potential + self.internal + self.units_kinetic + self.units_potential
    }
}

impl Simulation {
    /// Returns the kinetic, potential and internal energy of a water particle [J].
    pub(in crate::simulation::flume) fn energy_of(&self, particle: usize) -> [f64; 3] {
        energy_of(&self.water, self.solver().parameters(), self.porous.as_deref(), particle)
    }

    /// Returns the energy of the water of all regions, without their buffers, and of the units.
    pub fn energy(&self) -> Energies {
        let parameters = self.solver().parameters();
        let mut energy =
            Energies { kinetic: 0.0, potential: 0.0, internal: 0.0, units_kinetic: 0.0, units_potential: 0.0 };
        for region in self.regions() {
            let (water, parameters, [from, to]) = (&region.water, region.solver().parameters(), region.own_x());
            let porous = region.porous.as_deref();
            let is_own = |i: usize| (from..to).contains(&water.position[i].x);
            let of_particle = |i| if is_own(i) { energy_of(water, parameters, porous, i) } else { [0.0; 3] };
            let [kinetic, potential, internal] = sums(water.len(), of_particle);
            energy.kinetic += kinetic;
            energy.potential += potential;
            energy.internal += internal;
        }
        if let Some(units) = &self.units {
            for ((group, model), state) in units.each().zip(units.states()) {
                // In two dimensions, the water is as thick as one slice of a unit. Therefore use the mass of one slice.
                let mass = model.mass / group.slices;
                let inertia = model.shape.unit().inertia(mass);
                let spin = state.rotation.inverse() * state.angular_velocity;
                energy.units_kinetic += 0.5 * mass * state.velocity.length_squared() + 0.5 * spin.dot(inertia * spin);
                energy.units_potential += mass * parameters.gravity * state.position.z;
            }
        }
        energy
    }
}

fn energy_of(water: &Water, parameters: &Parameters, porous: Option<&PorousField>, particle: usize) -> [f64; 3] {
    // The added mass of the stones moves with the water.
    let pores = porous.map_or(Pores::NONE, |porous| porous.at(water.position[particle]));
    [
        0.5 * (1.0 + pores.added_mass) * water.velocity[particle].length_squared(),
        parameters.gravity * water.position[particle].z,
        parameters.tait.internal_energy(water.density[particle]),
    ]
    .map(|per_mass| water.mass[particle] * per_mass)
}
