//! The files and reports of an invented run: units slide over a mound while a wave crest passes.

use std::f64::consts::PI;
use std::path::{Path, PathBuf};

use breakwater::{
    case::Reference,
    output::{
        Cells, ContactSummary, CsvSeries, EnergySummary, Execution, FieldKind, FieldValues, GaugeSummary, OutputError,
        ParticleCounts, PolyDataSeries, Stopped, Summary, TimeStepSummary, UnitSummary, UnitSurface, WaveSummary,
        columns,
    },
    report::{compare::compare, run::write_report},
};

const DAMAGE_DISTANCE_M: f64 = 0.077;
const START_Z_M: f64 = 0.755;

/// Creates an empty folder inside the build folder. Its files are kept after the test for inspection.
fn empty_folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    if folder.exists() {
        std::fs::remove_dir_all(&folder).unwrap();
    }
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Returns the surface of four conical legs from the centre to the corners of a tetrahedron. One leg points upwards.
fn four_legs() -> UnitSurface {
    let (mut vertices_m, mut triangles) = (Vec::new(), Vec::new());
    let slant = (-1.0_f64 / 3.0, (8.0_f64 / 9.0).sqrt());
    let mut directions = vec![[0.0, 0.0, 1.0]];
    directions.extend((0..3).map(|i| {
        let angle = PI + 2.0 * PI * f64::from(i) / 3.0;
        [slant.1 * angle.cos(), slant.1 * angle.sin(), slant.0]
    }));
    const AROUND: u32 = 14;
    for d in directions {
        let side = if d[2].abs() < 0.9 { [0.0, 0.0, 1.0] } else { [1.0, 0.0, 0.0] };
        let cross = |a: [f64; 3], b: [f64; 3]| {
            [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
        };
        let unit = |v: [f64; 3]| v.map(|c| c / v.iter().map(|c| c * c).sum::<f64>().sqrt());
        let e1 = unit(cross(d, side));
        let e2 = cross(d, e1);
        let base = vertices_m.len() as u32;
        for (along, radius) in [(-0.005, 0.0), (0.0, 0.019), (0.047, 0.0125), (0.047, 0.0)] {
            for k in 0..AROUND {
                let angle = 2.0 * PI * f64::from(k) / f64::from(AROUND);
                vertices_m.push([0, 1, 2].map(|i| along * d[i] + radius * (angle.cos() * e1[i] + angle.sin() * e2[i])));
            }
        }
        for ring in 0..3 {
            for k in 0..AROUND {
                let (a, b) = (base + ring * AROUND + k, base + ring * AROUND + (k + 1) % AROUND);
                triangles.extend([[a, b, b + AROUND], [a, b + AROUND, a + AROUND]]);
            }
        }
    }
    UnitSurface { vertices_m, triangles }
}

/// Returns position and orientation (a rotation about y) of a unit at a time [s].
fn pose(unit: u32, time: f64) -> ([f64; 3], [f64; 4]) {
    let slid = ((time - 2.0) / 2.0).clamp(0.0, 1.0);
    let slid = slid * slid * (3.0 - 2.0 * slid);
    let distance = slid * (0.16 + 0.09 * f64::from(unit * 7 % 5) / 4.0);
    let fall = (0.5 * (distance - 0.16)).max(0.0);
    let y = 0.04 + 0.08 * f64::from(unit - 1);
    let turn = 8.0 * fall;
    // Even units are turned by half a circle about the vertical.
    let (s, c) = ((0.5 * turn).sin(), (0.5 * turn).cos());
    let orientation = if unit % 2 == 1 { [0.0, s, 0.0, c] } else { [-s, 0.0, c, 0.0] };
    ([39.0 + distance, y + 0.1 * fall * f64::from(unit % 3), START_Z_M - fall], orientation)
}

fn crest(time: f64, at: f64, height: f64) -> f64 {
    height / (1.6 * (time - at)).cosh().powi(2)
}

fn summary(units: u32) -> Summary {
    let mut summary = Summary {
        title: "Row of Tetrapods on a PVC mound, H = 4.5 cm".to_owned(),
        breakwater_version: "0.1.0".to_owned(),
        case_hash: "7d0c2f1b9a8e4c55".to_owned(),
        wave: Some(WaveSummary {
            kind: "solitary".to_owned(),
            theory: "rayleigh".to_owned(),
            height_m: 0.045,
            period_s: None,
        }),
        gauges: vec![
            GaugeSummary { name: "WG6".to_owned(), x_m: 36.0, crest_sph_m: Some(0.0569), crest_flume_m: Some(0.0578) },
            GaugeSummary { name: "WG7".to_owned(), x_m: 38.7, crest_sph_m: None, crest_flume_m: Some(0.0611) },
        ],
        contacts: ContactSummary {
            with_bed: 1834,
            between_units: 212,
            peak_force_n: 31.4,
            peak_normal_velocity_m_s: 0.42,
        },
        energy: Some(EnergySummary { start_j: -12.0, end_j: -3.5 }),
        assumptions: vec![
            "Crest width of the mound 0.32 m: read from the measured displacements, no source gives it.".to_owned(),
            "Side slopes 1:2.".to_owned(),
        ],
        warnings: vec!["at 2.150 s water moved at 3.25 m/s".to_owned()],
        largest_mach: Some(0.12),
        particles: 2_338_876,
        particle_counts: ParticleCounts { water: 1_800_000, bed: 500_000, wavemaker: 36_825, units: 2_051 },
        dp_m: 0.005,
        speed_of_sound_m_s: 27.1,
        still_water_level_m: 0.8,
        domain_x_m: [35.0, 41.0],
        domain_width_m: 0.08 * f64::from(units.max(1)),
        side_walls: units == 15,
        two_dimensional: false,
        steps: 151_234,
        simulated_s: 8.0,
        start_s: 11.25,
        time_step_s: TimeStepSummary { min: 3.1e-5, mean: 5.3e-5, max: 6.0e-5 },
        stopped: Stopped::AtRest,
        execution: Execution { wall_s: 9876.0, steps_per_s: 15.3, threads: 16, ..Execution::default() },
        ..Summary::default()
    };
    let moved = |unit: u32| {
        let (start, _) = pose(unit, 0.0);
        let (end, q) = pose(unit, 8.0);
        let turned = 2.0 * (q[1].hypot(q[0])).asin().to_degrees();
        let mut moved = UnitSummary::moved(unit, start, end, turned, DAMAGE_DISTANCE_M);
        (moved.peak_fluid_force_n, moved.peak_contact_force_n) = (1.8, 14.2);
        (moved.bed_contacts, moved.unit_contacts) = (120, 14);
        moved
    };
    summary.set_units((1..=units).map(moved).collect(), DAMAGE_DISTANCE_M);
    summary
}

fn write_run(folder: &Path, units: u32) -> Result<(), OutputError> {
    summary(units).write(folder)?;
    let mut profile = CsvSeries::create(&folder.join("profile.csv"), &columns::PROFILE)?;
    profile.append_rows(CORNERS)?;
    let [now, mean] = columns::pressure("P1");
    let names = [columns::elevation("WG6"), columns::elevation("WG7"), now, mean];
    let velocity = columns::velocity("ADV");
    let gauge_columns: Vec<&str> =
        std::iter::once("time_s").chain(names.iter().chain(&velocity).map(String::as_str)).collect();
    let mut gauges = CsvSeries::create(&folder.join("gauges.csv"), &gauge_columns)?;
    let mut flume = CsvSeries::create(&folder.join("flume_gauges.csv"), &gauge_columns[..3])?;
    let mut energy = CsvSeries::create(&folder.join("energy.csv"), &columns::ENERGY)?;
    let mut motion = (units > 0).then(|| CsvSeries::create(&folder.join("units.csv"), &columns::UNITS)).transpose()?;
    // Many units have fewer rows, so that the table stays small.
    let every = if units > 100 { 10 } else { 1 };
    for i in (0..=800).step_by(every) {
        let t = 0.01 * f64::from(i);
        let ripple = 0.0006 * (9.0 * t).sin();
        let (eta6, eta7) = (crest(t, 1.6, 0.0575), crest(t, 2.7, 0.061));
        let pressure = 780.0 + 9000.0 * eta7;
        gauges.append(&[t, eta6 + ripple, eta7 + ripple, pressure, pressure, 3.0 * eta7, 0.0, 0.3 * ripple])?;
        flume.append(&[t, eta6, eta7 + 0.001])?;
        energy.append(&[
            t,
            60.0 * eta6,
            -10.0 + 80.0 * eta7,
            0.1 * t,
            0.5 * eta7,
            -0.1 * t,
            t,
            -0.3 * t,
            -0.01 * t,
            0.0,
            0.0,
        ])?;
        for unit in 1..=units {
            let ([x, y, z], q) = pose(unit, t);
            let drag = crest(t, 2.6, 1.6 + 0.05 * f64::from(unit)) - crest(t, 4.0, 0.5);
            let force = if (2.0..4.2).contains(&t) { 3.0 + (70.0 * t + f64::from(unit)).sin() } else { 1.9 };
            let mut row = vec![t, f64::from(unit), x, y, z, q[0], q[1], q[2], q[3]];
            let after = pose(unit, t + 0.01).0;
            row.extend([(after[0] - x) / 0.01, (after[1] - y) / 0.01, (after[2] - z) / 0.01, 0.0, 0.0, 0.0]);
            row.extend([drag, 0.0, 1.0 + 0.4 * drag, 0.0, 0.0, 0.0, -0.3 * force, 0.0, force, 0.0, 0.0, 0.0]);
            if let Some(motion) = &mut motion {
                motion.append(&row)?;
            }
        }
    }
    if units > 0 {
        four_legs().write(&folder.join(UnitSurface::FILE))?;
    }
    Ok(())
}

/// Corners of the bed with the mound [m].
const CORNERS: [[f64; 2]; 6] =
    [[19.0, 0.0], [38.73, 0.658], [38.84, 0.717], [39.16, 0.717], [39.25, 0.675], [45.0, 0.867]];

fn bed(x: f64) -> f64 {
    let segment = CORNERS.windows(2).find(|segment| x <= segment[1][0]).unwrap();
    segment[0][1] + (segment[1][1] - segment[0][1]) * (x - segment[0][0]) / (segment[1][0] - segment[0][0])
}

/// Writes a few layers of water particles around the middle of the flume; their number changes as the crest passes.
fn write_water(folder: &Path, width: f64) -> Result<(), OutputError> {
    let fields = [("velocity", FieldKind::Vector), ("pressure", FieldKind::Scalar), ("id", FieldKind::Integer)];
    let mut fluid = PolyDataSeries::create(&folder.join("fluid.vtkhdf"), Cells::Vertices, &fields)?;
    for time in [0.0, 1.0, 2.0, 2.6, 3.0, 4.0, 8.0] {
        let (mut points, mut velocity) = (Vec::new(), Vec::new());
        for i in 0..600 {
            let x = 37.5 + 0.005 * (f64::from(i) + 0.5);
            let eta = crest(time - (x - 39.0) / 3.0, 2.6, 0.061);
            for k in 0..200 {
                let z = bed(x) + 0.005 * (f64::from(k) + 0.5);
                for layer in -2..2 {
                    if z < 0.8 + eta {
                        let y = 0.5 * width + 0.005 * (f64::from(layer) + 0.5);
                        points.push([x as f32, y as f32, z as f32]);
                        velocity.push([18.0 * eta as f32, 0.0, 0.0]);
                    }
                }
            }
        }
        let pressure = vec![0.0; points.len()];
        let id: Vec<i32> = (0..points.len() as i32).collect();
        let values = [FieldValues::Vector(&velocity), FieldValues::Scalar(&pressure), FieldValues::Integer(&id)];
        fluid.append(time, &points, &[], &values)?;
    }
    Ok(())
}

/// Writes the water and the surfaces of the units.
fn write_paraview(folder: &Path, width: f64) -> Result<(), OutputError> {
    write_water(folder, width)?;
    let surface = four_legs();
    let mut units =
        PolyDataSeries::create(&folder.join("units.vtkhdf"), Cells::Triangles, &[("unit", FieldKind::Integer)])?;
    for step in 0..4_u16 {
        let at = |v: &[f64; 3]| [v[0] as f32 + 0.1 * f32::from(step), v[1] as f32, v[2] as f32];
        let points: Vec<[f32; 3]> = surface.vertices_m.iter().map(at).collect();
        let triangles = if step == 2 { &surface.triangles[..100] } else { &surface.triangles };
        let unit = vec![1; points.len()];
        units.append(0.02 * f64::from(step), &points, triangles, &[FieldValues::Integer(&unit)])?;
    }
    Ok(())
}

#[test]
fn the_report_shows_units_gauges_and_assumptions() {
    for units in [2, 15] {
        let folder = empty_folder(&format!("run_{units}"));
        write_run(&folder, units).unwrap();
        write_paraview(&folder, 0.08 * f64::from(units)).unwrap();
        let html = std::fs::read_to_string(write_report(&folder).unwrap()).unwrap();
        for words in [
            "Damage ratio",
            "Mean displacement",
            "Side view after the wave",
            "WG7",
            "Side slopes 1:2.",
            "units.vtkhdf",
            "<li>at 2.150 s water moved at 3.25 m/s</li>",
            "0.12 times the speed of sound",
        ] {
            assert!(html.contains(words), "{words}");
        }
        // The compressed data of the film contain every sequence of three letters.
        let (before, rest) = html.split_once("id=\"film-data\">").unwrap();
        let after = rest.split_once("</script>").unwrap().1;
        for part in [before, after] {
            assert!(!part.contains("NaN") && !part.contains("inf "), "the report contains a number that is not finite");
        }
        assert!(
            !html.contains("http://") && !html.contains("https://") && !html.contains("<script src"),
            "the report needs other files"
        );
        assert_eq!(html.matches("<svg").count(), html.matches("</svg>").count());
        // The water of the film has at most 9 MB; the report must be small enough for an e-mail.
        assert!(html.contains("id=\"film-picture\"") && html.len() < 15_000_000, "{} bytes", html.len());
    }
}

#[test]
fn the_report_of_500_units_is_small_and_its_numbers_do_not_overlap() {
    let folder = empty_folder("run_500");
    write_run(&folder, 500).unwrap();
    let html = std::fs::read_to_string(write_report(&folder).unwrap()).unwrap();
    assert!(html.len() < 15_000_000, "{} bytes", html.len());
    assert!(html.contains("mean of all units") && html.contains("id=\"film-choice\""));
    // Numbers of the top view: at least 14 px apart in height, so at most 40 in a column of 560 px.
    let plan = html.split("<title>Top view of the units").nth(1).unwrap().split("</svg>").next().unwrap();
    let mut heights: Vec<f64> = (plan.split("class=\"note halo\"").skip(1))
        .map(|label| label.split(" y=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap())
        .collect();
    heights.sort_by(f64::total_cmp);
    assert!(heights.len() > 10 && heights.len() <= 3 * 40, "{}", heights.len());
}

#[test]
fn the_report_shows_the_wave_at_the_units() {
    let folder = empty_folder("run_wave");
    write_run(&folder, 2).unwrap();
    write_paraview(&folder, 0.16).unwrap();
    let html = std::fs::read_to_string(write_report(&folder).unwrap()).unwrap();
    let moments = [
        "<strong>0 s.</strong> Start of the particle simulation",
        "<strong>2.6 s.</strong> Near the peak of the mean horizontal force of the water",
        "<strong>3 s.</strong> Near the peak of the mean speed of the units",
        "<strong>8 s.</strong> End of the run",
    ];
    let places: Vec<usize> = moments.iter().map(|words| html.find(words).expect(words)).collect();
    assert!(places.is_sorted(), "the moments are not in the order of time");
    // The middle of the flume is between two layers of particles. The picture shows the layer with the larger y.
    assert!(html.contains("less than 3.8 mm from y = 0.0825 m") && html.contains("picture.svg"));

    let picture = std::fs::read_to_string(folder.join("picture.svg")).unwrap();
    assert!(picture.starts_with("<svg xmlns=") && picture.contains("Flume time 2.6 s. Near the peak"));
    assert!(!picture.contains("var(") && !picture.contains("NaN"), "the picture uses colours of the page or NaN");
    let classes = picture.split("class=\"").skip(1).flat_map(|rest| rest.split('"').next().unwrap().split(' '));
    for class in classes.filter(|class| *class != "unit") {
        let styled = [" {", ","].iter().any(|after| picture.contains(&format!(".{class}{after}")));
        assert!(styled, "the picture itself does not define the style {class}");
    }
}

#[test]
fn the_wave_is_shown_without_units_but_not_without_water() {
    let folder = empty_folder("wave_0");
    write_run(&folder, 0).unwrap();
    let html = std::fs::read_to_string(write_report(&folder).unwrap()).unwrap();
    assert!(!html.contains("The wave ") && !folder.join("picture.svg").exists());
    write_water(&folder, 0.08).unwrap();
    let html = std::fs::read_to_string(write_report(&folder).unwrap()).unwrap();
    assert!(html.contains("The wave in the flume") && html.contains("<strong>8 s.</strong> End of the run"));
    let picture = std::fs::read_to_string(folder.join("picture.svg")).unwrap();
    assert!(picture.contains("Flume time 8 s. End of the run."));
}

#[test]
fn the_report_works_without_units_and_without_gauges() {
    let folder = empty_folder("run_0");
    write_run(&folder, 0).unwrap();
    std::fs::remove_file(folder.join("flume_gauges.csv")).unwrap();
    let html = std::fs::read_to_string(write_report(&folder).unwrap()).unwrap();
    assert!(html.contains("Water at the gauges") && !html.contains("Damage ratio"));

    let bare = empty_folder("run_bare");
    Summary { title: "Still water".to_owned(), ..Summary::default() }.write(&bare).unwrap();
    let html = std::fs::read_to_string(write_report(&bare).unwrap()).unwrap();
    assert!(html.contains("Still water") && !html.contains("Water at the gauges"));
}

#[test]
fn the_report_of_a_folder_without_a_summary_is_refused() {
    let folder = empty_folder("run_none");
    let error = write_report(&folder).unwrap_err().to_string();
    assert!(error.contains("summary.json"), "{error}");
}

#[test]
fn runs_are_compared_with_the_experiment() {
    let (full, slice) = (empty_folder("compare_full"), empty_folder("compare_slice"));
    write_run(&full, 15).unwrap();
    write_run(&slice, 2).unwrap();
    let comparison = compare(&[&full, &slice], &Reference::load(Path::new("cases/fudo/reference")).unwrap()).unwrap();
    let [html, csv] = comparison.write(&full).unwrap();
    let html = std::fs::read_to_string(html).unwrap();
    assert!(html.contains("compare_slice") && html.contains("represents the inner units") && !html.contains("NaN"));
    assert_eq!(std::fs::read_to_string(csv).unwrap().lines().count(), 1 + 15 + 2);
    println!("{comparison}");
}
