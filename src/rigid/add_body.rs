//! Adds bodies during a run, and computes the overlap that a new body would have at a position.

use glam::{DQuat, DVec3};

use super::kinematics::Placements;
use super::motion::{BodyState, Load};
use super::world::RigidWorld;

impl RigidWorld {
    /// Largest overlap [m] that a new body of the given kind at this position would have with bodies, ground and walls.
    /// 0 if the position is free; infinite if the overlap exceeds the range of the contact law.
    pub fn overlap_at(&self, kind: usize, position: DVec3, rotation: DQuat) -> f64 {
        let number = self.position.len();
        let mut kinds = self.kind.clone();
        let mut positions = self.position.clone();
        let mut rotations = self.rotation.clone();
        kinds.push(kind);
        positions.push(position);
        rotations.push(rotation);
        let placements = Placements { kind: &kinds, rotation: &rotations, position: &positions };
        match self.surfaces.contact_points_of(number, placements, self.time) {
            Ok(points) => points.iter().map(|point| point.overlap).fold(0.0, f64::max),
            Err(_) => f64::INFINITY,
        }
    }

    /// Adds a body. The body starts to move at the next call of [`advance`](Self::advance).
    pub fn add(&mut self, kind: usize, body: BodyState) {
        let rotation = body.rotation.normalize();
        let inertia = &self.inertias[kind].tensor;
        self.angular_momentum.push(super::motion::angular_momentum(rotation, inertia, body.angular_velocity));
        self.kind.push(kind);
        self.rotation.push(rotation);
        self.position.push(body.position);
        self.velocity.push(body.velocity);
        self.contact_now.push(Load::default());
        self.contact_mean.push(Load::default());
        self.is_still.push(self.inertias[kind].is_fixed() && body.velocity == DVec3::ZERO);
        self.states.push(body);
        self.search.add_body();
        self.update_results();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::profile::Profile;
    use crate::rigid::{Body, BodyKind, BodyShape, ContactModel, Ground, Material, MaterialPair, RigidSetup, Sides};

    fn world(sides: Sides) -> RigidWorld {
        let material = Material { young_modulus: 1e8, poisson_ratio: 0.2, restitution: 0.5 };
        RigidWorld::new(RigidSetup {
            kinds: [0.1, 0.2]
                .map(|radius| BodyKind { shape: BodyShape::ball(radius, 1.0), material: 0, is_fixed: false })
                .to_vec(),
            bodies: Body::of_first_kind([BodyState::at_rest(DVec3::new(0.0, 0.5, 0.1), DQuat::IDENTITY)]),
            materials: vec![material],
            pairs: vec![MaterialPair { between: [0, 0], resistance: 0.5.into() }],
            ground: Some(Ground {
                profile: Profile::new(vec![[-5.0, 0.0], [5.0, 0.0]]),
                material: 0,
                covers: Vec::new(),
            }),
            surfaces: Vec::new(),
            sides,
            end_walls: None,
            wall_material: 0,
            model: ContactModel::HertzMindlin,
            gravity: DVec3::NEG_Z * 9.81,
        })
        .unwrap()
    }

    #[test]
    fn overlap_of_a_new_body_is_exact() {
        for (sides, y) in [(Sides::Open, 0.5), (Sides::Periodic { width: 0.6 }, 0.5 - 3.0 * 0.6)] {
            let world = world(sides);
            let at = |x: f64, y: f64, z: f64| world.overlap_at(0, DVec3::new(x, y, z), DQuat::IDENTITY);
            assert_eq!(at(0.21, y, 0.1), 0.0);
            assert!((at(0.19, y, 0.1) - 0.01).abs() < 1e-12);
            assert!((at(1.0, y, 0.09) - 0.01).abs() < 1e-12);
            assert_eq!(at(0.0, y, 0.1), f64::INFINITY);
            let larger = world.overlap_at(1, DVec3::new(0.28, y, 0.2), DQuat::IDENTITY);
            // The centres are sqrt(0.28^2 + 0.1^2) m apart.
            assert!((larger - (0.3 - 0.28f64.hypot(0.1))).abs() < 1e-12);
        }
    }

    #[test]
    fn added_body_comes_to_rest_on_another() {
        let mut world = world(Sides::Open);
        world.add(0, BodyState::at_rest(DVec3::new(0.0, 0.5, 0.32), DQuat::IDENTITY));
        for _ in 0..2000 {
            world.advance(1e-3, &[Load::default(); 2]).unwrap();
        }
        let z = world.states()[1].position.z;
        assert!((z - 0.3).abs() < 1e-3 && world.energy().kinetic < 1e-9, "{z}");
    }
}
