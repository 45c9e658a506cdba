//! Multi-layer piston: a wavemaker in the particle domain whose rows follow the water of a flume run.
//!
//! Altomare, Dominguez, Crespo, Suzuki, Caceres & Gomez-Gesteira (2015), "Hybridization of the wave propagation model
//! SWASH and the meshfree particle method SPH for real coastal applications". The rows are a Lagrangian wall. They
//! follow the water that is at the piston's rest position x0 when the particle run starts. This water, at (X, Z), moves
//! by dX/dt = u(X, Z, t), dZ/dt = w(X, Z, t). An integral of the Eulerian u(x0, t) would make the stroke too short.
//!
//! The rows move in x only, whereas the water also rises and falls. Therefore water particles are tracked in x and z:
//! one that starts at the height of each row in the water, and one at the surface. The velocity of a row is
//! interpolated in height between the tracked particles. A row below the lowest or above the highest particle gets the
//! velocity of this particle.

use std::io;

use crate::waves::flume_model::record::FlumeRecord;
use crate::waves::generation::absorption::Absorption;
use crate::waves::generation::velx::Velx;

/// Motion of the rows of a multi-layer piston.
#[derive(Debug, Clone, PartialEq)]
pub struct MlPiston {
    rest_x_m: f64,
    row_heights_m: Vec<f64>,
    start_s: f64,
    interval_s: f64,
    /// Velocities at the knots, which are evenly spaced times [m/s]; one list per row.
    velocities: Vec<Vec<f64>>,
    /// Displacements at the knots [m], one list per row.
    displacements: Vec<Vec<f64>>,
    absorption: Option<Absorption>,
}

impl MlPiston {
    /// Creates rows at levels z [m] that start at `x0_m` and follow the water of a flume run from start to end [s].
    /// Velocities are stored at knots, `interval_s` apart.
    ///
    /// In periodic waves the water drifts shoreward at the surface and seaward below, so the rows would move apart.
    /// `return_time_s` is the time constant [s] with which rows and tracked particles return to their initial
    /// positions; use a few wave periods. With `None` they do not return.
    ///
    /// The recorded window must contain the whole path of the water, up to about 1 m from x0. Outside the window, the
    /// velocity at the nearest end of the window is used.
    ///
    /// # Panics
    /// If there is no row, the interval is not positive, the end is not after the start, or x0 is outside the window.
    pub fn from_record(
        record: &FlumeRecord,
        x0_m: f64,
        row_heights_m: &[f64],
        [start_s, end_s]: [f64; 2],
        interval_s: f64,
        return_time_s: Option<f64>,
    ) -> Self {
        assert!(
            !row_heights_m.is_empty() && interval_s > 0.0 && end_s > start_s,
            "a piston needs rows, an interval > 0 and end > start"
        );
        let window = &record.window_x_m;
        assert!((window[0]..=window[window.len() - 1]).contains(&x0_m), "x0 = {x0_m} m is outside the window");
        let knots = ((end_s - start_s) / interval_s).ceil() as usize + 1;
        let initial = particles_at_start(record, x0_m, row_heights_m, start_s);
        let mut particles = initial.clone();
        let mut displacements = vec![0.0; row_heights_m.len()];
        let mut velocities = vec![Vec::with_capacity(knots); row_heights_m.len()];
        for knot in 0..knots {
            let t = start_s + knot as f64 * interval_s;
            let mut speeds: Vec<[f64; 2]> = particles.iter().map(|&[x, z]| [z, record.velocity(x, z, t).0]).collect();
            // Sort by height, because the order of particles can change at the bed or at a broken surface.
            speeds.sort_by(|a, b| a[0].total_cmp(&b[0]));
            for ((series, displacement), &height) in velocities.iter_mut().zip(&mut displacements).zip(row_heights_m) {
                let velocity =
                    velocity_at_height(&speeds, height) - return_time_s.map_or(0.0, |time| *displacement / time);
                *displacement += interval_s * velocity;
                series.push(velocity);
            }
            for (particle, initial) in particles.iter_mut().zip(&initial) {
                *particle = track_particle(record, *particle, t, interval_s);
                if let Some(time) = return_time_s {
                    let share = 1.0 - (-interval_s / time).exp();
                    for (coordinate, start) in particle.iter_mut().zip(initial) {
                        *coordinate += share * (start - *coordinate);
                    }
                }
            }
        }
        Self::from_velocities(x0_m, row_heights_m.to_vec(), start_s, interval_s, velocities)
    }

    /// Creates rows at levels z [m] that move with the velocities of a flume run at the fixed position `x_m`, from start
    /// to end [s]. Velocities are stored at knots, `interval_s` apart.
    pub fn at_fixed_place(
        record: &FlumeRecord,
        x_m: f64,
        row_heights_m: &[f64],
        [start_s, end_s]: [f64; 2],
        interval_s: f64,
    ) -> Self {
        let knots = ((end_s - start_s) / interval_s).ceil() as usize + 1;
        let velocity = |z: f64, knot: usize| record.velocity(x_m, z, start_s + knot as f64 * interval_s).0;
        let velocities = row_heights_m.iter().map(|&z| (0..knots).map(|knot| velocity(z, knot)).collect()).collect();
        Self::from_velocities(x_m, row_heights_m.to_vec(), start_s, interval_s, velocities)
    }

    /// Creates rows that move with the velocities of a file from start to end [s], in the time of the file.
    ///
    /// The file has the velocities at one position x. With a celerity c [m/s], a row displaced by X has the velocity of
    /// the file at the time t - X / c, as in a wave of permanent form. Without c, it has the velocity at the time t.
    /// Velocities are stored at knots, `interval_s` apart.
    pub fn from_velx(rows: &Velx, [start_s, end_s]: [f64; 2], interval_s: f64, celerity_m_s: Option<f64>) -> Self {
        let knots = ((end_s - start_s) / interval_s).ceil() as usize + 1;
        let motion = |row: usize| {
            let mut x = 0.0;
            let velocity = |x: f64, t: f64| row_velocity(rows, row, t - celerity_m_s.map_or(0.0, |c| x / c));
            let mut series = Vec::with_capacity(knots);
            for knot in 0..knots {
                let t = start_s + knot as f64 * interval_s;
                let u = velocity(x, t);
                // Heun's method integrates the displacement.
                x += 0.5 * interval_s * (u + velocity(x + interval_s * u, t + interval_s));
                series.push(u);
            }
            series
        };
        let velocities = (0..rows.heights_m[0].len()).map(motion).collect();
        Self::from_velocities(rows.position_m[0], rows.heights_m[0].clone(), start_s, interval_s, velocities)
    }

    /// Creates the motion from velocities at evenly spaced knots; the displacement is their trapezoidal integral.
    fn from_velocities(
        rest_x_m: f64,
        row_heights_m: Vec<f64>,
        start_s: f64,
        interval_s: f64,
        velocities: Vec<Vec<f64>>,
    ) -> Self {
        let integrate = |series: &Vec<f64>| {
            let mut displacement = 0.0;
            let mut integral = vec![0.0];
            for pair in series.windows(2) {
                displacement += 0.5 * (pair[0] + pair[1]) * interval_s;
                integral.push(displacement);
            }
            integral
        };
        let displacements = velocities.iter().map(integrate).collect();
        Self { rest_x_m, row_heights_m, start_s, interval_s, velocities, displacements, absorption: None }
    }

    /// Adds active absorption, which moves all rows together.
    pub fn with_absorption(self, absorption: Absorption) -> Self {
        Self { absorption: Some(absorption), ..self }
    }

    /// Active absorption, if any.
    pub fn absorption(&self) -> Option<&Absorption> {
        self.absorption.as_ref()
    }

    /// Levels z of the rows [m].
    pub fn row_heights_m(&self) -> &[f64] {
        &self.row_heights_m
    }

    /// Rest position x of the rows [m].
    pub fn rest_x_m(&self) -> f64 {
        self.rest_x_m
    }

    /// Time at which the rows start to move [s].
    pub fn start_s(&self) -> f64 {
        self.start_s
    }

    /// Time at which the rows stop [s].
    pub fn end_s(&self) -> f64 {
        self.start_s + (self.velocities[0].len() - 1) as f64 * self.interval_s
    }

    /// Displacement of a row [m] at flume time t [s]: 0 before the start, constant after the end. Between two knots it
    /// is a parabola, because the velocity is linear in time.
    pub fn displacement_m(&self, row: usize, t: f64) -> f64 {
        let (v, d) = (&self.velocities[row], &self.displacements[row]);
        match self.locate(t) {
            Knot::Before => 0.0,
            Knot::After => d[d.len() - 1],
            Knot::At(i, share) => d[i] + self.interval_s * share * (v[i] + 0.5 * share * (v[i + 1] - v[i])),
        }
    }

    /// Largest seaward displacement of a row from its rest position [m]. Returns 0 if it is smaller than the row
    /// spacing, because the particle layers behind the rows then prevent a gap.
    pub fn max_seaward_displacement_m(&self) -> f64 {
        let generated = self.displacements.iter().flatten().fold(0.0_f64, |least, &d| least.min(d));
        let furthest = generated - self.max_absorbed_displacement_m();
        let spacing = self.row_heights_m.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        if -furthest < spacing { 0.0 } else { -furthest }
    }

    /// Largest shoreward displacement of a row from its rest position [m].
    pub fn max_shoreward_displacement_m(&self) -> f64 {
        self.displacements.iter().flatten().fold(0.0_f64, |most, &d| most.max(d)) + self.max_absorbed_displacement_m()
    }

    /// Limit of the displacement that absorption adds, seaward or shoreward [m]; 0 without absorption.
    fn max_absorbed_displacement_m(&self) -> f64 {
        self.absorption.map_or(0.0, |absorption| absorption.max_displacement_m)
    }

    /// Velocity of a row [m/s] at flume time t [s]: linear between knots, 0 before the start and after the end. The
    /// velocity jumps at the start or end if the water moves at that time.
    pub fn velocity_m_s(&self, row: usize, t: f64) -> f64 {
        let v = &self.velocities[row];
        match self.locate(t) {
            Knot::Before | Knot::After => 0.0,
            Knot::At(i, share) => v[i] + share * (v[i + 1] - v[i]),
        }
    }

    /// Finds the knots between which the time t [s] lies.
    fn locate(&self, t: f64) -> Knot {
        let offset = (t - self.start_s) / self.interval_s;
        let intervals = self.velocities[0].len() - 1;
        if offset < 0.0 {
            Knot::Before
        } else if offset >= intervals as f64 {
            Knot::After
        } else {
            Knot::At(offset as usize, offset.fract())
        }
    }

    /// Velocities in DualSPHysics' `_velx` format; time counts from the start of the motion.
    pub fn velx(&self) -> Velx {
        let knots = self.velocities[0].len();
        Velx {
            position_m: [self.rest_x_m, 0.0],
            times_s: (0..knots).map(|i| i as f64 * self.interval_s).collect(),
            heights_m: vec![self.row_heights_m.clone(); knots],
            velocities_m_s: (0..knots).map(|i| self.velocities.iter().map(|series| series[i]).collect()).collect(),
        }
    }

    /// Writes the `_velx` file.
    pub fn write_velx(&self, out: impl io::Write) -> io::Result<()> {
        self.velx().write(out)
    }
}

/// Position of a time among the knots. `At` has the index of the knot before the time and the elapsed share of the
/// interval.
enum Knot {
    Before,
    At(usize, f64),
    After,
}

/// Velocity of a row [m/s] at t [s]: linear in time, constant before the first and after the last time of the file.
fn row_velocity(rows: &Velx, row: usize, t: f64) -> f64 {
    let times = &rows.times_s;
    let after = times.partition_point(|&time| time <= t);
    let velocity = |i: usize| rows.velocities_m_s[i][row];
    if after == 0 || after == times.len() {
        return velocity(after.saturating_sub(1));
    }
    let share = (t - times[after - 1]) / (times[after] - times[after - 1]);
    velocity(after - 1) + share * (velocity(after) - velocity(after - 1))
}

/// First time [s] at which the mean speed of the rows below the level `below_z_m` reaches `share` of its maximum.
pub fn velx_start_time(rows: &Velx, below_z_m: f64, share: f64) -> f64 {
    let wet = rows.heights_m[0].partition_point(|&z| z < below_z_m).max(1);
    let mean = |velocities: &Vec<f64>| (velocities[..wet].iter().sum::<f64>() / wet as f64).abs();
    let speeds: Vec<f64> = rows.velocities_m_s.iter().map(mean).collect();
    let largest = speeds.iter().copied().fold(0.0, f64::max);
    let first = speeds.iter().position(|&speed| largest > 0.0 && speed >= share * largest);
    rows.times_s[first.unwrap_or(0)]
}

/// First recorded time [s] at which the depth-mean speed of the water at x0 reaches `share` of its maximum. Returns the
/// end of the record if the water never moves.
pub fn motion_start_time(record: &FlumeRecord, x0_m: f64, share: f64) -> f64 {
    let speeds: Vec<f64> = record.times_s().iter().map(|&t| record.mean_velocity(x0_m, t).abs()).collect();
    let largest = speeds.iter().copied().fold(0.0, f64::max);
    let first = speeds.iter().position(|&speed| largest > 0.0 && speed >= share * largest);
    first.map_or(record.end_s(), |i| record.times_s()[i])
}

/// Start positions of the tracked particles: one per row in the water and one at the surface.
fn particles_at_start(record: &FlumeRecord, x0_m: f64, row_heights_m: &[f64], start_s: f64) -> Vec<[f64; 2]> {
    let (bed, surface) = (record.profile.z(x0_m), record.surface_level_m(x0_m, start_s));
    let mut heights: Vec<f64> = row_heights_m.iter().copied().filter(|z| (bed..surface).contains(z)).collect();
    heights.push(surface);
    heights.sort_by(f64::total_cmp);
    heights.into_iter().map(|z| [x0_m, z]).collect()
}

/// Moves a water particle by `dt` with the classical Runge-Kutta method and keeps it between bed and surface.
fn track_particle(record: &FlumeRecord, [x, z]: [f64; 2], t: f64, dt: f64) -> [f64; 2] {
    let rate = |shift: f64, [kx, kz]: [f64; 2]| {
        let (u, w) = record.velocity(x + shift * kx, z + shift * kz, t + shift);
        [u, w]
    };
    let k1 = rate(0.0, [0.0; 2]);
    let k2 = rate(0.5 * dt, k1);
    let k3 = rate(0.5 * dt, k2);
    let k4 = rate(dt, k3);
    let step = |i: usize| dt / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]);
    let x = x + step(0);
    let bed = record.profile.z(x);
    [x, (z + step(1)).clamp(bed, record.surface_level_m(x, t + dt).max(bed))]
}

/// Velocity at a height, from [height, velocity] pairs of increasing height: linear between pairs, constant outside.
fn velocity_at_height(speeds: &[[f64; 2]], height: f64) -> f64 {
    let above = speeds.partition_point(|s| s[0] <= height);
    if above == 0 {
        return speeds[0][1];
    }
    if above == speeds.len() {
        return speeds[above - 1][1];
    }
    let ([z0, u0], [z1, u1]) = (speeds[above - 1], speeds[above]);
    u0 + (u1 - u0) * (height - z0) / (z1 - z0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::profile::Profile;
    use crate::waves::flume_model::layered::Column;

    const AMPLITUDE: f64 = 0.3;

    /// u of a wave of period 4 s and length 8 m, uniform over the depth.
    fn wave(x: f64, t: f64) -> f64 {
        AMPLITUDE * (std::f64::consts::TAU * (t / 4.0 - x / 8.0)).sin()
    }

    /// `wave` in water 1 m deep, recorded every 0.02 s and 0.05 m.
    fn record() -> FlumeRecord {
        let profile = Profile::new(vec![[0.0, 0.0], [4.0, 0.0]]);
        let window: Vec<f64> = (0..=80).map(|i| 0.05 * f64::from(i)).collect();
        let mut record = FlumeRecord::new(profile, 1.0, 2, 0.02, vec![], window.clone());
        for r in 0..=300 {
            let t = 0.02 * f64::from(r);
            let column = |x: &f64| Column { surface_m: 1.0, bed_m: 0.0, u: vec![wave(*x, t); 2], w: vec![0.0; 3] };
            record.push(0.0, &[], window.iter().map(column));
        }
        record
    }

    #[test]
    fn rows_follow_the_water() {
        let record = record();
        let piston = MlPiston::from_record(&record, 1.0, &[0.2, 0.9, 1.4], [0.5, 4.5], 0.02, None);
        let (mut x, mut t, dt) = (1.0, 0.5, 1e-4);
        for i in 0..30_000 {
            let middle = x + 0.5 * dt * wave(x, t);
            x += dt * wave(middle, t + 0.5 * dt);
            t = 0.5 + dt * f64::from(i + 1);
            if i % 3000 == 0 {
                for row in 0..3 {
                    // The error of the trapezoidal rule is dt^2 / 12 times the change of du/dt. With dt = 0.02 s and a
                    // change of at most 0.9 m/s2, it is 3e-5 m.
                    assert!((piston.displacement_m(row, t) - (x - 1.0)).abs() < 5e-5);
                }
            }
        }
        // Integrating the Eulerian u(x0, t) gives a different displacement.
        let eulerian: f64 = (0..30_000).map(|i| dt * wave(1.0, 0.5 + dt * f64::from(i))).sum();
        assert!((eulerian - (x - 1.0)).abs() > 0.02);
    }

    #[test]
    fn velocity_is_the_derivative_and_rows_rest_outside_the_motion() {
        let piston = MlPiston::from_record(&record(), 1.0, &[0.2, 0.9], [0.5, 2.5], 0.1, None);
        for i in 0..40 {
            let (t, h) = (0.53 + 0.0481 * f64::from(i), 1e-6);
            let slope = (piston.displacement_m(0, t + h) - piston.displacement_m(0, t - h)) / (2.0 * h);
            // If a knot lies between t - h and t + h, slope and velocity differ by at most h times 0.5 m/s2.
            assert!((slope - piston.velocity_m_s(0, t)).abs() < 1e-6);
        }
        assert_eq!((piston.displacement_m(0, 0.4), piston.velocity_m_s(0, 0.4)), (0.0, 0.0));
        assert_eq!(piston.velocity_m_s(0, 9.0), 0.0);
        let last = piston.displacement_m(0, piston.end_s() - 1e-9);
        assert!((piston.displacement_m(0, 9.0) - last).abs() < 1e-8);
    }

    #[test]
    fn velocity_is_linear_between_particles_and_constant_beyond() {
        let speeds = [[0.1, 1.0], [0.3, 2.0]];
        assert_eq!([0.0, 0.1, 0.3, 9.0].map(|z| velocity_at_height(&speeds, z)), [1.0, 1.0, 2.0, 2.0]);
        assert!((velocity_at_height(&speeds, 0.25) - 1.75).abs() < 1e-12);
    }

    #[test]
    fn start_time_is_when_the_velocity_reaches_the_share() {
        // At x = 0, |sin| reaches half its maximum after a twelfth of the period.
        let start = motion_start_time(&record(), 0.0, 0.5);
        assert!((start - 4.0 / 12.0).abs() <= 0.02);
    }

    #[test]
    fn velx_file_lists_the_rows() {
        let piston = MlPiston::from_record(&record(), 1.0, &[0.2, 0.9], [0.5, 0.56], 0.02, None);
        let mut file = Vec::new();
        piston.write_velx(&mut file).unwrap();
        let text = String::from_utf8(file).unwrap();
        assert!(text.starts_with("px:;1;py:;0\n"));
        let second: Vec<f64> = text.lines().nth(3).unwrap().split(';').map(|field| field.parse().unwrap()).collect();
        assert_eq!((&second[1..3], second[3]), (&[0.2, 0.9][..], piston.velocities[0][1]));
    }
}
