//! Regions of different particle spacing: still water and a wave at their interfaces, and conservation of mass.

use std::sync::OnceLock;

use breakwater::simulation::flume::Simulation;
use glam::{DVec2, DVec3};
use serde_json::{Value, json};

use super::tanks::{GRAVITY, RHO0, run_until, simulation};

/// Depth of the water [m].
const DEPTH: f64 = 0.3;

/// Returns the case of still water in a tank with ranges of fine water in its middle.
fn still_case(dp: f64, fine: &[[f64; 2]], duration: f64) -> Value {
    json!({
        "title": "Still water with finer water in the middle",
        "flume": { "bed_m": [[0.0, 0.0], [10.0, 0.0]], "still_water_level_m": DEPTH },
        "domain": { "x_m": [0.0, 3.0], "sides": "two_dimensional", "top_z_m": 0.5, "dp_m": dp,
                    "fine_x_m": fine },
        "fluid": { "sound_speed_factor": 10.0 },
        "wave": { "kind": "none" },
        "stop": { "duration_s": duration }
    })
}

/// Returns the mass of the water of all regions, with the mass between the regions [kg]. The sum is constant if every
/// particle that crosses an interface is counted.
fn mass(simulation: &Simulation) -> f64 {
    let own = |region: &Simulation| -> f64 {
        let water = &region.water;
        (0..water.len()).filter(|&i| region.owns(water.position[i].x)).map(|i| water.mass[i]).sum()
    };
    simulation.regions().map(own).sum::<f64>() + simulation.mass_between_regions()
}

/// Returns the root mean square of the speed of the water of all regions [m/s].
fn rms_speed(simulation: &Simulation) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for region in simulation.regions() {
        let water = region.water.position.iter().zip(&region.water.velocity);
        for (_, velocity) in water.filter(|(position, _)| region.owns(position.x)) {
            sum += velocity.length_squared();
            count += 1.0;
        }
    }
    f64::sqrt(sum / count)
}

/// Returns the mass of the water of all regions [kg]; a particle near an interface counts for both regions, for each in
/// proportion to its distance from the interface, up to the spacing `coarse` [m]. In contrast to [`mass`], this mass
/// does not depend on the moment at which a column of particles crosses an interface.
fn shared_mass(simulation: &Simulation, coarse: f64) -> f64 {
    let own = |region: &Simulation| -> f64 {
        let [from, to] = region.own_x();
        let share = |inside: f64| (0.5 + 0.5 * inside / coarse).clamp(0.0, 1.0);
        let of_particle = |(position, mass): (&DVec3, &f64)| mass * share(position.x - from) * share(to - position.x);
        region.water.position.iter().zip(&region.water.mass).map(of_particle).sum()
    };
    simulation.regions().map(own).sum()
}

/// Largest errors of still water: rms speed over sqrt(g d), and mean pressure error over the pressure on the bed.
struct Errors {
    rms: f64,
    pressure: f64,
}

/// Runs still water; checks the mass. `moved(time)` is how far the ends of the fine water have moved [m]; the last move
/// must be more than one second before the end.
fn still_water(dp: f64, fine: &[[f64; 2]], duration: f64, moved: impl Fn(f64) -> [f64; 2] + Send + Sync) -> Errors {
    let mut tank = simulation(&still_case(dp, fine, duration));
    let start = mass(&tank);
    let places = [0.5, 0.8, 0.9, 1.0, 1.1, 1.2, 1.5, 1.9, 2.0, 2.1];
    let (mut rms, mut pressures, mut readings, mut largest_between) = (0.0_f64, [0.0; 10], 0.0, 0.0_f64);
    let mut shared = [f64::MAX, f64::MIN];
    let mut filled = 0.0;
    run_until(&mut tank, duration, |now| {
        let wanted = moved(now.time);
        if wanted != now.moved {
            now.move_regions(wanted).unwrap();
            filled = now.time;
        }
        largest_between = largest_between.max(now.mass_between_regions().abs());
        // One second removes the errors of the lattice on which the particles start. Water that a moving range fills
        // starts on a lattice, too.
        if now.time < 1.0 || now.steps % 20 > 1 {
            return;
        }
        let of_now = shared_mass(now, 2.0 * dp);
        shared = [shared[0].min(of_now), shared[1].max(of_now)];
        if now.time >= filled + 1.0 {
            rms = rms.max(rms_speed(now) / (GRAVITY * DEPTH).sqrt());
        }
        readings += 1.0;
        for (sum, x) in pressures.iter_mut().zip(places) {
            let sample = now.region_at(x).sampler().sample(DVec3::new(x, 0.5 * dp, 0.1)).unwrap();
            *sum += sample.pressure / (RHO0 * GRAVITY * DEPTH) - 2.0 / 3.0;
        }
    });
    let pressure = pressures.iter().map(|sum: &f64| (sum / readings).abs()).fold(0.0, f64::max);
    let lost = mass(&tank) / start - 1.0;
    let [between, varies] = [largest_between, shared[1] - shared[0]].map(|mass| mass / start);
    println!(
        "dp {dp} m, {duration} s: rms speed {:.3} % of sqrt(g d), pressure error {:.2} % of the pressure on the bed, \
         mass {lost:+.1e}, at most {:.2} % of it between the regions; shared mass varies by {varies:.1e}",
        100.0 * rms,
        100.0 * pressure,
        100.0 * between
    );
    // Rounding of the sum over some thousand particles.
    assert!(lost.abs() < 1e-12);
    // One column of the coarser particles at each interface, because a column crosses an interface at once: two columns
    // of 2 dp, and with a second range also two of 4 dp.
    let spacings = if fine.len() > 1 { 6.0 } else { 2.0 };
    assert!(between < 2.0 * spacings * dp / 3.0);
    Errors { rms, pressure }
}

/// Checks that still water is as calm as in a tank with the same spacing everywhere, and its pressure error at most 1 %
/// or that of such a tank. 20 % for the rms speed is the scatter of such tanks.
fn assert_still(Errors { rms, pressure }: &Errors, uniform: &Errors) {
    assert!(*rms < 1.2 * uniform.rms && *pressure < uniform.pressure.max(0.01));
}

/// Returns the errors with a spacing [m] everywhere.
fn uniform(dp: f64, duration: f64) -> Errors {
    still_water(dp, &[], duration, fixed)
}

/// Returns the errors with 0.01 m everywhere after 2.5 s, for two tests.
fn uniform_10_mm() -> &'static Errors {
    static ERRORS: OnceLock<Errors> = OnceLock::new();
    ERRORS.get_or_init(|| uniform(0.01, 2.5))
}

/// No end of the fine water moves.
fn fixed(_: f64) -> [f64; 2] {
    [0.0; 2]
}

#[test]
fn still_water_stays_still_at_interfaces() {
    let dp = 0.01;
    let tank = simulation(&still_case(dp, &[[1.0, 2.0]], 1.0));
    assert_eq!(tank.regions().map(|region| region.case.domain.dp).collect::<Vec<_>>(), [dp, 2.0 * dp, 2.0 * dp]);
    assert_still(&still_water(dp, &[[1.0, 2.0]], 2.5, fixed), uniform_10_mm());
}

#[test]
fn still_water_stays_still_with_three_spacings() {
    assert_still(&still_water(0.01, &[[1.2, 1.8], [0.72, 2.28]], 2.5, fixed), &uniform(0.04, 2.5));
}

#[test]
fn still_water_stays_still_when_the_fine_water_moves() {
    // After one second, the fine water moves by 0.04 m every 0.1 s, its shoreward end twice as far.
    let moved = |time: f64| {
        let moves = (10.0 * (time - 1.0)).floor().clamp(0.0, 8.0);
        [0.04 * moves, 0.08 * moves]
    };
    assert_still(&still_water(0.01, &[[1.0, 2.0]], 3.5, moved), uniform_10_mm());
}

/// The fine water can move away from the places where the units were at the start, and the units can move through its
/// former ends. The unit is moved by hand.
#[test]
fn fine_water_follows_units_past_its_former_ends() {
    let mut case: Value = serde_json::from_str(include_str!("../../cases/fudo/H4.5-slice.json")).unwrap();
    let case_of_file = case.as_object_mut().unwrap();
    case_of_file.remove("reference");
    case_of_file.remove("gauges");
    case["domain"] = json!({ "x_m": [37.9, 40.15], "sides": "two_dimensional", "top_z_m": 1.1, "dp_m": 0.007,
                             "fine_x_m": [[38.8, 39.2]] });
    case["wavemaker"] = json!({ "kind": "open_ends" });
    case["units"] = json!({ "shape": "cuboid", "size_m": [0.06, 0.06, 0.06], "mass_kg": 0.5, "material": "mortar",
                            "centres_m": [[39.0, 0.03, 0.747]] });
    let mut slice = simulation(&case);
    run_until(&mut slice, 0.004, |_| ());
    let (start, ends) = (mass(&slice), slice.own_x());
    let far = slice.units.as_ref().unwrap().states()[0].position.x + 0.3;
    // Move the unit in small steps; the fine water follows by one hop at a time.
    while slice.units.as_ref().unwrap().states()[0].position.x < far {
        let world = &mut slice.units.as_mut().unwrap().world;
        let mut snapshot = serde_json::to_value(world.snapshot()).unwrap();
        let position = &mut snapshot["bodies"][0]["position"];
        // Above the water, so that no water is inside the unit.
        *position = json!([position[0].as_f64().unwrap() + 0.02, position[1], 1.0]);
        world.restore(&serde_json::from_value(snapshot).unwrap()).unwrap();
        slice.place_boundary();
        slice.step().unwrap();
    }
    let now = slice.own_x();
    assert!((0..2).all(|end| (now[end] - ends[end] - 0.3).abs() < 0.03), "{ends:?} {now:?}");
    // Water also flows through the open ends, in about fifteen time steps less than a thousandth of all water.
    assert!((mass(&slice) / start - 1.0).abs() < 1e-3);
}

/// Takes five minutes: `cargo test --release --test verification -- --ignored --nocapture ten_seconds`
#[test]
#[ignore = "takes five minutes"]
fn still_water_stays_still_for_ten_seconds() {
    assert_still(&still_water(0.005, &[[1.0, 2.0]], 10.0, fixed), &uniform(0.005, 10.0));
}

/// Runs a solitary wave through an empty domain; returns its largest elevation at the gauges [m], and times [s] and
/// elevations [m] at the first gauge.
fn solitary_wave(dp: f64, fine: &Value, gauges: &[f64], duration: f64) -> (Vec<f64>, Vec<[f64; 2]>) {
    let mut case = json!({
        "title": "A wave passes through fine water",
        "flume": { "bed_m": [[0.0, 0.0], [30.0, 0.0]], "still_water_level_m": DEPTH,
                   "right_end": { "kind": "sponge", "length_m": 10.0 } },
        "domain": { "x_m": [8.0, 11.0], "sides": "two_dimensional", "top_z_m": 0.5, "dp_m": dp },
        "numerics": { "cfl": 0.4 },
        "fluid": { "sound_speed_factor": 10.0 },
        "wave": { "kind": "solitary", "height_m": 0.08 },
        "wavemaker": { "kind": "open_ends" },
        "stop": { "duration_s": duration }
    });
    if !fine.is_null() {
        case["domain"]["fine_x_m"] = fine.clone();
    }
    let mut tank = simulation(&case);
    let (mut crests, mut series) = (vec![f64::MIN; gauges.len()], Vec::new());
    run_until(&mut tank, duration, |now| {
        if now.steps % 10 > 1 {
            return;
        }
        let level = |x: f64| now.region_at(x).sampler().surface(DVec2::new(x, 0.5 * now.case.domain.width), 0.0);
        let levels: Vec<f64> = gauges.iter().map(|&x| level(x).unwrap() - DEPTH).collect();
        crests.iter_mut().zip(&levels).for_each(|(crest, level)| *crest = crest.max(*level));
        series.push([now.flume_time(), levels[0]]);
    });
    (crests, series)
}

/// Runs a wave through regions of 2 dp around fine water, and through a uniform spacing `uniform`. Returns the largest
/// difference of the crests, relative to the crest, and the rms difference of the elevation seaward of the fine water
/// over the wave height.
fn crossing_errors(dp: f64, uniform: f64, gauges: &[f64]) -> [f64; 2] {
    let (mixed, series) = solitary_wave(dp, &json!([[9.0, 10.0]]), gauges, 3.6);
    let (reference, alone) = solitary_wave(uniform, &Value::Null, gauges, 3.6);
    // A reflected wave would pass the first gauge after the crest; compare at equal times.
    let at = |series: &[[f64; 2]], t: f64| {
        let after = series.partition_point(|reading| reading[0] < t).clamp(1, series.len() - 1);
        let [a, b] = [series[after - 1], series[after]];
        a[1] + (b[1] - a[1]) * (t - a[0]) / (b[0] - a[0])
    };
    let differences = series.iter().map(|[t, level]| level - at(&alone, *t));
    let rms = (differences.map(|d| d * d).sum::<f64>() / series.len() as f64).sqrt() / 0.08;
    println!(
        "dp {dp} and {} m: crests {mixed:.5?} m, with {uniform} m everywhere {reference:.5?} m; seaward gauge differs by \
         {:.2} % of H",
        2.0 * dp,
        100.0 * rms
    );
    let errors = mixed.iter().zip(&reference).map(|(mixed, reference)| (mixed / reference - 1.0).abs());
    [errors.fold(0.0, f64::max), rms]
}

#[test]
fn a_solitary_wave_crosses_interfaces() {
    let [crests, seaward] = crossing_errors(0.015, 0.03, &[8.7, 9.2, 9.8, 10.4]);
    // Reached: 1.5 %. Limit 2 %: a twentieth of the coarse spacing, the scatter of levels.
    assert!(crests < 0.02, "{crests}");
    // Reached: 0.5 %.
    assert!(seaward < 0.01, "{seaward}");
}

/// Takes ten minutes: `cargo test --release --test verification -- --ignored --nocapture fine_water_hardly_changes`
#[test]
#[ignore = "takes ten minutes"]
fn coarse_water_outside_fine_water_hardly_changes_a_solitary_wave() {
    let [crests, seaward] = crossing_errors(0.005, 0.005, &[8.7, 9.2, 9.5, 9.8, 10.2, 10.4, 10.6]);
    // The largest loss of the crest beyond that of a uniform spacing, and the reflection.
    assert!(crests < 0.01 && seaward < 0.01, "{crests}, {seaward}");
}
