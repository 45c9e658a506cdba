//! Nodal forces of all tetrahedra, including the forces of the joints at their faces.

use glam::DVec3;
use rayon::prelude::*;

use super::assembly::{nodes::Nodes, tets::Tets};
use super::element::{self, Deformed, LaneModuli, LaneShape, Moduli};
use super::parallel::chunks::CHUNK;
use super::parallel::lanes::{self, LANES, Lanes, Vectors, WithLanes};

/// Share of the least strength of a body [-]. The faces of a tetrahedron are checked for failure only if the stress in
/// the tetrahedron reaches this share. To save time, this comparison uses the norm of the first Piola-Kirchhoff stress.
/// This norm differs from the norm of the Cauchy stress by a fraction of the order of the strains, far below the
/// margin of 10 %.
const CHECK_SHARE: f64 = 0.9;

/// Forces of all tetrahedra, and marks for the tetrahedra near failure.
#[derive(Debug, Clone, Default)]
pub struct Deformation {
    /// Forces on the vertices of each tetrahedron [N].
    pub forces: Vec<[DVec3; 4]>,
    /// For each tetrahedron, true if its stress is near the least strength of its body. Empty if the world has no tied
    /// faces at the start, because only tied faces need these marks.
    pub strained: Vec<bool>,
    sums: Vec<ChunkSum>,
}

#[derive(Debug, Clone, Copy, Default)]
struct ChunkSum {
    viscous: f64,
    inverted: Option<usize>,
}

/// Tetrahedra, nodes, moduli and joint forces from which [`Deformation::compute`] computes nodal forces.
#[derive(Clone, Copy)]
pub struct Bodies<'a> {
    /// Tetrahedra.
    pub tets: &'a Tets,
    /// Nodes.
    pub nodes: &'a Nodes,
    /// Moduli of each body.
    pub moduli: &'a [Moduli],
    /// Least stress that can break each body [Pa].
    pub strength: &'a [f64],
    /// For each interface, the forces of its joint on the corners of side 0 [N]; the forces on side 1 are opposite.
    pub joints: &'a [[DVec3; 3]],
}

impl Deformation {
    /// Creates the workspace for `count` tetrahedra. `tied` is true if some faces are tied at the start.
    pub fn new(count: usize, tied: bool) -> Self {
        Self {
            forces: vec![[DVec3::ZERO; 4]; count],
            strained: vec![false; if tied { count } else { 0 }],
            sums: vec![ChunkSum::default(); count.div_ceil(CHUNK)],
        }
    }

    /// Computes the forces at the current positions and velocities. Returns the viscous power [W].
    ///
    /// # Errors
    /// If a tetrahedron is inverted. The error is the number of the first inverted tetrahedron.
    pub fn compute(&mut self, bodies: Bodies) -> Result<f64, usize> {
        let Self { forces, strained, sums } = self;
        let compute = |chunk: usize, forces: &mut [[DVec3; 4]], strained: Option<&mut [bool]>, sum: &mut ChunkSum| {
            *sum = lanes::dispatch(Chunk { first: chunk * CHUNK, forces, strained, bodies });
        };
        let chunks = forces.par_chunks_mut(CHUNK).zip(sums.par_iter_mut()).enumerate();
        if strained.is_empty() {
            chunks.for_each(|(chunk, (forces, sum))| compute(chunk, forces, None, sum));
        } else {
            let chunks = chunks.zip(strained.par_chunks_mut(CHUNK));
            chunks.for_each(|((chunk, (forces, sum)), strained)| compute(chunk, forces, Some(strained), sum));
        }
        match self.sums.iter().find_map(|sum| sum.inverted) {
            Some(tet) => Err(tet),
            None => Ok(self.sums.iter().map(|sum| sum.viscous).sum()),
        }
    }
}

/// A chunk of the tetrahedra.
struct Chunk<'a> {
    first: usize,
    forces: &'a mut [[DVec3; 4]],
    strained: Option<&'a mut [bool]>,
    bodies: Bodies<'a>,
}

impl WithLanes for Chunk<'_> {
    type Output = ChunkSum;

    #[inline(always)]
    fn run<L: Lanes>(mut self) -> ChunkSum {
        let mut sum = ChunkSum::default();
        let count = self.forces.len();
        for start in (0..count).step_by(LANES) {
            // Lanes beyond the end of the chunk repeat its last tetrahedron; their results are not used.
            let number = |lane: usize| self.first + (start + lane).min(count - 1);
            let numbers = [number(0), number(1), number(2), number(3)];
            let deformed = self.deform::<L>(numbers);
            let [a, b, c] = deformed.forces;
            let [a, b, c] = [a.to_array(), b.to_array(), c.to_array()];
            let (ratio, power) = (deformed.ratio.to_array(), deformed.viscous_power.to_array());
            for lane in 0..LANES.min(count - start) {
                let out = &mut self.forces[start + lane];
                *out = [-(a[lane] + b[lane] + c[lane]), a[lane], b[lane], c[lane]];
                self.bodies.add_joints(numbers[lane], out);
                sum.viscous += power[lane];
                // A tetrahedron with the volume ratio NaN also counts as inverted.
                if !ratio[lane].is_finite() || ratio[lane] <= 0.0 {
                    sum.inverted = sum.inverted.or(Some(numbers[lane]));
                }
            }
            self.mark_strained(start, count, numbers, deformed.stress_squared);
        }
        sum
    }
}

impl Chunk<'_> {
    #[inline(always)]
    fn deform<L: Lanes>(&self, t: [usize; LANES]) -> Deformed<L> {
        let Bodies { tets, nodes, moduli, .. } = self.bodies;
        let shape = LaneShape::from_fn(|lane| &tets.shape[t[lane]]);
        let moduli = LaneModuli::from_fn(|lane| &moduli[usize::from(tets.body[t[lane]])]);
        let vertices = [tets.nodes[t[0]], tets.nodes[t[1]], tets.nodes[t[2]], tets.nodes[t[3]]];
        element::forces(&shape, &moduli, &gather(&nodes.position, &vertices), &gather(&nodes.velocity, &vertices))
    }

    /// Marks the tetrahedra whose stress is near the least strength of their body.
    #[inline(always)]
    fn mark_strained<L: Lanes>(&mut self, start: usize, count: usize, t: [usize; LANES], stress_squared: L) {
        let Some(strained) = &mut self.strained else { return };
        let squared = stress_squared.to_array();
        for lane in 0..LANES.min(count - start) {
            let limit = CHECK_SHARE * self.bodies.strength[usize::from(self.bodies.tets.body[t[lane]])];
            strained[start + lane] = squared[lane] >= limit * limit;
        }
    }
}

/// Gathers nodal values at the four vertices of the tetrahedra in the SIMD lanes.
#[inline(always)]
fn gather<L: Lanes>(values: &[DVec3], nodes: &[[u32; 4]; LANES]) -> [Vectors<L>; 4] {
    [
        Vectors::from_fn(|lane| values[nodes[lane][0] as usize]),
        Vectors::from_fn(|lane| values[nodes[lane][1] as usize]),
        Vectors::from_fn(|lane| values[nodes[lane][2] as usize]),
        Vectors::from_fn(|lane| values[nodes[lane][3] as usize]),
    ]
}

impl Bodies<'_> {
    /// Adds the forces of the joints at the faces of a tetrahedron.
    #[inline(always)]
    fn add_joints(&self, tet: usize, out: &mut [DVec3; 4]) {
        if !self.tets.jointed[tet] {
            return;
        }
        for link in self.tets.faces[tet] {
            let Some((number, side)) = link.interface() else { continue };
            let sign = if side == 0 { 1.0 } else { -1.0 };
            for (k, force) in link.nodes.into_iter().zip(self.joints[number]) {
                out[usize::from(k)] += force * sign;
            }
        }
    }
}
