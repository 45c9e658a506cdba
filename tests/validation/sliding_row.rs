//! The row of the Fudo experiment as a sliding block: how far does the 2.6 cm wave push it, with the forces on the held
//! row in OpenFOAM and in breakwater (docs/validation/floating-bodies.md)? This separates the forces from the other
//! inputs, because the block needs only the velocity of the flume model above the bare crest.
//!
//! Drag and lift are proportional to the square of the relative velocity. The pressure gradient and the added mass are
//! those of Morison et al. (1950); friction is that of Coulomb. One block stands for both units, because the units touch
//! each other.
//!
//! The block is a rough estimate: the row does not slow the water, the added mass is that of a unit alone, and the block
//! has its whole buoyancy also where its top is above the water. Beyond 0.16 m, the units would leave the crest.

use std::sync::Arc;

use breakwater::{case::Case, simulation::flume::Simulation};
use serde_json::Value;

/// Level of the crest of the mound, as published [m].
const CREST_Z: f64 = 0.717;
/// Friction coefficient, as published [-].
const FRICTION: f64 = 0.32;
/// Measured mean displacement of the inner units for the 2.6 cm wave [m].
const MEASURED: f64 = 0.095;

/// Mass of a unit [kg], and that of the water that it displaces.
const MASS: f64 = 0.3;
const DISPLACED: f64 = 0.1276;
/// Added mass of a Tetrapod in potential flow (`tools/potential-flow/tetrapod`) [kg].
const ADDED: f64 = 0.622 * DISPLACED;

/// Mean drag and lift of the two units of the held row in a stream of [`Push::SPEED`] [N].
#[derive(Debug, Clone, Copy)]
struct Push {
    drag: f64,
    lift: f64,
}

impl Push {
    const SPEED: f64 = 0.39;
    const OPENFOAM: Self = Self { drag: 0.464, lift: 0.16 };
    /// breakwater with a particle spacing of 9 mm, and of 14 mm.
    const FINE: Self = Self { drag: 0.694, lift: 0.065 };
    const COARSE: Self = Self { drag: 0.487, lift: 0.01 };

    /// Multiplies the drag.
    fn with_more_drag(self, factor: f64) -> Self {
        Self { drag: factor * self.drag, ..self }
    }
}

/// Times [s] and velocities [m/s] of the water above the crest; the velocity has the mean square over the height of a
/// unit.
struct Stream {
    times: Vec<f64>,
    speeds: Vec<f64>,
}

impl Stream {
    /// Computes the 2.6 cm wave in the flume model, with the crest of the mound at a level [m].
    fn over_crest(level: f64) -> Self {
        let text = std::fs::read_to_string("cases/fudo/H2.6-slice.json").unwrap();
        let mut case: Value = serde_json::from_str(&text).unwrap();
        case.as_object_mut().unwrap().remove("reference");
        case["domain"]["dp_m"] = 0.014.into();
        case["flume"]["mound"]["crest_z_m"] = level.into();
        let case = Case::from_str(&case.to_string(), "test").unwrap_or_else(|errors| panic!("{errors}"));
        let record = Simulation::new(Arc::new(case)).unwrap().flume.clone().unwrap();
        let heights = [0.1, 0.3, 0.5, 0.7, 0.9].map(|share| share * 0.077);
        let speed = |time: f64| {
            let squares = heights.map(|height| record.velocity(39.0, level + height, time).0).map(|u| u * u.abs());
            let mean = squares.iter().sum::<f64>() / 5.0;
            mean.abs().sqrt().copysign(mean)
        };
        let times = record.times_s().to_vec();
        Self { speeds: times.iter().map(|&time| speed(time)).collect(), times }
    }

    /// Multiplies the velocity.
    fn faster(&self, factor: f64) -> Self {
        Self { times: self.times.clone(), speeds: self.speeds.iter().map(|speed| factor * speed).collect() }
    }

    /// Returns how far the wave pushes the block [m]. (The water that flows back later would push it seaward.)
    fn pushes(&self, push: Push, friction: f64) -> f64 {
        let [drag, lift] = [push.drag, push.lift].map(|force| force / Push::SPEED.powi(2));
        let (mut way, mut furthest, mut velocity) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (times, speeds) in self.times.windows(2).zip(self.speeds.windows(2)) {
            // 20 parts of an interval of the record: with 50 parts, the way changes by less than 1 mm.
            let parts = 20;
            let interval = (times[1] - times[0]) / f64::from(parts);
            let acceleration = (speeds[1] - speeds[0]) / (times[1] - times[0]);
            for part in 0..parts {
                let relative = speeds[0] + acceleration * interval * f64::from(part) - velocity;
                let force = drag * relative * relative.abs() + (DISPLACED + ADDED) * acceleration;
                let load = ((MASS - DISPLACED) * 9.81 - lift * relative.powi(2)).max(0.0);
                let impulse = (MASS + ADDED) * velocity + force * interval;
                // Friction can at most stop the block.
                let rest = (impulse.abs() - friction * load * interval).max(0.0);
                velocity = rest.copysign(impulse) / (MASS + ADDED);
                way += velocity * interval;
                furthest = furthest.max(way);
            }
        }
        furthest
    }
}

#[test]
fn published_inputs_hardly_move_a_block() {
    let stream = Stream::over_crest(CREST_Z);
    // OpenFOAM's drag is too small: the measured drag of a round cylinder is 1.25 times as large, and the measured loss
    // of round bars is 1.58 times as large.
    let way = [1.0, 1.25, 1.58].map(|factor| stream.pushes(Push::OPENFOAM.with_more_drag(factor), FRICTION));
    let fine = stream.pushes(Push::FINE, FRICTION);
    println!("way of a block with the drag of OpenFOAM times 1, 1.25 and 1.58: {way:.3?} m; 9 mm: {fine:.3} m");
    // Reached: 0.000, 0.018 and 0.065 m; 0.043 m. In the particle simulation with 9 mm, the units move 0.061 m, so the
    // block moves a third less: limit 0.4 for this error. The limit for the second factor is half of the measured
    // displacement: a block that moves a third further would stay below the measured one. With the last factor, it could
    // reach the measured one, so the limit, 0.8, only shows that the block itself does not.
    assert!(way.is_sorted() && way[1] < 0.5 * MEASURED && way[2] < 0.8 * MEASURED, "{way:?}");
    assert!((fine / 0.061 - 1.0).abs() < 0.4, "{fine}");
}

/// Prints the table of docs/validation/fudo-notes.md: which other inputs would give the measured displacement?
#[test]
#[ignore = "a minute on one core: \
    cargo test --release --test validation -- --ignored --nocapture inputs_that_move_a_block"]
fn inputs_that_move_a_block_as_measured() {
    let published = Stream::over_crest(CREST_Z);
    let higher = [0.722, 0.727, 0.732].map(Stream::over_crest);
    let openfoam = [1.0, 1.25, 1.58].map(|factor| Push::OPENFOAM.with_more_drag(factor));
    for push in openfoam.into_iter().chain([Push::FINE, Push::COARSE]) {
        let friction = [0.32, 0.28, 0.24, 0.20].map(|friction| published.pushes(push, friction));
        let speed = [1.05, 1.1, 1.2].map(|factor| published.faster(factor).pushes(push, FRICTION));
        let crest = [0, 1, 2].map(|k: usize| higher[k].pushes(push, FRICTION));
        println!("{push:?}: friction 0.32, 0.28, 0.24, 0.20: {friction:.3?} m");
        println!("    faster by 5, 10 and 20 %: {speed:.3?} m; crest higher by 5, 10 and 15 mm: {crest:.3?} m");
        assert!(friction.is_sorted() && speed.is_sorted() && crest.is_sorted());
    }
}
