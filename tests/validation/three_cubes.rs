//! Dam break against a stack of three cubes: the experiment of Canelas et al. (2016).

use std::{path::Path, sync::Arc};

use breakwater::{case::Case, simulation::flume::Simulation};
use glam::DVec3;
use serde_json::Value;

use super::data;

const FOLDER: &str = "canelas2016_three_cubes";

/// x of the back wall in the experiment's axes [m].
const BACK_WALL: f64 = -1.0;

/// A measured place with its error bar [m] at a time [s].
#[derive(Clone, Copy)]
struct Measured {
    time: f64,
    place: f64,
    error: f64,
}

/// What was measured: file, number of the cube from the lowest, axis.
const SERIES: [(&str, usize, usize); 3] = [("x_bottom", 0, 0), ("x_top", 2, 0), ("z_top", 2, 2)];

/// A series from the gate's opening on; `None` where the data do not lie beside the crate.
fn measured(name: &str) -> Option<Vec<Measured>> {
    let rows = data::rows_of::<3>(&format!("{FOLDER}/{name}.csv"))?;
    let measured = rows.into_iter().map(|[time, place, error]| Measured { time, place, error });
    Some(measured.filter(|measured| measured.time > 0.0).collect())
}

/// Places of the cubes [m] at times [s], in the experiment's axes.
struct Paths(Vec<(f64, Vec<DVec3>)>);

impl Paths {
    fn of(dp: f64, end: f64) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/verification/three-cubes.json");
        let mut case: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        case["domain"]["dp_m"] = dp.into();
        let case = Case::from_str(&case.to_string(), "three-cubes.json").unwrap_or_else(|errors| panic!("{errors}"));
        let mut tank = Simulation::new(Arc::new(case)).unwrap();
        let places = |tank: &Simulation| -> (f64, Vec<DVec3>) {
            let states = tank.units.as_ref().unwrap().states();
            (tank.time, states.iter().map(|state| state.position + DVec3::X * BACK_WALL).collect())
        };
        let mut paths = vec![places(&tank)];
        while tank.time < end {
            tank.step().unwrap();
            paths.push(places(&tank));
        }
        Self(paths)
    }

    fn at(&self, time: f64, cube: usize, axis: usize) -> f64 {
        let after = self.0.partition_point(|(t, _)| *t < time).clamp(1, self.0.len() - 1);
        let ((t0, a), (t1, b)) = (&self.0[after - 1], &self.0[after]);
        a[cube][axis] + (time - t0) / (t1 - t0) * (b[cube][axis] - a[cube][axis])
    }
}

/// Deviations [m] of each series of a run up to `end` [s] from the measurement, with their error bars [m].
fn deviations(dp: f64, end: f64) -> Option<Vec<Vec<[f64; 2]>>> {
    let series: Vec<Vec<Measured>> = SERIES.iter().map(|(name, ..)| measured(name)).collect::<Option<_>>()?;
    let paths = Paths::of(dp, end);
    let compared = SERIES.iter().zip(series).map(|((name, cube, axis), series)| {
        let of = |m: &Measured| {
            let computed = paths.at(m.time, *cube, *axis);
            println!(
                "dp = {dp} m, {name} at {:.3} s: {computed:.3} m, measured {:.3} +- {:.3} m, {:+.3} m",
                m.time,
                m.place,
                m.error,
                computed - m.place
            );
            [computed - m.place, m.error]
        };
        series.iter().filter(|m| m.time <= end).map(of).collect()
    });
    Some(compared.collect())
}

/// What the first points of a series scatter round the place at rest [m]: 1.7742 to 1.7775 and 0.3749, for 1.775 and
/// 0.375.
const READING: f64 = 0.0033;

#[test]
fn the_stack_stands_until_the_water_comes() {
    let Some(series) = deviations(0.05, 0.53) else { return };
    // The lowest cube is left out: its measured place grows by 43 mm within 0.25 s of the gate's opening, when no water
    // can be there: the fastest possible tip, 2 sqrt(g H) t, has gone 0.98 m of the 1.7 m then.
    for [deviation, error] in series[1..].iter().flatten() {
        assert!(deviation.abs() <= error + READING, "{deviation}");
    }
}

/// Depth [m] and velocity [m/s] of the wave of a dam break of depth `dam` [m] on a dry bed without friction, `x` [m] from
/// the gate: Ritter (1892), the fastest that there is.
fn bore(dam: f64, x: f64, time: f64) -> [f64; 2] {
    let c = (9.81 * dam).sqrt();
    let behind_tip = 2.0 * c - x / time;
    if time <= 0.0 || behind_tip <= 0.0 {
        return [0.0, 0.0];
    }
    [behind_tip.powi(2) / (9.0 * 9.81), 2.0 / 3.0 * (c + x / time)]
}

/// Places [m] of three cubes that slide on each other and on the bed with one coefficient of friction, at times [s] that
/// rise: the lowest takes all the momentum that the bore brings to its front, and its pressure at rest besides.
fn sliding(friction: f64, times: &[f64]) -> Vec<[f64; 3]> {
    let (edge, mass, dt) = (0.15, 2.7, 5e-4);
    let load = [3.0, 2.0, 1.0].map(|cubes| friction * cubes * mass * 9.81 * dt);
    let (mut place, mut velocity, mut places) = ([0.0; 3], [0.0; 3], Vec::new());
    for step in 1.. {
        let Some(&next) = times.get(places.len()) else { break };
        let time = f64::from(step) * dt;
        let [depth, speed] = bore(0.4, 1.7 + place[0], time);
        let force = 1000.0 * edge * depth * ((speed - velocity[0]).max(0.0).powi(2) + 0.5 * 9.81 * depth);
        velocity[0] += force / mass * dt;
        // Impulses of friction: none is larger than Coulomb's law allows, and those that stick let nothing slide.
        let mut impulse = [0.0_f64; 3];
        for _ in 0..25 {
            for k in 0..3 {
                let wanted = if k == 0 { -velocity[0] * mass } else { (velocity[k - 1] - velocity[k]) * 0.5 * mass };
                let change = (impulse[k] + wanted).clamp(-load[k], load[k]) - impulse[k];
                impulse[k] += change;
                velocity[k] += change / mass;
                if k > 0 {
                    velocity[k - 1] -= change / mass;
                }
            }
        }
        (0..3).for_each(|k| place[k] += velocity[k] * dt);
        if time >= next {
            places.push(place);
        }
    }
    places
}

/// Even Ritter's wave does not push the lowest cube from under the others if friction is 0.45: that takes six times the
/// friction of one cube's weight, 72 N, and the wave has 59 N. With 0.1 it does.
#[test]
fn the_bore_parts_a_slippery_stack_only() {
    let times = [0.7602, 1.0046, 1.2524, 1.4967];
    for friction in [0.45, 0.3, 0.2, 0.15, 0.1, 0.05] {
        println!("friction {friction}: lowest, middle, top at {times:?} s: {:.3?}", sliding(friction, &times));
    }
    let together = |places: &[[f64; 3]]| places.iter().all(|[lowest, .., top]| lowest - top < 1e-3);
    assert!(together(&sliding(0.45, &times)) && !together(&sliding(0.1, &times)));
    let momentum = |time: f64| {
        let [depth, speed] = bore(0.4, 1.7, time);
        1000.0 * 0.15 * depth * speed * speed
    };
    println!("momentum of the wave [N]: {:.1?}", [0.6, 0.7, 0.8, 1.0, 1.25, 1.5].map(momentum));
    // To accelerate the lowest cube faster than friction can the two on it, 6 mu m g.
    assert!(momentum(1.5) < 6.0 * 0.45 * 2.7 * 9.81);
}

/// `cargo test --release --test validation -- --ignored --nocapture the_cubes_go_as_measured`
///
/// It fails: at dp = 0.03 m the water comes late and is too weak to carry the lowest cube from under the others; see
/// docs/validation.md.
#[test]
#[ignore = "20 minutes on 2 cores, and known to fail"]
fn the_cubes_go_as_measured() {
    for dp in [0.03, 0.02] {
        let Some(series) = deviations(dp, 1.76) else { return };
        for [deviation, error] in series.iter().flatten() {
            assert!(deviation.abs() <= error + READING, "dp = {dp} m: {deviation}");
        }
    }
}
