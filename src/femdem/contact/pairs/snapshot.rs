//! Saves and restores the history of the contacts.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::super::super::assembly::Tets;
use super::super::super::setup::Setup;
use super::super::friction::TangentialSpring;
use super::{Contacts, Pair};

/// History of the contacts of a world. Which tetrahedra can touch follows from the broken faces.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ContactSnapshot {
    /// Tetrahedra of each pair, the pairs in ascending order.
    pub tets: Vec<[u32; 2]>,
    /// Initial overlap of each pair that does not count [m3]; NaN before the first evaluation of the pair.
    pub born: Vec<f64>,
    /// Numbers of the pairs with a friction spring, in ascending order.
    pub sprung: Vec<u32>,
    /// Extension and normal of each spring [m, -].
    pub springs: Vec<[f64; 6]>,
    /// Tetrahedra whose joint has broken since the last search.
    pub opened: Vec<[u32; 2]>,
    /// Energy that the joint leaves to them [J].
    pub left: Vec<f64>,
    /// Everything else.
    pub scalars: ContactScalars,
}

/// Scalars of the contacts of a world; see [`Contacts`].
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct ContactScalars {
    travelled: f64,
    skin: f64,
    outdated: bool,
    stored: f64,
    friction: f64,
    taken_over: f64,
    touching: usize,
}

impl Contacts {
    /// Returns the history of the contacts after a time step.
    pub fn snapshot(&self) -> ContactSnapshot {
        let sprung = self.pairs.iter().zip(0u32..).filter_map(|(pair, number)| Some((number, pair.spring?)));
        let (sprung, springs) = sprung
            .map(|(number, TangentialSpring { extension: e, normal: n })| (number, [e.x, e.y, e.z, n.x, n.y, n.z]))
            .unzip();
        let (opened, left) = self.opened.iter().copied().unzip();
        ContactSnapshot {
            tets: self.pairs.iter().map(|pair| pair.tets).collect(),
            born: self.pairs.iter().map(|pair| pair.born.unwrap_or(f64::NAN)).collect(),
            sprung,
            springs,
            opened,
            left,
            scalars: ContactScalars {
                travelled: self.travelled,
                skin: self.skin,
                outdated: self.outdated,
                stored: self.stored,
                friction: self.friction,
                taken_over: self.taken_over,
                touching: self.touching,
            },
        }
    }

    /// Restores the history into new contacts whose groups are up to date. The tetrahedra `open` have broken faces.
    ///
    /// # Errors
    /// Says why the snapshot does not belong to this world.
    pub fn restore(
        &mut self,
        snapshot: ContactSnapshot,
        open: impl Iterator<Item = u32>,
        setup: &Setup,
        tets: &Tets,
    ) -> Result<(), &'static str> {
        let ContactSnapshot { tets: pair_tets, born, sprung, springs, opened, left, scalars } = snapshot;
        let is_valid = |pair: &[u32; 2]| pair[0] < pair[1] && (pair[1] as usize) < setup.tets.len();
        if born.len() != pair_tets.len() || !pair_tets.iter().all(is_valid) || !pair_tets.is_sorted_by(|a, b| a < b) {
            return Err("its contact pairs do not match the mesh");
        }
        if springs.len() != sprung.len() || sprung.iter().any(|number| *number as usize >= pair_tets.len()) {
            return Err("its friction springs do not match its contact pairs");
        }
        if left.len() != opened.len() || !opened.iter().all(is_valid) {
            return Err("its broken faces do not match the mesh");
        }
        let pair = |(tets_of_pair, born): (&[u32; 2], &f64)| Pair {
            born: (!born.is_nan()).then_some(*born),
            ..Pair::new(*tets_of_pair, setup, tets)
        };
        self.pairs = pair_tets.iter().zip(&born).map(pair).collect();
        for (number, [x, y, z, nx, ny, nz]) in sprung.into_iter().zip(springs) {
            let (extension, normal) = (DVec3::new(x, y, z), DVec3::new(nx, ny, nz));
            self.pairs[number as usize].spring = Some(TangentialSpring { extension, normal });
        }
        self.outer.extend(open);
        self.outer.sort_unstable();
        self.outer.dedup();
        self.opened = opened.into_iter().zip(left).collect();
        let ContactScalars { travelled, skin, outdated, stored, friction, taken_over, touching } = scalars;
        (self.travelled, self.skin, self.outdated) = (travelled, skin, outdated);
        (self.stored, self.friction, self.taken_over, self.touching) = (stored, friction, taken_over, touching);
        Ok(())
    }
}
