//! Rigid bodies with prescribed velocities at some of their points.
//!
//! Each prescribed velocity component of a point gives one equation c . u = prescribed component. The vector u contains
//! the velocity and the angular velocity of the body; the vector c depends on the position of the point. Equations that
//! depend linearly on earlier equations are dropped, so at most six remain. The constraint impulse changes u so that
//! all remaining equations hold (Gauss's principle of least constraint).

use glam::{DMat3, DVec3};

/// Smallest length of the part of a row that is independent of earlier rows, divided by the length of the row [-]. A
/// row with a shorter independent part is dropped. This value is far above rounding errors and far below the share of
/// any constraint that has an effect.
const INDEPENDENT: f64 = 1e-6;
/// Number of degrees of freedom of a body.
const FREEDOMS: usize = 6;

/// Velocity of a rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidVelocity {
    /// Velocity of the centre of mass [m/s].
    pub velocity: DVec3,
    /// Angular velocity [rad/s].
    pub angular_velocity: DVec3,
}

/// Impulse on a rigid body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Impulse {
    /// Impulse of the force [N s].
    pub force: DVec3,
    /// Impulse of the torque about the centre of mass [N m s].
    pub torque: DVec3,
}

/// A prescribed velocity component of a point of a rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// Direction of the component.
    pub axis: DVec3,
    /// Position of the point relative to the centre of mass [m].
    pub arm: DVec3,
    /// Prescribed velocity along `axis` [m/s].
    pub velocity: f64,
}

type Vector = [f64; FREEDOMS];

fn dot(a: &Vector, b: &Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn join(a: DVec3, b: DVec3) -> Vector {
    [a.x, a.y, a.z, b.x, b.y, b.z]
}

fn parts(v: &Vector) -> [DVec3; 2] {
    [DVec3::from_slice(&v[..3]), DVec3::from_slice(&v[3..])]
}

/// Computes the impulse that gives a body the prescribed velocities of `rows`. The body has a mass [kg] and an inverse
/// inertia [1/(kg m2)]. Without the constraints, it would have the velocity `free`.
pub fn constraint_impulse(
    mass: f64,
    inverse_inertia: DMat3,
    free: RigidVelocity,
    rows: impl Iterator<Item = Row>,
) -> Impulse {
    // Angular velocities are multiplied by a radius of gyration, so that all components have the same unit.
    let trace = inverse_inertia.x_axis.x + inverse_inertia.y_axis.y + inverse_inertia.z_axis.z;
    let radius = (3.0 / (mass * trace)).sqrt();
    let free = join(free.velocity, free.angular_velocity * radius);
    let velocity_change = |impulse: &Vector| {
        let [force, torque] = parts(impulse);
        join(force / mass, inverse_inertia * torque * (radius * radius))
    };
    let mut directions: Vec<Vector> = Vec::with_capacity(FREEDOMS);
    let mut kept: Vec<(Vector, f64)> = Vec::with_capacity(FREEDOMS);
    for row in rows {
        let own = join(row.axis, row.arm.cross(row.axis) / radius);
        let mut rest = own;
        for direction in &directions {
            let along = dot(&rest, direction);
            rest.iter_mut().zip(direction).for_each(|(r, d)| *r -= along * d);
        }
        let length = dot(&rest, &rest).sqrt();
        if length > INDEPENDENT * dot(&own, &own).sqrt() {
            directions.push(rest.map(|r| r / length));
            kept.push((own, row.velocity));
            if kept.len() == FREEDOMS {
                break;
            }
        }
    }
    let count = kept.len();
    let mut system = [[0.0; FREEDOMS + 1]; FREEDOMS];
    for (i, (row, given)) in kept.iter().enumerate() {
        for (j, (other, _)) in kept.iter().enumerate() {
            system[i][j] = dot(row, &velocity_change(other));
        }
        system[i][FREEDOMS] = given - dot(row, &free);
    }
    let solution = solve(system, count);
    let mut impulse = [0.0; FREEDOMS];
    for ((row, _), share) in kept.iter().zip(solution) {
        impulse.iter_mut().zip(row).for_each(|(sum, r)| *sum += share * r);
    }
    let [force, torque] = parts(&impulse);
    Impulse { force, torque: torque * radius }
}

/// Solves the first `count` equations of a positive definite system by Gaussian elimination.
fn solve(mut system: [[f64; FREEDOMS + 1]; FREEDOMS], count: usize) -> Vector {
    for pivot in 0..count {
        for row in pivot + 1..count {
            let share = system[row][pivot] / system[pivot][pivot];
            let above = system[pivot];
            system[row].iter_mut().zip(above).for_each(|(own, above)| *own -= share * above);
        }
    }
    let mut solution = [0.0; FREEDOMS];
    for row in (0..count).rev() {
        let known: f64 = (row + 1..count).map(|column| system[row][column] * solution[column]).sum();
        solution[row] = (system[row][FREEDOMS] - known) / system[row][row];
    }
    solution
}

#[cfg(test)]
mod tests {
    use super::*;

    fn after(rows: &[Row], free: RigidVelocity) -> RigidVelocity {
        let (mass, inverse_inertia) = (2.0, DMat3::from_diagonal(DVec3::new(1.0, 4.0, 9.0)));
        let impulse = constraint_impulse(mass, inverse_inertia, free, rows.iter().copied());
        RigidVelocity {
            velocity: free.velocity + impulse.force / mass,
            angular_velocity: free.angular_velocity + inverse_inertia * impulse.torque,
        }
    }

    const FREE: RigidVelocity =
        RigidVelocity { velocity: DVec3::new(1.0, 2.0, 3.0), angular_velocity: DVec3::new(4.0, 5.0, 6.0) };

    #[test]
    fn constrained_points_get_their_velocity_and_other_motion_stays_free() {
        let row = |axis, arm, velocity| Row { axis, arm, velocity };
        let corners =
            [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::new(1.0, 1.0, 0.0)].map(|x| x - DVec3::new(0.5, 0.5, 1.0));
        // The points lie in a plane, and only their velocity along z is prescribed. The body then cannot rotate about x
        // and y; all other motion stays as without constraints.
        let rows: Vec<Row> = corners.iter().map(|arm| row(DVec3::Z, *arm, -7.0)).collect();
        let moved = after(&rows, FREE);
        let expected =
            RigidVelocity { velocity: DVec3::new(1.0, 2.0, -7.0), angular_velocity: DVec3::new(0.0, 0.0, 6.0) };
        // Tolerance: rounding.
        assert!((moved.velocity - expected.velocity).length() < 1e-13);
        assert!((moved.angular_velocity - expected.angular_velocity).length() < 1e-13);
        // All components of all points are prescribed as zero: the body is at rest.
        let rows: Vec<Row> = corners.iter().flat_map(|arm| DVec3::AXES.map(|axis| row(axis, *arm, 0.0))).collect();
        let held = after(&rows, FREE);
        assert!(held.velocity.length() < 1e-13 && held.angular_velocity.length() < 1e-13);
        // One fixed point: the body rotates about it.
        let arm = corners[1];
        let hinged = after(&DVec3::AXES.map(|axis| row(axis, arm, 0.0)), FREE);
        assert!((hinged.velocity + hinged.angular_velocity.cross(arm)).length() < 1e-13);
        assert!(hinged.angular_velocity.length() > 1.0);
        assert_eq!(after(&[], FREE), FREE);
    }
}
