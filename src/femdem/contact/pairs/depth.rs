//! Overlap depth of tetrahedra in contact.

use super::Contacts;
use crate::femdem::assembly::tets::Tets;

impl Contacts {
    /// Returns the pair with the deepest overlap in the last time step, and the relative depth of this overlap [-].
    /// The relative depth is (I - I_b) / V, with the integrals I and I_b of [`super`] and the volume V of the smaller
    /// tetrahedron. It is 1/2 for identical tetrahedra and up to 5/4 for a tetrahedron inside the other one. It is of
    /// the order of 1e-3 or less if the contact stress equals the strength of concrete.
    pub fn deepest_overlap(&self, tets: &Tets) -> Option<([u32; 2], f64)> {
        let volume = |tet: u32| tets.shape[tet as usize].volume;
        let share = |pair: &super::Pair| {
            let spring = pair.spring.as_ref().map_or(0.0, |spring| spring.stored(&pair.law));
            // I - I_b = (sqrt I - sqrt I_b) (sqrt I + sqrt I_b).
            let difference = ((pair.stored - spring).max(0.0) / pair.penalty).sqrt();
            let sum = difference + 2.0 * pair.initial_overlap.unwrap_or(0.0).sqrt();
            difference * sum / pair.tets.map(volume).into_iter().fold(f64::MAX, f64::min)
        };
        let touching = self.pairs.iter().filter(|pair| pair.forces.is_some());
        touching.map(|pair| (pair.tets, share(pair))).max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// Returns true if a tetrahedron was in contact in the last time step.
    pub fn is_in_contact(&self, tet: u32) -> bool {
        self.pairs.iter().any(|pair| pair.forces.is_some() && pair.tets.contains(&tet))
    }
}
