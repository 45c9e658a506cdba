//! Positions at which cracks began, in order of time.

use glam::DVec3;

use crate::femdem::world::{Failure, World};

/// Distance from the nearest failed face over the edge length [-] beyond which a new crack begins. A growing crack
/// advances by one element at a time.
const APART: f64 = 4.0;

/// Beginning of a crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Initiation {
    /// The first face that failed there.
    pub first: Failure,
    /// Index of the body.
    pub body: usize,
    /// Area of all failed faces that belong to this crack at the end [m2].
    pub area: f64,
}

/// Finds the beginnings of the cracks. Faces that fail one after another within four edge lengths belong to one crack.
pub fn initiations(world: &World) -> Vec<Initiation> {
    let setup = world.setup();
    let mut found: Vec<(Initiation, Vec<DVec3>)> = Vec::new();
    for failure in &world.failures {
        // Edge length of an equilateral triangle of the same area.
        let reach = APART * (failure.area * 4.0 / 3f64.sqrt()).sqrt();
        let distance = |(_, places): &(Initiation, Vec<DVec3>)| {
            places.iter().map(|place| place.distance(failure.place)).fold(f64::MAX, f64::min)
        };
        let nearest = found.iter().map(distance).enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        match nearest.filter(|(_, distance)| *distance < reach) {
            Some((index, _)) => {
                found[index].0.area += failure.area;
                found[index].1.push(failure.place);
            }
            None => {
                let tet = setup.interfaces[failure.interface as usize].tets[0] as usize;
                let body = setup.bodies.partition_point(|body| body.tets.end <= tet);
                found.push((Initiation { first: *failure, body, area: failure.area }, vec![failure.place]));
            }
        }
    }
    found.into_iter().map(|(initiation, _)| initiation).collect()
}
