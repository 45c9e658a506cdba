//! The linear tetrahedron: finite strain, neo-Hookean with viscosity.
//!
//! F = sum x_i (x) grad N_i;  Cauchy stress T = mu/J (B - I) + lambda ln J / J I + eta D, with B = F F^T and D the
//! symmetric part of the velocity gradient (Xiang, Munjiza and Latham 2009); nodal forces f_i = -V_0 P grad N_i with
//! P = J T F^-T.

use glam::{DMat3, DVec3};

use super::material::Elastic;

/// Moduli of an element.
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
    /// Shape of a tetrahedron with these corners [m], the fourth on the side of the normal of the first three.
    pub fn new(corners: &[DVec3; 4]) -> Self {
        let edges = edges(corners);
        Self { inverse: edges.inverse(), volume: edges.determinant() / 6.0 }
    }

    /// Gradients of the four shape functions [1/m].
    pub fn gradients(&self) -> [DVec3; 4] {
        let rows = self.inverse.transpose();
        [-(rows.x_axis + rows.y_axis + rows.z_axis), rows.x_axis, rows.y_axis, rows.z_axis]
    }
}

fn edges(corners: &[DVec3; 4]) -> DMat3 {
    DMat3::from_cols(corners[1] - corners[0], corners[2] - corners[0], corners[3] - corners[0])
}

/// Forces of an element and what else is known on the way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer {
    /// On the vertices 1 to 3 [N]; vertex 0 has the negative of their sum.
    pub forces: [DVec3; 3],
    /// Ratio of volumes J [-]; not positive for an element turned inside out.
    pub ratio: f64,
    /// Power lost by viscosity [W].
    pub viscous_power: f64,
}

/// F and det F F^-T.
fn deformation(shape: &Shape, x: &[DVec3; 4]) -> (DMat3, DMat3) {
    let f = edges(x) * shape.inverse;
    let cofactor = DMat3::from_cols(f.y_axis.cross(f.z_axis), f.z_axis.cross(f.x_axis), f.x_axis.cross(f.y_axis));
    (f, cofactor)
}

/// First Piola-Kirchhoff stress of the elastic part [Pa]: mu (F - F^-T) + lambda ln J F^-T.
fn elastic_stress(moduli: &Moduli, f: DMat3, inverse_transposed: DMat3, log_ratio: f64) -> DMat3 {
    f * moduli.mu + inverse_transposed * (moduli.lambda * log_ratio - moduli.mu)
}

/// Forces on the vertices at the places x [m] and velocities v [m/s].
#[inline]
pub fn forces(shape: &Shape, moduli: &Moduli, x: &[DVec3; 4], v: &[DVec3; 4]) -> Answer {
    let (f, cofactor) = deformation(shape, x);
    let ratio = f.x_axis.dot(cofactor.x_axis);
    let inverse_transposed = cofactor * ratio.recip();
    let mut stress = elastic_stress(moduli, f, inverse_transposed, ratio.ln());
    let mut viscous_power = 0.0;
    if moduli.viscosity > 0.0 {
        let gradient = edges(v) * shape.inverse * inverse_transposed.transpose();
        let rate = (gradient + gradient.transpose()) * 0.5;
        stress += rate * cofactor * moduli.viscosity;
        viscous_power = moduli.viscosity * ratio * shape.volume * norm_squared(rate);
    }
    let h = stress * shape.inverse.transpose() * -shape.volume;
    Answer { forces: [h.x_axis, h.y_axis, h.z_axis], ratio, viscous_power }
}

/// Elastic energy [J]: V_0 (mu/2 (tr B - 3 - 2 ln J) + lambda/2 ln^2 J).
pub fn energy(shape: &Shape, moduli: &Moduli, x: &[DVec3; 4]) -> f64 {
    let (f, cofactor) = deformation(shape, x);
    let log_ratio = f.x_axis.dot(cofactor.x_axis).ln();
    let trace = norm_squared(f);
    shape.volume * (0.5 * moduli.mu * (trace - 3.0 - 2.0 * log_ratio) + 0.5 * moduli.lambda * log_ratio * log_ratio)
}

/// Elastic Cauchy stress [Pa].
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
    use glam::DQuat;

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
    fn a_turned_element_has_no_forces() {
        let (shape, moduli) = (Shape::new(&corners()), Moduli::from(&CONCRETE));
        let turn = DQuat::from_euler(glam::EulerRot::XYZ, 0.4, -1.2, 2.0);
        let spin = DVec3::new(3.0, -2.0, 5.0);
        let x = moved(|p| turn * p + DVec3::ONE);
        let answer = forces(&shape, &moduli, &x, &x.map(|p| spin.cross(p)));
        // Against E times an area: rounding.
        let scale = CONCRETE.young_modulus * shape.volume.powf(2.0 / 3.0);
        assert!(answer.forces.iter().all(|f| f.length() < 1e-13 * scale), "{answer:?}");
        assert!((answer.ratio - 1.0).abs() < 1e-12);
    }

    #[test]
    fn forces_are_the_gradient_of_the_energy() {
        let elastic = Elastic { viscosity: 0.0, ..CONCRETE };
        let (shape, moduli) = (Shape::new(&corners()), Moduli::from(&elastic));
        let strain = DMat3::from_cols_array(&[1.1, 0.05, -0.1, 0.02, 0.9, 0.15, -0.07, 0.03, 1.2]);
        let x = moved(|p| strain * p);
        let answer = forces(&shape, &moduli, &x, &[DVec3::ZERO; 4]);
        for vertex in 1..4 {
            for axis in 0..3 {
                let step = 1e-8;
                let at = |sign: f64| {
                    let mut x = x;
                    x[vertex][axis] += sign * step;
                    energy(&shape, &moduli, &x)
                };
                let slope = -(at(1.0) - at(-1.0)) / (2.0 * step);
                // Central differences over 1e-6 of the size: 1e-8, rounding.
                assert!((slope - answer.forces[vertex - 1][axis]).abs() < 1e-6 * answer.forces[vertex - 1].length());
            }
        }
    }

    #[test]
    fn small_strains_follow_hooke_and_viscosity_takes_power() {
        let (shape, moduli) = (Shape::new(&corners()), Moduli::from(&CONCRETE));
        let [sigma, nu] = [1e3, CONCRETE.poisson_ratio];
        let strain = sigma / CONCRETE.young_modulus;
        let x = moved(|p| p + strain * DVec3::new(p.x, -nu * p.y, -nu * p.z));
        let t = stress(&shape, &moduli, &x);
        // Strains of 4e-8: quadratic terms and the rounding of places.
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
