//! Boundary particles of fixed bed and walls, of the wavemaker's rows and of the armour units.

use std::ops::Range;

use glam::DVec3;

use crate::rigid::BodyState;

/// Boundary particles in a fixed order: bed and walls, then the piston, then one unit after the other.
#[derive(Debug, Clone, Default)]
pub struct Boundary {
    /// Position [m].
    pub position: Vec<DVec3>,
    /// Velocity [m/s].
    pub velocity: Vec<DVec3>,
    /// Vector from the particle to the wetted surface [m]; twice this vector leads to the ghost node.
    pub to_surface: Vec<DVec3>,
    /// Volume [m3].
    pub volume: Vec<f64>,
    /// Whether the particle allows free slip: on beds flatter than 1:4 and on walls. Particles at convex edges, of
    /// units and of obstacles represent surfaces of several directions. Free slip along all of them would let water
    /// converge inside the solid.
    pub slides: Vec<bool>,
    /// Density [kg/m3].
    pub density: Vec<f64>,
    /// Particles of the piston.
    piston: Range<usize>,
    /// Row of each particle of the piston.
    piston_row: Vec<u32>,
    /// Particles of each unit.
    units: Vec<Range<usize>>,
    /// Position of a piston particle at zero displacement; of a unit particle in the unit's axes [m].
    anchor: Vec<DVec3>,
    /// `to_surface` in the unit's axes [m].
    anchor_to_surface: Vec<DVec3>,
}

/// One boundary particle to be added.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundaryParticle {
    /// Position; for units in the unit's axes [m].
    pub position: DVec3,
    /// Vector from the particle to the surface [m].
    pub to_surface: DVec3,
    /// Volume [m3].
    pub volume: f64,
    /// Whether the particle allows free slip, see [`Boundary::slides`].
    pub slides: bool,
}

impl Boundary {
    /// Creates bed and walls, then the piston with the row of each of its particles, then `units` copies of `unit`.
    /// All start at the density `rho0` [kg/m3]; the units lie at the origin until [`Self::move_unit`] moves them.
    pub fn new(
        fixed: &[BoundaryParticle],
        piston: &[(u32, BoundaryParticle)],
        unit: &[BoundaryParticle],
        units: usize,
        rho0: f64,
    ) -> Self {
        let mut boundary = Self::default();
        fixed.iter().for_each(|p| boundary.push(p, rho0));
        let first = boundary.len();
        piston.iter().for_each(|(_, p)| boundary.push(p, rho0));
        boundary.piston = first..boundary.len();
        boundary.piston_row = piston.iter().map(|&(row, _)| row).collect();
        for _ in 0..units {
            let first = boundary.len();
            unit.iter().for_each(|p| boundary.push(p, rho0));
            boundary.units.push(first..boundary.len());
        }
        boundary.anchor = boundary.position.clone();
        boundary.anchor_to_surface = boundary.to_surface.clone();
        boundary
    }

    fn push(&mut self, particle: &BoundaryParticle, rho0: f64) {
        self.position.push(particle.position);
        self.velocity.push(DVec3::ZERO);
        self.to_surface.push(particle.to_surface);
        self.volume.push(particle.volume);
        self.slides.push(particle.slides);
        self.density.push(rho0);
    }

    /// Returns the number of particles.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Returns whether there are no particles.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Returns the particles of bed, walls and piston; those of the units follow.
    pub fn walls(&self) -> Range<usize> {
        0..self.piston.end
    }

    /// Returns the particles of the piston.
    pub fn piston(&self) -> Range<usize> {
        self.piston.clone()
    }

    /// Returns the particles of each unit.
    pub fn units(&self) -> &[Range<usize>] {
        &self.units
    }

    /// Returns position and vector to the surface of each unit particle, in the unit's axes [m]; all units share them.
    pub fn places_in_unit(&self) -> impl Iterator<Item = (DVec3, DVec3)> {
        let unit = self.units.first().cloned().unwrap_or_default();
        unit.map(|particle| (self.anchor[particle], self.anchor_to_surface[particle]))
    }

    /// Moves the piston; `rows` gives the displacement [m] and velocity [m/s] of each row along x.
    pub fn move_piston(&mut self, rows: &[[f64; 2]]) {
        for (particle, &row) in self.piston.clone().zip(&self.piston_row) {
            let [displacement, velocity] = rows[row as usize];
            self.position[particle] = self.anchor[particle] + DVec3::X * displacement;
            self.velocity[particle] = DVec3::X * velocity;
        }
    }

    /// Moves a unit to the state of its rigid body.
    pub fn move_unit(&mut self, unit: usize, motion: &BodyState) {
        for particle in self.units[unit].clone() {
            let arm = motion.rotation * self.anchor[particle];
            self.position[particle] = motion.position + arm;
            self.velocity[particle] = motion.velocity + motion.angular_velocity.cross(arm);
            self.to_surface[particle] = motion.rotation * self.anchor_to_surface[particle];
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::*;

    #[test]
    fn unit_particles_move_as_a_rigid_body() {
        let particle = BoundaryParticle { position: DVec3::X, to_surface: DVec3::X * 0.1, volume: 1.0, slides: false };
        let mut boundary = Boundary::new(&[], &[], &[particle], 2, 1000.0);
        let quarter = DQuat::from_rotation_z(std::f64::consts::FRAC_PI_2);
        boundary.move_unit(
            1,
            &BodyState {
                position: DVec3::new(5.0, 0.0, 0.0),
                rotation: quarter,
                velocity: DVec3::Z,
                angular_velocity: DVec3::Z * 2.0,
            },
        );
        assert!((boundary.position[1] - DVec3::new(5.0, 1.0, 0.0)).length() < 1e-15);
        assert!((boundary.velocity[1] - DVec3::new(-2.0, 0.0, 1.0)).length() < 1e-15);
        assert!((boundary.to_surface[1] - DVec3::Y * 0.1).length() < 1e-15);
        assert_eq!(boundary.position[0], DVec3::X);
    }
}
