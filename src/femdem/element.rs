//! The linear tetrahedron: finite strain, neo-Hookean elasticity with viscosity.
//!
//! The deformation gradient is F = sum of x_i (grad N_i)^T, with the current position x_i and the shape function N_i of
//! vertex i. The Cauchy stress is T = mu/J (B - I) + (lambda ln J / J) I + eta D (Xiang, Munjiza and Latham 2009), with
//! J = det F, B = F F^T, the identity matrix I, Lamé's constants lambda and mu, the viscosity eta, and the symmetric
//! part D of the velocity gradient. The first Piola-Kirchhoff stress is P = J T F^-T. The nodal forces are
//! f_i = -V_0 P grad N_i, with the undeformed volume V_0.

use glam::{DMat3, DVec3};

use super::material::Elastic;
use super::parallel::lanes::{LANES, Lanes, Vectors};

/// Elastic moduli and viscosity of an element.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Moduli {
    lambda: f64,
    mu: f64,
    viscosity: f64,
}

impl From<&Elastic> for Moduli {
    fn from(elastic: &Elastic) -> Self {
        Self { lambda: elastic.lambda(), mu: elastic.mu(), viscosity: elastic.viscosity }
    }
}

/// Undeformed shape of an element.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shape {
    /// Inverse of the matrix with the edges from vertex 0 as columns [1/m]; its rows are grad N_1 to grad N_3.
    pub inverse: DMat3,
    /// Volume V_0 [m3].
    pub volume: f64,
}

impl Shape {
    /// Computes the shape from the corners [m]. Seen from the fourth corner, the first three are in anticlockwise
    /// order.
    pub fn new(corners: &[DVec3; 4]) -> Self {
        let edges = edges(corners);
        Self { inverse: edges.inverse(), volume: edges.determinant() / 6.0 }
    }

    /// Returns the gradients of the four shape functions [1/m].
    pub fn gradients(&self) -> [DVec3; 4] {
        let rows = self.inverse.transpose();
        [-(rows.x_axis + rows.y_axis + rows.z_axis), rows.x_axis, rows.y_axis, rows.z_axis]
    }
}

fn edges(corners: &[DVec3; 4]) -> DMat3 {
    DMat3::from_cols(corners[1] - corners[0], corners[2] - corners[0], corners[3] - corners[0])
}

/// Moduli of the elements in the SIMD lanes.
#[derive(Debug, Clone, Copy)]
pub struct LaneModuli<L> {
    lambda: L,
    mu: L,
    viscosity: L,
}

impl<L: Lanes> LaneModuli<L> {
    /// Builds the moduli from a function of the lane number.
    #[inline(always)]
    pub fn from_fn<'a>(f: impl Fn(usize) -> &'a Moduli) -> Self {
        Self {
            lambda: L::from_fn(|lane| f(lane).lambda),
            mu: L::from_fn(|lane| f(lane).mu),
            viscosity: L::from_fn(|lane| f(lane).viscosity),
        }
    }
}

/// The three columns of one matrix per SIMD lane.
type Matrices<L> = [Vectors<L>; 3];

/// Undeformed shapes of the elements in the SIMD lanes.
#[derive(Debug, Clone, Copy)]
pub struct LaneShape<L> {
    inverse: Matrices<L>,
    volume: L,
}

impl<L: Lanes> LaneShape<L> {
    /// Builds the shapes from a function of the lane number.
    #[inline(always)]
    pub fn from_fn<'a>(f: impl Fn(usize) -> &'a Shape) -> Self {
        let column = |k: usize| Vectors::from_fn(|lane| f(lane).inverse.col(k));
        Self { inverse: [column(0), column(1), column(2)], volume: L::from_fn(|lane| f(lane).volume) }
    }
}

/// Forces, volume ratio, viscous power and stress of the elements in the SIMD lanes.
#[derive(Debug, Clone, Copy)]
pub struct Deformed<L> {
    /// Forces on the vertices 1 to 3 [N]; the force on vertex 0 is the negative of their sum.
    pub forces: [Vectors<L>; 3],
    /// Volume ratio J, current over undeformed volume [-]; not positive for an inverted element.
    pub ratio: L,
    /// Power dissipated by viscosity [W].
    pub viscous_power: L,
    /// Sum of the squares of the components of the elastic first Piola-Kirchhoff stress [Pa2].
    pub stress_squared: L,
}

/// Returns the deformation gradient F and its cofactor matrix, (det F) F^-T.
fn deformation(shape: &Shape, x: &[DVec3; 4]) -> (DMat3, DMat3) {
    let f = edges(x) * shape.inverse;
    let cofactor = DMat3::from_cols(f.y_axis.cross(f.z_axis), f.z_axis.cross(f.x_axis), f.x_axis.cross(f.y_axis));
    (f, cofactor)
}

/// Returns the elastic part of the first Piola-Kirchhoff stress [Pa]: mu (F - F^-T) + lambda ln J F^-T.
fn elastic_stress(moduli: &Moduli, f: DMat3, inverse_transposed: DMat3, log_ratio: f64) -> DMat3 {
    f * moduli.mu + inverse_transposed * (moduli.lambda * log_ratio - moduli.mu)
}

/// Computes the forces on the vertices at positions x [m] and velocities v [m/s].
#[inline(always)]
pub fn forces<L: Lanes>(
    shape: &LaneShape<L>,
    moduli: &LaneModuli<L>,
    x: &[Vectors<L>; 4],
    v: &[Vectors<L>; 4],
) -> Deformed<L> {
    let f = times(&lane_edges(x), &shape.inverse);
    let cofactor = [f[1].cross(f[2]), f[2].cross(f[0]), f[0].cross(f[1])];
    let ratio = f[0].dot(cofactor[0]);
    let per_ratio = L::splat(1.0) / ratio;
    let inverse_transposed = scaled(&cofactor, per_ratio);
    let pressure = moduli.lambda * logarithm(ratio) - moduli.mu;
    let elastic = sum(&scaled(&f, moduli.mu), &scaled(&inverse_transposed, pressure));
    let stress_squared = norm_squared_of(&elastic);
    // D = sym(dF/dt F^-1). The first Piola-Kirchhoff stress of the Cauchy stress eta D is (det F) eta D F^-T.
    let gradient = times_transposed(&times(&lane_edges(v), &shape.inverse), &inverse_transposed);
    let half = L::splat(0.5);
    let [xy, xz, yz] = [
        (gradient[0].y + gradient[1].x) * half,
        (gradient[0].z + gradient[2].x) * half,
        (gradient[1].z + gradient[2].y) * half,
    ];
    let rate = [
        Vectors { x: gradient[0].x, y: xy, z: xz },
        Vectors { x: xy, y: gradient[1].y, z: yz },
        Vectors { x: xz, y: yz, z: gradient[2].z },
    ];
    let stress = sum(&elastic, &scaled(&times(&rate, &cofactor), moduli.viscosity));
    Deformed {
        forces: scaled(&times_transposed(&stress, &shape.inverse), -shape.volume),
        ratio,
        viscous_power: moduli.viscosity * ratio * shape.volume * norm_squared_of(&rate),
        stress_squared,
    }
}

#[inline(always)]
fn lane_edges<L: Lanes>(x: &[Vectors<L>; 4]) -> Matrices<L> {
    [x[1] - x[0], x[2] - x[0], x[3] - x[0]]
}

#[inline(always)]
fn scaled<L: Lanes>(a: &Matrices<L>, by: L) -> Matrices<L> {
    [a[0] * by, a[1] * by, a[2] * by]
}

#[inline(always)]
fn sum<L: Lanes>(a: &Matrices<L>, b: &Matrices<L>) -> Matrices<L> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

/// Returns the matrix product A B.
#[inline(always)]
fn times<L: Lanes>(a: &Matrices<L>, b: &Matrices<L>) -> Matrices<L> {
    [
        a[0] * b[0].x + a[1] * b[0].y + a[2] * b[0].z,
        a[0] * b[1].x + a[1] * b[1].y + a[2] * b[1].z,
        a[0] * b[2].x + a[1] * b[2].y + a[2] * b[2].z,
    ]
}

/// Returns the matrix product A B^T.
#[inline(always)]
fn times_transposed<L: Lanes>(a: &Matrices<L>, b: &Matrices<L>) -> Matrices<L> {
    [
        a[0] * b[0].x + a[1] * b[1].x + a[2] * b[2].x,
        a[0] * b[0].y + a[1] * b[1].y + a[2] * b[2].y,
        a[0] * b[0].z + a[1] * b[1].z + a[2] * b[2].z,
    ]
}

/// Returns true if all four numbers are at most [`SMALL_CHANGE`].
#[inline(always)]
fn is_small([a, b, c, d]: [f64; LANES]) -> bool {
    a <= SMALL_CHANGE && b <= SMALL_CHANGE && c <= SMALL_CHANGE && d <= SMALL_CHANGE
}

#[inline(always)]
fn norm_squared_of<L: Lanes>(m: &Matrices<L>) -> L {
    m[0].dot(m[0]) + m[1].dot(m[1]) + m[2].dot(m[2])
}

/// Largest volume change |J - 1| for which [`logarithm`] uses a series [-]. The volume of concrete in tension changes
/// by less than a hundredth of this value before the concrete breaks.
const SMALL_CHANGE: f64 = 0.02;

/// Returns ln J. If |J - 1| is at most [`SMALL_CHANGE`] in all lanes, the function uses five terms of the series
/// ln J = 2 (s + s^3/3 + s^5/5 + ...), s = (J - 1) / (J + 1), whose error is below rounding. Otherwise, it uses
/// `f64::ln`.
#[inline(always)]
fn logarithm<L: Lanes>(ratio: L) -> L {
    let one = L::splat(1.0);
    let change = ratio - one;
    if !is_small(change.max(-change).to_array()) {
        return L::load(&ratio.to_array().map(f64::ln));
    }
    let s = change / (ratio + one);
    let squared = s * s;
    let sum = squared * L::splat(1.0 / 9.0) + L::splat(1.0 / 7.0);
    let sum = squared * sum + L::splat(1.0 / 5.0);
    let sum = squared * sum + L::splat(1.0 / 3.0);
    (s + s) * (squared * sum + one)
}

/// Returns the elastic energy of an element [J]: V_0 (mu/2 (tr B - 3 - 2 ln J) + lambda/2 ln^2 J).
pub fn energy(shape: &Shape, moduli: &Moduli, x: &[DVec3; 4]) -> f64 {
    let (f, cofactor) = deformation(shape, x);
    let log_ratio = f.x_axis.dot(cofactor.x_axis).ln();
    let trace = norm_squared(f);
    shape.volume * (0.5 * moduli.mu * (trace - 3.0 - 2.0 * log_ratio) + 0.5 * moduli.lambda * log_ratio * log_ratio)
}

/// Returns the elastic part of the Cauchy stress of an element [Pa].
pub fn stress(shape: &Shape, moduli: &Moduli, x: &[DVec3; 4]) -> DMat3 {
    let (f, cofactor) = deformation(shape, x);
    let ratio = f.x_axis.dot(cofactor.x_axis);
    elastic_stress(moduli, f, cofactor * ratio.recip(), ratio.ln()) * f.transpose() * ratio.recip()
}

fn norm_squared(m: DMat3) -> f64 {
    m.x_axis.length_squared() + m.y_axis.length_squared() + m.z_axis.length_squared()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::femdem::parallel::lanes::Portable;
    use glam::DQuat;

    /// Forces of one element.
    #[derive(Debug)]
    struct Answer {
        forces: [DVec3; 3],
        ratio: f64,
        viscous_power: f64,
    }

    fn forces(shape: &Shape, moduli: &Moduli, x: &[DVec3; 4], v: &[DVec3; 4]) -> Answer {
        let (shape, moduli) = (LaneShape::<Portable>::from_fn(|_| shape), LaneModuli::from_fn(|_| moduli));
        let [x, v] = [x, v].map(|corners| corners.map(|corner| Vectors::from_fn(|_| corner)));
        let deformed = super::forces(&shape, &moduli, &x, &v);
        Answer {
            forces: deformed.forces.map(|force| force.to_array()[LANES - 1]),
            ratio: deformed.ratio.to_array()[0],
            viscous_power: deformed.viscous_power.to_array()[0],
        }
    }

    const CONCRETE: Elastic = Elastic { density: 2340.0, young_modulus: 26e9, poisson_ratio: 0.2, viscosity: 2e4 };

    fn corners() -> [DVec3; 4] {
        [
            DVec3::new(0.01, 0.0, 0.002),
            DVec3::new(0.03, 0.001, 0.0),
            DVec3::new(0.012, 0.028, 0.004),
            DVec3::new(0.015, 0.008, 0.027),
        ]
    }

    fn moved(by: impl Fn(DVec3) -> DVec3) -> [DVec3; 4] {
        corners().map(by)
    }

    #[test]
    fn a_rigidly_rotated_element_has_no_forces() {
        let (shape, moduli) = (Shape::new(&corners()), Moduli::from(&CONCRETE));
        let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, -1.2, 2.0);
        let spin = DVec3::new(3.0, -2.0, 5.0);
        let x = moved(|p| turn * p + DVec3::ONE);
        let answer = forces(&shape, &moduli, &x, &x.map(|p| spin.cross(p)));
        // Tolerance: rounding of a force E V^(2/3), which would occur at strains of order one.
        let scale = CONCRETE.young_modulus * shape.volume.powf(2.0 / 3.0);
        assert!(answer.forces.iter().all(|f| f.length() < 1e-13 * scale), "{answer:?}");
        assert!((answer.ratio - 1.0).abs() < 1e-12);
    }

    #[test]
    fn the_series_of_the_logarithm_is_exact_to_rounding() {
        for change in [0.0f64, 1e-15, -3e-9, 1e-5, -0.0199, 0.02, 0.03, -0.7, 12.0] {
            let found = logarithm(Portable::load(&[1.0 + change; LANES])).to_array()[0];
            let expected = (1.0 + change).ln();
            // Tolerance: rounding, about two units in the last place of ln J.
            assert!((found - expected).abs() <= 5e-16 * expected.abs(), "{change}: {found:e} {expected:e}");
        }
    }

    #[test]
    fn forces_are_minus_the_gradient_of_the_energy() {
        let elastic = Elastic { viscosity: 0.0, ..CONCRETE };
        let (shape, moduli) = (Shape::new(&corners()), Moduli::from(&elastic));
        let strain = DMat3::from_cols_array(&[1.1, 0.05, -0.1, 0.02, 0.9, 0.15, -0.07, 0.03, 1.2]);
        let x = moved(|p| strain * p);
        let answer = forces(&shape, &moduli, &x, &[DVec3::ZERO; 4]);
        for vertex in 1..4 {
            for axis in 0..3 {
                let step = 1e-8;
                let energy_at = |sign: f64| {
                    let mut x = x;
                    x[vertex][axis] += sign * step;
                    energy(&shape, &moduli, &x)
                };
                let slope = -(energy_at(1.0) - energy_at(-1.0)) / (2.0 * step);
                // Tolerance: error of central differences with increments of 1e-6 of the element size, and rounding.
                assert!((slope - answer.forces[vertex - 1][axis]).abs() < 1e-6 * answer.forces[vertex - 1].length());
            }
        }
    }

    #[test]
    fn small_strains_follow_hooke_and_viscosity_dissipates() {
        let (shape, moduli) = (Shape::new(&corners()), Moduli::from(&CONCRETE));
        let [sigma, nu] = [1e3, CONCRETE.poisson_ratio];
        let strain = sigma / CONCRETE.young_modulus;
        let x = moved(|p| p + strain * DVec3::new(p.x, -nu * p.y, -nu * p.z));
        let t = stress(&shape, &moduli, &x);
        // Tolerance: terms that are quadratic in the strain of 4e-8, and rounding of the positions.
        assert!(
            (t.x_axis.x / sigma - 1.0).abs() < 1e-6
                && t.y_axis.y.abs() < 1e-6 * sigma
                && t.x_axis.y.abs() < 1e-6 * sigma
        );
        let rate = DMat3::from_cols_array(&[1.0, 0.5, 0.0, -0.5, 2.0, 0.3, 0.2, 0.0, -1.0]);
        let v = corners().map(|p| rate * p);
        let answer = forces(&shape, &moduli, &corners(), &v);
        let power: f64 = (1..4).map(|k| answer.forces[k - 1].dot(v[k] - v[0])).sum();
        let d = (rate + rate.transpose()) * 0.5;
        let expected = CONCRETE.viscosity * shape.volume * norm_squared(d);
        assert!((answer.viscous_power / expected - 1.0).abs() < 1e-9 && (-power / expected - 1.0).abs() < 1e-9);
    }
}
