//! Motion and forces of each unit over time, from `units.csv`.

use crate::output::{OutputError, Table};

/// Averaging time of the initial water force, before the wave arrives [s].
const START_S: f64 = 0.2;

/// Motion and forces of one unit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct UnitMotion {
    /// Number of the unit, from 1.
    pub unit: u32,
    /// Flume time [s].
    pub time_s: Vec<f64>,
    /// Centre of mass [m].
    pub position_m: Vec<[f64; 3]>,
    /// Orientation as a quaternion x, y, z, w.
    pub orientation: Vec<[f64; 4]>,
    /// Velocity of the centre of mass [m/s].
    pub velocity_m_s: Vec<[f64; 3]>,
    /// Force of the water [N]; NaN in a first row that was written before the first time step.
    pub fluid_n: Vec<[f64; 3]>,
    /// Contact force from bed and neighbouring units [N].
    pub contact_n: Vec<[f64; 3]>,
}

impl UnitMotion {
    /// Component (0 to 2: x, y, z) of the water force over time, minus the mean of this component over the first 0.2 s
    /// [N].
    pub fn fluid_change_n(&self, component: usize) -> Vec<f64> {
        let first = self.time_s.first().copied().unwrap_or(0.0);
        let at_start: Vec<f64> = (self.time_s.iter().zip(&self.fluid_n))
            .filter(|(t, _)| **t <= first + START_S)
            .map(|(_, force)| force[component])
            .filter(|force| force.is_finite())
            .collect();
        let initial_mean = at_start.iter().sum::<f64>() / at_start.len().max(1) as f64;
        self.fluid_n.iter().map(|force| force[component] - initial_mean).collect()
    }

    /// Magnitude of the contact force from bed and neighbouring units over time [N].
    pub fn contact_size_n(&self) -> Vec<f64> {
        self.contact_n.iter().map(magnitude).collect()
    }

    /// Speed of the centre of mass over time [m/s].
    pub fn speed_m_s(&self) -> Vec<f64> {
        self.velocity_m_s.iter().map(magnitude).collect()
    }

    /// Returns position and orientation at the recorded time nearest to `time_s` [s]; `None` without recorded times.
    pub fn at(&self, time_s: f64) -> Option<Pose> {
        self.nearest(time_s).map(|i| self.pose(i))
    }

    /// Returns the index of the recorded time nearest to `time_s` [s]; `None` without recorded times.
    pub fn nearest(&self, time_s: f64) -> Option<usize> {
        let last = self.time_s.len().checked_sub(1)?;
        let after = self.time_s.partition_point(|time| *time < time_s).min(last);
        let before = after.saturating_sub(1);
        let distance = |i: usize| (self.time_s[i] - time_s).abs();
        Some(if distance(before) <= distance(after) { before } else { after })
    }

    /// Returns position and orientation at the first and the last recorded time; `None` without recorded times.
    pub fn ends(&self) -> Option<[Pose; 2]> {
        let last = self.time_s.len().checked_sub(1)?;
        Some([0, last].map(|i| self.pose(i)))
    }

    fn pose(&self, index: usize) -> Pose {
        Pose { position_m: self.position_m[index], orientation: self.orientation[index] }
    }
}

fn magnitude(v: &[f64; 3]) -> f64 {
    v.iter().map(|c| c * c).sum::<f64>().sqrt()
}

/// Position and orientation of a unit.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Pose {
    /// Centre of mass [m].
    pub position_m: [f64; 3],
    /// Quaternion x, y, z, w.
    pub orientation: [f64; 4],
}

impl Pose {
    /// Transforms a point from body axes to flume axes [m].
    pub fn place(&self, body: [f64; 3]) -> [f64; 3] {
        let [x, y, z, w] = self.orientation;
        let q = [x, y, z];
        // The quaternion with the vector part q and the scalar part w rotates v to v + 2 q x (q x v + w v).
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let inner = cross(q, body);
        let turned = cross(q, [0, 1, 2].map(|i| inner[i] + w * body[i]));
        [0, 1, 2].map(|i| self.position_m[i] + body[i] + 2.0 * turned[i])
    }
}

/// Groups the rows of `units.csv` by unit.
///
/// # Errors
/// If a column is missing.
pub fn motions(units: &Table) -> Result<Vec<UnitMotion>, OutputError> {
    let column = |name: &str| units.column(name);
    let (time, number) = (column("time_s")?, column("unit")?);
    let position = [column("x_m")?, column("y_m")?, column("z_m")?];
    let orientation = [column("qx")?, column("qy")?, column("qz")?, column("qw")?];
    let velocity = [column("vx_m_s")?, column("vy_m_s")?, column("vz_m_s")?];
    let fluid = [column("fluid_fx_n")?, column("fluid_fy_n")?, column("fluid_fz_n")?];
    let contact = [column("contact_fx_n")?, column("contact_fy_n")?, column("contact_fz_n")?];
    let mut motions: Vec<UnitMotion> = Vec::new();
    for row in 0..units.rows() {
        let unit = number[row] as u32;
        let index = motions.iter().position(|m| m.unit == unit).unwrap_or_else(|| {
            motions.push(UnitMotion { unit, ..UnitMotion::default() });
            motions.len() - 1
        });
        let motion = &mut motions[index];
        motion.time_s.push(time[row]);
        motion.position_m.push(position.map(|c| c[row]));
        motion.orientation.push(orientation.map(|c| c[row]));
        motion.velocity_m_s.push(velocity.map(|c| c[row]));
        let force = fluid.map(|c| c[row]);
        // The first row may be written before the first time step computes the forces.
        let unknown = motion.fluid_n.is_empty() && force == [0.0; 3];
        motion.fluid_n.push(if unknown { [f64::NAN; 3] } else { force });
        motion.contact_n.push(contact.map(|c| c[row]));
    }
    motions.sort_by_key(|motion| motion.unit);
    Ok(motions)
}

/// Returns mean and standard deviation over the units at each recorded time.
pub fn mean_and_deviation(histories: &[Vec<f64>]) -> (Vec<f64>, Vec<f64>) {
    let length = histories.iter().map(Vec::len).min().unwrap_or(0);
    let count = histories.len().max(1) as f64;
    (0..length)
        .map(|i| {
            let mean = histories.iter().map(|h| h[i]).sum::<f64>() / count;
            let square = histories.iter().map(|h| (h[i] - mean).powi(2)).sum::<f64>() / count;
            (mean, square.sqrt())
        })
        .unzip()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::output::columns;

    #[test]
    fn a_quarter_turn_about_the_vertical_maps_x_to_y() {
        let half = std::f64::consts::FRAC_PI_4;
        let pose = Pose { position_m: [39.0, 0.0, 1.0], orientation: [0.0, 0.0, half.sin(), half.cos()] };
        let placed = pose.place([0.1, 0.0, 0.02]);
        for (value, expected) in placed.into_iter().zip([39.0, 0.1, 1.02]) {
            assert!((value - expected).abs() < 1e-12);
        }
    }

    #[test]
    fn a_force_not_yet_computed_is_nan() {
        let row = |time: f64, force: f64| {
            let mut row = vec![0.0; columns::UNITS.len()];
            (row[0], row[1], row[15]) = (time, 1.0, force);
            row.iter().map(f64::to_string).collect::<Vec<_>>().join(",")
        };
        let text = [columns::UNITS.join(","), row(0.0, 0.0), row(0.1, 2.0), row(0.2, 0.0)].join("\n");
        let motions = motions(&Table::parse(Path::new("units.csv"), &text).unwrap()).unwrap();
        assert!(motions[0].fluid_n[0][0].is_nan());
        assert_eq!(motions[0].fluid_n[1..], [[2.0, 0.0, 0.0], [0.0; 3]]);
        assert_eq!(motions[0].at(0.14).unwrap(), motions[0].pose(1));
    }

    #[test]
    fn the_initial_mean_force_is_subtracted() {
        let motion = UnitMotion {
            time_s: vec![0.0, 0.1, 0.2, 1.0],
            fluid_n: vec![[f64::NAN; 3], [1.0, 0.0, 2.0], [3.0, 0.0, 2.0], [7.0, 0.0, 2.0]],
            ..UnitMotion::default()
        };
        assert_eq!(motion.fluid_change_n(0)[1..], [-1.0, 1.0, 5.0]);
        let (mean, deviation) = mean_and_deviation(&[vec![1.0, 2.0], vec![3.0, 2.0]]);
        assert_eq!((mean, deviation), (vec![2.0, 2.0], vec![1.0, 0.0]));
    }
}
