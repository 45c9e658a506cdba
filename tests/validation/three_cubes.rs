//! Dam break against a stack of three cubes: the experiment of Canelas et al. (2016).

use std::{path::Path, sync::Arc};

use breakwater::{case::Case, simulation::Simulation};
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
            let dt = tank.begin_step().unwrap();
            tank.finish_step(dt).unwrap();
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
