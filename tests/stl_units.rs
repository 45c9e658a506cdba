//! Units from STL files and at given poses: sound ones run, broken ones are refused; nothing panics or hangs.

use std::{path::Path, sync::Arc};

use breakwater::{
    case::DryCase,
    geometry::{armour_unit::ArmourUnit, stl},
    output::driver::Control,
    simulation::dry_test::DryRun,
};
use glam::DVec3;
use serde_json::{Value, json};

/// A dry case with one unit from `stl`, in the folder of which the case lies.
fn case_of(stl: Value, poses: Value) -> Value {
    json!({
        "title": "unit from STL",
        "dry": { "kind": "settle" },
        "flume": { "bed_m": [[-2.0, 0.0], [2.0, 0.0]], "material": "concrete" },
        "domain": { "x_m": [-1.0, 1.0], "width_m": 1.0, "sides": "walls", "top_z_m": 2.0 },
        "units": { "shape": "stl", "stl": stl, "mass_kg": 2.0, "material": "concrete", "poses": poses },
        "materials": [{ "name": "concrete", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }],
        "friction": [{ "between": ["concrete", "concrete"], "coefficient": 0.6 }],
        "contact": { "rounding_share": 0.05 },
        "stop": { "duration_s": 0.02 }
    })
}

/// Validate and run a case: what was refused, or nothing.
fn outcome(case: &Value, folder: &Path) -> Result<(), String> {
    let name = folder.join("case.json").display().to_string();
    let case = DryCase::from_str(&case.to_string(), &name).map_err(|errors| errors.to_string())?;
    let mut run = DryRun::new(Arc::new(case)).map_err(|error| error.to_string())?;
    while run.time() < 0.02 {
        run.advance(0.02).map_err(|error| error.to_string())?;
    }
    assert!(run.world.states().iter().all(|state| state.position.is_finite()));
    Ok(())
}

/// Numbers that follow from a seed, evenly distributed in 0..1.
struct Shares(u64);

impl Shares {
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
fn a_unit_from_stl_moves_like_that_of_the_catalogue() {
    let folder = tempfile::tempdir().unwrap();
    let cuboid = ArmourUnit::cuboid(DVec3::new(0.1, 0.15, 0.2), 0.05).unwrap();
    write_unit(&folder.path().join("block.stl"), &cuboid);
    let pose = json!([{ "centre_m": [0.0, 0.5, 0.3], "quaternion_xyzw": [0.1, 0.2, 0.3, 0.9273618495495704] }]);
    let from_stl = case_of(json!({ "path": "block.stl" }), pose);
    let mut catalogue = from_stl.clone();
    let units = catalogue["units"].as_object_mut().unwrap();
    units.remove("stl");
    units.insert("shape".into(), json!("cuboid"));
    units.insert("size_m".into(), json!([0.1, 0.15, 0.2]));
    let end = |case: &Value| {
        let name = folder.path().join("case.json").display().to_string();
        let case = DryCase::from_str(&case.to_string(), &name).unwrap_or_else(|errors| panic!("{errors}"));
        let mut run = DryRun::new(Arc::new(case)).unwrap();
        for _ in 0..400 {
            run.advance(10.0).unwrap();
        }
        run.world.states()[0]
    };
    let (a, b) = (end(&from_stl), end(&catalogue));
    println!("{} {}", a.position, b.position);
    // The file has single precision; an impact carries that on a hundredfold.
    assert!((a.position - b.position).length() < 1e-5);
}

#[test]
fn convex_parts_come_from_files_or_from_decomposition() {
    let folder = tempfile::tempdir().unwrap();
    let dolos = ArmourUnit::dolos(0.2, 0.34, 0.05).unwrap();
    write_unit(&folder.path().join("dolos.stl"), &dolos);
    for (number, block) in breakwater::geometry::dolos::blocks(0.2, 0.34).unwrap().iter().enumerate() {
        let (vertices, triangles) = breakwater::geometry::union::surface(std::slice::from_ref(block));
        stl::write(&folder.path().join(format!("part{number}.stl")), &vertices, &triangles).unwrap();
    }
    let pose = json!([{ "centre_m": [0.0, 0.5, 0.3] }]);
    let parts: Vec<String> = (0..5).map(|number| format!("part{number}.stl")).collect();
    outcome(&case_of(json!({ "path": "dolos.stl", "parts": parts }), pose.clone()), folder.path()).unwrap();
    // Four of five: the missing one is told as a share of the volume.
    let error = outcome(&case_of(json!({ "path": "dolos.stl", "parts": parts[1..] }), pose.clone()), folder.path());
    assert!(error.as_ref().unwrap_err().contains("of its volume"), "{error:?}");
    let found = outcome(&case_of(json!({ "path": "dolos.stl" }), pose), folder.path());
    println!("decomposed: {found:?}");
    // Parts that fill the unit, or a refusal that tells by how much they do not.
    assert!(found.is_ok() || found.unwrap_err().contains("of its volume"));
}

#[test]
fn a_surface_that_cuts_itself_is_refused_with_the_place() {
    let folder = tempfile::tempdir().unwrap();
    let cube = ArmourUnit::cuboid(DVec3::splat(0.2), 0.05).unwrap();
    let (mut vertices, mut triangles) = (cube.solid().vertices().to_vec(), cube.solid().triangles().to_vec());
    // A second cube that overlaps the first.
    let first = vertices.len() as u32;
    vertices.extend(cube.solid().vertices().iter().map(|v| *v + DVec3::new(0.1, 0.03, 0.02)));
    triangles.extend(cube.solid().triangles().iter().map(|t| t.map(|v| v + first)));
    stl::write(&folder.path().join("two.stl"), &vertices, &triangles).unwrap();
    let case = case_of(json!({ "path": "two.stl" }), json!([{ "centre_m": [0.0, 0.5, 0.3] }]));
    let error = outcome(&case, folder.path()).unwrap_err();
    assert!(error.contains("does not intersect itself") && error.contains("units.stl.path"), "{error}");
}

/// A binary STL file with one to three faults.
fn damaged(good: &[u8], shares: &mut Shares) -> Vec<u8> {
    let mut bytes = good.to_vec();
    for _ in 0..=shares.below(3) {
        match shares.below(7) {
            // A byte anywhere.
            0 => {
                let at = shares.below(bytes.len());
                bytes[at] = shares.below(256) as u8;
            }
            1 => bytes.truncate(shares.below(bytes.len()) + 1),
            // A coordinate that is no place.
            2 if bytes.len() >= 134 => {
                let odd = [f32::NAN, f32::INFINITY, 1e30, -1e-30, 0.0, f32::MAX][shares.below(6)];
                let at = 84 + 50 * shares.below((bytes.len() - 84) / 50) + 12 + 4 * shares.below(9);
                bytes[at..at + 4].copy_from_slice(&odd.to_le_bytes());
            }
            // A triangle turned round, doubled or left out.
            3 if bytes.len() >= 134 => {
                let at = 84 + 50 * shares.below((bytes.len() - 84) / 50);
                let corner: Vec<u8> = bytes[at + 12..at + 24].to_vec();
                bytes.copy_within(at + 24..at + 36, at + 12);
                bytes[at + 24..at + 36].copy_from_slice(&corner);
            }
            4 if bytes.len() >= 134 => {
                let at = 84 + 50 * shares.below((bytes.len() - 84) / 50);
                bytes.drain(at..at + 50);
            }
            // Another number of triangles than there are.
            5 if bytes.len() >= 84 => {
                let count = [0, 1, 11, 13, u32::MAX][shares.below(5)];
                bytes[80..84].copy_from_slice(&u32::to_le_bytes(count));
            }
            // A text that begins like an ASCII file.
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
fn two_hundred_broken_files_are_refused_or_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("unit.stl");
    write_unit(&path, &ArmourUnit::cuboid(DVec3::new(0.1, 0.15, 0.2), 0.05).unwrap());
    let good = std::fs::read(&path).unwrap();
    let case = case_of(json!({ "path": "unit.stl" }), json!([{ "centre_m": [0.0, 0.5, 0.3] }]));
    outcome(&case, folder.path()).unwrap();
    let mut shares = Shares(5);
    let mut refused = 0;
    for _ in 0..200 {
        let bytes = damaged(&good, &mut shares);
        std::fs::write(&path, &bytes).unwrap();
        if let Err(message) = outcome(&case, folder.path()) {
            refused += 1;
            assert!(!message.is_empty());
        }
    }
    println!("{refused} of 200 refused");
    assert!(refused > 100);
}

#[test]
fn two_hundred_random_poses_are_refused_or_run() {
    let folder = tempfile::tempdir().unwrap();
    let mut shares = Shares(11);
    let (mut refused, mut ran) = (0, 0);
    for attempt in 0..200 {
        let mut pose = || {
            let place: Vec<f64> =
                [[-1.2, 1.2], [-0.1, 1.1], [-0.05, 0.6]].map(|[low, high]| low + (high - low) * shares.next()).to_vec();
            let q =
                glam::DQuat::from_xyzw(shares.next() - 0.5, shares.next() - 0.5, shares.next() - 0.5, 0.1).normalize();
            // Some are no rotations.
            let scale = if shares.below(20) == 0 { 1.5 } else { 1.0 };
            json!({ "centre_m": place, "quaternion_xyzw": q.to_array().map(|c| scale * c) })
        };
        let poses: Vec<Value> = (0..1 + attempt % 4).map(|_| pose()).collect();
        let mut case = case_of(json!(null), json!(poses));
        let units = case["units"].as_object_mut().unwrap();
        units.remove("stl");
        let (shape, height, mass) =
            [("tetrapod", 0.2, 5.0), ("dolos", 0.2, 3.0), ("core_loc", 0.2, 4.0), ("grooved_cube", 0.15, 8.0)]
                [attempt % 4];
        units.insert("shape".into(), json!(shape));
        units.insert("height_m".into(), json!(height));
        units.insert("mass_kg".into(), json!(mass));
        match outcome(&case, folder.path()) {
            Ok(()) => ran += 1,
            Err(message) => {
                refused += 1;
                assert!(!message.is_empty());
            }
        }
    }
    println!("{refused} refused, {ran} ran");
    assert!(ran > 10 && refused > 10);
}

/// The same case on a triangle surface.
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
fn a_run_on_terrain_keeps_the_surface_beside_its_case() {
    let folder = tempfile::tempdir().unwrap();
    // A block of 0.2 m in the middle, on which the unit falls.
    write_unit(&folder.path().join("terrain.stl"), &ArmourUnit::cuboid(DVec3::splat(0.2), 0.05).unwrap());
    let case = on_terrain(&case_of(json!(null), json!([{ "centre_m": [0.0, 0.0, 0.3] }])));
    let mut case = case;
    case["domain"]["sides"] = json!("periodic");
    let name = folder.path().join("case.json").display().to_string();
    let parsed = DryCase::from_str(&case.to_string(), &name).unwrap();
    let run = folder.path().join("run");
    std::fs::create_dir(&run).unwrap();
    breakwater::simulation::dry_test::run::run(Arc::new(parsed.clone()), &run, &Control::quiet()).unwrap();
    let kept = DryCase::load(run.join("case.json")).unwrap();
    assert_eq!(kept.site.terrain, parsed.site.terrain);
    assert_eq!(
        std::fs::read(run.join("terrain.stl")).unwrap(),
        std::fs::read(folder.path().join("terrain.stl")).unwrap()
    );
}

#[test]
fn two_hundred_broken_terrains_are_refused_or_run() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("terrain.stl");
    let case = on_terrain(&case_of(json!(null), json!([{ "centre_m": [0.0, 0.5, 0.3] }])));
    let missing = outcome(&case, folder.path()).unwrap_err();
    assert!(
        missing.contains("flume.terrain.path") && missing.contains("cannot be read") | missing.contains("can be read")
    );
    write_unit(&path, &ArmourUnit::cuboid(DVec3::new(0.5, 0.4, 0.2), 0.05).unwrap());
    let good = std::fs::read(&path).unwrap();
    outcome(&case, folder.path()).unwrap();
    let mut shares = Shares(17);
    let mut refused = 0;
    for _ in 0..200 {
        std::fs::write(&path, damaged(&good, &mut shares)).unwrap();
        if let Err(message) = outcome(&case, folder.path()) {
            refused += 1;
            assert!(!message.is_empty());
        }
    }
    println!("{refused} of 200 terrains refused");
    // A surface with a hole can be stood upon; less is refused than of units.
    assert!(refused > 50 && refused < 200);
}
