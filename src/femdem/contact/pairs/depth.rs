//! How deep tetrahedra are in each other.

use super::super::super::assembly::Tets;
use super::Contacts;

impl Contacts {
    /// The pair that is deepest in each other at the last step, and its overlap, but for what it was born with: energy of
    /// the overlap over penalty over the volume of the smaller tetrahedron [-]. A tetrahedron on one of its own size has 1/2, one swallowed whole up to 5/4; contact
    /// at the strength of concrete has some 1e-3.
    pub fn deepest(&self, tets: &Tets) -> Option<([u32; 2], f64)> {
        let volume = |tet: u32| tets.shape[tet as usize].volume;
        let share = |pair: &super::Pair| {
            let spring = pair.spring.as_ref().map_or(0.0, |spring| spring.stored(&pair.law));
            // The difference of the roots of the overlap and of what it was born with; their sum times it is asked for.
            let apart = ((pair.stored - spring).max(0.0) / pair.penalty).sqrt();
            let sum = apart + 2.0 * pair.born.unwrap_or(0.0).sqrt();
            apart * sum / pair.tets.map(volume).into_iter().fold(f64::MAX, f64::min)
        };
        let pressed = self.pairs.iter().filter(|pair| pair.forces.is_some());
        pressed.map(|pair| (pair.tets, share(pair))).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Whether a tetrahedron was pressed by another one at the last step.
    pub fn presses(&self, tet: u32) -> bool {
        self.pairs.iter().any(|pair| pair.forces.is_some() && pair.tets.contains(&tet))
    }
}
