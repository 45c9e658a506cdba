//! Positions at which cracks began, in order of time.

use glam::DVec3;

use crate::femdem::world::{Failure, World};

/// A failed face that is further than this from all earlier failed faces begins a new crack: distance divided by the
/// edge length of the face [-]. A growing crack advances by one element at a time, so its next face is within this
/// distance.
const NEW_CRACK_DISTANCE: f64 = 4.0;

/// Beginning of a crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Initiation {
    /// The face of this crack that failed first.
    pub first: Failure,
    /// Index of the body, from 0.
    pub body: usize,
    /// Area of all failed faces that belong to this crack at the end [m2].
    pub area: f64,
}

/// Returns the beginnings of the cracks, in order of time. A failing face belongs to the crack of the nearest earlier
/// failed face, if its distance to this face is less than four edge lengths.
pub fn initiations(world: &World) -> Vec<Initiation> {
    let setup = world.setup();
    let mut found: Vec<(Initiation, Vec<DVec3>)> = Vec::new();
    for failure in &world.failures {
        // The edge length of the face is that of an equilateral triangle of the same area.
        let reach = NEW_CRACK_DISTANCE * (failure.area * 4.0 / 3f64.sqrt()).sqrt();
        let distance = |(_, places): &(Initiation, Vec<DVec3>)| {
            places.iter().map(|place| place.distance(failure.centroid)).fold(f64::MAX, f64::min)
        };
        let nearest = found.iter().map(distance).enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
        match nearest.filter(|(_, distance)| *distance < reach) {
            Some((index, _)) => {
                found[index].0.area += failure.area;
                found[index].1.push(failure.centroid);
            }
            None => {
                let tet = setup.interfaces[failure.interface as usize].tets[0] as usize;
                let body = setup.bodies.partition_point(|body| body.tets.end <= tet);
                found.push((Initiation { first: *failure, body, area: failure.area }, vec![failure.centroid]));
            }
        }
    }
    found.into_iter().map(|(initiation, _)| initiation).collect()
}
