//! Pieces that bodies have broken into.

use crate::femdem::joints::Bond;
use crate::femdem::world::World;

/// A piece of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fragment {
    /// Number of the body.
    pub body: usize,
    /// Tetrahedra.
    pub tets: usize,
    /// Mass [kg].
    pub mass: f64,
}

/// Pieces of the bodies that can crack, the heaviest first: what unbroken faces hold together.
pub fn fragments(world: &World) -> Vec<Fragment> {
    let setup = world.setup();
    let mut leader: Vec<u32> = (0..setup.tets.len() as u32).collect();
    for (interface, bond) in setup.interfaces.iter().zip(&world.joints.bond) {
        if *bond != Bond::Broken {
            let [a, b] = interface.tets.map(|tet| first_of(&mut leader, tet));
            // The lower number leads, whatever the order.
            leader[a.max(b) as usize] = a.min(b);
        }
    }
    let mut found: Vec<Option<Fragment>> = vec![None; setup.tets.len()];
    for (number, body) in setup.bodies.iter().enumerate().filter(|(_, body)| body.cohesion.is_some()) {
        for tet in body.tets.clone() {
            let mass = body.elastic.density * world.tets.shape[tet].volume;
            let first = first_of(&mut leader, tet as u32) as usize;
            let fragment = found[first].get_or_insert(Fragment { body: number, tets: 0, mass: 0.0 });
            fragment.tets += 1;
            fragment.mass += mass;
        }
    }
    let mut fragments: Vec<Fragment> = found.into_iter().flatten().collect();
    fragments.sort_by(|a, b| b.mass.total_cmp(&a.mass));
    fragments
}

/// First tetrahedron of a piece; the way to it becomes shorter.
fn first_of(leader: &mut [u32], tet: u32) -> u32 {
    let mut at = tet;
    while leader[at as usize] != at {
        leader[at as usize] = leader[leader[at as usize] as usize];
        at = leader[at as usize];
    }
    at
}
