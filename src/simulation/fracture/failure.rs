//! Messages for fracture runs that fail: element or node, its position, time, and likely causes.

use std::fmt;

use glam::DVec3;
use thiserror::Error;

use crate::{
    case::FractureCase,
    femdem::world::{World, limits::StepError},
};

/// Speed of a corner of a tetrahedron, divided by the wave speed in the material [-]. No impact of units reaches this
/// ratio, because the strains would be about 10 %.
const MAX_SPEED_RATIO: f64 = 0.1;

/// Usual causes of an unstable run.
const UNSTABLE: &str = "likely causes: velocities in the case that are too high for units, a time step too long for \
     the worst tetrahedra there (lower fracture.step_share), or loads and contacts too stiff for the mesh (lower \
     fracture.contact_penalty, refine the mesh)";

/// A tetrahedron or node in a message, with its number in the mesh file.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    kind: &'static str,
    tag: u64,
    body: String,
    /// Position at the start [m].
    position: DVec3,
}

impl Part {
    fn tet(case: &FractureCase, tet: usize) -> Self {
        let mesh = &case.mesh.mesh;
        let (tag, body, position) = (mesh.tet_tags[tet], mesh.body_of(tet).name.clone(), mesh.centroid(tet));
        Self { kind: "tetrahedron", tag, body, position }
    }

    fn node(case: &FractureCase, world: &World, node: usize) -> Self {
        let copy = world.nodes.copies_of(node)[0] as usize;
        let mesh = &case.mesh.mesh;
        let tag = mesh.node_tags[mesh.tets[copy / 4][copy % 4] as usize];
        Self { kind: "node", tag, body: mesh.body_of(copy / 4).name.clone(), position: world.initial_position(node) }
    }
}

impl fmt::Display for Part {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, tag, body, position: DVec3 { x, y, z } } = self;
        write!(out, "{kind} {tag} of body {body:?}, in the mesh at ({x:.4}, {y:.4}, {z:.4}) m,")
    }
}

/// Reason why a fracture run failed. Times are simulated times [s].
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Failure {
    /// A tetrahedron is inverted.
    #[error(
        "after {:.5} ms (step {step}) {tet} is inverted; its corners move at up to {speed:.3e} m/s: {cause}",
        time * 1e3
    )]
    Inverted { time: f64, step: u64, tet: Part, speed: f64, cause: &'static str },
    /// A position is not a finite number.
    #[error(
        "after {:.5} ms (step {step}) the position of {node} is not a finite number: the run is unstable; {UNSTABLE}",
        time * 1e3
    )]
    NotFinite { time: f64, step: u64, node: Part },
    /// A node is faster than twice the wave speed in the material plus the speed that the case prescribes.
    #[error(
        "after {:.5} ms (step {step}) {node} moves at {speed:.3e} m/s, more than the limit of {limit:.3e} m/s, which \
         is twice the wave speed plus the speed given by the case: the run is unstable; {UNSTABLE}", time * 1e3
    )]
    TooFast { time: f64, step: u64, node: Part, speed: f64, limit: f64 },
    /// A node is too far from the middle of the mesh.
    #[error(
        "after {:.5} ms (step {step}) {node} is {distance:.3} m from the middle of the mesh, more than the limit of \
         {limit:.3} m, which is 50 mesh diagonals plus the travel given by the case: a piece moves away freely (end \
         the run earlier with stop.duration_s), a body that should stop the piece is missing, or a contact ejected the \
         node (lower fracture.step_share)", time * 1e3
    )]
    Escaped { time: f64, step: u64, node: Part, distance: f64, limit: f64 },
    /// Two tetrahedra overlap too much.
    #[error(
        "after {:.5} ms (step {step}) {first} and {second} overlap by {:.0} % of the smaller one: the contact is too \
         soft for the impact; raise fracture.contact_penalty or refine the mesh, and check the velocities of the case",
        time * 1e3, 100.0 * share
    )]
    TooDeep { time: f64, step: u64, first: Part, second: Part, share: f64 },
}

impl Failure {
    /// Converts an error of the solver to a message about the case; `step` is the number of the time step.
    pub fn of(case: &FractureCase, world: &World, step: u64, error: StepError) -> Self {
        let node = |number| Part::node(case, world, number);
        match error {
            StepError::Inverted { tet, time } => {
                let speeds = world.tets.nodes[tet].map(|node| world.nodes.velocity[node as usize].length());
                let speed = speeds.into_iter().fold(0.0, f64::max);
                let cause = cause_of_inversion(world, tet, speed);
                Self::Inverted { time, step, tet: Part::tet(case, tet), speed, cause }
            }
            StepError::NotFinite { node: number, time } => Self::NotFinite { time, step, node: node(number) },
            StepError::TooFast { node: number, speed: [speed, limit], time } => {
                Self::TooFast { time, step, node: node(number), speed, limit }
            }
            StepError::Escaped { node: number, distance: [distance, limit], time } => {
                Self::Escaped { time, step, node: node(number), distance, limit }
            }
            StepError::TooDeep { tets, share, time } => {
                let [first, second] = tets.map(|tet| Part::tet(case, tet as usize));
                Self::TooDeep { time, step, first, second, share }
            }
        }
    }
}

fn cause_of_inversion(world: &World, tet: usize, speed: f64) -> &'static str {
    let body = &world.setup().bodies[usize::from(world.tets.body[tet])];
    if speed > MAX_SPEED_RATIO * body.elastic.celerity() {
        "this speed is more than a tenth of the wave speed; the velocities of the case are too high for units, or the \
         time step is too long (lower fracture.step_share)"
    } else if world.contacts.is_in_contact(tet as u32) {
        "another tetrahedron presses on it; the impact crushes elements of this size: refine the mesh there, or lower \
         fracture.contact_penalty"
    } else {
        "it was stretched or sheared flat, often because it is a thin element next to a crack: remesh with \
         Mesh.Optimize = 1, refine the mesh there, or give the material some viscosity"
    }
}
