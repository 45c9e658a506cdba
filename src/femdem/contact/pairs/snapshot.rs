//! Saves and restores the history of the contacts.

use glam::DVec3;

use super::super::friction::TangentialSpring;
use super::{ContactScalars, Contacts, Pair};
use crate::femdem::assembly::tets::Tets;
use crate::femdem::setup::Setup;

/// History of the contacts of a world. It does not list the tetrahedra that can touch, because the setup and the broken
/// faces determine them.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ContactSnapshot {
    /// Tetrahedra of each pair; the pairs are in ascending order.
    pub tets: Vec<[u32; 2]>,
    /// Initial overlap of each pair that does not count [m3]; NaN before the first evaluation of the pair.
    pub initial_overlap: Vec<f64>,
    /// Numbers of the pairs with a friction spring, in ascending order.
    pub pairs_with_spring: Vec<u32>,
    /// Extension [m] and normal [-] of each friction spring.
    pub springs: Vec<[f64; 6]>,
    /// Pairs of tetrahedra whose joint has broken since the last search.
    pub opened: Vec<[u32; 2]>,
    /// Elastic energy [J] that each pair in `opened` takes over from its joint.
    pub inherited_energy: Vec<f64>,
}

impl Contacts {
    /// Returns the history of the contacts after a time step.
    pub fn snapshot(&self) -> ContactSnapshot {
        let sprung = self.pairs.iter().zip(0u32..).filter_map(|(pair, number)| Some((number, pair.spring?)));
        let (pairs_with_spring, springs) = sprung
            .map(|(number, TangentialSpring { extension: e, normal: n })| (number, [e.x, e.y, e.z, n.x, n.y, n.z]))
            .unzip();
        let (opened, inherited_energy) = self.opened.iter().copied().unzip();
        ContactSnapshot {
            tets: self.pairs.iter().map(|pair| pair.tets).collect(),
            initial_overlap: self.pairs.iter().map(|pair| pair.initial_overlap.unwrap_or(f64::NAN)).collect(),
            pairs_with_spring,
            springs,
            opened,
            inherited_energy,
        }
    }

    /// Restores the history into new contacts. Their groups of node copies must already match the broken faces. `open`
    /// are the tetrahedra with broken faces.
    ///
    /// # Errors
    /// If the snapshot does not belong to this world. The text gives the reason.
    pub fn restore(
        &mut self,
        (snapshot, scalars): (ContactSnapshot, ContactScalars),
        open: impl Iterator<Item = u32>,
        setup: &Setup,
        tets: &Tets,
    ) -> Result<(), &'static str> {
        let ContactSnapshot { tets: pair_tets, initial_overlap: initial, inherited_energy: inherited, .. } = snapshot;
        let ContactSnapshot { pairs_with_spring: sprung, springs, opened, .. } = snapshot;
        let is_valid = |pair: &[u32; 2]| pair[0] < pair[1] && (pair[1] as usize) < setup.tets.len();
        if initial.len() != pair_tets.len() || !pair_tets.iter().all(is_valid) || !pair_tets.is_sorted_by(|a, b| a < b)
        {
            return Err("its contact pairs do not match the mesh");
        }
        if springs.len() != sprung.len() || sprung.iter().any(|number| *number as usize >= pair_tets.len()) {
            return Err("its friction springs do not match its contact pairs");
        }
        if inherited.len() != opened.len() || !opened.iter().all(is_valid) {
            return Err("its broken faces do not match the mesh");
        }
        let pair = |(tets_of_pair, initial): (&[u32; 2], &f64)| Pair {
            initial_overlap: (!initial.is_nan()).then_some(*initial),
            ..Pair::new(*tets_of_pair, setup, tets)
        };
        self.pairs = pair_tets.iter().zip(&initial).map(pair).collect();
        for (number, [x, y, z, nx, ny, nz]) in sprung.into_iter().zip(springs) {
            let (extension, normal) = (DVec3::new(x, y, z), DVec3::new(nx, ny, nz));
            self.pairs[number as usize].spring = Some(TangentialSpring { extension, normal });
        }
        self.outer.extend(open);
        self.outer.sort_unstable();
        self.outer.dedup();
        self.opened = opened.into_iter().zip(inherited).collect();
        self.scalars = scalars;
        Ok(())
    }
}
