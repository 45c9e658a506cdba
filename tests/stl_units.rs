//! Units from STL files and at given poses: valid cases run, invalid cases are refused, and nothing panics or hangs.

use std::{path::Path, sync::Arc};

use breakwater::{
    case::DryTestCase,
    geometry::{armour_unit::ArmourUnit, stl},
    output::driver::Control,
    simulation::dry_test::DryTest,
};
use glam::DVec3;
use serde_json::{Value, json};

/// Returns the case of a settling test with a unit from an STL file. `stl` is the section `units.stl`; paths in it are
/// relative to the folder of the case.
fn settling_case(stl: Value, poses: Value) -> Value {
    json!({
        "title": "unit from STL",
        "dry_test": { "kind": "settle" },
        "flume": { "bed_m": [[-2.0, 0.0], [2.0, 0.0]], "material": "concrete" },
        "domain": { "x_m": [-1.0, 1.0], "width_m": 1.0, "sides": "walls", "top_z_m": 2.0 },
        "units": { "shape": "stl", "stl": stl, "mass_kg": 2.0, "material": "concrete", "poses": poses },
        "materials": [{ "name": "concrete", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }],
        "friction": [{ "between": ["concrete", "concrete"], "coefficient": 0.6 }],
        "contact": { "rounding_share": 0.05 },
        "stop": { "duration_s": 0.02 }
    })
}

/// Validates and runs a case; returns the error message if it is refused or fails.
fn try_run(case: &Value, folder: &Path) -> Result<(), String> {
    let name = folder.join("case.json").display().to_string();
    let case = DryTestCase::from_str(&case.to_string(), &name).map_err(|errors| errors.to_string())?;
    let mut run = DryTest::new(Arc::new(case)).map_err(|error| error.to_string())?;
    while run.time() < 0.02 {
        run.advance(0.02).map_err(|error| error.to_string())?;
    }
    assert!(run.world.states().iter().all(|state| state.position.is_finite()));
    Ok(())
}

/// Pseudo-random numbers, uniformly distributed in 0..1.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        ((self.next() * count as f64) as usize).min(count - 1)
    }
}

fn write_unit(path: &Path, unit: &ArmourUnit) {
    stl::write(path, unit.solid().vertices(), unit.solid().triangles()).unwrap();
}

#[test]
fn a_unit_from_stl_moves_like_the_same_catalogue_unit() {
    let folder = tempfile::tempdir().unwrap();
    let cuboid = ArmourUnit::cuboid(DVec3::new(0.1, 0.15, 0.2), 0.05).unwrap();
    write_unit(&folder.path().join("block.stl"), &cuboid);
    let pose = json!([{ "centre_m": [0.0, 0.5, 0.3], "quaternion_xyzw": [0.1, 0.2, 0.3, 0.9273618495495704] }]);
    let from_stl = settling_case(json!({ "path": "block.stl" }), pose);
    let mut catalogue = from_stl.clone();
    let units = catalogue["units"].as_object_mut().unwrap();
    units.remove("stl");
    units.insert("shape".into(), json!("cuboid"));
    units.insert("size_m".into(), json!([0.1, 0.15, 0.2]));
    let end = |case: &Value| {
        let name = folder.path().join("case.json").display().to_string();
        let case = DryTestCase::from_str(&case.to_string(), &name).unwrap_or_else(|errors| panic!("{errors}"));
        let mut run = DryTest::new(Arc::new(case)).unwrap();
        for _ in 0..400 {
            run.advance(10.0).unwrap();
        }
        run.world.states()[0]
    };
    let (a, b) = (end(&from_stl), end(&catalogue));
    println!("{} {}", a.position, b.position);
    // Limit 1e-5 m: the file is in single precision, and the impact amplifies its rounding a hundredfold.
    assert!((a.position - b.position).length() < 1e-5);
}

#[test]
fn convex_parts_come_from_files_or_from_decomposition() {
    let folder = tempfile::tempdir().unwrap();
    let dolos = ArmourUnit::dolos(0.2, 0.34, 0.05).unwrap();
    write_unit(&folder.path().join("dolos.stl"), &dolos);
    for (number, block) in breakwater::geometry::armour_unit::dolos::blocks(0.2, 0.34).unwrap().iter().enumerate() {
        let (vertices, triangles) = breakwater::geometry::convex::union::surface(std::slice::from_ref(block));
        stl::write(&folder.path().join(format!("part{number}.stl")), &vertices, &triangles).unwrap();
    }
    let pose = json!([{ "centre_m": [0.0, 0.5, 0.3] }]);
    let parts: Vec<String> = (0..5).map(|number| format!("part{number}.stl")).collect();
    try_run(&settling_case(json!({ "path": "dolos.stl", "parts": parts }), pose.clone()), folder.path()).unwrap();
    // With four of the five parts, the message gives the missing share of the volume.
    let error =
        try_run(&settling_case(json!({ "path": "dolos.stl", "parts": parts[1..] }), pose.clone()), folder.path());
    assert!(error.as_ref().unwrap_err().contains("of its volume"), "{error:?}");
    try_run(&settling_case(json!({ "path": "dolos.stl" }), pose), folder.path()).unwrap();
}

#[test]
fn a_tetrapod_from_stl_rests_like_the_catalogue_unit() {
    let folder = tempfile::tempdir().unwrap();
    write_unit(&folder.path().join("tetrapod.stl"), &ArmourUnit::tetrapod(0.2, 0.05).unwrap());
    let mut from_stl = settling_case(json!({ "path": "tetrapod.stl" }), json!([{ "centre_m": [0.0, 0.5, 0.08] }]));
    from_stl["stop"]["duration_s"] = json!(1.0);
    let mut catalogue = from_stl.clone();
    let units = catalogue["units"].as_object_mut().unwrap();
    units.remove("stl");
    units.insert("shape".into(), json!("tetrapod"));
    units.insert("height_m".into(), json!(0.2));
    let end = |case: &Value| {
        let name = folder.path().join("case.json").display().to_string();
        let case = DryTestCase::from_str(&case.to_string(), &name).unwrap_or_else(|errors| panic!("{errors}"));
        let mut run = DryTest::new(Arc::new(case)).unwrap();
        while run.time() < 0.5 {
            run.advance(0.5).unwrap();
        }
        run.world.states()[0]
    };
    let (a, b) = (end(&from_stl), end(&catalogue));
    println!("{} {}, angle {:.4} rad", a.position, b.position, a.rotation.angle_between(b.rotation));
    // Limit 1 % of the height: the parts differ from the unit by less than 2 % of its volume.
    assert!((a.position - b.position).length() < 0.002);
}

#[test]
fn a_surface_that_intersects_itself_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let cube = ArmourUnit::cuboid(DVec3::splat(0.2), 0.05).unwrap();
    let (mut vertices, triangles) = (cube.solid().vertices().to_vec(), cube.solid().triangles().to_vec());
    // A corner of the top is pushed through the bottom.
    let corner = vertices.iter().position(|v| v.min_element() > 0.0).unwrap();
    vertices[corner].z = -0.15;
    vertices[corner].x = 0.05;
    vertices[corner].y = 0.05;
    stl::write(&folder.path().join("folded.stl"), &vertices, &triangles).unwrap();
    let case = settling_case(json!({ "path": "folded.stl" }), json!([{ "centre_m": [0.0, 0.5, 0.3] }]));
    let error = try_run(&case, folder.path()).unwrap_err();
    assert!(error.contains("does not intersect itself") && error.contains("units.stl.path"), "{error}");
}

/// Returns a binary STL file with one to three faults.
fn damaged(intact: &[u8], random: &mut Random) -> Vec<u8> {
    let mut bytes = intact.to_vec();
    for _ in 0..=random.below(3) {
        match random.below(7) {
            // Replaces a byte.
            0 => {
                let offset = random.below(bytes.len());
                bytes[offset] = random.below(256) as u8;
            }
            1 => bytes.truncate(random.below(bytes.len()) + 1),
            // Replaces a coordinate by an extreme value.
            2 if bytes.len() >= 134 => {
                let odd = [f32::NAN, f32::INFINITY, 1e30, -1e-30, 0.0, f32::MAX][random.below(6)];
                let offset = 84 + 50 * random.below((bytes.len() - 84) / 50) + 12 + 4 * random.below(9);
                bytes[offset..offset + 4].copy_from_slice(&odd.to_le_bytes());
            }
            // Reverses or removes a triangle.
            3 if bytes.len() >= 134 => {
                let offset = 84 + 50 * random.below((bytes.len() - 84) / 50);
                let corner: Vec<u8> = bytes[offset + 12..offset + 24].to_vec();
                bytes.copy_within(offset + 24..offset + 36, offset + 12);
                bytes[offset + 24..offset + 36].copy_from_slice(&corner);
            }
            4 if bytes.len() >= 134 => {
                let offset = 84 + 50 * random.below((bytes.len() - 84) / 50);
                bytes.drain(offset..offset + 50);
            }
            // Changes the number of triangles in the header.
            5 if bytes.len() >= 84 => {
                let count = [0, 1, 11, 13, u32::MAX][random.below(5)];
                bytes[80..84].copy_from_slice(&u32::to_le_bytes(count));
            }
            // Overwrites the start of the file with the start of an ASCII file.
            _ => {
                let text = b"solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 nan\n";
                let length = text.len().min(bytes.len());
                bytes[..length].copy_from_slice(&text[..length]);
            }
        }
    }
    bytes
}

#[test]
fn two_hundred_damaged_files_are_refused_or_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("unit.stl");
    write_unit(&path, &ArmourUnit::cuboid(DVec3::new(0.1, 0.15, 0.2), 0.05).unwrap());
    let intact = std::fs::read(&path).unwrap();
    let case = settling_case(json!({ "path": "unit.stl" }), json!([{ "centre_m": [0.0, 0.5, 0.3] }]));
    try_run(&case, folder.path()).unwrap();
    let mut random = Random(5);
    let mut refused = 0;
    for _ in 0..200 {
        let bytes = damaged(&intact, &mut random);
        std::fs::write(&path, &bytes).unwrap();
        if let Err(message) = try_run(&case, folder.path()) {
            refused += 1;
            assert!(!message.is_empty());
        }
    }
    println!("{refused} of 200 files refused");
    assert!(refused > 100);
}

#[test]
fn two_hundred_random_poses_are_refused_or_run() {
    let folder = tempfile::tempdir().unwrap();
    let mut random = Random(11);
    let (mut refused, mut ran) = (0, 0);
    for attempt in 0..200 {
        let mut pose = || {
            let position: Vec<f64> =
                [[-1.2, 1.2], [-0.1, 1.1], [-0.05, 0.6]].map(|[low, high]| low + (high - low) * random.next()).to_vec();
            let q =
                glam::DQuat::from_xyzw(random.next() - 0.5, random.next() - 0.5, random.next() - 0.5, 0.1).normalize();
            // A twentieth of the quaternions is not normalised.
            let scale = if random.below(20) == 0 { 1.5 } else { 1.0 };
            json!({ "centre_m": position, "quaternion_xyzw": q.to_array().map(|c| scale * c) })
        };
        let poses: Vec<Value> = (0..1 + attempt % 4).map(|_| pose()).collect();
        let mut case = settling_case(json!(null), json!(poses));
        let units = case["units"].as_object_mut().unwrap();
        units.remove("stl");
        let (shape, height, mass) =
            [("tetrapod", 0.2, 5.0), ("dolos", 0.2, 3.0), ("core_loc", 0.2, 4.0), ("grooved_cube", 0.15, 8.0)]
                [attempt % 4];
        units.insert("shape".into(), json!(shape));
        units.insert("height_m".into(), json!(height));
        units.insert("mass_kg".into(), json!(mass));
        match try_run(&case, folder.path()) {
            Ok(()) => ran += 1,
            Err(message) => {
                refused += 1;
                assert!(!message.is_empty());
            }
        }
    }
    println!("{refused} of 200 cases refused, {ran} ran");
    assert!(ran > 10 && refused > 10);
}

/// Returns the case with one Tetrapod on a terrain from an STL file.
fn on_terrain(case: &Value) -> Value {
    let mut case = case.clone();
    case["flume"]["terrain"] = json!({ "path": "terrain.stl" });
    let units = case["units"].as_object_mut().unwrap();
    units.remove("stl");
    units.insert("shape".into(), json!("tetrapod"));
    units.insert("height_m".into(), json!(0.2));
    case
}

#[test]
fn a_run_on_terrain_keeps_the_surface_in_its_folder() {
    let folder = tempfile::tempdir().unwrap();
    // The unit falls on a block of 0.2 m in the middle.
    write_unit(&folder.path().join("terrain.stl"), &ArmourUnit::cuboid(DVec3::splat(0.2), 0.05).unwrap());
    let case = on_terrain(&settling_case(json!(null), json!([{ "centre_m": [0.0, 0.0, 0.3] }])));
    let mut case = case;
    case["domain"]["sides"] = json!("periodic");
    let name = folder.path().join("case.json").display().to_string();
    let parsed = DryTestCase::from_str(&case.to_string(), &name).unwrap();
    let run = folder.path().join("run");
    std::fs::create_dir(&run).unwrap();
    breakwater::simulation::dry_test::run::run(Arc::new(parsed.clone()), &run, &Control::quiet()).unwrap();
    let kept = DryTestCase::load(run.join("case.json")).unwrap();
    assert_eq!(kept.site.terrain, parsed.site.terrain);
    assert_eq!(
        std::fs::read(run.join("terrain.stl")).unwrap(),
        std::fs::read(folder.path().join("terrain.stl")).unwrap()
    );
}

/// Returns the text of an STL file with one solid per list of triangles.
fn stl_text(solids: &[Vec<[[f64; 3]; 3]>]) -> String {
    let vertex = |[x, y, z]: &[f64; 3]| format!("vertex {x} {y} {z}\n");
    let facet = |corners: &[[f64; 3]; 3]| {
        let corners: String = corners.iter().map(vertex).collect();
        format!("facet normal 0 0 0\nouter loop\n{corners}endloop\nendfacet\n")
    };
    let solid = |triangles: &Vec<_>| format!("solid\n{}endsolid\n", triangles.iter().map(facet).collect::<String>());
    solids.iter().map(solid).collect()
}

/// Returns two triangles that face up: a rectangle from (x0, y0) to (x1, y1) at the level z [m].
fn plate([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], z: f64) -> Vec<[[f64; 3]; 3]> {
    let [a, b, c, d] = [[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]];
    vec![[a, b, c], [a, c, d]]
}

/// Settles a cube of 0.1 m on a terrain and returns the level of its centre [m], or the reason of the refusal.
fn settled_level(terrain: &str, folder: &Path, change: impl FnOnce(&mut Value)) -> Result<f64, String> {
    std::fs::write(folder.join("terrain.stl"), terrain).unwrap();
    let mut case = settling_case(json!(null), json!([{ "centre_m": [0.5, 0.5, 0.26] }]));
    case["flume"]["bed_m"] = json!([[-2.0, -0.5], [2.0, -0.5]]);
    case["flume"]["terrain"] = json!({ "path": "terrain.stl" });
    case["units"]["shape"] = json!("cuboid");
    case["units"]["size_m"] = json!([0.1, 0.1, 0.1]);
    case["units"].as_object_mut().unwrap().remove("stl");
    case["stop"]["duration_s"] = json!(0.3);
    change(&mut case);
    let name = folder.join("case.json").display().to_string();
    let case = DryTestCase::from_str(&case.to_string(), &name).map_err(|errors| errors.to_string())?;
    let mut run = DryTest::new(Arc::new(case)).map_err(|error| error.to_string())?;
    while run.time() < 0.3 {
        run.advance(0.3).map_err(|error| error.to_string())?;
    }
    Ok(run.world.states()[0].position.z)
}

#[test]
fn all_solids_of_a_terrain_carry_a_unit() {
    let folder = tempfile::tempdir().unwrap();
    let (toe, berm) = (plate([-1.0, 0.0], [0.0, 1.0], 0.0), plate([0.0, 1.0], [0.0, 1.0], 0.2));
    let halves = [plate([0.0, 0.5], [0.0, 1.0], 0.2), plate([0.5, 1.0], [0.0, 1.0], 0.2)];
    let one = [toe.clone(), berm.clone()].concat();
    let layouts = [
        vec![one],
        vec![toe.clone(), berm.clone()],
        vec![berm, toe.clone()],
        vec![toe, Vec::new(), halves[0].clone(), halves[1].clone()],
    ];
    for solids in layouts {
        let level = settled_level(&stl_text(&solids), folder.path(), |_| ()).unwrap();
        // The cube rests on the berm at 0.2 m. Limit 1 mm: the overlap of the contact.
        assert!((level - 0.25).abs() < 1e-3, "{level} m with {} solids", solids.len());
    }
}

#[test]
fn a_misplaced_terrain_is_refused_with_the_reason() {
    let folder = tempfile::tempdir().unwrap();
    let at = |x: [f64; 2], y: [f64; 2], z: f64| stl_text(&[plate(x, y, z)]);
    let around = |z: f64| at([-1.0, 1.0], [0.0, 1.0], z);
    let reversed = |mut triangles: Vec<[[f64; 3]; 3]>| {
        triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
        stl_text(&[triangles])
    };
    let refused = [
        (at([-1000.0, 1000.0], [0.0, 1000.0], 200.0), "write 0.001 for a file in millimetres"),
        (at([-1e-3, 1e-3], [0.0, 1e-3], 2e-4), "must be of about the size of the domain"),
        (at([3.0, 5.0], [0.0, 1.0], 0.2), "must be in the domain, x = -1 to 1 m, y = 0 to 1 m"),
        (at([-1.0, 1.0], [-1.0, -0.1], 0.2), "must be in the domain"),
        (reversed(plate([-1.0, 1.0], [0.0, 1.0], 0.2)), "must be facing up"),
        (around(2.1), "must be below the top of the walls"),
        (around(-0.6), "must be above the bed"),
        (
            around(0.27),
            "unit 1 with its centre at (0.5, 0.5, 0.26) m: must be above the terrain, which is at z = 0.27 m",
        ),
        (around(0.2).replace("0.2\n", "0,2\n"), "line 4: found `0,2` instead of a number"),
    ];
    for (terrain, reason) in refused {
        let error = settled_level(&terrain, folder.path(), |_| ()).unwrap_err();
        assert!(error.contains(reason), "{error}, expected {reason}");
    }
    settled_level(&at([-1000.0, 1000.0], [0.0, 1000.0], 200.0), folder.path(), |case| {
        case["flume"]["terrain"]["scale"] = json!(0.001);
    })
    .unwrap();
}

#[test]
fn a_file_with_two_bodies_is_no_unit() {
    let folder = tempfile::tempdir().unwrap();
    let block = ArmourUnit::cuboid(DVec3::splat(0.1), 0.05).unwrap();
    let (corners, triangles) = (block.solid().vertices(), block.solid().triangles());
    // The second block stands apart from the first, touches it with a smaller face, or is inside it.
    for (scale, shift) in [(1.0, 0.2), (0.5, 0.075), (0.5, 0.0)] {
        let moved = |k: f64, x: f64| {
            let corner = |v: u32| (k * corners[v as usize] + DVec3::X * x).to_array();
            triangles.iter().map(|triangle| triangle.map(corner)).collect::<Vec<_>>()
        };
        let file = stl_text(&[moved(1.0, 0.0), moved(scale, shift)]);
        std::fs::write(folder.path().join("unit.stl"), file).unwrap();
        let case = settling_case(json!({ "path": "unit.stl" }), json!([{ "centre_m": [0.0, 0.5, 0.3] }]));
        let error = try_run(&case, folder.path()).unwrap_err();
        assert!(error.contains("must be one body (the file has 2 separate closed surfaces)"), "{error}");
    }
}

#[test]
fn two_hundred_damaged_terrains_are_refused_or_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("terrain.stl");
    let case = on_terrain(&settling_case(json!(null), json!([{ "centre_m": [0.0, 0.5, 0.3] }])));
    let missing = try_run(&case, folder.path()).unwrap_err();
    assert!(
        missing.contains("flume.terrain.path") && missing.contains("cannot be read") | missing.contains("can be read")
    );
    write_unit(&path, &ArmourUnit::cuboid(DVec3::new(0.5, 0.4, 0.2), 0.05).unwrap());
    let intact = std::fs::read(&path).unwrap();
    try_run(&case, folder.path()).unwrap();
    let mut random = Random(17);
    let mut refused = 0;
    for _ in 0..200 {
        std::fs::write(&path, damaged(&intact, &mut random)).unwrap();
        if let Err(message) = try_run(&case, folder.path()) {
            refused += 1;
            assert!(!message.is_empty());
        }
    }
    println!("{refused} of 200 terrains refused");
    // A terrain may have a hole but a unit may not, so fewer terrains than units are refused.
    assert!(refused > 50 && refused < 200);
}
