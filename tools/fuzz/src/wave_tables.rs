//! The same wave as files of three programs, and the cases that read these files.

use breakwater::waves::external::openfoam::{Frame, Up, probes};
use breakwater::waves::external::swash::{self, Heading};
use breakwater::waves::external::table::{Layers, Place, VelocityTable};
use serde_json::{Value, json};

use crate::folder::Folder;

const PLACE: Place = Place { bed_z_m: 0.0, still_water_z_m: 0.4, gravity_m_s2: 9.81, layers: Layers::AtLeastTwo };
const SHARES: [f64; 3] = [0.5, 0.3, 0.2];

fn table() -> VelocityTable {
    let times_s: Vec<f64> = (0..12).map(|i| 0.25 * f64::from(i)).collect();
    let levels = vec![0.05, 0.2, 0.3];
    VelocityTable {
        surface_z_m: Some(times_s.iter().map(|t| 0.4 + 0.03 * t.sin()).collect()),
        heights_m: vec![levels; times_s.len()],
        velocities_m_s: times_s.iter().map(|t| vec![0.1 * t.sin(), 0.11 * t.sin(), 0.12 * t.sin()]).collect(),
        times_s,
    }
}

/// Content of a file that `write` fills.
fn content(write: impl FnOnce(&mut Vec<u8>) -> std::io::Result<()>) -> Vec<u8> {
    let mut content = Vec::new();
    write(&mut content).unwrap();
    content
}

/// Returns name and content of all files.
pub fn files() -> Vec<(&'static str, Vec<u8>)> {
    let table = table();
    let levels: Vec<f64> = (1..=9).map(|k| 0.05 * f64::from(k)).collect();
    let frame = Frame { up: Up::Y, origin_z_m: 0.1 };
    let line = |t: f64| {
        let row = |z: &f64| format!("{z} {} 0 0\n", 0.1 * t.sin());
        levels[..7].iter().map(row).collect::<String>().into_bytes()
    };
    vec![
        ("piston_velx.csv", content(|out| table.velx([4.0, 0.0], &levels[..7]).write(out))),
        ("level.tbl", content(|out| swash::write_level(&table, &PLACE, Heading::None, out))),
        ("velocity.tbl", content(|out| swash::write_velocities(&table, &PLACE, &SHARES, Heading::Names, out))),
        ("probes/0/U", content(|out| probes::write_velocities(&table, &levels, 4.0, frame, out))),
        ("probes/0/alpha.water", content(|out| probes::write_water(&table, &levels, 4.0, frame, out))),
        ("line/0/gauge_U.xy", line(0.0)),
        ("line/0.5/gauge_U.xy", line(0.5)),
        ("line/1/gauge_U.xy", line(1.0)),
    ]
}

/// Writes all files to a subfolder.
pub fn write(folder: &Folder, place: &str) {
    for (name, content) in files() {
        folder.write(&format!("{place}/{name}"), &content);
    }
}

/// Returns a case for each of the sources.
pub fn cases() -> Vec<Vec<u8>> {
    let sources: [Value; 4] = [
        json!({ "format": "dualsphysics", "path": "piston_velx.csv" }),
        json!({
            "format": "swash", "layer_shares": SHARES, "velocity": { "path": "velocity.tbl" },
            "level": { "path": "level.tbl", "columns": ["tsec", "watl"] }
        }),
        json!({ "format": "openfoam", "folder": "probes", "water": "alpha.water", "up": "y", "origin_z_m": 0.1 }),
        json!({ "format": "openfoam", "folder": "line", "line": "gauge" }),
    ];
    let case = |source: &Value| {
        json!({
            "title": "A wave from files",
            "flume": { "bed_m": [[0.0, 0.0], [12.0, 0.0]], "still_water_level_m": 0.4 },
            "domain": { "x_m": [4.0, 6.0], "width_m": 0.4, "sides": "periodic", "top_z_m": 0.6, "dp_m": 0.04 },
            "wave": { "kind": "file", "source": source },
            "stop": { "duration_s": 0.5 }
        })
    };
    sources.iter().map(|source| case(source).to_string().into_bytes()).collect()
}
