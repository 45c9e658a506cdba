//! Compares a dam break against a stack of three cubes with the experiment of Canelas et al. (2016).

use std::{path::Path, sync::Arc};

use breakwater::{case::Case, simulation::flume::Simulation};
use glam::DVec3;
use serde_json::Value;

use super::data;

const TABLE: &str = "canelas2016_three_cubes.csv";
const FOLDER: &str = "canelas2016_three_cubes";

/// x of the back wall in the experiment's axes [m].
const BACK_WALL: f64 = -1.0;

/// A measured position with its error bar [m] at a time [s].
#[derive(Clone, Copy)]
struct Measured {
    time: f64,
    position: f64,
    error: f64,
}

/// Measured series: file name, number of the cube (0: lowest, 2: highest), axis (0: x, 2: z).
const SERIES: [(&str, usize, usize); 3] = [("x_bottom", 0, 0), ("x_top", 2, 0), ("z_top", 2, 2)];

/// Returns each of [`SERIES`] after the opening of the gate, from each source.
///
/// The same tolerance applies to both sources. The times of the table are within 0.03 s of published points, except for
/// z at 0.25 and 0.5 s, when the stack is at rest. The error bars of the table are interpolated like the positions.
fn measured() -> Vec<(&'static str, Vec<Vec<Measured>>)> {
    let after_opening = |rows: Vec<[f64; 3]>| {
        let measured = rows.into_iter().map(|[time, position, error]| Measured { time, position, error });
        measured.filter(|m| m.time > 0.0 && m.position.is_finite()).collect::<Vec<Measured>>()
    };
    let rows: Vec<[f64; 7]> = data::table_of(TABLE);
    let columns = |k: usize| after_opening(rows.iter().map(|row| [row[0], row[2 * k + 1], row[2 * k + 2]]).collect());
    let file = |(name, ..): &(&str, _, _)| data::series_of(&format!("{FOLDER}/{name}.csv")).map(after_opening);
    data::table_and_series((0..SERIES.len()).map(columns).collect(), SERIES.iter().map(file).collect())
}

/// Positions of the cubes [m] at times [s], in the axes of the experiment.
struct Paths(Vec<(f64, Vec<DVec3>)>);

impl Paths {
    /// Runs the case with the given particle spacing [m] and friction coefficient until `end` [s].
    fn computed(dp: f64, friction: f64, end: f64) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/verification/three-cubes.json");
        let mut case: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        case["domain"]["dp_m"] = dp.into();
        for pair in case["friction"].as_array_mut().unwrap() {
            pair["coefficient"] = friction.into();
        }
        let case = Case::from_str(&case.to_string(), "three-cubes.json").unwrap_or_else(|errors| panic!("{errors}"));
        let mut tank = Simulation::new(Arc::new(case)).unwrap();
        let positions = |tank: &Simulation| -> (f64, Vec<DVec3>) {
            let states = tank.units.as_ref().unwrap().states();
            (tank.time, states.iter().map(|state| state.position + DVec3::X * BACK_WALL).collect())
        };
        let mut paths = vec![positions(&tank)];
        while tank.time < end {
            tank.step().unwrap();
            paths.push(positions(&tank));
        }
        Self(paths)
    }

    fn at(&self, time: f64, cube: usize, axis: usize) -> f64 {
        let after = self.0.partition_point(|(t, _)| *t < time).clamp(1, self.0.len() - 1);
        let ((t0, a), (t1, b)) = (&self.0[after - 1], &self.0[after]);
        a[cube][axis] + (time - t0) / (t1 - t0) * (b[cube][axis] - a[cube][axis])
    }
}

/// Runs until `end` [s]. Returns, for each source and each of [`SERIES`], the deviation and the error bar of each point
/// [m].
fn deviations(dp: f64, friction: f64, end: f64) -> Vec<Vec<Vec<[f64; 2]>>> {
    let paths = Paths::computed(dp, friction, end);
    println!("dp = {dp} m, friction coefficient {friction}");
    measured().iter().map(|(source, series)| deviations_from(source, series, &paths, end)).collect()
}

fn deviations_from(source: &str, series: &[Vec<Measured>], paths: &Paths, end: f64) -> Vec<Vec<[f64; 2]>> {
    let compared = SERIES.iter().zip(series).map(|((name, cube, axis), series)| {
        let deviation = |m: &Measured| {
            let computed = paths.at(m.time, *cube, *axis);
            println!(
                "{source}, {name} at {:.3} s: {computed:.3} m, measured {:.3} +- {:.3} m, {:+.3} m",
                m.time,
                m.position,
                m.error,
                computed - m.position
            );
            [computed - m.position, m.error]
        };
        series.iter().filter(|m| m.time <= end).map(deviation).collect()
    });
    compared.collect()
}

/// Friction coefficient of PVC on PVC and on steel in the material table of the DualSPHysics examples [-].
const FRICTION: f64 = 0.45;
/// Friction coefficient with which [`sliding`] blocks move as the measured cubes do [-].
const INFERRED_FRICTION: f64 = 0.1;

/// Scatter of the first measured points around the position at rest [m]: x is 1.7742 to 1.7775 instead of 1.775, and z
/// is 0.3749 instead of 0.375.
const READING_ERROR: f64 = 0.0033;

#[test]
fn stack_is_at_rest_until_the_water_arrives() {
    // The lowest cube is left out, because its measured position moves 43 mm within 0.25 s of the opening of the gate.
    // No water can have reached the cube: by then, the fastest possible tip, 2 sqrt(g H) t with the depth H = 0.4 m,
    // has travelled 0.98 m of the 1.7 m.
    let sources = deviations(0.05, FRICTION, 0.53);
    for [deviation, error] in sources.iter().flat_map(|series| series[1..].iter().flatten()) {
        assert!(deviation.abs() <= error + READING_ERROR, "{deviation}");
    }
}

/// Returns depth [m] and velocity [m/s] of a dam-break wave on a dry frictionless bed at the distance `x` [m] from the
/// gate (Ritter 1892). `dam` is the water depth behind the gate [m]. The velocity is an upper bound.
fn bore(dam: f64, x: f64, time: f64) -> [f64; 2] {
    let c = (9.81 * dam).sqrt();
    let behind_tip = 2.0 * c - x / time;
    if time <= 0.0 || behind_tip <= 0.0 {
        return [0.0, 0.0];
    }
    [behind_tip.powi(2) / (9.0 * 9.81), 2.0 / 3.0 * (c + x / time)]
}

/// Returns the displacements [m] at increasing times [s] of three cubes that slide on each other and on the bed with
/// the same friction coefficient. The front of the lowest cube receives all momentum of the bore and its hydrostatic
/// pressure.
fn sliding(friction: f64, times: &[f64]) -> Vec<[f64; 3]> {
    let (edge, mass, dt) = (0.15, 2.7, 5e-4);
    let load = [3.0, 2.0, 1.0].map(|cubes| friction * cubes * mass * 9.81 * dt);
    let (mut position, mut velocity, mut positions) = ([0.0; 3], [0.0; 3], Vec::new());
    for step in 1.. {
        let Some(&next) = times.get(positions.len()) else { break };
        let time = f64::from(step) * dt;
        let [depth, speed] = bore(0.4, 1.7 + position[0], time);
        let force = 1000.0 * edge * depth * ((speed - velocity[0]).max(0.0).powi(2) + 0.5 * 9.81 * depth);
        velocity[0] += force / mass * dt;
        // A friction impulse prevents sliding as long as it is below the limit of Coulomb's law.
        let mut impulse = [0.0_f64; 3];
        for _ in 0..25 {
            for k in 0..3 {
                let sticking_impulse =
                    if k == 0 { -velocity[0] * mass } else { (velocity[k - 1] - velocity[k]) * 0.5 * mass };
                let change = (impulse[k] + sticking_impulse).clamp(-load[k], load[k]) - impulse[k];
                impulse[k] += change;
                velocity[k] += change / mass;
                if k > 0 {
                    velocity[k - 1] -= change / mass;
                }
            }
        }
        (0..3).for_each(|k| position[k] += velocity[k] * dt);
        if time >= next {
            positions.push(position);
        }
    }
    positions
}

/// With a friction coefficient of 0.45, even Ritter's wave cannot move the lowest cube from under the other cubes. The
/// necessary force is 72 N, six times the friction of one cube's weight, but the wave exerts only 59 N. With a friction
/// coefficient of 0.1, the wave can move the cube.
#[test]
fn bore_separates_a_stack_only_with_little_friction() {
    let times = [0.7602, 1.0046, 1.2524, 1.4967];
    for friction in [FRICTION, 0.3, 0.2, 0.15, INFERRED_FRICTION, 0.05] {
        println!("friction {friction}: lowest, middle, top at {times:?} s: {:.3?}", sliding(friction, &times));
    }
    let stays_together = |positions: &[[f64; 3]]| positions.iter().all(|[lowest, .., top]| lowest - top < 1e-3);
    assert!(stays_together(&sliding(FRICTION, &times)) && !stays_together(&sliding(INFERRED_FRICTION, &times)));
    let momentum = |time: f64| {
        let [depth, speed] = bore(0.4, 1.7, time);
        1000.0 * 0.15 * depth * speed * speed
    };
    println!("momentum flux of the wave [N]: {:.1?}", [0.6, 0.7, 0.8, 1.0, 1.25, 1.5].map(momentum));
    // A force of 6 mu m g is needed to accelerate the lowest cube faster than friction accelerates the two cubes on it.
    assert!(momentum(1.5) < 6.0 * FRICTION * 2.7 * 9.81);
}

/// This test fails. With the friction coefficient of the case, the water cannot move the lowest cube from under the
/// other cubes. With the inferred one, the lowest cube starts too late; see docs/validation/floating-bodies.md.
#[test]
#[ignore = "40 minutes on 2 cores, known to fail: \
    cargo test --release --test validation -- --ignored --nocapture cubes_move_as_measured"]
fn cubes_move_as_measured() {
    let runs = [[0.03, FRICTION], [0.03, INFERRED_FRICTION], [0.02, INFERRED_FRICTION], [0.02, FRICTION]];
    let sources: Vec<_> = runs.into_iter().flat_map(|[dp, friction]| deviations(dp, friction, 1.76)).collect();
    for [deviation, error] in sources.iter().flatten().flatten() {
        assert!(deviation.abs() <= error + READING_ERROR, "{deviation}");
    }
}
