//! Deformable bodies and joints compared with elasticity and fracture mechanics.

mod bounce;
mod contact;
mod continuum;
mod core_locs;
mod dolos;
mod energy_balance;
mod joints;
mod loads;
mod rigid;
mod stability;
mod strength;

use breakwater::femdem::loads::history::History;
use breakwater::femdem::material::cohesive_law::{Cohesion, Range};
use breakwater::femdem::material::{Elastic, Strength};
use breakwater::femdem::mesh::block::{Pattern, block};
use breakwater::femdem::mesh::{PreparedMesh, prepare};
use breakwater::femdem::setup::{Body, Constraint, Setup};
use breakwater::femdem::world::World;
use glam::DVec3;

/// Concrete of Guo, Latham and Xiang, table 2, without viscosity.
const CONCRETE: Elastic = Elastic { density: 2340.0, young_modulus: 26e9, poisson_ratio: 0.2, viscosity: 0.0 };

const STRENGTH: Strength = Strength {
    tensile: 3.3e6,
    cohesion: 16.5e6,
    // tan 30 degrees.
    friction: 0.577_350_269_189_625_8,
    opening_energy: 50.0,
    sliding_energy: 50.0,
};

fn cohesion(penalty: f64, tied: bool) -> Option<Cohesion> {
    Some(Cohesion { strength: STRENGTH, penalty: penalty * CONCRETE.young_modulus, range: Range::Exact, tied })
}

fn mesh(lengths: DVec3, cells: [usize; 3]) -> PreparedMesh {
    prepare(block(lengths, cells, Pattern::Centred)).unwrap()
}

/// Celerity of longitudinal waves in a thin bar of concrete, sqrt(E / rho) [m/s].
fn bar_celerity() -> f64 {
    (CONCRETE.young_modulus / CONCRETE.density).sqrt()
}

/// A constraint with a constant velocity along each axis [m/s].
fn constant_velocity(nodes: Vec<u32>, velocity: [Option<f64>; 3]) -> Constraint {
    Constraint { nodes, velocity: velocity.map(|speed| speed.map(History::from)) }
}

fn setup(mesh: &PreparedMesh, cohesion: Option<Cohesion>) -> Setup {
    let body = Body { cohesion, ..Body::at_rest(0..mesh.mesh.tets.len(), CONCRETE) };
    Setup::of_mesh(mesh, vec![body])
}

/// Displaces all nodes of a world that is undeformed and at rest; `by` gives the displacement [m] at a position.
fn displace(world: &mut World, by: impl Fn(DVec3) -> DVec3) {
    world.nodes.position.iter_mut().for_each(|x| *x += by(*x));
}

/// Returns the interpolated times at which a signal crosses zero.
fn crossings(signal: &[(f64, f64)]) -> Vec<f64> {
    let cross = |w: &[(f64, f64)]| {
        let [(t, a), (u, b)] = [w[0], w[1]];
        (a * b < 0.0).then(|| t + (u - t) * a / (a - b))
    };
    signal.windows(2).filter_map(cross).collect()
}
