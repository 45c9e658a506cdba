//! Buoyancy of a Tetrapod by Archimedes' law: on the bed or above it, submerged or half submerged.

use breakwater::geometry::armour_unit::ArmourUnit;
use breakwater::simulation::flume::unit_setup::particles_of;
use glam::{DQuat, DVec3};
use serde_json::{Value, json};

use super::tanks::{BareTank, GRAVITY, RHO0, UNIT_HEIGHT, run_until, simulation, tank_with_held_unit, volume_below};

/// Side of the square tank [m]: three heights of the unit.
const LENGTH: f64 = 0.24;

/// Simulated time [s]; the water settles in the first half.
const DURATION: f64 = 0.24;

/// Mean force on a unit in the second half of a run, divided by Archimedes' force [-]. 1 is subtracted from the
/// vertical part.
#[derive(Debug, Clone, Copy)]
struct Deviation {
    vertical: f64,
    horizontal: f64,
}

impl Deviation {
    fn of(name: &str, mean: DVec3, displaced: f64) -> Self {
        let share = mean / (RHO0 * GRAVITY * displaced);
        let deviation = Self { vertical: share.z - 1.0, horizontal: share.truncate().length() };
        let percent = [deviation.vertical, deviation.horizontal].map(|part| 100.0 * part);
        println!("{name}: vertical {:+.2} %, horizontal {:.2} % of {:.3} N", percent[0], percent[1], mean.z / share.z);
        deviation
    }
}

/// Returns the deviation for a unit on the bed in water of a depth [m], from a flume run.
fn on_bed(depth: f64, dp: f64) -> Deviation {
    on_bed_in(&tank_with_held_unit(LENGTH, depth, dp, DURATION), depth, dp)
}

fn on_bed_in(case: &Value, depth: f64, dp: f64) -> Deviation {
    let mut tank = simulation(case);
    let (mut sum, mut count) = (DVec3::ZERO, 0.0);
    run_until(&mut tank, DURATION, |now| {
        if now.time > 0.5 * DURATION {
            sum += now.units.as_ref().unwrap().fluid_loads[0].force;
            count += 1.0;
        }
    });
    let units = tank.units.as_ref().unwrap();
    let state = units.states()[0];
    // The unit stands upright, so only its height matters.
    let displaced = volume_below(units.shape.solid(), depth - state.position.z);
    Deviation::of(&format!("standing in {depth} m, dp = {dp} m"), sum / count, displaced)
}

/// Returns the deviation for a unit held with its centre of mass at a height [m] in water of a depth [m], from the bare
/// solver.
fn above_bed(centre_z: f64, depth: f64, dp: f64) -> Deviation {
    let unit = ArmourUnit::tetrapod(UNIT_HEIGHT, 0.05).unwrap();
    // The centre lies off the lattice of the water.
    let centre = DVec3::new(0.5 * LENGTH + 0.3 * dp, 0.5 * LENGTH + 0.1 * dp, centre_z);
    let mut tank = BareTank::new(LENGTH, depth, dp, &particles_of(&unit, dp));
    tank.hold(&unit, centre, DQuat::IDENTITY);
    let (mut time, mut sum, mut count) = (0.0, DVec3::ZERO, 0.0);
    while time < DURATION {
        time += tank.step(|tank| {
            if time > 0.5 * DURATION {
                sum += tank.solver.unit_loads(&tank.boundary, &[centre])[0].force;
                count += 1.0;
            }
        });
    }
    let displaced = volume_below(unit.solid(), depth - centre_z);
    Deviation::of(&format!("centre at {centre_z} m in {depth} m, dp = {dp} m"), sum / count, displaced)
}

#[test]
fn volume_below_a_level_is_between_zero_and_the_whole() {
    let unit = ArmourUnit::tetrapod(UNIT_HEIGHT, 0.05).unwrap();
    let (solid, whole) = (unit.solid(), unit.solid().volume_properties().volume);
    // Limit 1e-12: rounding.
    assert!((volume_below(solid, 1.0) / whole - 1.0).abs() < 1e-12);
    assert_eq!(volume_below(solid, -1.0), 0.0);
    let half = volume_below(solid, 0.0) / whole;
    assert!((0.4..0.7).contains(&half), "{half}");
}

impl Deviation {
    /// Asserts that vertical and horizontal deviations are below these limits.
    fn assert_below(self, vertical: f64, horizontal: f64) {
        assert!(self.vertical.abs() < vertical && self.horizontal < horizontal, "{self:?}");
    }
}

// The limits are the values reached with 8 particles per unit height, rounded up, to detect a regression.
// An error of dp / 30 in the position of the surface changes the volume of a ball as large as the unit by 3 %, and the
// volume of a Tetrapod by more.

#[test]
fn a_submerged_unit_on_the_bed_has_its_buoyancy() {
    on_bed(0.16, 0.01).assert_below(0.03, 0.01);
}

/// Without the pressure through gaps between unit and bed, the water presses on a foot from above only.
#[test]
fn without_gap_pressure_the_water_presses_a_unit_down() {
    let mut case = tank_with_held_unit(LENGTH, 0.16, 0.01, DURATION);
    case["numerics"]["gap_pressure"] = json!(false);
    let held_down = on_bed_in(&case, 0.16, 0.01);
    // The water presses the unit down with a force larger than its buoyancy. In a tank with closed sides, this force is
    // 1.7 times the buoyancy. The unit stands in the middle, so the horizontal force is small: 0.01 of the buoyancy.
    assert!(held_down.vertical < -2.0 && held_down.horizontal < 0.05, "{held_down:?}");
}

#[test]
fn a_half_submerged_unit_on_the_bed_has_its_buoyancy() {
    // The water is four particles deep.
    on_bed(0.04, 0.01).assert_below(0.06, 0.01);
}

#[test]
fn a_submerged_unit_above_the_bed_has_its_buoyancy() {
    above_bed(0.09, 0.18, 0.01).assert_below(0.04, 0.01);
}

#[test]
fn a_half_submerged_unit_above_the_bed_has_its_buoyancy() {
    above_bed(0.09, 0.1, 0.01).assert_below(0.04, 0.02);
}

/// Returns all four deviations: on and above the bed, submerged and half submerged.
fn all_deviations(dp: f64) -> [Deviation; 4] {
    [on_bed(0.16, dp), on_bed(0.04, dp), above_bed(0.09, 0.18, dp), above_bed(0.09, 0.1, dp)]
}

#[test]
#[ignore = "5 minutes on 2 cores: \
    cargo test --release --test verification -- --ignored --nocapture buoyancy_holds_at_coarse_and_fine"]
fn buoyancy_holds_at_coarse_and_fine_resolution() {
    for (dp, vertical) in [(0.015, 0.15), (0.0075, 0.04)] {
        all_deviations(dp).into_iter().for_each(|deviation| deviation.assert_below(vertical, 0.05));
    }
}

#[test]
#[ignore = "20 minutes on 2 cores: \
    cargo test --release --test verification -- --ignored --nocapture buoyancy_holds_at_full_resolution"]
fn buoyancy_holds_at_full_resolution() {
    all_deviations(0.005).into_iter().for_each(|deviation| deviation.assert_below(0.04, 0.01));
}
