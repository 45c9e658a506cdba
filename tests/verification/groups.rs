//! Groups of units of different kinds, fixed or free, with a fixed box, in still water.

use serde_json::{Value, json};

use super::tanks::{GRAVITY, run_until, simulation};

/// Simulated time [s].
const DURATION: f64 = 0.4;
/// Mass of a block [kg].
const BLOCK: f64 = 0.3;

/// Returns a case with two fixed cubes, two Tetrapods, a block that leans against a wall, and a block on this wall. The
/// wall is an obstacle across the whole width.
fn section() -> Value {
    let block = |centre: [f64; 3]| json!({ "centre_m": centre });
    json!({
        "title": "Groups in still water",
        "flume": { "bed_m": [[0.0, 0.0], [1.0, 0.0]], "still_water_level_m": 0.12, "material": "mortar" },
        "domain": { "x_m": [0.0, 1.0], "width_m": 0.16, "sides": "periodic", "top_z_m": 0.34, "dp_m": 0.014,
            "obstacles": [{ "low_m": [0.7, 0.0, 0.0], "high_m": [0.8, 0.16, 0.25] }] },
        "units": [
            { "name": "toe", "fixed": true, "shape": "cuboid", "size_m": [0.04, 0.04, 0.04], "mass_kg": 0.15,
              "material": "rock", "poses": [block([0.15, 0.03, 0.02]), block([0.15, 0.11, 0.02])] },
            { "name": "armour", "shape": "tetrapod", "height_m": 0.077, "mass_kg": 0.3, "material": "mortar",
              "count": 2, "pitch_m": 0.08, "x_m": 0.35 },
            { "name": "blocks", "shape": "cuboid", "size_m": [0.05, 0.05, 0.05], "mass_kg": BLOCK, "material": "rock",
              "poses": [block([0.674, 0.05, 0.025]), block([0.75, 0.08, 0.275])] },
        ],
        "materials": [
            { "name": "mortar", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 },
            { "name": "rock", "young_modulus_pa": 1e8, "poisson_ratio": 0.25, "restitution": 0.5 },
        ],
        "friction": [
            { "between": ["mortar", "mortar"], "coefficient": 0.65 },
            { "between": ["mortar", "rock"], "coefficient": 0.6 },
            { "between": ["rock", "rock"], "coefficient": 0.6 },
        ],
        "numerics": { "hold_units_s": 0.1 },
        "stop": { "duration_s": DURATION },
    })
}

#[test]
fn groups_at_rest_in_still_water_stay_where_they_are() {
    let mut flume = simulation(&section());
    run_until(&mut flume, DURATION, |_| ());
    let units = flume.units.as_ref().unwrap();
    let moved: Vec<f64> =
        units.states().iter().zip(&units.start).map(|(now, start)| (now.position - start.position).length()).collect();
    println!("moved: {moved:.6?} m");
    let members: Vec<(&str, usize)> = units.groups.iter().map(|group| (&*group.name, group.members.len())).collect();
    assert_eq!(members, [("toe", 2), ("armour", 2), ("blocks", 2)]);
    assert_eq!(moved[..2], [0.0, 0.0]);
    // Target: 0.1 mm. The weights compress the contacts by some hundredths of a millimetre.
    assert!(moved.iter().all(|way| *way < 1e-4));
    // The dry block stands on the wall: the contact force is its weight. Limit 1 %: it still swings by this much.
    let weight = BLOCK * GRAVITY;
    let [contact, water] = [units.world.contact_loads()[5].force, units.fluid_loads[5].force];
    println!("contact force {contact:.4} N, weight {weight:.4} N");
    assert!((contact.z / weight - 1.0).abs() < 0.01 && water.length() == 0.0);
    // The Tetrapods have the buoyancy of Archimedes within 5 %, at 5.5 particles over their height.
    for (unit, load) in units.fluid_loads[2..4].iter().enumerate() {
        let volume = units.groups[1].shape.volume();
        println!("buoyancy of Tetrapod {unit}: {:.3} of Archimedes' force", load.force.z / (1000.0 * GRAVITY * volume));
        assert!((load.force.z / (1000.0 * GRAVITY * volume) - 1.0).abs() < 0.05);
    }
}
