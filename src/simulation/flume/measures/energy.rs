//! Energy of water and units.

use crate::simulation::flume::Simulation;

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
    /// Returns the energy of water and units.
    pub fn energy(&self) -> Energies {
        let (water, parameters) = (&self.water, self.solver().parameters());
        let mut energy =
            Energies { kinetic: 0.0, potential: 0.0, internal: 0.0, units_kinetic: 0.0, units_potential: 0.0 };
        for i in 0..water.len() {
            energy.kinetic += 0.5 * water.mass[i] * water.velocity[i].length_squared();
            energy.potential += water.mass[i] * parameters.gravity * water.position[i].z;
            energy.internal += water.mass[i] * parameters.tait.internal_energy(water.density[i]);
        }
        if let (Some(units), Some(of_case)) = (&self.units, &self.case.units) {
            // In two dimensions, the water is as thick as one slice of a unit. Therefore use the mass of one slice.
            let mass = of_case.mass / of_case.slices;
            let inertia = units.shape.inertia(mass);
            for state in units.states() {
                let spin = state.rotation.inverse() * state.angular_velocity;
                energy.units_kinetic += 0.5 * mass * state.velocity.length_squared() + 0.5 * spin.dot(inertia * spin);
                energy.units_potential += mass * parameters.gravity * state.position.z;
            }
        }
        energy
    }
}
