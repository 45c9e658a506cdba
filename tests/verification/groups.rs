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
        let volume = units.groups[1].shape().volume();
        println!("buoyancy of Tetrapod {unit}: {:.3} of Archimedes' force", load.force.z / (1000.0 * GRAVITY * volume));
        assert!((load.force.z / (1000.0 * GRAVITY * volume) - 1.0).abs() < 0.05);
    }
}

/// Still water level, edge of the fixed box, depth to which it is in the water, and place of its centre in plan [m].
const LEVEL: f64 = 0.2;
const EDGE: f64 = 0.1;
const DRAUGHT: f64 = 0.06;
const PLACE: [f64; 2] = [0.26, 0.12];

#[test]
fn a_force_gauge_shows_the_buoyancy_of_a_fixed_box_and_its_moment() {
    let case = json!({
        "title": "Fixed box",
        "flume": { "bed_m": [[0.0, 0.0], [0.5, 0.0]], "still_water_level_m": LEVEL, "material": "mortar" },
        "domain": { "x_m": [0.0, 0.5], "width_m": 0.24, "sides": "periodic", "top_z_m": 0.3, "dp_m": 0.01 },
        "units": [{ "name": "box", "fixed": true, "shape": "cuboid", "size_m": [EDGE, EDGE, EDGE], "mass_kg": 1.0,
            "material": "mortar", "poses": [{ "centre_m": [PLACE[0], PLACE[1], LEVEL - DRAUGHT + 0.5 * EDGE] }] }],
        "materials": [{ "name": "mortar", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }],
        "friction": [{ "between": ["mortar", "mortar"], "coefficient": 0.65 }],
        "gauges": [{ "kind": "force", "name": "all", "on": "box", "about_m": [0.0, 0.0, 0.0] }],
        "output": { "series_interval_s": 0.05, "units_interval_s": 0, "fluid_interval_s": 0, "surface_interval_s": 0,
            "checkpoint_interval_s": 0 },
        "stop": { "duration_s": 0.6 },
    });
    let folder = tempfile::tempdir().unwrap();
    let case = breakwater::case::Case::from_str(&case.to_string(), "box.json").unwrap();
    let control = breakwater::output::driver::Control { quiet: true, silent: true, ..Default::default() };
    let options = breakwater::simulation::flume::run::RunOptions { control, ..Default::default() };
    breakwater::simulation::flume::run::run(std::sync::Arc::new(case), folder.path(), &options).unwrap();
    let table = breakwater::output::Table::read(&folder.path().join("gauges.csv")).unwrap();
    let mean = |column: &str| {
        let values = table.column(column).unwrap();
        let settled = &values[values.len() / 2..];
        settled.iter().sum::<f64>() / settled.len() as f64
    };
    let buoyancy = 1000.0 * GRAVITY * EDGE * EDGE * DRAUGHT;
    let force = ["all_fx_n", "all_fy_n", "all_fz_n"].map(|column| mean(column) / buoyancy);
    let moment = ["all_mx_n_m", "all_my_n_m", "all_mz_n_m"].map(|column| mean(column) / buoyancy);
    println!("force {force:.4?} of the buoyancy, moment {moment:.5?} m of the buoyancy");
    // Limit 4 %: a quarter of a particle spacing in the draught of six spacings.
    assert!((force[2] - 1.0).abs() < 0.04 && force[0].abs() < 0.01 && force[1].abs() < 0.01);
    // Moment about the origin of a force through the vertical axis of the box: (y, -x, 0) times the force. Limit: a
    // fiftieth of the edge, a fifth of a spacing.
    let wanted = [PLACE[1] * force[2], -PLACE[0] * force[2], 0.0];
    for (moment, wanted) in moment.iter().zip(wanted) {
        assert!((moment - wanted).abs() < 0.02 * EDGE, "{moment} instead of {wanted}");
    }
}
