//! The pass over the tetrahedra: their forces with those of the joints at their faces.

use glam::DVec3;
use rayon::prelude::*;

use super::assembly::{Nodes, Tets};
use super::element::{self, Deformed, LaneModuli, LaneShape, Moduli};
use super::lanes::{self, LANES, Lanes, Vectors, WithLanes};
use super::world::PIECE;

/// Share of the least strength above which the stress of a tetrahedron is looked at [-]: the first Piola-Kirchhoff stress
/// is that of Cauchy but for strains, which are far smaller than this leaves room for.
const NEAR: f64 = 0.9;

/// What the tetrahedra have to say besides their forces.
#[derive(Debug, Clone, Default)]
pub struct Deformation {
    /// Forces on the vertices [N].
    pub forces: Vec<[DVec3; 4]>,
    /// Whether the stress of each is near the least strength of its body; empty where nothing is tied.
    pub strained: Vec<bool>,
    sums: Vec<PieceSum>,
}

#[derive(Debug, Clone, Copy, Default)]
struct PieceSum {
    viscous: f64,
    inverted: Option<usize>,
}

/// What a pass reads.
#[derive(Clone, Copy)]
pub struct Bodies<'a> {
    /// Tetrahedra.
    pub tets: &'a Tets,
    /// Nodes.
    pub nodes: &'a Nodes,
    /// Of each body.
    pub moduli: &'a [Moduli],
    /// Least strength of each body [Pa].
    pub strength: &'a [f64],
    /// Forces of each interface on the corners of its side 0 [N].
    pub joints: &'a [[DVec3; 3]],
}

impl Deformation {
    /// Workspace for so many tetrahedra, with or without tied faces.
    pub fn new(count: usize, ties: bool) -> Self {
        Self {
            forces: vec![[DVec3::ZERO; 4]; count],
            strained: vec![false; if ties { count } else { 0 }],
            sums: vec![PieceSum::default(); count.div_ceil(PIECE)],
        }
    }

    /// Forces at the present places and velocities; returns the power of viscosity [W].
    ///
    /// # Errors
    /// The number of a tetrahedron that is turned inside out.
    pub fn compute(&mut self, bodies: Bodies) -> Result<f64, usize> {
        let Self { forces, strained, sums } = self;
        let piece_of = |piece: usize, forces: &mut [[DVec3; 4]], strained: Option<&mut [bool]>, sum: &mut PieceSum| {
            *sum = lanes::dispatch(Piece { first: piece * PIECE, forces, strained, bodies });
        };
        let pieces = forces.par_chunks_mut(PIECE).zip(sums.par_iter_mut()).enumerate();
        if strained.is_empty() {
            pieces.for_each(|(piece, (forces, sum))| piece_of(piece, forces, None, sum));
        } else {
            let pieces = pieces.zip(strained.par_chunks_mut(PIECE));
            pieces.for_each(|((piece, (forces, sum)), strained)| piece_of(piece, forces, Some(strained), sum));
        }
        match self.sums.iter().find_map(|sum| sum.inverted) {
            Some(tet) => Err(tet),
            None => Ok(self.sums.iter().map(|sum| sum.viscous).sum()),
        }
    }
}

/// A piece of the tetrahedra.
struct Piece<'a> {
    first: usize,
    forces: &'a mut [[DVec3; 4]],
    strained: Option<&'a mut [bool]>,
    bodies: Bodies<'a>,
}

impl WithLanes for Piece<'_> {
    type Output = PieceSum;

    #[inline(always)]
    fn run<L: Lanes>(mut self) -> PieceSum {
        let mut sum = PieceSum::default();
        let count = self.forces.len();
        for start in (0..count).step_by(LANES) {
            // The last one fills the lanes.
            let number = |lane: usize| self.first + (start + lane).min(count - 1);
            let of = [number(0), number(1), number(2), number(3)];
            let deformed = self.deform::<L>(of);
            let [a, b, c] = deformed.forces;
            let [a, b, c] = [a.to_array(), b.to_array(), c.to_array()];
            let (ratio, power) = (deformed.ratio.to_array(), deformed.viscous_power.to_array());
            for lane in 0..LANES.min(count - start) {
                let out = &mut self.forces[start + lane];
                *out = [-(a[lane] + b[lane] + c[lane]), a[lane], b[lane], c[lane]];
                self.bodies.add_joints(of[lane], out);
                sum.viscous += power[lane];
                // Not a number counts, too.
                if !ratio[lane].is_finite() || ratio[lane] <= 0.0 {
                    sum.inverted = sum.inverted.or(Some(of[lane]));
                }
            }
            self.mark(start, count, of, deformed.stress_squared);
        }
        sum
    }
}

impl Piece<'_> {
    #[inline(always)]
    fn deform<L: Lanes>(&self, of: [usize; LANES]) -> Deformed<L> {
        let Bodies { tets, nodes, moduli, .. } = self.bodies;
        let shape = LaneShape::from_fn(|lane| &tets.shape[of[lane]]);
        let moduli = LaneModuli::from_fn(|lane| &moduli[usize::from(tets.body[of[lane]])]);
        let at = [tets.nodes[of[0]], tets.nodes[of[1]], tets.nodes[of[2]], tets.nodes[of[3]]];
        element::forces(&shape, &moduli, &corners(&nodes.place, &at), &corners(&nodes.velocity, &at))
    }

    /// Mark the tetrahedra whose stress is near the strength.
    #[inline(always)]
    fn mark<L: Lanes>(&mut self, start: usize, count: usize, of: [usize; LANES], stress_squared: L) {
        let Some(strained) = &mut self.strained else { return };
        let squared = stress_squared.to_array();
        for lane in 0..LANES.min(count - start) {
            let near = NEAR * self.bodies.strength[usize::from(self.bodies.tets.body[of[lane]])];
            strained[start + lane] = squared[lane] >= near * near;
        }
    }
}

/// Values at the four vertices of the tetrahedra in the lanes.
#[inline(always)]
fn corners<L: Lanes>(of: &[DVec3], at: &[[u32; 4]; LANES]) -> [Vectors<L>; 4] {
    [
        Vectors::from_fn(|lane| of[at[lane][0] as usize]),
        Vectors::from_fn(|lane| of[at[lane][1] as usize]),
        Vectors::from_fn(|lane| of[at[lane][2] as usize]),
        Vectors::from_fn(|lane| of[at[lane][3] as usize]),
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
