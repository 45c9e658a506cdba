//! Gmsh meshes of fracture cases and of the breakage analysis.

#![no_main]

use std::sync::LazyLock;

use breakwater_fuzz::folder::{Role, Target, read, store};
use breakwater_fuzz::{cases, random::Random, text};
use libfuzzer_sys::{fuzz_mutator, fuzz_target};

static TARGET: LazyLock<Target> = LazyLock::new(|| {
    let folder = cases::folder();
    let case = |bodies: &str, friction: &str| {
        format!(
            r#"{{
            "title": "Mesh", "assumptions": [],
            "fracture": {{ "mesh": "mesh.msh" }}, "gravity_m_s2": [0, 0, -9.8],
            "bodies": [{bodies}],
            "materials": [{{ "name": "concrete", "density_kg_m3": 2340, "young_modulus_pa": 26e9, "poisson_ratio": 0.2,
                "strength": {{ "tensile_pa": 3.3e6, "cohesion_pa": 16.5e6, "friction_angle_deg": 30,
                               "fracture_energy_j_m2": 50, "sliding_energy_j_m2": 50 }} }}],
            "friction": [{friction}],
            "output": {{ "surfaces_interval_s": 1e-4, "energy_interval_s": 1e-5 }},
            "stop": {{ "duration_s": 1e-3 }}
        }}"#
        )
    };
    let two =
        r#"{ "name": "block", "material": "concrete", "cracks": true }, { "name": "plate", "material": "concrete" }"#;
    let between = r#"{ "between": ["block", "plate"], "coefficient": 0.6 }"#;
    folder.write("two.json", case(two, between).as_bytes());
    let one = r#"{ "name": "cube", "material": "concrete", "cracks": true }"#;
    folder.write("one.json", case(one, r#"{ "between": ["cube", "cube"], "coefficient": 0.6 }"#).as_bytes());
    Target {
        folder,
        roles: vec![
            Role { file: "mesh.msh", case: "two.json", seeds: vec![read("tests/data/meshes/block_on_plate.msh")] },
            Role {
                file: "mesh.msh",
                case: "one.json",
                seeds: vec![
                    read("tests/data/meshes/cube_with_crack_binary.msh"),
                    read("tests/data/meshes/cube_with_crack_renumbered.msh"),
                ],
            },
        ],
    }
});

fuzz_target!(|input: &[u8]| TARGET.check(input));

fuzz_mutator!(|data: &mut [u8], size: usize, largest: usize, seed: u32| {
    let mut random = Random::new(seed);
    let mutated = TARGET.mutate(&data[..size], &mut random, text::mutate);
    store(&mutated, data, largest)
});
