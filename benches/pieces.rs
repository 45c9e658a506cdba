//! Benchmarks of the stages of an SPH time step on one thread, for each instruction set of the processor. Run them with
//! `cargo bench --bench pieces`. The command `breakwater bench` measures complete time steps.

use breakwater::bench::tank::Tank;
use breakwater::sph::{
    lanes::{InstructionSet, Lanes, WithLanes},
    parameters::Parameters,
    terms::{kernel::Wendland, wall_slip::WallSlip},
};
use divan::{Bencher, counter::ItemsCount};
use glam::DVec2;

/// Particle spacing [m].
const DP: f64 = 0.01;
/// Length of the edges of the cube of water, in particle spacings.
const EDGE: f64 = 24.0;

fn main() {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("one thread can be started");
    divan::main();
}

fn instruction_sets() -> Vec<InstructionSet> {
    InstructionSet::available()
}

/// Creates a cube of still water with sorted particles and neighbour lists.
fn tank(instructions: InstructionSet) -> Tank {
    let side = EDGE * DP;
    // Smoothing length h = 2.08 dp, the default of case files.
    let mut parameters = Parameters::published(DP, 2.08 * DP, 15.0 * (9.81 * side).sqrt(), 9.81, Some(side));
    parameters.slip = WallSlip::FreeSlip;
    let mut tank = Tank::new(instructions, parameters, [side; 3], &|_| side, &|_, _| DVec2::ZERO, &[]);
    let Tank { solver, water, boundary } = &mut tank;
    solver.sort(water, boundary);
    solver.build_neighbour_lists(water, boundary);
    solver.boundary_densities(boundary);
    tank
}

/// Measures one stage of the time step. The reported throughput is the number of particles per second.
fn measure(bencher: Bencher, instructions: InstructionSet, mut run: impl FnMut(&mut Tank)) {
    let mut tank = tank(instructions);
    let particles = tank.water.len() + tank.boundary.len();
    bencher.counter(ItemsCount::new(particles)).bench_local(|| run(&mut tank));
}

#[divan::bench(args = instruction_sets())]
fn sort(bencher: Bencher, instructions: InstructionSet) {
    measure(bencher, instructions, |Tank { solver, water, boundary }| solver.sort(water, boundary));
}

#[divan::bench(args = instruction_sets())]
fn neighbour_lists(bencher: Bencher, instructions: InstructionSet) {
    measure(bencher, instructions, |Tank { solver, water, boundary }| solver.build_neighbour_lists(water, boundary));
}

#[divan::bench(args = instruction_sets())]
fn boundary_densities(bencher: Bencher, instructions: InstructionSet) {
    measure(bencher, instructions, |Tank { solver, boundary, .. }| solver.boundary_densities(boundary));
}

#[divan::bench(args = instruction_sets())]
fn pair_sums(bencher: Bencher, instructions: InstructionSet) {
    measure(bencher, instructions, |Tank { solver, .. }| solver.rates());
}

/// Sums the kernel and its gradient factor over all distances [m].
struct KernelSum<'a> {
    kernel: &'a Wendland,
    distances: &'a [f32],
}

impl WithLanes for KernelSum<'_> {
    type Output = f32;

    #[inline(always)]
    fn run<L: Lanes>(self) -> f32 {
        let (mut values, mut gradients) = (L::splat(0.0), L::splat(0.0));
        for r in self.distances.chunks_exact(L::COUNT) {
            let closeness = self.kernel.closeness(L::load(r));
            values += self.kernel.value(closeness);
            gradients += self.kernel.gradient_factor(closeness);
        }
        (values + gradients).to_array().iter().sum()
    }
}

#[divan::bench(args = instruction_sets())]
fn kernel(bencher: Bencher, instructions: InstructionSet) {
    let kernel = Wendland::new(2.08 * DP);
    let count = 4096;
    let distances: Vec<f32> = (0..count).map(|i| i as f32 / count as f32 * kernel.support() as f32).collect();
    bencher
        .counter(ItemsCount::new(distances.len()))
        .bench(|| instructions.dispatch(KernelSum { kernel: &kernel, distances: divan::black_box(&distances) }));
}
