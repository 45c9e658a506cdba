//! An impact computed again: both bodies collide from the poses and velocities that they had just before.

use glam::DVec3;

use super::base;
use super::blow::{Blow, Mover};
use super::fracture_case::{Part, Scene};
use super::unit_mesh::{UnitMesh, together};
use crate::femdem::mesh::Mesh;

/// Gap between the bodies at the start over the height of the unit [-].
const GAP: f64 = 1e-4;

/// Largest width of the block of the bed over the height of the unit [-], where legs reach below the plane of contact.
const WIDEST: f64 = 1.5;

/// Least one [-]: where there is less room between them, the block lies below them all.
const NARROWEST: f64 = 0.2;

/// Nodes so near the plane of contact belong to feet, over the height of the unit [-].
const FOOT: f64 = 0.25;

/// The block of a plane bed reaches so much further than the feet [-].
const MARGIN: f64 = 1.1;

/// Sharp edges of the unit reach so far below the place where its rounded edges touched, over its height [-].
const ROUNDED_OFF: f64 = 0.05;

/// Cells of the bed over the mean edge of the unit's mesh [-]; each is cut into 24 tetrahedra.
const BASE_CELL: f64 = 2.0;

/// Nodes about the place of contact within this distance over the height of the unit [-] say how far two units are apart.
const ABOUT: f64 = 0.12;

/// Longest wait for the bodies to touch over the time that is computed after it [-].
const LONGEST_WAIT: f64 = 3.0;

/// Name of the other unit.
pub const PARTNER: &str = "partner";

/// Scene of the collision, at the place of contact.
pub fn scene(blow: &Blow) -> Scene {
    let height = blow.model.shape.height() * blow.froude.length();
    let normal = DVec3::from_array(blow.impact.event.normal).normalize_or(DVec3::Z);
    let (mover, partner) = blow.movers();
    let mesh = blow.handover.mesh.posed(&mover.pose, UnitMesh::NAME);
    let unit = part(blow, UnitMesh::NAME, &mover);
    let (mesh, parts, gap) = match partner {
        Some(partner) => {
            let other = blow.handover.mesh.posed(&partner.pose, PARTNER);
            let near = |mesh: &Mesh| -> Vec<f64> {
                let within = mesh.nodes.iter().filter(|node| node.length() < ABOUT * height);
                within.map(|node| node.dot(normal)).collect()
            };
            let lowest = near(&mesh).into_iter().fold(f64::INFINITY, f64::min);
            let highest = near(&other).into_iter().fold(f64::NEG_INFINITY, f64::max);
            // Without nodes about the place of contact, the bodies stay where they are.
            let overlap = if (highest - lowest).is_finite() { highest - lowest } else { 0.0 };
            let most = ROUNDED_OFF * height;
            let back = (overlap + GAP * height).clamp(-most, most);
            let parts = vec![shifted_part(unit, normal * back), part(blow, PARTNER, &partner)];
            (together(shifted(mesh, normal * back), other), parts, most)
        }
        None => {
            let (block, gap) = bed(blow, &mesh, normal, height);
            let base = Part::held(base::NAME, base::BOTTOM);
            (together(mesh, block), vec![unit, base], gap)
        }
    };
    let approach = blow.impact.event.approach_normal.max(0.0) * blow.froude.velocity();
    // A body that hardly approaches is not waited for.
    let before = if approach > 0.0 { (gap / approach).min(LONGEST_WAIT * blow.time_after()) } else { 0.0 };
    Scene { mesh, parts, loads: Vec::new(), duration: before + blow.time_after() }
}

/// A block of the bed just below the unit, and how far below [m]: under all feet where the bed is plane, else, where legs
/// reach below the plane of contact, about the place of contact and as wide as they leave room.
fn bed(blow: &Blow, mesh: &Mesh, normal: DVec3, height: f64) -> (Mesh, f64) {
    let level = |node: &DVec3| node.dot(normal);
    let flat = |place: DVec3| place - normal * place.dot(normal);
    let below = |node: &DVec3| level(node) < -ROUNDED_OFF * height;
    let room = mesh.nodes.iter().filter(|node| below(node)).map(|node| flat(*node).length());
    // Half the diagonal of the block lies within the room.
    let room = 0.9 * std::f64::consts::SQRT_2 * room.fold(f64::INFINITY, f64::min);
    let (middle, width) = if (NARROWEST * height..f64::INFINITY).contains(&room) {
        (DVec3::ZERO, room.min(WIDEST * height))
    } else {
        let (mover, _) = blow.movers();
        let middle = flat(mover.pose.position);
        let feet = mesh.nodes.iter().filter(|node| level(node) < FOOT * height);
        let reach = feet.map(|node| flat(*node - middle).length()).fold(NARROWEST * height, f64::max);
        (middle, 2.0 * MARGIN * reach)
    };
    let half_diagonal = width * std::f64::consts::FRAC_1_SQRT_2;
    let over = mesh.nodes.iter().filter(|node| flat(**node - middle).length() <= half_diagonal);
    let lowest = over.map(level).fold(f64::INFINITY, f64::min);
    let top = if lowest.is_finite() { lowest } else { 0.0 } - GAP * height;
    let cell = BASE_CELL * blow.handover.mesh.edge() * blow.froude.length();
    (base::under(middle, normal, top, width, cell), GAP * height)
}

/// A unit that moves as it was recorded.
pub fn part(blow: &Blow, name: &'static str, mover: &Mover) -> Part {
    Part {
        name,
        velocity: mover.velocity,
        angular_velocity: blow.angular_velocity(mover),
        pivot: blow.handover.mesh.centre(&mover.pose),
        held: None,
    }
}

fn shifted(mut mesh: Mesh, shift: DVec3) -> Mesh {
    mesh.nodes.iter_mut().for_each(|node| *node += shift);
    mesh
}

fn shifted_part(part: Part, shift: DVec3) -> Part {
    Part { pivot: part.pivot + shift, ..part }
}
