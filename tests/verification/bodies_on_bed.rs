//! Bodies that stand on the bed, fixed, free, or on a path: no water passes below them, and the water presses on them
//! as on walls.

use breakwater::simulation::flume::Simulation;
use glam::{DVec2, DVec3};
use serde_json::{Value, json};

use super::tanks::{GRAVITY, RHO0, run_until, simulation};

/// Depth of the water and width of the flume [m].
const DEPTH: f64 = 0.2;
const WIDTH: f64 = 0.1;
/// x of both faces of the wall across the flume [m].
const WALL: [f64; 2] = [0.3, 0.4];
/// Particle spacing [m].
const DP: f64 = 0.01;
/// Speed of sound divided by the square root of g times the depth [-].
const FACTOR: f64 = 10.0;

/// Returns the case of a tank with still water in front of a wall, without the wall.
fn tank() -> Value {
    json!({
        "title": "Wall",
        "flume": { "bed_m": [[0.0, 0.0], [0.5, 0.0]], "still_water_level_m": DEPTH, "material": "mortar" },
        "domain": { "x_m": [0.0, 0.5], "width_m": WIDTH, "sides": "periodic", "top_z_m": 0.3, "dp_m": DP,
            "water": { "kind": "block", "x_m": [0.0, WALL[0]], "top_z_m": DEPTH } },
        "materials": [{ "name": "mortar", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }],
        "friction": [{ "between": ["mortar", "mortar"], "coefficient": 0.5 }],
        "fluid": { "sound_speed_factor": FACTOR },
        "stop": { "duration_s": 1.0 },
    })
}

/// Runs a second of the tank. Returns the number of particles behind the wall, and the mean horizontal force on the
/// wall [N] and its moment about the middle of its foot [N m] in the second half. `load` returns force and moment.
fn run(tank: &mut Simulation, load: impl Fn(&Simulation) -> [f64; 2] + Sync) -> (usize, [f64; 2]) {
    let (mut sum, mut count) = ([0.0; 2], 0.0);
    run_until(tank, 1.0, |now| {
        if now.time > 0.5 {
            let [force, moment] = load(now);
            sum = [sum[0] + force, sum[1] + moment];
            count += 1.0;
        }
    });
    let behind = tank.water.position.iter().filter(|position| position.x > 0.5 * (WALL[0] + WALL[1])).count();
    (behind, sum.map(|sum| sum / count))
}

/// Returns force and moment divided by their hydrostatic values [-]. The pressure in the gap below the block is that of
/// the nearest foot: half of the block has the pressure at the front foot, and the other half has none.
fn relative([force, moment]: [f64; 2]) -> [f64; 2] {
    let pressure = RHO0 * GRAVITY * DEPTH;
    // The density increases downwards: rho = rho0 (1 + g d / c^2) at the depth d.
    let compressed = 1.0 + 1.0 / (3.0 * FACTOR * FACTOR);
    let (exact, half) = (0.5 * pressure * DEPTH * WIDTH * compressed, 0.5 * (WALL[1] - WALL[0]));
    [force / exact, moment / (exact * DEPTH / 3.0 + pressure * WIDTH * 0.5 * half * half)]
}

/// Runs the tank with a block, which has these further keys. Checks that no particle passes, and returns the largest
/// way of the block [m].
fn check_block(keys: &Value) -> f64 {
    let mut case = tank();
    case["units"] = json!({ "shape": "cuboid", "size_m": [WALL[1] - WALL[0], WIDTH, 0.25], "mass_kg": 6.0,
        "material": "mortar", "poses": [{ "centre_m": [0.5 * (WALL[0] + WALL[1]), 0.5 * WIDTH, 0.125] }] });
    for (key, value) in keys.as_object().unwrap() {
        case["units"][key] = value.clone();
    }
    let mut tank = simulation(&case);
    let (behind, load) = run(&mut tank, |now| {
        let units = now.units.as_ref().unwrap();
        let (load, centre) = (units.fluid_loads[0], units.states()[0].position);
        let arm = centre - DVec3::new(0.5 * (WALL[0] + WALL[1]), centre.y, 0.0);
        [load.force.x, (load.torque + arm.cross(load.force)).y]
    });
    let [force, moment] = relative(load);
    println!("{keys}: {behind} particles behind, force {force:.4} and moment {moment:.4} of hydrostatics");
    assert_eq!(behind, 0);
    // Targets: 1 % of the force, 2 % of the moment.
    assert!((force - 1.0).abs() < 0.01 && (moment - 1.0).abs() < 0.02);
    tank.units.as_ref().unwrap().displacements()[0]
}

#[test]
fn no_water_passes_below_a_fixed_block_on_the_bed() {
    assert_eq!(check_block(&json!({ "fixed": true })), 0.0);
}

#[test]
fn no_water_passes_below_a_heavy_block_that_stands_on_the_bed() {
    // Friction carries up to 0.5 (12 kg g - uplift) = 54 N; the water pushes with 20 N. The block leans on its elastic
    // corners: they are pressed in by 0.5 mm, and give way by 0.1 to 0.3 mm along the bed. Limit: 0.05 dp = 0.5 mm.
    let moved = check_block(&json!({ "mass_kg": 12.0 }));
    println!("moved by {:.3} mm", 1e3 * moved);
    assert!(moved < 0.05 * DP);
}

#[test]
fn a_block_that_follows_a_path_makes_the_wave_of_a_piston() {
    let speed = 0.15;
    let (end, dp) = (2.0, 2.0 * DP);
    let case = json!({
        "title": "Block as piston",
        "flume": { "bed_m": [[0.0, 0.0], [4.2, 0.0]], "still_water_level_m": DEPTH, "material": "mortar" },
        "domain": { "x_m": [0.0, 4.2], "sides": "two_dimensional", "top_z_m": 0.4, "dp_m": dp },
        "materials": [{ "name": "mortar", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }],
        "friction": [{ "between": ["mortar", "mortar"], "coefficient": 0.5 }],
        "units": { "shape": "cuboid", "size_m": [0.1, 0.3, 0.3], "mass_kg": 18.0, "material": "mortar",
            "fixed": true, "way": [[0.2, 0.0, 0.0, 0.0], [end, speed * (end - 0.2), 0.0, 0.0]],
            "poses": [{ "centre_m": [0.3, 0.0, 0.15] }] },
        "stop": { "duration_s": end },
    });
    let mut tank = simulation(&case);
    let mut levels = Vec::new();
    run_until(&mut tank, end, |now| {
        let time = now.time;
        let level = now.sampler().unwrap().surface(DVec2::new(0.9, 0.5 * dp), 0.0);
        // The front of the wave passes 0.4 s after the start and reaches the end of the tank after 2.4 s. It is
        // followed by waves, which are averaged.
        levels.extend(level.filter(|_| time > 1.0));
    });
    let rise = levels.iter().sum::<f64>() / levels.len() as f64 - DEPTH;
    // A piston with the speed u drives a wave with the celerity c = sqrt(g D (D + d) / (2 d)) into water of the depth
    // d; D is the depth behind the front, and u D = c (D - d) (Stoker 1957, section 10.6).
    let speed_of = |rise: f64| {
        let high = DEPTH + rise;
        (GRAVITY * high * (high + DEPTH) / (2.0 * DEPTH)).sqrt() * rise / high
    };
    let (mut low, mut high) = (0.0, DEPTH);
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if speed_of(middle) < speed { low = middle } else { high = middle }
    }
    let units = tank.units.as_ref().unwrap();
    let moved = units.states()[0].position.x - 0.3;
    println!("rise {:.2} mm, by theory {:.2} mm; moved {moved:.6} m", 1e3 * rise, 1e3 * low);
    // The block follows the path; the last step ends behind `end`, where it stands still.
    assert!((moved - speed * (end - 0.2)).abs() < 1e-12);
    // Limit: dp / 10.
    assert!((rise - low).abs() < 0.1 * dp, "{rise} {low}");
}
