//! Runs that are killed at random moments, and runs that fill their disk: after `resume`, their files equal those of an
//! unbroken run.
//!
//! The short test is part of the suite. The long tests are the campaigns; their commands are in `ignore`.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
    thread::sleep,
    time::{Duration, Instant},
};

use hdf5_metno::{File, types::VarLenUnicode};
use serde_json::{Value, json};

use super::{assert_same_results, breakwater, files, message, tank};

/// The case of the tutorial, two Tetrapods under a solitary wave, with a checkpoint every 0.02 s.
fn tutorial() -> Value {
    let mut case: Value = serde_json::from_str(include_str!("../../cases/tutorial/units.json")).unwrap();
    case["output"]["checkpoint_interval_s"] = json!(0.02);
    case["reference"] = json!(Path::new(env!("CARGO_MANIFEST_DIR")).join("cases/fudo/reference"));
    case
}

/// A solitary wave that passes through a short domain with open ends, in two dimensions.
fn open_ends() -> Value {
    json!({
        "title": "open ends",
        "flume": { "bed_m": [[0.0, 0.0], [12.0, 0.0]], "still_water_level_m": 0.3,
                   "right_end": { "kind": "radiating" } },
        "domain": { "x_m": [3.0, 4.0], "sides": "two_dimensional", "top_z_m": 0.5, "dp_m": 0.03,
                    "start_at_share": 0.3 },
        "wave": { "kind": "solitary", "height_m": 0.1 },
        "wavemaker": { "kind": "open_ends" },
        "output": { "fluid_interval_s": 0.1, "series_interval_s": 0.01, "checkpoint_interval_s": 0.05 },
        "stop": { "duration_s": 1.5 }
    })
}

/// Pseudo-random numbers in [0, 1), from the linear congruential generator of Knuth's MMIX computer.
struct Random(u64);

impl Random {
    fn share(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Begins a run of the case file in the folder `out`, or resumes it if the folder has a checkpoint.
fn start_or_resume(case: &Path, out: &Path) -> Command {
    let [case, dir] = [case, out].map(|path| path.to_str().unwrap());
    if out.join("checkpoint.h5").exists() {
        breakwater(&["resume", dir])
    } else {
        breakwater(&["run", case, "--out", dir, "--overwrite"])
    }
}

/// A wave that moves a cuboid along the bed, in two dimensions. The fine water follows the cuboid.
fn sliding_cuboid() -> Value {
    let mut case = open_ends();
    case["domain"]["x_m"] = json!([3.0, 5.6]);
    case["domain"]["dp_m"] = json!(0.02);
    case["domain"]["fine_x_m"] = json!([[3.64, 4.6]]);
    case["units"] = json!({ "shape": "cuboid", "size_m": [0.12, 0.12, 0.12], "mass_kg": 2.0, "material": "ice",
                            "centres_m": [[4.1, 0.06, 0.06]] });
    case["materials"] = json!([{ "name": "ice", "young_modulus_pa": 1e7, "poisson_ratio": 0.3, "restitution": 0.5 }]);
    case["flume"]["material"] = json!("ice");
    case["friction"] = json!([{ "between": ["ice", "ice"], "coefficient": 0.02 }]);
    case
}

/// Kills runs of a case at random moments, resumes them after each kill, and compares each finished run with an unbroken
/// one. Ends when at least `kills` processes were killed; returns the state in the last checkpoint of the unbroken run.
fn kill_and_resume(case: &Value, kills: usize) -> Value {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.json");
    fs::write(&path, case.to_string()).unwrap();
    let (unbroken, killed) = (folder.path().join("unbroken"), folder.path().join("killed"));
    let begin = Instant::now();
    let ended = start_or_resume(&path, &unbroken).output().unwrap();
    assert!(ended.status.success(), "{}", message(&ended));
    let wall_s = begin.elapsed().as_secs_f64();
    let (mut random, mut done, mut runs, mut before_first) = (Random(1), 0, 0, 0);
    while done < kills {
        let _ = fs::remove_dir_all(&killed);
        loop {
            let mut child = start_or_resume(&path, &killed).spawn().unwrap();
            // Several kills in each run, on average at a quarter of the duration of the unbroken run.
            let wait = Duration::from_secs_f64(0.5 * wall_s * random.share());
            let begin = Instant::now();
            while begin.elapsed() < wait && child.try_wait().unwrap().is_none() {
                sleep(Duration::from_millis(1));
            }
            if child.try_wait().unwrap().is_none() {
                child.kill().unwrap();
                done += 1;
                before_first += usize::from(!killed.join("checkpoint.h5").exists());
            }
            let ended = child.wait_with_output().unwrap();
            if ended.status.success() {
                break;
            }
            // Without a code, the process ended by the signal.
            assert_eq!(ended.status.code(), None, "{}", message(&ended));
        }
        runs += 1;
        assert_same_results(&unbroken, &killed, &[]);
    }
    println!(
        "{done} kills in {runs} runs, {before_first} of them before the first checkpoint; unbroken run {wall_s:.1} s"
    );
    let checkpoint = File::open(unbroken.join("checkpoint.h5")).unwrap();
    let state: VarLenUnicode = checkpoint.attr("state").unwrap().read_scalar().unwrap();
    serde_json::from_str(&state).unwrap()
}

#[test]
fn killed_runs_end_with_the_results_of_an_unbroken_run() {
    let mut case = tank();
    case["output"]["fluid_interval_s"] = json!(0.05);
    case["output"]["checkpoint_interval_s"] = json!(0.02);
    case["stop"]["duration_s"] = json!(0.6);
    let state = kill_and_resume(&case, 5);
    let turns = state["statistics"]["rocking"][0]["turns"].as_u64().unwrap();
    assert!(turns > 0, "the block did not rock");
}

#[test]
fn killed_runs_with_open_ends_have_the_results_of_an_unbroken_run() {
    kill_and_resume(&open_ends(), 3);
}

#[test]
fn killed_runs_with_regions_have_the_results_of_an_unbroken_run() {
    let mut case = open_ends();
    case["domain"]["x_m"] = json!([3.0, 5.6]);
    case["domain"]["dp_m"] = json!(0.02);
    case["domain"]["fine_x_m"] = json!([[4.0, 4.7]]);
    kill_and_resume(&case, 3);
}

#[test]
fn killed_runs_whose_fine_water_moves_have_the_results_of_an_unbroken_run() {
    let state = kill_and_resume(&sliding_cuboid(), 3);
    // The fine water follows in hops of 0.08 m (four particle spacings).
    let moved = state["moved"][1].as_f64().unwrap();
    assert!(moved > 0.1, "the fine water moved only {moved} m");
}

#[test]
#[ignore = "10 to 17 min: cargo test --release --test resume -- --ignored --nocapture hundred"]
fn a_hundred_kills_do_not_change_the_results() {
    kill_and_resume(&tutorial(), 100);
}

/// A file system in memory of limited size, for the results of one run.
struct SmallDisk(PathBuf);

impl SmallDisk {
    fn mount(path: PathBuf, bytes: u64) -> Self {
        fs::create_dir(&path).unwrap();
        let size = format!("size={bytes}");
        assert!(
            Command::new("mount").args(["-t", "tmpfs", "-o", &size, "tmpfs"]).arg(&path).status().unwrap().success()
        );
        Self(path)
    }

    fn enlarge(&self) {
        let status = Command::new("mount").args(["-o", "remount,size=4g"]).arg(&self.0).status().unwrap();
        assert!(status.success());
    }
}

impl Drop for SmallDisk {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg("--lazy").arg(&self.0).status();
    }
}

#[test]
#[ignore = "7 min, as root: cargo test --release --test resume -- --ignored --nocapture full_disk"]
fn a_full_disk_gives_a_clear_message_and_keeps_the_last_checkpoint() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.json");
    fs::write(&path, tutorial().to_string()).unwrap();
    let unbroken = folder.path().join("unbroken");
    assert!(start_or_resume(&path, &unbroken).status().unwrap().success());
    let bytes: u64 = files(&unbroken).iter().map(|path| fs::metadata(unbroken.join(path)).unwrap().len()).sum();
    let mut random = Random(2);
    for number in 0..10 {
        let size = (random.share() * bytes as f64) as u64;
        let disk = SmallDisk::mount(folder.path().join(format!("disk{number}")), size.max(8192));
        let out = disk.0.join("out");
        let ended = start_or_resume(&path, &out).output().unwrap();
        let text = message(&ended);
        let checkpoint = out.join("checkpoint.h5").exists();
        let error = text.lines().last().unwrap_or_default();
        println!("disk of {:.2} MB, checkpoint: {checkpoint}: {error}", size as f64 * 1e-6);
        assert_eq!(ended.status.code(), Some(1), "{text}");
        let state = if checkpoint { "the last checkpoint is complete" } else { "there is no checkpoint yet" };
        let is_named = error.contains(state) || error.contains("the run is complete");
        assert!(error.contains("No space left on device; ") && is_named, "{text}");
        disk.enlarge();
        let ended = start_or_resume(&path, &out).output().unwrap();
        assert!(ended.status.success(), "{}", message(&ended));
        assert_same_results(&unbroken, &out, &[]);
    }
}
