//! Benchmarks on one thread of FEMDEM time steps (without joints, with joints on all faces, with tied joints) and of
//! the contact detection. Run them with `cargo bench --bench tetrahedra`. In the time steps, a block of tetrahedra
//! rotates and nothing breaks.

use breakwater::femdem::{
    contact::detection::{Bounds, intersecting_pairs},
    material::{
        Elastic, Strength,
        cohesive_law::{Cohesion, Range},
    },
    mesh::{
        block::{Pattern, block},
        prepare,
    },
    setup::{Body, Setup},
    world::World,
};
use divan::{Bencher, counter::ItemsCount};
use glam::DVec3;

const CONCRETE: Elastic = Elastic { density: 2340.0, young_modulus: 26e9, poisson_ratio: 0.2, viscosity: 2e4 };
const STRENGTH: Strength =
    Strength { tensile: 3.3e6, cohesion: 16.5e6, friction: 0.577, opening_energy: 50.0, sliding_energy: 1250.0 };

/// Number of cells along each edge of the block. The blocks have 16,464, 131,712 and 998,250 tetrahedra.
const CELLS: [usize; 3] = [14, 28, 55];

fn main() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("one thread can be started");
    divan::main();
}

fn measure_steps(bencher: Bencher, cells: usize, cohesion: Option<Cohesion>) {
    let mesh = prepare(block(DVec3::splat(0.3), [cells; 3], Pattern::Diagonal)).expect("a block is a valid mesh");
    let count = mesh.mesh.tets.len();
    let body = Body { cohesion, angular_velocity: DVec3::Z * 10.0, ..Body::at_rest(0..count, CONCRETE) };
    let mut world = World::new(Setup::of_mesh(&mesh, vec![body]), 0.9);
    bencher.counter(ItemsCount::new(count)).bench_local(|| world.step());
}

fn cohesion(tied: bool) -> Cohesion {
    let penalty = if tied { 2.0 } else { 50.0 } * CONCRETE.young_modulus;
    Cohesion { strength: STRENGTH, penalty, range: Range::Exact, tied }
}

#[divan::bench(args = CELLS)]
fn without_joints(bencher: Bencher, cells: usize) {
    measure_steps(bencher, cells, None);
}

#[divan::bench(args = CELLS)]
fn joints_everywhere(bencher: Bencher, cells: usize) {
    measure_steps(bencher, cells, Some(cohesion(false)));
}

#[divan::bench(args = CELLS)]
fn tied_joints(bencher: Bencher, cells: usize) {
    measure_steps(bencher, cells, Some(cohesion(true)));
}

/// Measures contact detection on boxes as dense as the bounding boxes of a mesh of tetrahedra with edges of 1 m. The
/// time must grow linearly with the number of boxes.
#[divan::bench(args = [10_000, 100_000, 1_000_000])]
fn contact_detection(bencher: Bencher, count: usize) {
    // A regular tetrahedron with edges of 1 m has a volume of 0.118 m3.
    let row = (count as f64).cbrt().ceil();
    let spacing = (0.118 * count as f64).cbrt() / row;
    let boxes: Vec<Bounds> = (0..count)
        .map(|number| {
            let number = number as f64;
            let cell = DVec3::new(number % row, (number / row).floor() % row, (number / row / row).floor());
            Bounds { low: spacing * cell - 0.4, high: spacing * cell + 0.4 }
        })
        .collect();
    bencher.counter(ItemsCount::new(count)).bench_local(|| intersecting_pairs(&boxes, |_, _| true));
}
