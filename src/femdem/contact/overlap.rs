//! Contact of two tetrahedra: the energy of their overlap and its exact gradient.
//!
//! Contact potential: Munjiza (2004), "The Combined Finite-Discrete Element Method", ch. 2. phi_T is 1 at the centroid
//! of tetrahedron T, 0 on its surface, and linear in the four sub-tetrahedra between the centroid and the faces. With
//! the barycentric coordinates lambda_j of T, phi_T is 4 times the smallest lambda_j. phi_C is the same for tetrahedron
//! C. With the contact penalty p [Pa], the energy of the pair (T, C) is
//!
//!   E = p (I_T + I_C),   I_T and I_C = integrals of phi_T and phi_C over the overlap of T and C [m3].
//!
//! Gradient. If the vertices move, the velocities u_T in T and u_C in C are linear in the position. phi_T moves with T,
//! so at a fixed position d phi_T / dt = -u_T . grad phi_T. phi_T is zero on the surface of T. With the outward unit
//! normal n_k of face k of C and the surface element dA, Reynolds' transport theorem and the divergence theorem give
//!
//!   dI_T/dt = sum over faces k of C of  integral of phi_T (u_C - u_T) . n_k dA over (face k inside T)  +  I_T div u_T.
//!
//! The forces from I_T are therefore, with the shape functions N_i^C of C and N_j^T of T,
//!
//!   on vertex i of C: -p sum_k n_k integral phi_T N_i^C dA,
//!   on vertex j of T: +p sum_k n_k integral phi_T N_j^T dA - p I_T grad N_j^T.
//!
//! The forces from I_C follow if T and C are exchanged. The forces on T and C act on the same surface elements dA, so
//! the pair conserves momentum and angular momentum to rounding.
//!
//! Volume integral. In part j of T, where lambda_j is least, phi_T is linear. With the position x and any point a_j in
//! the plane of the face opposite to vertex j, div(phi_T (x - a_j)) = 4 phi_T. With the divergence theorem, I_T becomes
//! a sum of surface integrals. The plane between two parts j and l, with the normal n, contributes the integral of
//! phi_T (a_l - a_j) . n. This integral vanishes if a_l - a_j is parallel to the plane. The points a_j from `anchors`
//! achieve this for all planes except the plane between parts 0 and 1. This plane contains the triangle (centroid,
//! vertex 2, vertex 3) of T. The product of a_1 - a_0 and the area vector of this triangle is 3 V_T. With the volumes
//! V_T and V_C,
//!
//!   4 I_T = sum_k sum_j 3 V_C N_k^C(a_j) m_kj + 3 V_T q.
//!
//! m_kj is the integral of phi_T over the area of face k of C that is in part j, divided by the area of the whole face.
//! q is the integral of phi_T over the part of the triangle inside C, divided by the area of the whole triangle. Every
//! term has a factor phi_T, so faces of T and C that coincide except for rounding cause no error.
//!
//! Stiffness. A pair is stiffest if a face of T and a face of C, both of area A, lie on each other. If d is the small
//! overlap depth, and h_T and h_C are the heights of T and C over this face, E = 2 p A (1/h_T + 1/h_C) d^2. The largest
//! eigenvalue of the Hessian of E is (8/3) p A (1/h_T + 1/h_C) [N/m]. With a quarter of the mass of each tetrahedron at
//! each of its vertices and the density rho, the square of the angular frequency is (16 p / rho) (1/h_T + 1/h_C)^2.

use glam::{DVec3, DVec4};

use super::polygon::{Linear, Moments, Polygon, Side};
use super::tetrahedron::Tetrahedron;

/// Energy and forces of two overlapping tetrahedra, per unit of penalty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// Energy, I_T + I_C [m3].
    pub energy: f64,
    /// Forces on the vertices of T and of C: minus the gradient of the energy [m2].
    pub forces: [[DVec3; 4]; 2],
    /// Point of action of the resultant [m]: mean position of those parts of both surfaces that are inside the other
    /// tetrahedron, weighted by the potential.
    pub centre: DVec3,
}

impl Overlap {
    /// Returns the resultant force on tetrahedron C per unit of penalty [m2]. The resultant on T is opposite.
    pub fn resultant(&self) -> DVec3 {
        self.forces[1].iter().sum()
    }
}

/// If `Sum::weight`, divided by `Sum::energy`^(2/3), is at most this value [-], the weight consists of rounding errors
/// only, as for identical tetrahedra.
const NO_WEIGHT: f64 = 1e-12;

/// Computes the overlap of tetrahedra T and C from their vertices [m] (in any order); `None` if T and C do not overlap.
pub fn overlap(t: &[DVec3; 4], c: &[DVec3; 4]) -> Option<Overlap> {
    if are_boxes_apart(t, c) {
        return None;
    }
    let t = Tetrahedron::new(t)?;
    let c_in_t = c.map(|vertex| t.shape_functions(vertex));
    if are_outside_a_face(&c_in_t) {
        return None;
    }
    let c = Tetrahedron::new(c)?;
    let t_in_c = t.vertices.map(|vertex| c.shape_functions(vertex));
    if are_outside_a_face(&t_in_c) {
        return None;
    }
    let over_t = Potential { owner: &t, other: &c, other_in_owner: c_in_t, owner_in_other: t_in_c };
    let over_c = Potential { owner: &c, other: &t, other_in_owner: t_in_c, owner_in_other: c_in_t };
    let mut sum = Sum::default();
    over_t.add_to(&mut sum, [0, 1]);
    over_c.add_to(&mut sum, [1, 0]);
    let surfaces_count = sum.weight > NO_WEIGHT * sum.energy.abs().powf(2.0 / 3.0);
    let centre = if surfaces_count { sum.position / sum.weight } else { 0.5 * (t.centroid + c.centroid) };
    (sum.energy > 0.0).then_some(Overlap { energy: sum.energy, forces: sum.forces, centre })
}

/// Returns true if the bounding boxes of two tetrahedra do not overlap.
fn are_boxes_apart(t: &[DVec3; 4], c: &[DVec3; 4]) -> bool {
    let low = |v: &[DVec3; 4]| v[0].min(v[1]).min(v[2].min(v[3]));
    let high = |v: &[DVec3; 4]| v[0].max(v[1]).max(v[2].max(v[3]));
    low(t).cmpge(high(c)).any() || low(c).cmpge(high(t)).any()
}

/// Returns true if one face of a tetrahedron separates it from the four vertices of the other tetrahedron. These
/// vertices are given in the barycentric coordinates of the first tetrahedron.
fn are_outside_a_face(vertices: &[DVec4; 4]) -> bool {
    let highest = vertices[0].max(vertices[1]).max(vertices[2].max(vertices[3]));
    highest.cmple(DVec4::ZERO).any()
}

/// Sums of energy and forces over the potentials of both tetrahedra, per unit of penalty.
#[derive(Default)]
struct Sum {
    energy: f64,
    forces: [[DVec3; 4]; 2],
    /// Integral of the potentials over those parts of the surfaces that are inside the other tetrahedron [m2].
    weight: f64,
    /// Integral of the potentials times the position over the same parts [m3].
    position: DVec3,
}

/// The contact potential of a tetrahedron `owner` in its overlap with a tetrahedron `other` (T and C in the formulas).
struct Potential<'a> {
    owner: &'a Tetrahedron,
    other: &'a Tetrahedron,
    /// Vertices of each tetrahedron in the barycentric coordinates of the other tetrahedron [-].
    other_in_owner: [DVec4; 4],
    owner_in_other: [DVec4; 4],
}

impl Potential<'_> {
    /// Adds energy and forces of the potential to `sum`. `owner` and `other` are indices in `Sum::forces`.
    fn add_to(&self, sum: &mut Sum, [owner, other]: [usize; 2]) {
        let anchors = anchors(&self.owner_in_other);
        let mut integral = 0.75 * self.owner.volume * self.between_parts();
        for (k, corners) in FACES.iter().enumerate() {
            let Some(FaceIntegrals { per_part, at_corner }) = face_integrals(corners.map(|i| self.other_in_owner[i]))
            else {
                continue;
            };
            integral += 0.75 * self.other.volume * (0..4).map(|j| anchors[j][k] * per_part[j]).sum::<f64>();
            let area = self.other.area_vector(k);
            let (mut at_vertex, mut position) = (DVec4::ZERO, DVec3::ZERO);
            for (i, share) in corners.iter().zip(at_corner) {
                sum.forces[other][*i] -= share * area;
                at_vertex += share * self.other_in_owner[*i];
                position += share * self.other.vertices[*i];
            }
            for (force, share) in sum.forces[owner].iter_mut().zip(at_vertex.to_array()) {
                *force += share * area;
            }
            sum.weight += area.length() * at_corner.iter().sum::<f64>();
            sum.position += area.length() * position;
        }
        for (force, gradient) in sum.forces[owner].iter_mut().zip(self.owner.gradients) {
            *force -= integral * gradient;
        }
        sum.energy += integral;
    }

    /// Returns the integral q over the plane between parts 0 and 1 [-], see the comment of this module.
    fn between_parts(&self) -> f64 {
        let vertices = &self.owner_in_other;
        let centroid = 0.25 * (vertices[0] + vertices[1] + vertices[2] + vertices[3]);
        let inside = inside_tetrahedron(&coordinates([centroid, vertices[2], vertices[3]]));
        // The potential is 1 at the centroid and 0 at the vertices.
        inside.map_or(0.0, |polygon| polygon.integrate(Linear::with_values([1.0, 0.0, 0.0])).zeroth)
    }
}

/// For each vertex, the vertices of the face opposite to it.
const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]];

/// Returns the points a_j (see the comment of this module) from the vertices of the tetrahedron in any affine
/// coordinates. In barycentric coordinates, a_0 = (0, 2, -1/2, -1/2), a_1 = (2, 0, -1/2, -1/2) and
/// a_2 = a_3 = (1/2, 1/2, 0, 0).
fn anchors(vertices: &[DVec4; 4]) -> [DVec4; 4] {
    let middle = 0.5 * (vertices[0] + vertices[1]);
    let opposite = 0.5 * (vertices[2] + vertices[3]);
    [2.0 * vertices[1] - opposite, 2.0 * vertices[0] - opposite, middle, middle]
}

/// Integrals of a potential over the part of a face inside its owner, divided by the area of the face.
struct FaceIntegrals {
    /// Integral of the potential over the part where barycentric coordinate j is least, m_kj for face k [-].
    per_part: [f64; 4],
    /// Integral of the potential times the shape function of each corner of the face [-].
    at_corner: [f64; 3],
}

/// Returns the integrals over a face. Its corners are given in the barycentric coordinates of the owner of the
/// potential. Returns `None` if the face is outside the owner.
fn face_integrals(face: [DVec4; 3]) -> Option<FaceIntegrals> {
    let coordinates = coordinates(face);
    let inside = inside_tetrahedron(&coordinates)?;
    let (mut per_part, mut total) = ([0.0; 4], Moments::default());
    for_each_part(&inside, &coordinates, [0, 1], &mut |least, part| {
        let Moments { zeroth, first } = part.integrate(coordinates[least]);
        per_part[least] += 4.0 * zeroth;
        total.zeroth += 4.0 * zeroth;
        total.first += 4.0 * first;
    });
    let [s, t] = total.first.to_array();
    Some(FaceIntegrals { per_part, at_corner: [total.zeroth - s - t, s, t] })
}

/// Divides a polygon into parts in which one coordinate is the least. Calls `visit` with the number of this coordinate
/// and with the part. Among the coordinates with numbers below `next`, the coordinate number `least` is the least.
fn for_each_part(
    polygon: &Polygon,
    coordinates: &[Linear; 4],
    [least, next]: [usize; 2],
    visit: &mut impl FnMut(usize, &Polygon),
) {
    if next == 4 {
        return visit(least, polygon);
    }
    match polygon.side(coordinates[next] - coordinates[least]) {
        Side::Positive => for_each_part(polygon, coordinates, [least, next + 1], visit),
        Side::Negative => for_each_part(polygon, coordinates, [next, next + 1], visit),
        Side::Both(cut) => {
            for_each_part(&polygon.positive_part(&cut), coordinates, [least, next + 1], visit);
            for_each_part(&polygon.negative_part(&cut), coordinates, [next, next + 1], visit);
        }
    }
}

/// Returns barycentric coordinates as linear functions on a triangle, from their values at the corners of the triangle.
fn coordinates([a, b, c]: [DVec4; 3]) -> [Linear; 4] {
    let (a, b, c) = (a.to_array(), b.to_array(), c.to_array());
    [0, 1, 2, 3].map(|j| Linear::with_values([a[j], b[j], c[j]]))
}

/// Returns the part of a triangle inside a tetrahedron. `coordinates` are the barycentric coordinates on the triangle.
fn inside_tetrahedron(coordinates: &[Linear; 4]) -> Option<Polygon> {
    Polygon::triangle().clip(coordinates)
}
