//! The output files of a fracture run: tables, files for ParaView, and the report with its sections and pictures.

use std::path::{Path, PathBuf};
use std::process::Command;

use breakwater::femdem::mesh::block::{Pattern, block};
use breakwater::output::{PolyDataMoments, Table};
use glam::DVec3;
use hdf5_metno::File;
use serde_json::{Value, json};

/// Impact speed of the beam [m/s]; the beam is weak enough to crack at this speed.
const SPEED: f64 = 4.0;

/// Writes the case and the mesh of a small beam that falls on a slab.
fn case(folder: &Path) -> PathBuf {
    let beam = block(DVec3::new(0.4, 0.1, 0.1), [8, 2, 2], Pattern::Diagonal);
    let slab = block(DVec3::new(0.4, 0.1, 0.1), [4, 1, 1], Pattern::Diagonal);
    // The beam starts 0.1 mm above the slab; half of its length overhangs.
    let bodies = [("beam", beam, DVec3::new(0.2, 0.0, 0.1001)), ("slab", slab, DVec3::ZERO)];
    std::fs::write(folder.join("beam.msh"), msh(&bodies)).unwrap();
    let case = json!({
        "title": "A beam that falls on the end of a slab",
        "fracture": { "mesh": "beam.msh" },
        "gravity_m_s2": [0, 0, -9.8],
        "bodies": [
            { "name": "beam", "material": "mortar", "cracks": true, "velocity_m_s": [0, 0, -SPEED] },
            { "name": "slab", "material": "mortar" }
        ],
        "materials": [{
            "name": "mortar", "density_kg_m3": 2340, "young_modulus_pa": 2.6e9, "poisson_ratio": 0.2,
            "strength": { "tensile_pa": 2e5, "cohesion_pa": 1e6, "friction_angle_deg": 30, "fracture_energy_j_m2": 5 }
        }],
        "landmarks": [{ "name": "edge of the slab", "low_m": [0.38, 0.0, 0.1], "high_m": [0.42, 0.1, 0.2] }],
        "output": { "surfaces_interval_s": 1e-4, "energy_interval_s": 2e-5, "tets_interval_s": 5e-4 },
        "stop": { "duration_s": 1e-3 }
    });
    let file = folder.join("beam.json");
    std::fs::write(&file, serde_json::to_string_pretty(&case).unwrap()).unwrap();
    file
}

/// Returns the text of an MSH 4.1 file with the given bodies, each shifted by a vector [m].
fn msh(bodies: &[(&str, breakwater::femdem::mesh::Mesh, DVec3)]) -> String {
    let mut names = format!("$PhysicalNames\n{}\n", bodies.len());
    let mut entities = format!("$Entities\n0 0 0 {}\n", bodies.len());
    let (mut nodes, mut tets, mut first_node, mut first_tet) = (String::new(), String::new(), 1, 1);
    for (tag, (name, mesh, shift)) in (1..).zip(bodies) {
        names += &format!("3 {tag} \"{name}\"\n");
        entities += &format!("{tag} -1 -1 -1 2 2 2 1 {tag} 0\n");
        nodes += &format!("3 {tag} 0 {}\n", mesh.nodes.len());
        (0..mesh.nodes.len()).for_each(|k| nodes += &format!("{}\n", first_node + k));
        mesh.nodes.iter().map(|node| *node + *shift).for_each(|n| nodes += &format!("{} {} {}\n", n.x, n.y, n.z));
        tets += &format!("3 {tag} 4 {}\n", mesh.tets.len());
        for (k, tet) in mesh.tets.iter().enumerate() {
            let [a, b, c, d] = tet.map(|node| first_node + node as usize);
            tets += &format!("{} {a} {b} {c} {d}\n", first_tet + k);
        }
        first_node += mesh.nodes.len();
        first_tet += mesh.tets.len();
    }
    let count = bodies.len();
    format!(
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n{names}$EndPhysicalNames\n{entities}$EndEntities\n\
         $Nodes\n{count} {n} 1 {n}\n{nodes}$EndNodes\n$Elements\n{count} {t} 1 {t}\n{tets}$EndElements\n",
        n = first_node - 1,
        t = first_tet - 1
    )
}

fn breakwater(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_breakwater")).args(arguments).output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{arguments:?}: {message}");
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn a_fracture_run_writes_tables_paraview_files_and_a_report() {
    let folder = tempfile::tempdir().unwrap();
    let (file, dir) = (case(folder.path()), folder.path().join("run"));
    let check_output = breakwater(&["check", file.to_str().unwrap()]);
    assert!(check_output.contains("tets.vtkhdf"), "{check_output}");
    breakwater(&["fracture", file.to_str().unwrap(), "--out", dir.to_str().unwrap(), "--quiet"]);

    let summary: Value = serde_json::from_str(&std::fs::read_to_string(dir.join("summary.json")).unwrap()).unwrap();
    for key in ["tets", "steps", "tet_steps_per_s", "energy_residual_ratio", "crack_area_m2", "fragments"] {
        assert!(!summary[key].is_null(), "{key}");
    }
    let impact = summary["impact_s"].as_f64().unwrap();
    // The beam falls 0.1 mm; the contact is detected one or two time steps later.
    let expected = 1e-4 / SPEED;
    assert!((expected..1.5 * expected).contains(&impact), "{impact}");
    let initiation = summary["initiation"].as_array().unwrap();
    assert!(!initiation.is_empty(), "no joint has cracked");
    for crack in initiation {
        let since = crack["t_s"].as_f64().unwrap() - impact;
        assert_eq!(crack["since_impact_s"].as_f64().unwrap(), since);
        assert_eq!(crack["near"], "edge of the slab");
        assert!(crack["place"].as_array().unwrap().len() == 3 && crack["mode"].is_string());
    }

    let cracks = Table::read(&dir.join("cracks.csv")).unwrap();
    let area: f64 = cracks.column("area_m2").unwrap().iter().sum();
    // The numbers are equal, because both sums have the same order and the files keep all digits.
    assert_eq!(area, summary["crack_area_m2"].as_f64().unwrap());
    let fragments = Table::read(&dir.join("fragments.csv")).unwrap();
    assert_eq!(fragments.rows(), summary["fragments"].as_array().unwrap().len());
    let mass: f64 = fragments.column("mass_kg").unwrap().iter().sum();
    // Limit 1e-12: rounding of some hundred volumes.
    assert!((mass / (0.4 * 0.1 * 0.1 * 2340.0) - 1.0).abs() < 1e-12, "{mass}");

    let section = PolyDataMoments::open(&dir.join("section.vtkhdf")).unwrap();
    assert_eq!(section.times_s().len(), 11);
    let section_area: f64 =
        section.corners(0).unwrap().iter().map(|[a, b, c]| 0.5 * (*b - *a).cross(*c - *a).length()).sum();
    // The section cuts both bodies along their middle. Limit 1e-6: positions are in single precision.
    assert!((section_area - 0.08).abs() < 1e-6, "{section_area}");
    let tets = File::open(dir.join("tets.vtkhdf")).unwrap();
    let count = summary["tets"].as_u64().unwrap() as i64;
    let cells: Vec<i64> = tets.dataset("VTKHDF/NumberOfCells").unwrap().read_raw().unwrap();
    assert_eq!(cells, [count; 3]);
    let fragment: Vec<i32> = tets.dataset("VTKHDF/CellData/fragment").unwrap().read_raw().unwrap();
    let last = &fragment[2 * count as usize..];
    assert_eq!(last.iter().max().copied().unwrap() as usize, fragments.rows());
    assert!(last.contains(&0), "the slab cannot crack");

    let report = std::fs::read_to_string(dir.join("report.html")).unwrap();
    for heading in ["Crack initiation", "Pictures", "Energy", "Pieces", "How the run was made"] {
        assert!(report.contains(&format!("<h2>{heading}</h2>")), "{heading}");
    }
    let pictures = report.matches("data:image/png;base64,").count();
    assert!((8..=12).contains(&pictures), "{pictures} pictures of four to six moments");
    // The search leaves out the pictures, because their base64 text may contain "NaN" by chance.
    let text: String = report.split('"').filter(|part| !part.starts_with("data:")).collect();
    assert!(text.contains("the edge of the slab") && !text.contains("NaN"));
    // The report must be small enough for an e-mail.
    assert!(report.len() < 2_000_000, "{} bytes", report.len());
    std::fs::remove_file(dir.join("report.html")).unwrap();
    breakwater(&["report", dir.to_str().unwrap()]);
    assert_eq!(std::fs::read_to_string(dir.join("report.html")).unwrap(), report);
}

#[test]
fn invalid_landmarks_and_sections_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = case(folder.path());
    let mut value: Value = serde_json::from_str(&std::fs::read_to_string(&file).unwrap()).unwrap();
    value["landmarks"][0]["high_m"][1] = json!(-0.1);
    value["landmarks"][0]["name"] = json!(" ");
    value["output"]["section"] = json!({ "point_m": [0, 0, 0], "normal": [0, 0, 0] });
    value["output"]["tets_interval_s"] = json!(-1);
    std::fs::write(&file, value.to_string()).unwrap();
    let output =
        Command::new(env!("CARGO_BIN_EXE_breakwater")).args(["check", file.to_str().unwrap()]).output().unwrap();
    let message = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(2), "{message}");
    let keys =
        ["landmarks[0].high_m[1] = -0.1", "landmarks[0].name", "output.section.normal", "output.tets_interval_s = -1"];
    keys.into_iter().for_each(|key| assert!(message.contains(key), "{key} in {message}"));
}
