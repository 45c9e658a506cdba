//! Parts of any shape from STL files: forces of still water, leaks, and units on them.

use std::f64::consts::TAU;
use std::path::Path;
use std::sync::Arc;

use breakwater::case::{Case, DryTestCase, PartShape};
use breakwater::geometry::stl;
use breakwater::simulation::dry_test::DryTest;
use breakwater::simulation::flume::Simulation;
use glam::{DVec2, DVec3};
use serde_json::{Value, json};

use super::tanks::{GRAVITY, RHO0, run_until};

/// Depth of the water [m].
const DEPTH: f64 = 0.2;

/// Writes a body between two polygons with the same number of corners, in the planes z = `low` and z = `high` [m]. The
/// corners run counter-clockwise seen from above.
fn write_frustum(path: &Path, bottom: &[DVec2], top: &[DVec2], [low, high]: [f64; 2]) {
    let count = bottom.len() as u32;
    let vertices: Vec<DVec3> =
        bottom.iter().map(|at| at.extend(low)).chain(top.iter().map(|at| at.extend(high))).collect();
    let mut triangles = Vec::new();
    for corner in 0..count {
        let next = (corner + 1) % count;
        triangles.extend([[corner, next, count + next], [corner, count + next, count + corner]]);
        if (1..count - 1).contains(&corner) {
            triangles.extend([[0, next, corner], [count, count + corner, count + next]]);
        }
    }
    stl::write(path, &vertices, &triangles).unwrap();
}

/// Returns the corners of a regular polygon around `centre` [m].
fn polygon(corners: u32, centre: DVec2, radius: f64) -> Vec<DVec2> {
    (0..corners).map(|k| centre + radius * DVec2::from_angle(TAU * f64::from(k) / f64::from(corners))).collect()
}

/// Returns a tank of still water between walls, 0.8 m long and 0.8 m wide, with the particle spacing `dp` [m] and a part
/// of the given shape. Paths are
/// relative to `folder`.
fn tank(folder: &Path, dp: f64, key: &str, shape: Value) -> Simulation {
    let case = json!({
        "title": "Body in still water",
        "flume": { "bed_m": [[0.0, 0.0], [0.8, 0.0]], "still_water_level_m": DEPTH },
        "structure": [{ "name": "body", key: shape }],
        "domain": { "x_m": [0.0, 0.8], "width_m": 0.8, "sides": "walls", "top_z_m": 0.4, "dp_m": dp },
        "gauges": [{ "kind": "force", "name": "body", "on": "body" }],
        "fluid": { "sound_speed_factor": 10.0 },
        "stop": { "duration_s": 1.0 },
    });
    let name = folder.join("case.json").display().to_string();
    let case = Case::from_str(&case.to_string(), &name).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(matches!(case.flume.parts[0].shape, PartShape::Body(_)), key == "stl");
    Simulation::new(Arc::new(case)).unwrap()
}

/// What a run of a tank gives.
struct Found {
    /// Mean force on the part in the second half [N].
    force: DVec3,
    /// Distance of the deepest particle inside the part from its surface [m].
    deepest: f64,
    /// Root mean square of the velocities in the second half [m/s].
    velocity: f64,
}

/// Runs a second of the tank.
fn run(tank: &mut Simulation) -> Found {
    let (mut force, mut square, mut count) = (DVec3::ZERO, 0.0, 0.0);
    run_until(tank, 1.0, |now| {
        if now.time > 0.5 && now.steps.is_multiple_of(5) {
            force += now.part_load(0, DVec3::ZERO).force;
            let sum: f64 = now.water.velocity.iter().map(|velocity| velocity.length_squared()).sum();
            square += sum / now.water.len() as f64;
            count += 1.0;
        }
    });
    let depth = |position: &DVec3| -tank.case.flume.parts[0].distance(*position);
    let deepest = tank.water.position.iter().map(depth).fold(f64::MIN, f64::max);
    let velocity = (square / count).sqrt();
    println!("deepest particle {:.2} mm, velocities {:.1} mm/s", 1e3 * deepest, 1e3 * velocity);
    Found { force: force / count, deepest, velocity }
}

#[test]
fn a_turned_block_in_still_water_has_no_horizontal_force() {
    let folder = tempfile::tempdir().unwrap();
    // A block of 0.3 x 0.3 m, turned by 45 degrees about the vertical, with its foot on the bed.
    let corners = polygon(4, DVec2::splat(0.4), 0.3 / 2f64.sqrt());
    write_frustum(&folder.path().join("part.stl"), &corners, &corners, [0.0, 0.3]);
    let dp = 0.025;
    let turned = run(&mut tank(folder.path(), dp, "stl", json!({ "path": "part.stl" })));
    let aligned =
        run(&mut tank(folder.path(), dp, "box", json!({ "low_m": [0.25, 0.25, 0.0], "high_m": [0.55, 0.55, 0.3] })));
    let face = 0.5 * RHO0 * GRAVITY * DEPTH * DEPTH * 0.3;
    println!("force {:.4} of the force on one face, aligned {:.4}", turned.force / face, aligned.force / face);
    // Target: 1 % of the force on one face.
    assert!(turned.force.truncate().length() < 0.01 * face && turned.force.z.abs() < 0.01 * face);
    // The surface stops particles that reach it, to a few hundredths of the particle spacing.
    assert!(turned.deepest < 0.1 * dp);
    // Both tanks settle from their start. Measured 1.3: the columns of particles do not fit the turned faces.
    assert!(turned.velocity < 1.5 * aligned.velocity);
}

#[test]
fn still_water_stays_at_rest_on_a_cone_that_reaches_into_the_bed() {
    let folder = tempfile::tempdir().unwrap();
    // A cone with the slope 1:1.5, with the radius 0.3 m on the bed. It continues 0.06 m below the bed.
    let [bottom, top] = [0.39, 0.09].map(|radius| polygon(24, DVec2::splat(0.4), radius));
    write_frustum(&folder.path().join("part.stl"), &bottom, &top, [-0.06, 0.14]);
    let dp = 0.02;
    let mut tank = tank(folder.path(), dp, "stl", json!({ "path": "part.stl" }));
    let surface_at = [[0.08, 0.08], [0.4, 0.4], [0.4, 0.08], [0.6, 0.5]];
    let levels = |tank: &mut Simulation| -> Vec<f64> {
        let mut step = tank.begin_step().unwrap();
        let sampler = step.sampler().unwrap();
        surface_at.iter().map(|[x, y]| sampler.surface(DVec2::new(*x, *y), 0.0).unwrap()).collect()
    };
    let before = levels(&mut tank);
    let Found { force, deepest, .. } = run(&mut tank);
    let after = levels(&mut tank);
    let risen = before.iter().zip(&after).map(|(before, after)| after - before).sum::<f64>() / 4.0;
    println!("force {force:.3} N, surface {:.2} mm higher", 1e3 * risen);
    assert!(deepest < 0.1 * dp);
    // A tenth of a particle spacing: the particles settle by this much.
    assert!(risen.abs() < 0.1 * dp);
    // The weight of the water above the flank: the flank is a regular polygon with 24 corners.
    let area = |radius: f64| 12.0 * (TAU / 24.0).sin() * radius * radius;
    let [foot, crest] = [0.3, 0.09].map(area);
    let solid = 0.14 / 3.0 * (foot + crest + (foot * crest).sqrt());
    let weight = RHO0 * GRAVITY * (foot * DEPTH - solid);
    println!("vertical force {:.4} of the weight of the water above", -force.z / weight);
    // Limit 2 %: 1.3 % with 3 particles above the crest, 3.2 % with 2.4.
    assert!((force.z / -weight - 1.0).abs() < 0.02 && force.truncate().length() < 0.01 * weight);
}

#[test]
fn a_tetrapod_on_a_cone_moves_as_on_the_same_terrain() {
    let folder = tempfile::tempdir().unwrap();
    let [bottom, top] = [0.33, 0.09].map(|radius| polygon(24, DVec2::splat(0.4), radius));
    write_frustum(&folder.path().join("part.stl"), &bottom, &top, [-0.02, 0.14]);
    let case = |flume: Value, structure: Value| {
        json!({
            "title": "Drop on a cone",
            "dry_test": { "kind": "settle" },
            "flume": flume,
            "structure": structure,
            "domain": { "x_m": [0.0, 0.8], "width_m": 0.8, "sides": "walls", "top_z_m": 0.6 },
            "units": { "shape": "tetrapod", "height_m": 0.077, "mass_kg": 0.3, "material": "mortar",
                "poses": [{ "centre_m": [0.4, 0.4, 0.2] }, { "centre_m": [0.55, 0.4, 0.2] }] },
            "materials": [{ "name": "mortar", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }],
            "friction": [{ "between": ["mortar", "mortar"], "coefficient": 0.4 }],
            "stop": { "duration_s": 0.6 },
        })
    };
    let bed = json!([[0.0, 0.0], [0.8, 0.0]]);
    let ways = [
        case(json!({ "bed_m": bed, "material": "mortar", "terrain": { "path": "part.stl" } }), json!([])),
        case(json!({ "bed_m": bed, "material": "mortar" }), json!([{ "name": "cone", "stl": { "path": "part.stl" } }])),
    ];
    let name = folder.path().join("case.json").display().to_string();
    let ends = ways.map(|case| {
        let case = DryTestCase::from_str(&case.to_string(), &name).unwrap_or_else(|errors| panic!("{errors}"));
        let mut test = DryTest::new(Arc::new(case)).unwrap();
        rayon::scope(|_| (0..600).for_each(|_| test.advance(1.0).unwrap()));
        [0, 1].map(|unit| test.world.states()[unit])
    });
    for (terrain, part) in ends[0].iter().zip(&ends[1]) {
        let apart = terrain.position.distance(part.position);
        println!("{:.4} on terrain, {apart:.1e} m apart", terrain.position);
        // The same triangles: rounding only.
        assert!(apart < 1e-9);
    }
    // The first unit rests on the crest, the second one has moved down the flank.
    assert!((ends[1][0].position.truncate() - DVec2::splat(0.4)).length() < 0.02 && ends[1][0].position.z > 0.14);
    assert!(ends[1][1].position.x > 0.56 && ends[1][1].position.z < 0.14);
}
