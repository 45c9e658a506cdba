//! Why a fracture run cannot go on, in words: which part of the mesh, where, when, and what is probably behind it.

use std::fmt;

use glam::DVec3;
use thiserror::Error;

use crate::{
    case::FractureCase,
    femdem::{watch::StepError, world::World},
};

/// Share of the celerity [-] above which the corners of a tetrahedron move as in no impact of units: strains of a tenth.
const FAST: f64 = 0.1;

/// What is usually behind motion that is no motion of a solid.
const UNSTABLE: &str = "likely causes: speeds in the case that are no speeds of units, a time step too long for the worst \
     tetrahedra there (lower fracture.step_share), or loads and contacts too stiff for the mesh (lower \
     fracture.contact_penalty, refine)";

/// A tetrahedron or a node as messages name it, by its number in the mesh file.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    kind: &'static str,
    tag: u64,
    body: String,
    /// Where it was at the start [m].
    place: DVec3,
}

impl Part {
    fn tet(case: &FractureCase, tet: usize) -> Self {
        let mesh = &case.mesh.mesh;
        let (tag, body, place) = (mesh.tet_tags[tet], mesh.body_of(tet).name.clone(), mesh.centroid(tet));
        Self { kind: "tetrahedron", tag, body, place }
    }

    fn node(case: &FractureCase, world: &World, node: usize) -> Self {
        let copy = world.nodes.ties.of(node)[0] as usize;
        let mesh = &case.mesh.mesh;
        let tag = mesh.node_tags[mesh.tets[copy / 4][copy % 4] as usize];
        Self { kind: "node", tag, body: mesh.body_of(copy / 4).name.clone(), place: world.place_at_start(node) }
    }
}

impl fmt::Display for Part {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, tag, body, place: DVec3 { x, y, z } } = self;
        write!(out, "{kind} {tag} of body {body:?}, in the mesh at ({x:.4}, {y:.4}, {z:.4}) m,")
    }
}

/// Why a run cannot go on. Times [s] count from the start.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Failure {
    /// A tetrahedron was turned inside out.
    #[error(
        "after {:.5} ms (step {step}) {tet} was turned inside out, its corners moving with up to {speed:.3e} m/s: {cause}",
        time * 1e3
    )]
    Inverted { time: f64, step: u64, tet: Part, speed: f64, cause: &'static str },
    /// A place is no longer a number.
    #[error(
        "after {:.5} ms (step {step}) the place of {node} is no longer a finite number: the run has become unstable; {UNSTABLE}",
        time * 1e3
    )]
    NotFinite { time: f64, step: u64, node: Part },
    /// A node is faster than any wave.
    #[error(
        "after {:.5} ms (step {step}) {node} moves with {speed:.3e} m/s, more than the {limit:.3e} m/s that twice the celerity \
         and the motion of the case allow: the run has become unstable; {UNSTABLE}", time * 1e3
    )]
    TooFast { time: f64, step: u64, node: Part, speed: f64, limit: f64 },
    /// A node has flown away.
    #[error(
        "after {:.5} ms (step {step}) {node} has gone {distance:.3} m from the middle of the mesh, more than the {limit:.3} m \
         that 50 diagonals and the motion of the case allow: a piece flew off that touches nothing any more (end the run \
         earlier with stop.duration_s), or a body is missing that should stop it, or a contact threw it out (lower \
         fracture.step_share)", time * 1e3
    )]
    Escaped { time: f64, step: u64, node: Part, distance: f64, limit: f64 },
    /// Two tetrahedra are too deep in each other.
    #[error(
        "after {:.5} ms (step {step}) {first} and {second} overlap by {:.0} % of the smaller one: the contact is too soft for \
         the impact; raise fracture.contact_penalty, or refine the mesh there, and check the velocities of the case",
        time * 1e3, 100.0 * share
    )]
    TooDeep { time: f64, step: u64, first: Part, second: Part, share: f64 },
}

impl Failure {
    /// What an error of the world means for the run of a case, at its step of that number.
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
    if speed > FAST * body.elastic.celerity() {
        "that is a tenth of the celerity and more; the velocities of the case are no speeds of units, or the time step is too \
         long for it (lower fracture.step_share)"
    } else if world.contacts.presses(tet as u32) {
        "another one presses it; the impact crushes elements of that size: refine the mesh there, or lower \
         fracture.contact_penalty"
    } else {
        "it was pulled or sheared flat, often a sliver beside a crack: mesh again with Mesh.Optimize = 1, refine there, or give \
         the material some viscosity"
    }
}
