//! Re-run of an impact by collision: both bodies collide from their poses and velocities just before the impact.

use glam::DVec3;

use super::base::{self, ABOUT, GAP, ROUNDED_OFF, Seat};
use super::blow::{Blow, Mover};
use super::fracture_case::{Part, Scene};
use crate::femdem::mesh::Mesh;
use crate::femdem::mesh::unit_mesh::{UnitMesh, together};

/// Cell length of the bed over the mean edge of the unit's mesh [-]; each cell is cut into 24 tetrahedra.
const BASE_CELL: f64 = 2.0;

/// Largest time before first contact over the time that is simulated after it [-].
const LONGEST_WAIT: f64 = 3.0;

/// Name of the other unit.
pub const PARTNER: &str = "partner";

/// Returns the scene of the collision; the origin is the contact point.
pub fn scene(blow: &Blow) -> Scene {
    let height = blow.model.shape.height() * blow.froude.length();
    let normal = DVec3::from_array(blow.impact.event.normal).normalize_or(DVec3::Z);
    let (mover, partner) = blow.movers();
    let mesh = blow.handover.mesh.posed(&mover.pose, UnitMesh::NAME);
    let unit = part(blow, UnitMesh::NAME, &mover);
    let (mesh, parts, gap) = match partner {
        Some(partner) => {
            let other = blow.handover.mesh.posed(&partner.pose, PARTNER);
            let levels_near_contact = |mesh: &Mesh| -> Vec<f64> {
                let within = mesh.nodes.iter().filter(|node| node.length() < ABOUT * height);
                within.map(|node| node.dot(normal)).collect()
            };
            let lowest = levels_near_contact(&mesh).into_iter().fold(f64::INFINITY, f64::min);
            let highest = levels_near_contact(&other).into_iter().fold(f64::NEG_INFINITY, f64::max);
            // Without nodes near the contact point, the bodies keep their positions.
            let overlap = if (highest - lowest).is_finite() { highest - lowest } else { 0.0 };
            let most = ROUNDED_OFF * height;
            let back = (overlap + GAP * height).clamp(-most, most);
            let parts = vec![shifted_part(unit, normal * back), part(blow, PARTNER, &partner)];
            (together(shifted(mesh, normal * back), other), parts, most)
        }
        None => {
            let velocity = |node: DVec3| mover.velocity + mover.angular_velocity.cross(node - mover.pose.position);
            let path = |node: DVec3| velocity(node) * blow.time_after();
            let seat = Seat::below(&mesh.nodes, path, mover.pose.position, normal, height);
            let cell = BASE_CELL * blow.handover.mesh.edge() * blow.froude.length();
            let base = Part::held(base::NAME, base::BOTTOM);
            (together(mesh, seat.block(normal, cell)), vec![unit, base], seat.gap)
        }
    };
    let approach = blow.impact.event.approach_normal.max(0.0) * blow.froude.velocity();
    // Do not wait for a body that hardly approaches.
    let before = if approach > 0.0 { (gap / approach).min(LONGEST_WAIT * blow.time_after()) } else { 0.0 };
    Scene { mesh, parts, loads: Vec::new(), duration: before + blow.time_after() }
}

/// Returns a unit with its recorded motion.
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
