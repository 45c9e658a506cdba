//! The limit of the time step.
//!
//! With lumped masses, each element of a mesh has its own share of the nodal masses. No angular frequency of the mesh
//! exceeds omega, the largest angular frequency of all its elements as separate free bodies (Irons). Joints and
//! contacts act as springs at the vertices of a tetrahedron. They increase omega^2 by at most 2 k / m. m is the mass at
//! a vertex, and k is the stiffness of the joints at a vertex or of the contact there, whichever is larger. The limit
//! of the time step for central differences is 2 / omega. With the viscous damping rate gamma and
//! xi = gamma / (2 omega), the limit is (2 / omega) (sqrt(1 + xi^2) - xi).

use glam::{DMat3, DVec3};
use rayon::prelude::*;

use super::World;
use crate::femdem::element::Shape;
use crate::femdem::material::Elastic;

/// Number of power iterations. With this number, the largest of the twelve eigenvalues of a tetrahedron is accurate to
/// 1 %.
const ROUNDS: usize = 40;
/// Safety factor for the remaining error of the power iteration [-].
const EIGENVALUE_SAFETY: f64 = 1.02;

impl World {
    /// Computes the limit of the time step [s]. Every interface counts as a joint, because a tied face may be released.
    pub fn time_step_limit(&self) -> f64 {
        let limit = |t: usize| {
            let body = &self.setup.bodies[usize::from(self.tets.body[t])];
            let shape = &self.tets.shape[t];
            let mass = 0.25 * body.elastic.density * shape.volume;
            let mut springs = [0.0; 4];
            if let Some(cohesion) = body.cohesion {
                for (face, link) in self.tets.faces[t].into_iter().enumerate() {
                    let Some((number, _)) = link.interface() else { continue };
                    let [edge, area] = self.joints.size[number];
                    let stiffness = cohesion.law(edge).stiffness() * area / 3.0;
                    (0..4).filter(|k| *k != face).for_each(|k| springs[k] += stiffness);
                }
            }
            let contact = contact_stiffness(shape, body.contact_penalty);
            if body.rigid {
                // For a rigid body, only contact limits the time step. The limit for a free tetrahedron is safe,
                // because a contact force accelerates the whole body less than a free tetrahedron.
                let touches = contact > 0.0 && self.setup.outer.binary_search(&(t as u32)).is_ok();
                return if touches { stable_step(2.0 * contact / mass, 0.0) } else { f64::INFINITY };
            }
            let springs = 2.0 * springs.into_iter().fold(contact, f64::max) / mass;
            let frequency_squared = element_frequency_squared(shape, &body.elastic) + springs;
            stable_step(frequency_squared, element_damping_rate(shape, &body.elastic))
        };
        (0..self.tets.nodes.len()).into_par_iter().map(limit).reduce(|| f64::INFINITY, f64::min)
    }
}

/// Returns the square of the largest angular frequency of a free tetrahedron [1/s2].
pub fn element_frequency_squared(shape: &Shape, elastic: &Elastic) -> f64 {
    let (lambda, mu) = (elastic.lambda(), elastic.mu());
    let mass = 0.25 * elastic.density * shape.volume;
    let largest = largest_eigenvalue(shape, |strain| {
        let trace = strain.x_axis.x + strain.y_axis.y + strain.z_axis.z;
        DMat3::IDENTITY * (lambda * trace) + strain * (2.0 * mu)
    });
    largest * shape.volume / mass
}

/// Returns the largest rate at which viscosity damps the motion of a free tetrahedron [1/s].
pub fn element_damping_rate(shape: &Shape, elastic: &Elastic) -> f64 {
    let mass = 0.25 * elastic.density * shape.volume;
    largest_eigenvalue(shape, |rate| rate * elastic.viscosity) * shape.volume / mass
}

/// Returns the contact stiffness at a vertex of a tetrahedron whose largest face is in contact [N/m].
///
/// The contact potential rises from 0 to 1 over a quarter of the height H of the tetrahedron. Two tetrahedra of this
/// height, whose faces lie on each other with the overlap depth d, have the energy 4 p d^2 / H and the stiffness
/// 8 p / H per unit of area, with the contact penalty p. Each vertex gets a third of the area of the face.
pub fn contact_stiffness(shape: &Shape, penalty: f64) -> f64 {
    // For the face opposite to vertex k, with the area A, |grad N_k| = 1 / H. V / H is A / 3, because V = A H / 3.
    let steepest = shape.gradients().into_iter().map(|gradient| gradient.length()).fold(0.0, f64::max);
    8.0 * penalty * steepest * (shape.volume * steepest)
}

/// Returns the largest eigenvalue of B^T C B, in the unit of C per m2. B is the matrix that computes the strain from
/// the displacements of the vertices. `stress` is the linear function C, which computes the stress from the strain.
fn largest_eigenvalue(shape: &Shape, stress: impl Fn(DMat3) -> DMat3) -> f64 {
    let gradients = shape.gradients();
    // The start vector has no symmetry, so it contains a part of every eigenvector.
    let mut u = [0.3, -0.7, 1.0, -0.6].map(|a: f64| DVec3::new(a, a * a - 0.4, 0.5 - a));
    let mut largest = 0.0;
    for _ in 0..ROUNDS {
        let mut gradient = DMat3::ZERO;
        for (u, n) in u.iter().zip(gradients) {
            gradient += DMat3::from_cols(*u * n.x, *u * n.y, *u * n.z);
        }
        let sigma = stress((gradient + gradient.transpose()) * 0.5);
        let next = gradients.map(|n| sigma * n);
        let length = next.iter().map(|f| f.length_squared()).sum::<f64>().sqrt();
        largest = length / u.iter().map(|f| f.length_squared()).sum::<f64>().sqrt();
        if length == 0.0 {
            return 0.0;
        }
        u = next.map(|f| f / length);
    }
    EIGENVALUE_SAFETY * largest
}

/// Returns the limit of the time step [s] for the square of the largest angular frequency and a damping rate [1/s].
pub fn stable_step(frequency_squared: f64, damping_rate: f64) -> f64 {
    let omega = frequency_squared.sqrt();
    let xi = 0.5 * damping_rate / omega;
    2.0 / omega * ((1.0 + xi * xi).sqrt() - xi)
}
