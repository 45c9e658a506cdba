//! What contacts remember from step to step, taken down and put back.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::super::super::assembly::Tets;
use super::super::super::setup::Setup;
use super::super::friction::TangentialSpring;
use super::{Contacts, Pair};

/// Memory of the contacts of a world. Who can touch whom follows from the faces that have broken.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ContactSnapshot {
    /// Tetrahedra of each pair, the pairs in rising order.
    pub tets: Vec<[u32; 2]>,
    /// Overlap of each pair that does not count [m3]; not a number before the pair was first looked at.
    pub born: Vec<f64>,
    /// Numbers of the pairs whose friction has a spring, in rising order.
    pub sprung: Vec<u32>,
    /// Extension and normal of each spring [m, -].
    pub springs: Vec<[f64; 6]>,
    /// Tetrahedra whose joint has broken since the last search.
    pub opened: Vec<[u32; 2]>,
    /// Energy that it leaves to them [J].
    pub left: Vec<f64>,
    /// Everything else.
    pub scalars: ContactScalars,
}

/// Numbers of the contacts of a world as a whole; see [`Contacts`].
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
    /// What the contacts remember after a step.
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

    /// Puts back what contacts remembered. These are new, with the groups of now; at the tetrahedra `open`, faces have
    /// broken.
    ///
    /// # Errors
    /// If the memory cannot be that of this world: what is wrong.
    pub fn restore(
        &mut self,
        snapshot: ContactSnapshot,
        open: impl Iterator<Item = u32>,
        setup: &Setup,
        tets: &Tets,
    ) -> Result<(), &'static str> {
        let ContactSnapshot { tets: of_pairs, born, sprung, springs, opened, left, scalars } = snapshot;
        let known = |of: &[u32; 2]| of[0] < of[1] && (of[1] as usize) < setup.tets.len();
        if born.len() != of_pairs.len() || !of_pairs.iter().all(known) || !of_pairs.is_sorted_by(|a, b| a < b) {
            return Err("its pairs in contact are not those of the mesh");
        }
        if springs.len() != sprung.len() || sprung.iter().any(|number| *number as usize >= of_pairs.len()) {
            return Err("its springs of friction belong to no pair");
        }
        if left.len() != opened.len() || !opened.iter().all(known) {
            return Err("its broken faces are not those of the mesh");
        }
        let pair = |(of, born): (&[u32; 2], &f64)| Pair {
            born: (!born.is_nan()).then_some(*born),
            ..Pair::new(*of, setup, tets)
        };
        self.pairs = of_pairs.iter().zip(&born).map(pair).collect();
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
