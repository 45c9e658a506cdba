//! A terrain from an STL file under water: the same bed as a profile, and still water over an uneven sea bed.

use std::path::Path;
use std::sync::Arc;

use breakwater::case::Case;
use breakwater::simulation::flume::Simulation;
use glam::DVec3;
use serde_json::{Value, json};

use super::tanks::GRAVITY;

/// Still water level, width and length of the basin [m].
const DEPTH: f64 = 0.3;
const WIDTH: f64 = 0.4;
const LENGTH: f64 = 0.5;
const DP: f64 = 0.02;

/// Mean level of the hills [m].
const HILL: f64 = 0.05;

/// Writes the surface z(x, y) as a text STL file: squares with the edge `step` [m], two triangles each, up to `margin`
/// [m] beyond the basin.
fn write_surface(path: &Path, step: f64, margin: f64, level: impl Fn(f64, f64) -> f64) {
    let count = |length: f64| ((length + 2.0 * margin) / step).round() as u32;
    let corner = |i: u32, j: u32| {
        let (x, y) = (f64::from(i) * step - margin, f64::from(j) * step - margin);
        format!("vertex {x} {y} {}\n", level(x, y))
    };
    let mut text = "solid terrain\n".to_owned();
    for (i, j) in (0..count(LENGTH)).flat_map(|i| (0..count(WIDTH)).map(move |j| (i, j))) {
        let [a, b, c, d] = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)].map(|(i, j)| corner(i, j));
        for [p, q, r] in [[&a, &b, &c], [&a, &c, &d]] {
            text += &format!("facet normal 0 0 1\nouter loop\n{p}{q}{r}endloop\nendfacet\n");
        }
    }
    std::fs::write(path, text + "endsolid terrain\n").unwrap();
}

fn case(folder: &Path, bed: Value, terrain: Value) -> Case {
    let case = json!({
        "title": "Terrain",
        "flume": { "bed_m": bed, "still_water_level_m": DEPTH, "terrain": terrain },
        "domain": { "x_m": [0.0, LENGTH], "width_m": WIDTH, "sides": "walls", "top_z_m": 0.5, "dp_m": DP },
        "stop": { "duration_s": 2.0 },
    });
    let name = folder.join("case.json").display().to_string();
    Case::from_str(&case.to_string(), &name).unwrap_or_else(|errors| panic!("{errors}"))
}

#[test]
fn a_terrain_that_is_the_same_across_the_flume_is_a_profile() {
    let folder = tempfile::tempdir().unwrap();
    let level = |x: f64| (0.5 * (x - 0.2)).clamp(0.0, 0.1);
    write_surface(&folder.path().join("bed.stl"), 0.1, 0.1, |x, _| level(x));
    let flat = json!([[0.0, 0.0], [LENGTH, 0.0]]);
    let case = case(folder.path(), flat, json!({ "path": "bed.stl" }));
    assert!(case.flume.parts.is_empty() && case.flume.bathymetry.is_none());
    // A run stores the file, because its case file refers to it.
    assert_eq!(case.flume.files().map(|(name, _)| name).collect::<Vec<_>>(), ["terrain.stl"]);
    assert!(case.text.contains("terrain.stl"));
    for x in (0..=50).map(|k| 0.01 * f64::from(k)) {
        // Limit: the coordinates in the file.
        assert!((case.flume.profile.z(x) - level(x)).abs() < 1e-9, "{x}");
    }
}

/// Runs still water for a second. Returns its largest velocity at the end [m/s] and, for each place, the mean pressure
/// error in the second half, divided by the hydrostatic pressure at the depth of the basin [-]. The places are 1.5
/// particle spacings above the ground.
fn rest(case: Case, places: &[[f64; 2]]) -> (f64, Vec<f64>) {
    let mut simulation = Simulation::new(Arc::new(case)).unwrap();
    let (mut sums, mut count) = (vec![0.0; places.len()], 0.0);
    rayon::scope(|_| {
        while simulation.time < 1.0 {
            simulation.step().unwrap();
            if simulation.time < 0.5 {
                continue;
            }
            count += 1.0;
            let sampler = simulation.sampler();
            for (sum, [x, y]) in sums.iter_mut().zip(places) {
                let z = simulation.case.flume.level(*x, *y) + 1.5 * DP;
                let pressure = sampler.sample(DVec3::new(*x, *y, z)).unwrap().pressure;
                *sum += pressure / (1000.0 * GRAVITY * DEPTH) - (DEPTH - z) / DEPTH;
            }
        }
    });
    let fastest = simulation.water.velocity.iter().map(|velocity| velocity.length()).fold(0.0, f64::max);
    (fastest, sums.into_iter().map(|sum| sum / count).collect())
}

#[test]
fn still_water_over_an_uneven_sea_bed_is_as_still_as_over_a_flat_bed() {
    let folder = tempfile::tempdir().unwrap();
    // Hills 0.1 m high, with slopes up to 1:1.3.
    let level = |x: f64, y: f64| {
        let wave = |s: f64, length: f64| (std::f64::consts::TAU * s / length).cos();
        HILL * (1.0 - wave(x, 0.5) * wave(y - 0.1, 0.4))
    };
    write_surface(&folder.path().join("bed.stl"), 0.025, 0.1, level);
    let bed = |z: f64| json!([[0.0, z], [LENGTH, z]]);
    let hills = case(folder.path(), bed(-0.02), json!({ "path": "bed.stl", "section_y_m": 0.1 }));
    let section = &hills.flume.bathymetry.as_ref().unwrap().section;
    for x in (0..=20).map(|k| 0.025 * f64::from(k)) {
        // Limit: edges 25 mm long are at most 0.6 mm away from the curved surface.
        assert!((section.z(x) - level(x, 0.1)).abs() < 1e-3, "{x}");
    }
    let simulation = Simulation::new(Arc::new(hills.clone())).unwrap();
    let volumes = simulation.water.mass.iter().zip(&simulation.water.density).map(|(mass, density)| mass / density);
    let share = volumes.sum::<f64>() / (LENGTH * WIDTH * (DEPTH - HILL));
    println!("filled volume / exact volume - 1: {:.1e}", share - 1.0);
    // Limit: the midpoint rule over columns of 20 mm.
    assert!((share - 1.0).abs() < 1e-3);
    let places = [[0.25, 0.1], [0.25, 0.3], [0.1, 0.1], [0.4, 0.2], [0.1, 0.3]];
    let flat = rest(case(folder.path(), bed(HILL), Value::Null), &places);
    let hills = rest(hills, &places);
    println!("largest velocity: {:.4} m/s, over a flat bed {:.4} m/s", hills.0, flat.0);
    for (place, (hills, flat)) in places.iter().zip(hills.1.iter().zip(&flat.1)) {
        println!("{place:?}: pressure {hills:+.4} of that at the bed, over a flat bed {flat:+.4}");
        // Target: at most 1 % more error than over the flat bed.
        assert!((hills - flat).abs() < 0.01);
    }
    // Limit 1.5: the largest velocity is that of a single particle.
    assert!(hills.0 < 1.5 * flat.0);
}
