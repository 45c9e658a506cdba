//! Pieces into which the bodies broke.

use std::path::Path;

use glam::DVec3;

use crate::femdem::joints::Bond;
use crate::femdem::world::World;
use crate::output::{CsvSeries, OutputError, columns};

const FILE: &str = "fragments.csv";

/// A piece of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fragment {
    /// Index of the body, from 0.
    pub body: usize,
    /// Number of tetrahedra.
    pub tets: usize,
    /// Mass [kg].
    pub mass: f64,
    /// Centre of mass [m].
    pub centre: DVec3,
    /// Velocity of the centre [m/s].
    pub velocity: DVec3,
}

/// The pieces of all bodies of a run.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pieces {
    /// Pieces of the bodies that can crack, the heaviest first.
    pub fragments: Vec<Fragment>,
    /// Number of the piece to which each tetrahedron belongs, from 1; 0 in bodies that cannot crack.
    pub of_tet: Vec<u32>,
}

/// Finds the pieces of the bodies that can crack: sets of tetrahedra that are connected by unbroken faces. The heaviest
/// piece comes first.
pub fn pieces(world: &World) -> Pieces {
    let setup = world.setup();
    let mut leader: Vec<u32> = (0..setup.tets.len() as u32).collect();
    for (interface, bond) in setup.interfaces.iter().zip(&world.joints.bond) {
        if *bond != Bond::Broken {
            let [a, b] = interface.tets.map(|tet| first_of(&mut leader, tet));
            // The tetrahedron with the lower index leads its piece: the order of the faces does not affect the result.
            leader[a.max(b) as usize] = a.min(b);
        }
    }
    let mut found: Vec<Option<Fragment>> = vec![None; setup.tets.len()];
    for (number, body) in setup.bodies.iter().enumerate().filter(|(_, body)| body.cohesion.is_some()) {
        for tet in body.tets.clone() {
            let mass = body.elastic.density * world.tets.shape[tet].volume;
            let first = first_of(&mut leader, tet as u32) as usize;
            let nothing = Fragment { body: number, tets: 0, mass: 0.0, centre: DVec3::ZERO, velocity: DVec3::ZERO };
            let fragment = found[first].get_or_insert(nothing);
            let nodes = world.tets.nodes[tet].map(|node| node as usize);
            fragment.tets += 1;
            fragment.mass += mass;
            fragment.centre += nodes.map(|n| world.nodes.position[n]).iter().sum::<DVec3>() * (0.25 * mass);
            fragment.velocity += nodes.map(|n| world.nodes.velocity[n]).iter().sum::<DVec3>() * (0.25 * mass);
        }
    }
    let mut fragments: Vec<(usize, Fragment)> =
        found.into_iter().enumerate().filter_map(|(first, fragment)| Some((first, fragment?))).collect();
    fragments.sort_by(|(_, a), (_, b)| b.mass.total_cmp(&a.mass));
    let mut number_of = vec![0; setup.tets.len()];
    for (number, (first, fragment)) in (1..).zip(&mut fragments) {
        number_of[*first] = number;
        fragment.centre /= fragment.mass;
        fragment.velocity /= fragment.mass;
    }
    let of_tet = (0..setup.tets.len() as u32).map(|tet| number_of[first_of(&mut leader, tet) as usize]).collect();
    Pieces { fragments: fragments.into_iter().map(|(_, fragment)| fragment).collect(), of_tet }
}

/// Writes the pieces at the end of a run to `fragments.csv` in the run folder.
///
/// # Errors
/// If the file cannot be written.
pub fn write_fragments(fragments: &[Fragment], dir: &Path) -> Result<(), OutputError> {
    let row = |(index, fragment): (usize, &Fragment)| {
        let [x, y, z] = fragment.centre.to_array();
        let [u, v, w] = fragment.velocity.to_array();
        [index as f64 + 1.0, fragment.body as f64, fragment.tets as f64, fragment.mass, x, y, z, u, v, w]
    };
    CsvSeries::create(&dir.join(FILE), &columns::FRAGMENTS)?.append_rows(fragments.iter().enumerate().map(row))
}

/// Returns the first tetrahedron of the piece that contains `tet` (union-find with path halving).
fn first_of(leader: &mut [u32], tet: u32) -> u32 {
    let mut current = tet;
    while leader[current as usize] != current {
        leader[current as usize] = leader[leader[current as usize] as usize];
        current = leader[current as usize];
    }
    current
}
