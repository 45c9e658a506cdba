//! Boundary particles of the fixed bed and walls, of the pistons (wavemaker or open ends) and of the armour units.

use std::ops::Range;

use glam::DVec3;

use crate::{
    geometry::axis_box::AxisBox,
    mechanics::{BodyState, Load},
    sph::terms::wall_slip::Mirroring,
};

/// All boundary particles in a fixed order: bed and walls, then the pistons, then one unit after the other.
#[derive(Debug, Clone, Default)]
pub struct Boundary {
    /// Position [m].
    pub position: Vec<DVec3>,
    /// Velocity [m/s].
    pub velocity: Vec<DVec3>,
    /// Vector from the particle to the wetted surface [m]. Twice this vector leads from the particle to its ghost node.
    pub to_surface: Vec<DVec3>,
    /// Volume [m3].
    pub volume: Vec<f64>,
    /// Components of the water velocity that the particle mirrors under no slip and free slip.
    pub mirroring: Vec<Mirroring>,
    /// Density [kg/m3].
    pub density: Vec<f64>,
    pistons: Vec<Piston>,
    /// Index of the first unit particle.
    first_unit: usize,
    /// Index range of the particles of each unit.
    units: Vec<Range<usize>>,
    /// Number of the unit of each unit particle.
    unit_numbers: Vec<u32>,
    /// Reference position [m]: for a piston particle its position at zero displacement, for a unit particle its
    /// position in the unit's axes.
    anchor: Vec<DVec3>,
    /// Reference value of `to_surface` [m]; for a unit particle, this vector is in the unit's axes.
    anchor_to_surface: Vec<DVec3>,
    /// For each unit, the box in its axes to whose open faces the surface vectors lead; `None` if they have their
    /// reference values.
    standing: Vec<Option<AxisBox>>,
    /// Indices of the wall particles that units cover.
    covered: Vec<usize>,
    /// Range of the indices of all wall particles that units have covered so far.
    ever_covered: Range<usize>,
}

/// Particles that move in rows along x.
#[derive(Debug, Clone)]
struct Piston {
    /// Index range of the particles.
    particles: Range<usize>,
    /// Row of each particle. A row is a level of the piston with its own displacement.
    row: Vec<u32>,
}

/// Data from which one boundary particle is created.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundaryParticle {
    /// Position [m]; for a unit particle in the unit's axes.
    pub position: DVec3,
    /// Vector from the particle to the surface [m].
    pub to_surface: DVec3,
    /// Volume [m3].
    pub volume: f64,
    /// See [`Boundary::mirroring`].
    pub mirroring: Mirroring,
}

impl Boundary {
    /// Creates the `fixed` particles of bed and walls, the particles of each piston with their row numbers, and the
    /// particles of each of the `units`. All particles start with the density `rho0` [kg/m3]. The units lie at the
    /// origin until [`Self::move_unit`] moves them.
    pub fn new(
        fixed: &[BoundaryParticle],
        pistons: &[Vec<(u32, BoundaryParticle)>],
        units: &[&[BoundaryParticle]],
        rho0: f64,
    ) -> Self {
        let mut boundary = Self::default();
        fixed.iter().for_each(|p| boundary.push(p, rho0));
        for piston in pistons {
            let first = boundary.len();
            piston.iter().for_each(|(_, p)| boundary.push(p, rho0));
            let row = piston.iter().map(|&(row, _)| row).collect();
            boundary.pistons.push(Piston { particles: first..boundary.len(), row });
        }
        boundary.first_unit = boundary.len();
        for unit in units {
            let (first, number) = (boundary.len(), boundary.units.len());
            unit.iter().for_each(|p| boundary.push(p, rho0));
            boundary.units.push(first..boundary.len());
            boundary.unit_numbers.extend(unit.iter().map(|_| number as u32));
        }
        boundary.standing = vec![None; units.len()];
        boundary.anchor = boundary.position.clone();
        boundary.anchor_to_surface = boundary.to_surface.clone();
        boundary
    }

    fn push(&mut self, particle: &BoundaryParticle, rho0: f64) {
        self.position.push(particle.position);
        self.velocity.push(DVec3::ZERO);
        self.to_surface.push(particle.to_surface);
        self.volume.push(particle.volume);
        self.mirroring.push(particle.mirroring);
        self.density.push(rho0);
    }

    /// Returns the number of particles.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Returns true if there are no particles.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }

    /// Returns the index range of the bed, wall and piston particles. The unit particles follow this range.
    pub fn walls(&self) -> Range<usize> {
        0..self.first_unit
    }

    /// Returns the index range of the particles of all pistons.
    pub fn pistons(&self) -> Range<usize> {
        self.pistons.first().map_or(self.first_unit, |piston| piston.particles.start)..self.first_unit
    }

    /// Returns the index of each particle of a piston, with its row.
    pub fn rows_of(&self, piston: usize) -> impl Iterator<Item = (usize, usize)> {
        let Piston { particles, row } = &self.pistons[piston];
        particles.clone().zip(row.iter().map(|&row| row as usize))
    }

    /// Returns the index range of the particles of each unit.
    pub fn units(&self) -> &[Range<usize>] {
        &self.units
    }

    /// Returns the number of the unit of each unit particle.
    pub fn unit_numbers(&self) -> &[u32] {
        &self.unit_numbers
    }

    /// Returns position and surface vector of each particle of a unit, in the unit's axes [m]. These values are the
    /// same for all units of its shape.
    pub fn positions_in_unit(&self, unit: usize) -> impl Iterator<Item = (DVec3, DVec3)> {
        self.units
            .get(unit)
            .cloned()
            .unwrap_or_default()
            .map(|particle| (self.anchor[particle], self.anchor_to_surface[particle]))
    }

    /// Returns the force on each unit and the torque about its centre of mass. `centres` lists the centres of mass [m];
    /// `force_on` returns the force on the boundary particle with a given index [N]. The order of summation is fixed.
    pub fn unit_loads(&self, centres: &[DVec3], force_on: impl Fn(usize) -> DVec3) -> Vec<Load> {
        let load = |(unit, centre): (&Range<usize>, &DVec3)| {
            let mut load = Load::default();
            unit.clone().for_each(|i| load += Load::of_force(force_on(i), self.position[i] - *centre));
            load
        };
        self.units.iter().zip(centres).map(load).collect()
    }

    /// Moves the particles of a piston. `rows` gives the displacement [m] and the velocity [m/s] of each row along x.
    pub fn move_piston(&mut self, piston: usize, rows: &[[f64; 2]]) {
        let Piston { particles, row } = &self.pistons[piston];
        for (particle, &row) in particles.clone().zip(row) {
            let [displacement, velocity] = rows[row as usize];
            self.position[particle] = self.anchor[particle] + DVec3::X * displacement;
            self.velocity[particle] = DVec3::X * velocity;
        }
    }

    /// Moves the particles of a unit according to the position, rotation and velocities of its rigid body.
    pub fn move_unit(&mut self, unit: usize, motion: &BodyState) {
        for particle in self.units[unit].clone() {
            let place = self.anchor[particle];
            let arm = motion.rotation * place;
            let to_surface = match &self.standing[unit] {
                Some(bounds) => bounds.vector_to_surface(place),
                None => self.anchor_to_surface[particle],
            };
            self.position[particle] = motion.position + arm;
            self.velocity[particle] = motion.velocity + motion.angular_velocity.cross(arm);
            self.to_surface[particle] = motion.rotation * to_surface;
        }
    }

    /// Lets the surface vectors of a unit lead to the open faces of a box in its axes, from the next
    /// [`Self::move_unit`] on; `None` gives them their reference values.
    pub fn stand_unit(&mut self, unit: usize, bounds: Option<AxisBox>) {
        self.standing[unit] = bounds;
    }

    /// Adds vectors [m] to the own surface vectors of these wall particles. All other wall particles have their own
    /// ones.
    pub fn cover_walls(&mut self, covered: impl Iterator<Item = (usize, DVec3)>) {
        for particle in self.covered.drain(..) {
            self.to_surface[particle] = self.anchor_to_surface[particle];
        }
        for (particle, further) in covered {
            self.to_surface[particle] = self.anchor_to_surface[particle] + further;
            self.covered.push(particle);
            let Range { start, end } = self.ever_covered;
            let is_first = start == end;
            self.ever_covered = if is_first { particle } else { start.min(particle) }..end.max(particle + 1);
        }
    }

    /// Returns a range of indices that contains all wall particles whose surface vectors have changed since the start.
    pub fn ever_covered(&self) -> Range<usize> {
        self.ever_covered.clone()
    }

    /// Returns the index of each particle of bed and walls, and the surface point to which its own vector leads [m].
    pub fn wall_surface(&self) -> impl Iterator<Item = (usize, DVec3)> {
        (0..self.pistons().start).map(|particle| (particle, self.anchor[particle] + self.anchor_to_surface[particle]))
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::*;

    #[test]
    fn covered_wall_particles_have_longer_vectors_until_they_are_free_again() {
        let wall = |depth: f64| BoundaryParticle {
            position: DVec3::NEG_Z * depth,
            to_surface: DVec3::Z * depth,
            volume: 1.0,
            mirroring: Mirroring::Normal,
        };
        let mut boundary = Boundary::new(&[wall(0.5), wall(1.5)], &[], &[], 1000.0);
        boundary.cover_walls([(1, DVec3::X)].into_iter());
        assert_eq!(boundary.to_surface, [DVec3::Z * 0.5, DVec3::new(1.0, 0.0, 1.5)]);
        assert_eq!(boundary.ever_covered(), 1..2);
        boundary.cover_walls([(0, DVec3::NEG_X)].into_iter());
        assert_eq!(boundary.to_surface, [DVec3::new(-1.0, 0.0, 0.5), DVec3::Z * 1.5]);
        assert_eq!(boundary.ever_covered(), 0..2);
    }

    #[test]
    fn unit_particles_move_as_a_rigid_body() {
        let particle = BoundaryParticle {
            position: DVec3::X,
            to_surface: DVec3::X * 0.1,
            volume: 1.0,
            mirroring: Mirroring::Normal,
        };
        let mut boundary = Boundary::new(&[], &[], &[&[particle], &[particle]], 1000.0);
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
