//! STL files: a unit, a part of a unit, terrain.

#![no_main]

use std::sync::LazyLock;

use breakwater_fuzz::folder::{Role, Target, store};
use breakwater_fuzz::{cases, random::Random, text};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};

static TARGET: LazyLock<Target> = LazyLock::new(|| {
    let folder = cases::folder();
    let case = |units: &str, terrain: &str| {
        format!(
            r#"{{
            "title": "STL", "dry_test": {{ "kind": "drop", "height_m": 0.1 }},
            "flume": {{ "bed_m": [[-1.0, -0.4], [2.0, -0.4]], {terrain} "material": "mortar" }},
            "domain": {{ "x_m": [0.0, 0.65], "width_m": 0.36, "sides": "walls", "top_z_m": 1.0 }},
            "units": {{ {units}, "material": "mortar", "poses": [{{ "centre_m": [0.3, 0.15, 0.4] }}] }},
            "materials": [{{ "name": "mortar", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }}],
            "friction": [{{ "between": ["mortar", "mortar"], "coefficient": 0.65 }}],
            "stop": {{ "duration_s": 0.01 }}
        }}"#
        )
    };
    let unit = r#""shape": "stl", "mass_kg": 1.0, "stl": { "path": "unit.stl" }"#;
    let parts = r#""shape": "stl", "mass_kg": 1.0, "stl": { "path": "whole.stl", "parts": ["part.stl"] }"#;
    let cuboid = r#""shape": "cuboid", "size_m": [0.1, 0.1, 0.1], "mass_kg": 2.3"#;
    folder.write("unit.json", case(unit, "").as_bytes());
    folder.write("parts.json", case(parts, "").as_bytes());
    folder.write("terrain.json", case(cuboid, r#""terrain": { "path": "terrain.stl" },"#).as_bytes());
    let bodies = vec![cube(false), cube(true)];
    folder.write("whole.stl", &bodies[0]);
    let ground = vec![open_ground(false), open_ground(true), cube(false)];
    Target {
        folder,
        roles: vec![
            Role { file: "unit.stl", case: "unit.json", seeds: bodies.clone() },
            Role { file: "part.stl", case: "parts.json", seeds: bodies },
            Role { file: "terrain.stl", case: "terrain.json", seeds: ground },
        ],
    }
});

fuzz_target!(|input: &[u8]| TARGET.check(input));

fuzz_mutator!(|data: &mut [u8], size: usize, largest: usize, seed: u32| {
    let mut random = Random::new(seed);
    let mutated = TARGET.mutate(&data[..size], &mut random, text::mutate);
    store(&mutated, data, largest)
});

/// A triangle with its three corners.
type Triangle = [[f32; 3]; 3];

/// A cube with edges of 0.1 m as a text or binary file.
fn cube(binary: bool) -> Vec<u8> {
    let corner = |k: usize| [k & 1, (k >> 1) & 1, k >> 2].map(|bit| 0.1 * bit as f32);
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<Triangle> =
        sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).map(|t| t.map(corner)).collect();
    file(&triangles, binary)
}

/// A rough open surface below the units.
fn open_ground(binary: bool) -> Vec<u8> {
    let at = |i: usize, j: usize| [0.16 * i as f32, 0.12 * j as f32, 0.03 * ((3 * i + 5 * j) % 4) as f32];
    let cells = (0..4).flat_map(|i| (0..3).map(move |j| (i, j)));
    let triangles: Vec<Triangle> = cells
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    file(&triangles, binary)
}

fn file(triangles: &[Triangle], binary: bool) -> Vec<u8> {
    if binary {
        let mut bytes = vec![0; 80];
        bytes.extend((triangles.len() as u32).to_le_bytes());
        for triangle in triangles {
            bytes.extend([0; 12]);
            bytes.extend(triangle.as_flattened().iter().flat_map(|number| number.to_le_bytes()));
            bytes.extend([0; 2]);
        }
        return bytes;
    }
    let vertex = |[x, y, z]: &[f32; 3]| format!("  vertex {x} {y} {z}\n");
    let facet = |triangle: &Triangle| {
        let corners: String = triangle.iter().map(vertex).collect();
        format!("facet normal 0 0 1\n outer loop\n{corners} endloop\nendfacet\n")
    };
    format!("solid x\n{}endsolid x\n", triangles.iter().map(facet).collect::<String>()).into_bytes()
}
