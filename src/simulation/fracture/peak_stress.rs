//! Value, position and time of the largest tension in each body.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::femdem::element::{self, Moduli};
use crate::femdem::principal_stresses::principal_stresses;
use crate::femdem::world::World;

/// Largest first principal stress of a body, among the times at which `energy.csv` has a row.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PeakStress {
    /// First principal stress sigma_1 of a tetrahedron, tension positive [Pa].
    pub sigma_1_pa: f64,
    /// Time of this stress [s].
    pub t_s: f64,
    /// Centroid of the tetrahedron in the undeformed body [m].
    pub place_m: [f64; 3],
}

/// Returns, for each body, the largest first principal stress at the current time (elastic Cauchy stress) [Pa], and the
/// index of its tetrahedron.
pub fn largest_stresses(world: &World) -> Vec<(f64, usize)> {
    let largest = |body: &crate::femdem::setup::Body| {
        let moduli = Moduli::from(&body.elastic);
        let sigma_1 = |tet: usize| {
            let places = world.tets.nodes[tet].map(|node| world.nodes.position[node as usize]);
            (principal_stresses(element::stress(&world.tets.shape[tet], &moduli, &places))[0], tet)
        };
        // Of equal stresses, take the first tetrahedron, so that the result does not depend on the number of threads.
        let larger = |a: (f64, usize), b: (f64, usize)| {
            if b.0 > a.0 || (b.0 == a.0 && b.1 < a.1) { b } else { a }
        };
        body.tets.clone().into_par_iter().map(sigma_1).reduce(|| (f64::NEG_INFINITY, usize::MAX), larger)
    };
    world.setup().bodies.iter().map(largest).collect()
}

/// Updates the largest stress of each body since the start, `peaks`, with the largest stresses `now` at `time` [s].
pub fn update_peaks(peaks: &mut Vec<PeakStress>, world: &World, now: &[(f64, usize)], time: f64) {
    let setup = world.setup();
    let peak = |(sigma_1, tet): &(f64, usize)| {
        let places = setup.tets[*tet].map(|node| setup.nodes[node as usize]);
        let place = places.iter().sum::<glam::DVec3>() * 0.25;
        PeakStress { sigma_1_pa: *sigma_1, t_s: time, place_m: place.to_array() }
    };
    if peaks.is_empty() {
        peaks.extend(now.iter().map(peak));
    }
    for (known, now) in peaks.iter_mut().zip(now).filter(|(known, now)| now.0 > known.sigma_1_pa) {
        *known = peak(now);
    }
}
