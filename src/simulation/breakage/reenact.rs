//! Re-run of an impact by collision: both bodies collide from their poses and velocities just before the impact.

use glam::DVec3;

use super::base::{self, BlockPosition, GAP, ROUNDED_OFF, TOUCHING_DISTANCE};
use super::blow::{ScaledImpact, UnitMotion};
use super::fracture_case::{ImpactScene, PARTNER, Part};
use crate::femdem::mesh::Mesh;
use crate::femdem::mesh::unit_mesh::{UnitMesh, combine};

/// Cell length of the block of the bed, divided by the mean edge length of the unit's mesh [-]. Each cell is cut into
/// 24 tetrahedra.
const BASE_CELL: f64 = 2.0;

/// Longest simulated time before first contact, divided by the simulated time after first contact [-].
const LONGEST_WAIT: f64 = 3.0;

/// Returns bodies and meshes of the collision; the origin is the contact point. The bodies start with a small gap.
pub fn scene(blow: &ScaledImpact) -> ImpactScene {
    let height = blow.model.shape.height() * blow.froude.length();
    let normal = DVec3::from_array(blow.impact.event.normal).normalize_or(DVec3::Z);
    let (mover, partner) = blow.movers();
    let mesh = blow.settings.mesh.posed(&mover.pose, UnitMesh::NAME);
    let unit = part(blow, UnitMesh::NAME, &mover);
    let (mesh, parts, gap) = match partner {
        Some(partner) => {
            let other = blow.settings.mesh.posed(&partner.pose, PARTNER);
            let levels_near_contact = |mesh: &Mesh| -> Vec<f64> {
                let within = mesh.nodes.iter().filter(|node| node.length() < TOUCHING_DISTANCE * height);
                within.map(|node| node.dot(normal)).collect()
            };
            let lowest = levels_near_contact(&mesh).into_iter().fold(f64::INFINITY, f64::min);
            let highest = levels_near_contact(&other).into_iter().fold(f64::NEG_INFINITY, f64::max);
            // If a body has no nodes near the contact point, the overlap is unknown: assume zero.
            let overlap = if (highest - lowest).is_finite() { highest - lowest } else { 0.0 };
            let most = ROUNDED_OFF * height;
            let back = (overlap + GAP * height).clamp(-most, most);
            let parts = vec![shifted_part(unit, normal * back), part(blow, PARTNER, &partner)];
            (combine(shifted(mesh, normal * back), other), parts, most)
        }
        None => {
            let velocity = |node: DVec3| mover.velocity + mover.angular_velocity.cross(node - mover.pose.position);
            let path = |node: DVec3| velocity(node) * blow.time_after();
            let seat = BlockPosition::below(&mesh.nodes, path, mover.pose.position, normal, height);
            let cell = BASE_CELL * blow.settings.mesh.edge() * blow.froude.length();
            let base = Part::held(base::NAME, base::BOTTOM);
            (combine(mesh, seat.block(normal, cell)), vec![unit, base], seat.gap)
        }
    };
    let approach = blow.impact.event.approach_normal.max(0.0) * blow.froude.velocity();
    // The approach may be very slow: limit the time before contact.
    let before = if approach > 0.0 { (gap / approach).min(LONGEST_WAIT * blow.time_after()) } else { 0.0 };
    ImpactScene { mesh, parts, loads: Vec::new(), duration: before + blow.time_after() }
}

/// Returns the body called `name` for a unit that has the motion `mover` just before the impact.
pub fn part(blow: &ScaledImpact, name: &'static str, mover: &UnitMotion) -> Part {
    Part {
        name,
        velocity: mover.velocity,
        angular_velocity: blow.angular_velocity(mover),
        pivot: blow.settings.mesh.centre(&mover.pose),
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
