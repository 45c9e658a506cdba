//! Principal axes of a symmetric matrix, by Jacobi's rotations.

use glam::{DMat3, DVec3};

/// Number of sweeps; each sweep has one rotation in each of the three coordinate planes. Off-diagonal elements converge
/// quadratically to zero, so six sweeps would be enough.
const SWEEPS: usize = 12;

/// Returns the principal values and axes of a symmetric matrix; the axes are columns of a right-handed matrix.
pub fn principal_axes(matrix: DMat3) -> (DVec3, DMat3) {
    let (mut m, mut axes) = (matrix, DMat3::IDENTITY);
    for _ in 0..SWEEPS {
        for [p, q] in [[0, 1], [0, 2], [1, 2]] {
            let off_diagonal = m.col(q)[p];
            if off_diagonal == 0.0 {
                continue;
            }
            // t is the tangent of the rotation angle: the smaller root of t^2 + 2 tau t - 1 = 0 (Golub and Van Loan,
            // section 8.5).
            let tau = (m.col(q)[q] - m.col(p)[p]) / (2.0 * off_diagonal);
            let t = tau.signum() / (tau.abs() + (1.0 + tau * tau).sqrt());
            let c = 1.0 / (1.0 + t * t).sqrt();
            let mut rotation = DMat3::IDENTITY;
            rotation.col_mut(p)[p] = c;
            rotation.col_mut(q)[q] = c;
            rotation.col_mut(q)[p] = t * c;
            rotation.col_mut(p)[q] = -t * c;
            m = rotation.transpose() * m * rotation;
            axes *= rotation;
        }
    }
    (DVec3::new(m.x_axis.x, m.y_axis.y, m.z_axis.z), axes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DQuat, EulerRot};

    #[test]
    fn principal_axes_make_the_matrix_diagonal() {
        let rotation = DMat3::from_quat(DQuat::from_euler(EulerRot::XYZ, 0.3, -1.1, 2.2));
        for given in [[5.0, 2.0, 7.0], [3.0, 3.0, 1.0], [4.0, 4.0, 4.0]] {
            let matrix = rotation * DMat3::from_diagonal(DVec3::from_array(given)) * rotation.transpose();
            let (values, axes) = principal_axes(matrix);
            // Tolerance: rounding.
            assert!((axes * DMat3::from_diagonal(values) * axes.transpose()).abs_diff_eq(matrix, 1e-14));
            assert!((axes.determinant() - 1.0).abs() < 1e-14);
            let mut sorted = (values.to_array(), given);
            sorted.0.sort_by(f64::total_cmp);
            sorted.1.sort_by(f64::total_cmp);
            assert!(sorted.0.iter().zip(sorted.1).all(|(a, b)| (a - b).abs() < 1e-14));
        }
    }
}
