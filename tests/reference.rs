//! Reference folders with measurements: runs are compared with a reference, a case keeps its reference, and invalid
//! references are refused with advice.

use std::{
    fs,
    path::{Path, PathBuf},
};

use breakwater::{
    case::{Case, Reference},
    output::{Summary, Table, UnitSummary, WaveSummary},
    report::compare::compare,
};
use serde_json::{Value, json};

/// Returns an invented reference: regular waves of one height and two periods over three units, measured twice.
fn reference() -> Value {
    json!({
        "title": "Three cubes on a slope", "source": "made up", "notes": ["The second unit has a mark."],
        "units": 3, "inner_units": [2, 2], "damage_distance_m": 0.05,
        "series": [
            { "name": "first", "role": "measured" },
            { "name": "second", "role": "measured" },
            { "name": "code", "role": "published_simulation", "dp_m": 0.01 }
        ],
        "waves": [
            { "kind": "regular", "height_m": 0.1, "period_s": 2.0, "displacements": "long.csv" },
            { "kind": "regular", "height_m": 0.1, "period_s": 1.0, "displacements": "short.csv", "convergence": "spacing.csv" }
        ]
    })
}

fn write_reference(folder: &Path, reference: &Value) {
    fs::create_dir_all(folder).unwrap();
    fs::write(folder.join("reference.json"), reference.to_string()).unwrap();
    fs::write(
        folder.join("long.csv"),
        "# a comment\nunit,first,second,code\n1,0.2,0.1,0.3\n2,0.1,0.1,0.3\n3,0.3,0,0.3\n",
    )
    .unwrap();
    fs::write(folder.join("short.csv"), "first,second,code\n0.02,0.02,0\n0.08,0.08,0\n0.02,0.02,0\n").unwrap();
    fs::write(folder.join("spacing.csv"), "dp_m,deviation_percent,runtime_h\n0.02,-50,0.5\n0.01,-100,\n").unwrap();
}

/// Writes the folder of a finished run of regular waves 0.1 m high.
fn write_run(folder: &Path, name: &str, period_s: f64, displacements: &[f64]) -> PathBuf {
    let dir = folder.join(name);
    fs::create_dir(&dir).unwrap();
    let wave = WaveSummary {
        kind: "regular".to_owned(),
        theory: "stream_function".to_owned(),
        height_m: 0.1,
        period_s: Some(period_s),
    };
    let mut summary = Summary { wave: Some(wave), dp_m: 0.01, ..Summary::default() };
    let unit = |(k, d): (usize, &f64)| UnitSummary::moved(k as u32 + 1, [0.0; 3], [*d, 0.0, 0.0], 0.0, 0.05);
    summary.set_units(displacements.iter().enumerate().map(unit).collect(), 0.05);
    summary.write(&dir).unwrap();
    dir
}

#[test]
fn runs_are_compared_with_the_wave_of_their_period() {
    let folder = tempfile::tempdir().unwrap();
    write_reference(&folder.path().join("flume"), &reference());
    let reference = Reference::load(&folder.path().join("flume")).unwrap_or_else(|errors| panic!("{errors}"));
    let short = write_run(folder.path(), "short", 1.0, &[0.02, 0.08, 0.02]);
    // This period differs by less than 0.5 % from the period in the reference.
    let slice = write_run(folder.path(), "slice", 2.005, &[0.2]);
    let comparison = compare(&[&slice, &short], &reference).unwrap();
    let [of_short, of_long] = &comparison.waves[..] else { panic!("two waves") };
    assert_eq!((of_short.reference.period_s, of_long.reference.period_s), (Some(1.0), Some(2.0)));
    let run = &of_short.runs[0];
    assert!(run.deviation_percent.abs() < 1e-9 && (run.damage_ratio - 1.0 / 3.0).abs() < 1e-12);
    // Limits: rounding. The two repetitions have mean displacements of 0.2 and 0.0667 m. In both repetitions together,
    // the inner unit moves 0.1 m on average. The run moves 0.2 m, 50 % more than the mean of all units and 100 % more
    // than the inner unit.
    let run = &of_long.runs[0];
    assert!((run.deviation_percent - 50.0).abs() < 1e-9 && (run.inner_deviation_percent - 100.0).abs() < 1e-9);
    let text = comparison.to_string();
    for words in [
        "Three cubes on a slope, made up",
        "Regular waves, H = 0.1 m, T = 1 s",
        "20.0 mm    -50.0 %  published, 0.5 h",
        "Its mean displacement deviates from the measured mean of the inner units (2 to 2) by +100.0 %.",
        "Measured mean displacement (2 repetitions): 0.133 m.",
        "The second unit has a mark.",
    ] {
        assert!(text.contains(words), "{words} in\n{text}");
    }
    let [html, csv] = comparison.write(folder.path()).unwrap();
    assert!(fs::read_to_string(html).unwrap().contains("Three cubes on a slope"));
    let table = Table::read(&csv).unwrap();
    assert_eq!((table.rows(), table.column("wave_period_s").unwrap()[6]), (3 + 3 + 1, 2.0));

    let other = write_run(folder.path(), "other", 1.5, &[0.1]);
    let message = compare(&[&other], &reference).unwrap_err().to_string();
    assert!(
        message.contains("regular 0.1 m, 1.5 s") && message.contains("regular 0.1 m, 1 s; regular 0.1 m, 2 s"),
        "{message}"
    );
}

#[test]
fn bad_reference_folders_are_refused_with_key_value_and_advice() {
    let refused = |key: &str, value: Value| {
        let (folder, mut reference) = (tempfile::tempdir().unwrap(), reference());
        *reference.pointer_mut(key).unwrap() = value;
        write_reference(folder.path(), &reference);
        Reference::load(folder.path()).unwrap_err().to_string()
    };
    for (key, value, words) in [
        ("/title", json!(" "), "title = \" \": must be a line of text"),
        (
            "/units",
            json!(4),
            "waves[0].displacements = \"long.csv\" with 3 rows: must be a table with 4 rows, one per unit",
        ),
        ("/inner_units", json!([2, 4]), "inner_units = [2, 4]: must be first and last unit in ascending order"),
        ("/damage_distance_m", json!(0), "damage_distance_m = 0: must be > 0"),
        ("/series/2/name", json!("third"), "must be a table with a column \"third\"; it has unit, first, second, code"),
        (
            "/series/2/name",
            json!("first"),
            "series[2].name = \"first\": must be different from the other names; rename one of them",
        ),
        ("/series/0/role", json!("guessed"), "unknown value \"guessed\"; allowed here: measured, published_simulation"),
        (
            "/series",
            json!([{ "name": "code", "role": "published_simulation" }]),
            "must be a list with a measured series",
        ),
        ("/waves/0/height_m", json!(-0.1), "waves[0].height_m = -0.1: must be at least 0.0005 and at most 5 m"),
        ("/waves/0/height_m", json!(100.0), "waves[0].height_m = 100: must be at least 0.0005 and at most 5 m"),
        ("/damage_distance_m", json!(50.0), "damage_distance_m = 50: must be > 0 and at most 20 m; write it in metres"),
        ("/damage_distance_m", json!(15.0), "waves[0].height_m = 0.1: must be at least 0.15"),
        ("/series/2/dp_m", json!(10.0), "series[2].dp_m = 10: must be > 0 and at most 0.05 m"),
        (
            "/waves/0/period_s",
            json!(1.0),
            "waves[1] = regular 0.1 m: must be different from the other waves; give the period",
        ),
        (
            "/waves/0/displacements",
            json!("none.csv"),
            "waves[0].displacements = \"none.csv\": must be a file that can be read",
        ),
        ("/waves/0/displacements", json!("../long.csv"), "must be the name of a .csv file, without folders"),
        ("/waves/1/convergence", json!("long.csv"), "must be a table with a column \"dp_m\""),
        (
            "/waves",
            json!([{ "kind": "regular", "hight_m": 0.1 }]),
            "unknown key \"hight_m\"; did you mean \"height_m\"?",
        ),
    ] {
        let message = refused(key, value);
        assert!(message.contains("reference.json: ") && message.contains(words), "{key}: {words}\nin {message}");
    }
    for (file, text, words) in [
        (
            "short.csv",
            "first,second,code\n0.02,0.02,0\n0.08,wet,0\n0.02,0.02,0\n",
            "line 3 is not 3 numbers; separate the numbers by commas",
        ),
        (
            "short.csv",
            "first,second,code\n20,20,0\n80,80,0\n20,20,0\n",
            "waves[1].displacements: first = 20: must be at least 0 and at most 5 m",
        ),
        (
            "spacing.csv",
            "dp_m,deviation_percent\n20,-50\n10,-100\n",
            "waves[1].convergence: dp_m = 20: must be > 0 and at most 0.05 m",
        ),
    ] {
        let folder = tempfile::tempdir().unwrap();
        write_reference(folder.path(), &reference());
        fs::write(folder.path().join(file), text).unwrap();
        let message = Reference::load(folder.path()).unwrap_err().to_string();
        assert!(message.contains(words), "{words}\nin {message}");
    }
}

#[test]
fn case_keeps_its_reference_and_its_hash() {
    let folder = tempfile::tempdir().unwrap();
    write_reference(&folder.path().join("flume"), &reference());
    let name = folder.path().join("case.json").display().to_string();
    let text = breakwater::case::template_text();
    let named = text.replacen("\"title\"", "\"reference\": \"./flume\", \"title\"", 1);
    let [plain, case] =
        [&text, &named].map(|text| Case::from_str(text, &name).unwrap_or_else(|errors| panic!("{errors}")));
    assert_eq!((&case.hash, &case.start_hash), (&plain.hash, &plain.start_hash));
    let kept: Value = serde_json::from_str(&case.text).unwrap();
    assert_eq!(kept["reference"], "reference");
    let reference = case.reference.unwrap();
    let names: Vec<&str> = reference.files.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, ["reference.json", "long.csv", "short.csv", "spacing.csv"]);
}
