//! The time step limit.
//!
//! With mass lumping, the largest angular frequency of a mesh is at most that of its stiffest element with its own
//! share of the masses (Irons). Joints at the faces of a tetrahedron add twice their stiffness at each vertex to its
//! largest eigenvalue. The time step limit of central differences is 2 / omega; with the viscous damping rate gamma it
//! is (2 / omega) (sqrt(1 + xi^2) - xi), xi = gamma / (2 omega).

use glam::{DMat3, DVec3};

use super::element::Shape;
use super::material::Elastic;

/// Rounds of the power iteration; they give the largest of twelve eigenvalues to one percent.
const ROUNDS: usize = 40;
/// Safety factor for the remaining error of the iteration [-].
const LACKING: f64 = 1.02;

/// Square of the largest angular frequency of a free tetrahedron [1/s2].
pub fn element_frequency_squared(shape: &Shape, elastic: &Elastic) -> f64 {
    let (lambda, mu) = (elastic.lambda(), elastic.mu());
    let mass = 0.25 * elastic.density * shape.volume;
    let largest = largest_eigenvalue(shape, |strain| {
        let trace = strain.x_axis.x + strain.y_axis.y + strain.z_axis.z;
        DMat3::IDENTITY * (lambda * trace) + strain * (2.0 * mu)
    });
    largest * shape.volume / mass
}

/// Largest rate at which viscosity damps a free tetrahedron [1/s].
pub fn element_damping_rate(shape: &Shape, elastic: &Elastic) -> f64 {
    let mass = 0.25 * elastic.density * shape.volume;
    largest_eigenvalue(shape, |rate| rate * elastic.viscosity) * shape.volume / mass
}

/// Contact stiffness at a vertex of a tetrahedron in contact at its largest face [N/m].
///
/// The contact potential rises from 0 to 1 over a quarter of the height H. Two flush tetrahedra with overlap depth d
/// have the energy p 4 d^2 / H and the stiffness 8 p / H per unit of area. Each vertex gets a third of the face.
pub fn contact_stiffness(shape: &Shape, penalty: f64) -> f64 {
    // For face k, |grad N_k| = 1 / H along the normal, and V = A H / 3.
    let steepest = shape.gradients().into_iter().map(|gradient| gradient.length()).fold(0.0, f64::max);
    8.0 * penalty * steepest * (shape.volume * steepest)
}

/// Largest eigenvalue of B^T C B [C/m2] for a stress C(strain).
fn largest_eigenvalue(shape: &Shape, stress: impl Fn(DMat3) -> DMat3) -> f64 {
    let gradients = shape.gradients();
    // Start vector without any symmetry.
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
    LACKING * largest
}

/// Time step limit [s] for the square of the largest angular frequency [1/s2] and a damping rate [1/s].
pub fn stable_step(frequency_squared: f64, damping_rate: f64) -> f64 {
    let omega = frequency_squared.sqrt();
    let xi = 0.5 * damping_rate / omega;
    2.0 / omega * ((1.0 + xi * xi).sqrt() - xi)
}
