//! Principal stresses of a stress tensor.

use glam::DMat3;

/// Computes the principal values of a symmetric tensor, the largest first (Smith 1961).
pub fn principal_stresses(t: DMat3) -> [f64; 3] {
    let mean = (t.x_axis.x + t.y_axis.y + t.z_axis.z) / 3.0;
    let deviator = t - DMat3::IDENTITY * mean;
    let squares =
        deviator.x_axis.length_squared() + deviator.y_axis.length_squared() + deviator.z_axis.length_squared();
    let p = (squares / 6.0).sqrt();
    if p == 0.0 {
        return [mean; 3];
    }
    let cosine = (0.5 * (deviator * p.recip()).determinant()).clamp(-1.0, 1.0);
    let angle = cosine.acos() / 3.0;
    let third = std::f64::consts::TAU / 3.0;
    let [largest, least] = [angle, angle + third].map(|angle| mean + 2.0 * p * angle.cos());
    [largest, 3.0 * mean - largest - least, least]
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DQuat, DVec3};

    #[test]
    fn principal_stresses_do_not_depend_on_the_axes() {
        let turn = DMat3::from_quat(DQuat::from_euler(glam::EulerRot::XYZ, 0.3, -1.1, 2.2));
        for given in [[5.0, 2.0, -7.0], [3.0, 3.0, -1.0], [4.0, 4.0, 4.0], [0.0, 0.0, 0.0]] {
            let tensor = turn * DMat3::from_diagonal(DVec3::from_array(given)) * turn.transpose();
            let found = principal_stresses(tensor);
            // Tolerance: if two principal stresses are equal, the error of `angle` is the square root of the rounding
            // error.
            assert!(found.iter().zip(given).all(|(a, b)| (a - b).abs() < 1e-6), "{found:?} {given:?}");
        }
    }
}
