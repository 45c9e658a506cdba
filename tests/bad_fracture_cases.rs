//! Every file in `tests/bad_fracture_cases` and every corrupted mesh is refused with its expected message. No corrupted
//! case or mesh makes the program panic.

use std::path::{Path, PathBuf};
use std::process::Command;

use breakwater::case::FractureCase;
use breakwater::simulation::fracture::run::world;
use proptest::prelude::*;
use serde_json::{Value, json};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Lists the case files with the lines that must appear in their error messages.
fn bad_cases() -> Vec<(PathBuf, Vec<String>)> {
    let entries = std::fs::read_dir(root().join("tests/bad_fracture_cases")).unwrap();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "json"));
    files.sort();
    let with_lines = |path: PathBuf| {
        let text = std::fs::read_to_string(path.with_extension("expect")).unwrap_or_else(|e| panic!("{path:?}: {e}"));
        (path, text.lines().map(str::to_owned).collect())
    };
    files.into_iter().map(with_lines).collect()
}

/// Lists the expected lines that the message lacks, and the lines of the message that do not name the file.
fn message_faults(message: &str, path: &Path, expected: &[String]) -> Vec<String> {
    let name = path.file_name().unwrap().to_string_lossy();
    let missing = expected.iter().filter(|line| !message.contains(line.as_str()));
    let mut found: Vec<String> =
        missing.map(|line| format!("{name}:\n  expected: {line}\n  message:  {message}")).collect();
    if expected.is_empty() {
        found.push(format!("{name}: its .expect file is empty"));
    }
    let nameless = message.lines().filter(|line| !line.contains(&*name));
    found.extend(nameless.map(|line| format!("{name}: a line of the message does not name the file: {line}")));
    found
}

#[test]
fn every_bad_case_is_refused_with_its_message() {
    let cases = bad_cases();
    assert!(cases.len() >= 40, "only {} bad cases found", cases.len());
    let mut found = Vec::new();
    for (path, expected) in cases {
        match FractureCase::load(&path) {
            Ok(_) => found.push(format!("{} was accepted", path.display())),
            Err(errors) => found.extend(message_faults(&errors.to_string(), &path, &expected)),
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

#[test]
fn program_refuses_every_bad_case_with_exit_code_2() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    for (path, expected) in bad_cases() {
        let mut program = Command::new(env!("CARGO_BIN_EXE_breakwater"));
        let run = program.arg("fracture").arg(&path).arg("--out").arg(&out).output().unwrap();
        let message = String::from_utf8_lossy(&run.stderr);
        assert_eq!(run.status.code(), Some(2), "{}: {message}", path.display());
        let found = message_faults(&message, &path, &expected);
        assert!(found.is_empty(), "{}", found.join("\n"));
        assert!(!out.exists(), "{} left a folder", path.display());
    }
}

/// Returns the text of a valid case, a block on a plate, and the text of its mesh.
fn valid_case_and_mesh() -> (String, String) {
    let mesh = std::fs::read_to_string(root().join("tests/data/meshes/block_on_plate.msh")).unwrap();
    let case = json!({
        "title": "A block on a plate",
        "assumptions": ["The strength is that of concrete."],
        "fracture": { "mesh": "mesh.msh", "scale": 1.0, "joints": "tied", "joint_penalty": 2.0, "dt_s": 1e-7 },
        "gravity_m_s2": [0.0, 0.0, -9.8],
        "bodies": [
            { "name": "block", "material": "concrete", "cracks": true, "velocity_m_s": [0.0, 0.0, -2.0] },
            { "name": "plate", "material": "concrete" }
        ],
        "constraints": [{ "set": "plate_bottom", "velocity_m_s": [null, null, 0.0] }],
        "materials": [{
            "name": "concrete", "density_kg_m3": 2340.0, "young_modulus_pa": 26e9, "poisson_ratio": 0.2,
            "strength": { "tensile_pa": 3.3e6, "cohesion_pa": 16.5e6, "friction_angle_deg": 30.0,
                          "fracture_energy_j_m2": 50.0, "sliding_energy_j_m2": 50.0 }
        }],
        "friction": [{ "between": ["block", "plate"], "coefficient": 0.6 }],
        "output": { "surfaces_interval_s": 1e-4, "energy_interval_s": 1e-5, "checkpoint_interval_s": 1e-4 },
        "stop": { "duration_s": 1e-3 }
    });
    (serde_json::to_string_pretty(&case).unwrap(), mesh)
}

/// Loads the valid case with another mesh; returns the error message if it is refused.
fn load_with_mesh(folder: &Path, mesh: &[u8]) -> Result<FractureCase, String> {
    std::fs::write(folder.join("mesh.msh"), mesh).unwrap();
    let name = folder.join("case.json");
    FractureCase::from_str(&valid_case_and_mesh().0, name.to_str().unwrap()).map_err(|errors| errors.to_string())
}

/// Returns the warnings for a cube with the pre-crack "crack mid", whose only body has the keys `body`.
fn warnings_for_cracked_cube(body: &str, joints: &str) -> Vec<String> {
    let mut case: serde_json::Value = serde_json::from_str(&valid_case_and_mesh().0).unwrap();
    case["bodies"] = json!([serde_json::from_str::<serde_json::Value>(body).unwrap()]);
    case["constraints"] = json!([]);
    case["friction"] = json!([{ "between": ["unit", "unit"], "coefficient": 0.6 }]);
    case["fracture"] = json!({ "mesh": "cube_with_crack_renumbered.msh", "joints": joints });
    let name = root().join("tests/data/meshes/case.json");
    FractureCase::from_str(&case.to_string(), name.to_str().unwrap()).unwrap().warnings
}

#[test]
fn pre_cracks_and_strengths_without_effect_are_reported() {
    let cracks = r#"{ "name": "unit", "material": "concrete", "cracks": true }"#;
    let has_words = |warnings: &[String], words: &str| warnings.iter().any(|warning| warning.contains(words));
    let closed = "4 of 4 faces of the pre-crack \"crack mid\" stay closed, because their body cannot crack";
    let unused = "\"concrete\" has a strength, but no body of this material can crack";
    let sound = warnings_for_cracked_cube(cracks, "tied");
    assert!(!has_words(&sound, closed) && !has_words(&sound, unused), "{sound:?}");
    let whole = r#"{ "name": "unit", "material": "concrete" }"#;
    let rigid = r#"{ "name": "unit", "material": "concrete", "rigid": true }"#;
    for body in [whole, rigid] {
        let warnings = warnings_for_cracked_cube(body, "tied");
        assert!(has_words(&warnings, closed) && has_words(&warnings, unused), "{warnings:?}");
    }
    let unbreakable = warnings_for_cracked_cube(cracks, "unbreakable");
    assert!(has_words(&unbreakable, closed), "{unbreakable:?}");
}

#[test]
fn every_corrupted_mesh_is_refused_with_its_message() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = valid_case_and_mesh().1;
    load_with_mesh(folder.path(), mesh.as_bytes()).unwrap();
    let replaced = |from: &str, to: &str| {
        assert!(mesh.contains(from), "{from:?} not in the mesh");
        mesh.replacen(from, to, 1)
    };
    let cases: [(String, &str); 17] = [
        (String::new(), "not a Gmsh mesh: its first line is not $MeshFormat; write it with `gmsh -3 -format msh41`"),
        (replaced("4.1 0 8", "2.2 0 8"), "MSH version 2.2 is not supported, only 4.1; set `Mesh.MshFileVersion = 4.1`"),
        (replaced("4.1 0 8", "4.0 0 8"), "MSH version 4.0 is not supported, only 4.1"),
        (mesh[..mesh.len() - 60].to_owned(), "inside section $Elements; it is incomplete: write or copy it again"),
        (mesh[..mesh.find("$Elements").unwrap()].to_owned(), "no section $Elements: the file contains no mesh"),
        (replaced("\n0 0 0.0001\n", "\nnan 0 0.0001\n"), "node 1 is at (NaN, 0, 0.0001); coordinates must be finite"),
        (replaced("\n0 0 0.0001\n", "\n0 inf 0.0001\n"), "node 1 is at (0, inf, 0.0001)"),
        (replaced("\n0 0 0.0001\n", "\nzero 0 0.0001\n"), "section $Nodes: found \"zero\", expected a number"),
        (replaced("\n29 1 2 3 4\n", "\n29 2 1 3 4\n"), "72 tetrahedra have a negative volume, the first is 29 at ("),
        (replaced("\n29 1 2 3 4\n", "\n29 1 2 3 3\n"), "1 of 72 tetrahedra are flat"),
        (replaced("\n29 1 2 3 4\n", "\n29 1 2 3 77\n"), "element 29 refers to node 77, which is not in section $Nodes"),
        (
            with_detached_triangle(&mesh),
            "physical surface \"plate_bottom\": 1 of 12 triangles are not faces of tetrahedra",
        ),
        (replaced("3 2 \"plate\"\n", "").replacen("\n5\n2 1", "\n4\n2 1", 1), "physical Volume 2 has no name"),
        (
            replaced("\n2 0 0 0 0 0 0 1 2 0\n$EndEntities", "\n2 0 0 0 0 0 0 0 0\n$EndEntities"),
            "is in no physical volume",
        ),
        (
            replaced("\n2 0 0 0 0 0 0 1 2 0\n$EndEntities", "\n2 0 0 0 0 0 0 1 1 0\n$EndEntities"),
            "physical volume \"plate\" has no tetrahedra",
        ),
        (replaced("3 2 4 36\n", "3 2 11 36\n"), "type 11 (second order)"),
        (
            replaced("\"plate_bottom\"", "\"crack_bottom\""),
            "physical surface \"crack_bottom\" is a crack because its name begins with \"crack\", but 12 of",
        ),
    ];
    for (mesh, expected) in cases {
        let message = load_with_mesh(folder.path(), mesh.as_bytes()).map(|_| ()).unwrap_err();
        assert!(message.contains(expected), "expected: {expected}\nmessage:  {message}");
        assert!(message.contains("case.json: fracture.mesh = \"") && message.contains("docs/cases.md"), "{message}");
        assert_eq!(message.lines().count(), 1, "{message}");
    }
}

/// Returns the mesh with the nodes of the first triangle of its first set changed. The triangle is then no longer a
/// face of a tetrahedron.
fn with_detached_triangle(mesh: &str) -> String {
    let set = "\n2 1 2 12\n";
    let start = mesh.find(set).unwrap() + set.len();
    let end = start + mesh[start..].find('\n').unwrap();
    format!("{}1 37 48 60{}", &mesh[..start], &mesh[end..])
}

/// Advances an accepted case by two time steps. A time step may return an error but must not panic.
fn run_two_steps(case: &FractureCase) {
    let Ok(mut world) = world(case) else { return };
    let _ = world.step().and_then(|()| world.step()).and_then(|()| world.check_limits());
}

#[test]
fn truncated_cases_are_refused_at_every_length() {
    let text = valid_case_and_mesh().0;
    for length in 0..text.trim_end().len() {
        assert!(FractureCase::from_str(&text[..length], "cut.json").is_err(), "accepted when cut at {length}");
    }
}

#[test]
fn extreme_values_give_an_error_or_a_case_that_runs() {
    let extreme = ["0", "-1", "1e308", "-1e308", "5e-324", "4294967295", "0.001", "null", "\"\"", "[]", "{}", "true"];
    let folder = tempfile::tempdir().unwrap();
    let (text, mesh) = valid_case_and_mesh();
    std::fs::write(folder.path().join("mesh.msh"), mesh).unwrap();
    let name = folder.path().join("extreme.json");
    let file: breakwater::case::file::FractureFile = serde_json::from_str(&text).unwrap();
    let valid = serde_json::to_value(&file).unwrap();
    let mut pointers = Vec::new();
    collect_pointers(&valid, String::new(), &mut pointers);
    for pointer in &pointers {
        for value in extreme {
            let mut changed = valid.clone();
            *changed.pointer_mut(pointer).unwrap() = serde_json::from_str(value).unwrap();
            match FractureCase::from_str(&changed.to_string(), name.to_str().unwrap()) {
                Ok(case) => run_two_steps(&case),
                Err(errors) => assert!(!errors.errors.is_empty(), "{pointer} = {value}: refused without a reason"),
            }
        }
    }
}

/// Collects the JSON pointers of a value and of everything inside it.
fn collect_pointers(value: &Value, pointer: String, pointers: &mut Vec<String>) {
    match value {
        Value::Object(object) => {
            object.iter().for_each(|(key, inner)| collect_pointers(inner, format!("{pointer}/{key}"), pointers));
        }
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(i, inner)| collect_pointers(inner, format!("{pointer}/{i}"), pointers));
        }
        _ => {}
    }
    pointers.push(pointer);
}

/// A corruption of a text file.
#[derive(Debug, Clone)]
enum Damage {
    /// The byte at a position is replaced.
    Byte(usize, u8),
    /// A line is removed.
    Removed(usize),
    /// A line is duplicated.
    Duplicated(usize),
    /// A copy of the line with the first number replaces the line with the second number.
    Copied(usize, usize),
    /// An extreme number replaces a word.
    Number(usize, &'static str),
}

fn damage() -> impl Strategy<Value = Damage> {
    let number = prop::sample::select(vec!["0", "-1", "1e300", "-1e-300", "1e9", "4294967296", "18446744073709551615"]);
    prop_oneof![
        (any::<usize>(), any::<u8>()).prop_map(|(position, byte)| Damage::Byte(position, byte)),
        (any::<usize>(), b'0'..=b'9').prop_map(|(position, digit)| Damage::Byte(position, digit)),
        any::<usize>().prop_map(Damage::Removed),
        any::<usize>().prop_map(Damage::Duplicated),
        (any::<usize>(), any::<usize>()).prop_map(|(from, to)| Damage::Copied(from, to)),
        (any::<usize>(), number).prop_map(|(word, number)| Damage::Number(word, number)),
    ]
}

fn corrupted(text: &str, damages: &[Damage]) -> Vec<u8> {
    let mut bytes = text.as_bytes().to_vec();
    for damage in damages {
        let separator = if matches!(damage, Damage::Number(..)) { b' ' } else { b'\n' };
        let mut lines: Vec<Vec<u8>> = bytes.split(|byte| *byte == separator).map(<[u8]>::to_vec).collect();
        let count = lines.len();
        match *damage {
            Damage::Byte(position, byte) => {
                let position = position % bytes.len().max(1);
                bytes.iter_mut().skip(position).take(1).for_each(|old| *old = byte);
                continue;
            }
            Damage::Removed(line) => drop(lines.remove(line % count)),
            Damage::Duplicated(line) => lines.insert(line % count, lines[line % count].clone()),
            Damage::Copied(from, to) => lines[to % count] = lines[from % count].clone(),
            Damage::Number(word, number) => lines[word % count] = number.as_bytes().to_vec(),
        }
        bytes = lines.join(&separator);
    }
    bytes
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn corrupted_meshes_are_refused_or_run(damages in prop::collection::vec(damage(), 1..4)) {
        let folder = tempfile::tempdir().unwrap();
        match load_with_mesh(folder.path(), &corrupted(&valid_case_and_mesh().1, &damages)) {
            Ok(case) => run_two_steps(&case),
            Err(message) => prop_assert!(message.contains("case.json: "), "{}", message),
        }
    }

    #[test]
    fn corrupted_cases_are_refused_or_run(damages in prop::collection::vec(damage(), 1..4)) {
        let (text, mesh) = valid_case_and_mesh();
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("mesh.msh"), mesh).unwrap();
        let text = String::from_utf8_lossy(&corrupted(&text, &damages)).into_owned();
        match FractureCase::from_str(&text, folder.path().join("case.json").to_str().unwrap()) {
            Ok(case) => run_two_steps(&case),
            Err(errors) => prop_assert!(!errors.errors.is_empty()),
        }
    }
}
