//! Compares solitary waves on a plane beach of 1:19.85 with Synolakis (1987): the analytic solution and the laboratory
//! data of benchmark problems 1 and 4 of the US tsunami hazard programme.
//!
//! Lengths are in units of the depth d, times in units of sqrt(d/g). x points seaward from the still-water shoreline.
//! At t = 0 the crest is at X1 = 19.85 + arccosh(sqrt(20)) / sqrt(3H/4d), half a wave length before the toe.

use breakwater::geometry::profile::Profile;
use breakwater::report::plot::{Line, LineChart, standalone};
use breakwater::waves::flume_model::incoming::IncomingWave;
use breakwater::waves::flume_model::layered::{Breaking, Friction, Pressure, RightEnd};
use breakwater::waves::flume_model::record::FlumeRecord;
use breakwater::waves::flume_model::{FlumeSetup, WaveSource, run};
use breakwater::waves::theory::solitary::ThirdOrderSolitary;

use super::data;

const GRAVITY: f64 = 9.81;
const COT_BETA: f64 = 19.85;
/// Distance from the inflow to X1, divided by d [-].
const RUN_IN: f64 = 10.0;
/// Bed friction of the smooth bed and beach in the laboratory.
const GLASS: Friction = Friction::SmoothBed { viscosity_m2_s: 1e-6 };

/// Returns the run-up R/d of non-breaking and of breaking waves (Synolakis 1987, equations 5.1 and 6.1).
fn run_up_law(height: f64) -> [f64; 2] {
    [2.831 * COT_BETA.sqrt() * height.powf(1.25), 0.918 * height.powf(0.606)]
}

/// One wave on the beach.
struct Beach {
    /// Wave height divided by depth, H/d [-].
    height: f64,
    /// Depth d [m].
    depth_m: f64,
    /// Cell length divided by d [-].
    cell: f64,
    pressure: Pressure,
    friction: Friction,
}

impl Beach {
    fn wave(&self) -> ThirdOrderSolitary {
        ThirdOrderSolitary { height_m: self.height * self.depth_m, depth_m: self.depth_m, gravity: GRAVITY }
    }

    /// Returns half a wave length, X1 - 19.85, divided by d [-].
    fn half_wave(&self) -> f64 {
        20f64.sqrt().acosh() / (0.75 * self.height).sqrt()
    }

    /// Returns the time in the flume model [s] that corresponds to t = 0.
    fn origin_s(&self) -> f64 {
        let wave = self.wave();
        (wave.half_length_m() + RUN_IN * self.depth_m) / wave.celerity_m_s()
    }

    fn seconds(&self, t: f64) -> f64 {
        self.origin_s() + t * (self.depth_m / GRAVITY).sqrt()
    }

    /// Returns the x coordinate in the flume model [m] that corresponds to x.
    fn place_m(&self, x: f64) -> f64 {
        (RUN_IN + self.half_wave() + COT_BETA - x) * self.depth_m
    }

    /// Runs the wave until t = `end`, with gauges at the given x and surface profiles at the given t.
    fn run(&self, gauges: &[f64], profiles: &[f64], end: f64) -> FlumeRecord {
        let d = self.depth_m;
        let [non_breaking, broken] = run_up_law(self.height);
        let top = 1.5 * non_breaking.min(broken).max(0.02);
        let toe = RUN_IN + self.half_wave();
        run(&FlumeSetup {
            profile: Profile::new(vec![[0.0, -d], [toe * d, -d], [(toe + COT_BETA * (1.0 + top)) * d, top * d]]),
            still_level_m: 0.0,
            gravity_m_s2: GRAVITY,
            wave: WaveSource::Inflow(IncomingWave::solitary(self.wave())),
            right_end: RightEnd::Wall,
            pressure: self.pressure,
            friction: self.friction,
            breaking: Breaking::default(),
            layers: 2,
            cell_m: self.cell * d,
            gauges_x_m: gauges.iter().map(|x| self.place_m(*x)).collect(),
            profile_times_s: profiles.iter().map(|t| self.seconds(*t)).collect(),
            window_x_m: [0.0, d],
            record_interval_s: 0.1 * (d / GRAVITY).sqrt(),
            end_s: self.seconds(end),
        })
        .unwrap_or_else(|error| panic!("H/d = {}: {error}", self.height))
    }

    /// Returns the highest shoreline level divided by d. The level occurs before t = 45 + 1.5 half wave lengths.
    fn run_up(&self) -> f64 {
        let record = self.run(&[], &[], 45.0 + 1.5 * self.half_wave());
        record.shore_level_m.iter().copied().fold(0.0, f64::max) / self.depth_m
    }
}

fn rms(errors: &[f64]) -> f64 {
    (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt()
}

/// Returns the rms difference between a profile of the flume model and points (x, eta), divided by H [-].
fn profile_error(beach: &Beach, record: &FlumeRecord, index: usize, points: impl Iterator<Item = [f64; 2]>) -> f64 {
    let profile = &record.profiles[index];
    let difference = |[x, eta]: [f64; 2]| {
        let place = beach.place_m(x);
        // On the dry beach, the ground level replaces the water level.
        let surface = profile.surface_m(place).unwrap_or_else(|| record.profile.z(place));
        (surface / beach.depth_m - eta) / beach.height
    };
    rms(&points.map(difference).collect::<Vec<f64>>())
}

/// The analytic solution: rows (t, eta at x = 0.25, t, eta at x = 9.95), and rows (x, eta at t = 35, 40 .. 70). Values
/// on dry ground are NaN.
struct Analytic {
    series: Vec<Vec<f64>>,
    profiles: Vec<Vec<f64>>,
}

impl Analytic {
    /// Returns the rms differences between model and analytic solution, divided by H [-]: for the two series, then for
    /// the profiles.
    fn differences(&self, source: &str, beach: &Beach, record: &FlumeRecord) -> Vec<f64> {
        let mut errors = Vec::new();
        for gauge in 0..2 {
            let at = |t: f64| {
                let (eta, place) = (&record.gauge_elevations_m[gauge], beach.seconds(t) / record.interval_s);
                let (before, share) = (place as usize, place.fract());
                eta[before] + share * (eta[before + 1] - eta[before])
            };
            // In the file, the second series has fewer rows than the first.
            let points = self.series.iter().filter_map(|row| Some([*row.get(2 * gauge)?, *row.get(2 * gauge + 1)?]));
            let wet = points.filter(|[t, eta]| *t < 100.0 && eta.is_finite());
            errors.push(rms(&wet.map(|[t, eta]| (at(t) - eta) / beach.height).collect::<Vec<f64>>()));
        }
        for i in 0..record.profiles.len() {
            let wet = self.profiles.iter().filter(|row| row.len() == 9 && row[i + 1].is_finite());
            errors.push(profile_error(beach, record, i, wet.map(|row| [row[0], row[i + 1]])));
        }
        let percent: Vec<String> = errors.iter().map(|e| format!("{:.2}", 100.0 * e)).collect();
        println!("{source}: [{}] % of H", percent.join(", "));
        errors
    }
}

/// Returns the analytic solution from each source.
///
/// The same tolerance applies to both sources. The profiles of the table start at x = 3, seaward of the lowest
/// shoreline; the errors are largest at this shoreline. The times of both sources cover all phases of the wave evenly.
fn analytic_solution() -> Vec<(&'static str, Analytic)> {
    let series: Vec<[f64; 3]> = data::table_of("synolakis1987_analytic_series.csv");
    let table = Analytic {
        series: series.into_iter().map(|[t, near, far]| vec![t, near, t, far]).collect(),
        profiles: data::table("synolakis1987_analytic_profiles.csv"),
    };
    let file = |name: &str| data::series(&format!("nthmp_bp01_simple_beach_analytic/{name}.txt"));
    let full_series = file("canonical_ts");
    let full = full_series.and_then(|series| Ok(Analytic { series, profiles: file("canonical_profiles")? }));
    data::table_and_series(table, full)
}

/// Returns, for each source of the analytic solution, the rms differences, divided by H [-]: for the series at x = 0.25
/// and 9.95, then for the profiles at t = 35, 40 .. 70.
fn differences_from_analytic(pressure: Pressure, cell: f64) -> Vec<Vec<f64>> {
    let beach = Beach { height: 0.019, depth_m: 1.0, cell, pressure, friction: Friction::None };
    let times: Vec<f64> = (0..8).map(|i| 35.0 + 5.0 * f64::from(i)).collect();
    let record = beach.run(&[0.25, 9.95], &times, 101.0);
    println!("{pressure:?}, cell {cell} d");
    let differences = |(source, solution): &(&str, Analytic)| solution.differences(source, &beach, &record);
    analytic_solution().iter().map(differences).collect()
}

/// The analytic solution satisfies the shallow-water equations, like the model without vertical accelerations.
#[test]
fn hydrostatic_wave_on_the_beach_follows_the_analytic_solution() {
    let errors = differences_from_analytic(Pressure::Hydrostatic, 0.05);
    // Limit for the rms differences: 3 % of H, which is 0.6 mm in 1 m of water. The largest is at the lowest shoreline,
    // t = 70.
    assert!(errors.iter().flatten().all(|error| *error < 0.03));
}

/// With vertical accelerations the wave disperses on the slope, arrives 0.3 sqrt(d/g) later and is a little lower. It
/// differs from the analytic solution by 3 to 5 % of H on any grid.
#[test]
fn dispersive_wave_on_the_beach_is_near_the_analytic_solution() {
    for errors in differences_from_analytic(Pressure::NonHydrostatic, 0.1) {
        let worst = errors.iter().copied().fold(0.0, f64::max);
        // At x = 9.95 the wave is still long, so the limit is only 3.5 %. The largest error is at the shoreline, t =
        // 70.
        assert!(errors[1] < 0.035 && worst < 0.065);
    }
}

/// Returns the measured profiles (x, eta) at the given times from each source.
///
/// The same tolerance applies to both sources. The points of the table are interpolated between published points and
/// scatter like the published points. No point of the table is on the steep front of the high wave.
fn laboratory_profiles(name: &str, times: &[f64]) -> Vec<(&'static str, Vec<Vec<[f64; 2]>>)> {
    let rows = data::table(&format!("synolakis1987_profiles_{name}.csv"));
    let profile = |k: usize| {
        let points = rows.iter().map(|row| [row[0], row[k + 1]]);
        points.filter(|[_, eta]| eta.is_finite()).collect::<Vec<[f64; 2]>>()
    };
    let file = |t| data::series_of(&format!("nthmp_bp04_simple_beach_lab/Case{name}.t={t}"));
    data::table_and_series((0..times.len()).map(profile).collect(), times.iter().map(file).collect())
}

/// Difference of the model from the measured profiles of one source.
struct LaboratoryDifference {
    /// "table" or "full series".
    source: &'static str,
    /// Root mean square difference from each profile, divided by H [-].
    errors: Vec<f64>,
    /// Time shift, in sqrt(d/g), with the smallest mean difference. It is the same for all profiles.
    shift: f64,
}

/// Returns the difference from the measured profiles of each source.
fn differences_from_laboratory(height: f64, depth_m: f64, name: &str, times: &[f64]) -> Vec<LaboratoryDifference> {
    let beach = Beach { height, depth_m, cell: 0.1, pressure: Pressure::NonHydrostatic, friction: GLASS };
    let shifts: Vec<f64> = (-15..16).map(|i| 0.1 * f64::from(i)).collect();
    // Profiles are recorded at every time with every shift; the record keeps them sorted by time.
    let profile_times = times.iter().flat_map(|t| shifts.iter().map(move |shift| t + shift));
    let record = beach.run(&[], &profile_times.collect::<Vec<f64>>(), times[times.len() - 1] + 2.0);
    let compare = |(source, profiles): (&'static str, Vec<Vec<[f64; 2]>>)| {
        let errors_at = |s: usize| -> Vec<f64> {
            let error = |(i, points): (usize, &Vec<[f64; 2]>)| {
                profile_error(&beach, &record, i * shifts.len() + s, points.iter().copied())
            };
            profiles.iter().enumerate().map(error).collect()
        };
        let mean = |s: usize| errors_at(s).iter().sum::<f64>();
        let best = (0..shifts.len()).min_by(|a, b| mean(*a).total_cmp(&mean(*b))).unwrap();
        let percent =
            |s: usize| errors_at(s).iter().map(|e| format!("{:.1}", 100.0 * e)).collect::<Vec<_>>().join(", ");
        println!("H/d = {height}, {source}: [{}] % of H at t = {times:?}", percent(shifts.len() / 2));
        println!("  with a time shift of {:.1}: [{}] %", shifts[best], percent(best));
        LaboratoryDifference { source, errors: errors_at(best), shift: shifts[best] }
    };
    laboratory_profiles(name, times).into_iter().map(compare).collect()
}

#[test]
fn profiles_on_the_beach_agree_with_the_laboratory() {
    let cases = [
        // Limits for the rms differences: 0.25 H (low wave), 0.1 H (high wave). Neighbouring measured points differ by
        // as much.
        (0.0185, 0.30, "0_0185", [30.0, 40.0, 50.0, 60.0, 70.0].as_slice(), 0.25),
        (0.30, 0.16, "0_3", &[15.0, 20.0, 25.0, 30.0], 0.1),
    ];
    for (height, depth_m, name, times, most) in cases {
        for LaboratoryDifference { source, errors, shift } in differences_from_laboratory(height, depth_m, name, times)
        {
            assert!(errors.iter().all(|error| *error < most), "{source}: {errors:?}");
            // The shift is at most 0.9 with the full series. With the fewer points of the table, it is uncertain by
            // 0.2.
            let most_shift = if source == "full series" { 1.0 } else { 1.2 };
            assert!(shift.abs() < most_shift, "{source}: {shift}");
        }
    }
}

/// Run-up of one wave: H/d, measured R/d and computed R/d [-].
struct RunUp {
    height: f64,
    measured: f64,
    computed: f64,
}

impl RunUp {
    fn error(&self) -> f64 {
        self.computed / self.measured - 1.0
    }
}

/// Computes the run-up for each row `(H/d, measured R/d, d in cm)`. Prints it together with both run-up laws.
fn run_ups(pairs: &[Vec<f64>]) -> Vec<RunUp> {
    println!("  H/d    R/d measured  computed  error   laws: non-breaking, breaking");
    let run_up = |pair: &Vec<f64>| {
        let [height, measured, depth_m] = [pair[0], pair[1], 0.01 * pair[2]];
        let [non_breaking, broken] = run_up_law(height);
        // The shoreline moves over twenty cells, or at least eight for the lowest waves. The largest cell still
        // resolves the wave length.
        let cell = (COT_BETA * non_breaking.min(broken) / 20.0).clamp(0.05, 0.06);
        let beach = Beach { height, depth_m, cell, pressure: Pressure::NonHydrostatic, friction: GLASS };
        let run_up = RunUp { height, measured, computed: beach.run_up() };
        println!(
            "  {height:.3}  {measured:.3}         {:.4}    {:+5.1} %  {non_breaking:.3} {broken:.3}",
            run_up.computed,
            100.0 * run_up.error()
        );
        run_up
    };
    pairs.iter().map(run_up).collect()
}

/// Returns the median of the absolute errors of the run-up [-]. Prints it together with the largest error.
fn median_error(run_ups: &[RunUp]) -> f64 {
    let mut errors: Vec<f64> = run_ups.iter().map(RunUp::error).collect();
    errors.sort_by(|a, b| a.abs().total_cmp(&b.abs()));
    let (median, worst) = (errors[errors.len() / 2].abs(), errors[errors.len() - 1]);
    println!("median of {}: {:.1} %, largest {:+.1} %", errors.len(), 100.0 * median, 100.0 * worst);
    median
}

/// Computes the waves of the table: every twelfth measurement with H/d > 0.03. Lower waves take longer to compute.
#[test]
fn run_up_follows_the_laboratory() {
    // Limit 10 % for the median error: measurements of equal waves differ by up to 13 % (H/d = 0.009).
    assert!(median_error(&run_ups(&data::table("synolakis1987_run_up.csv"))) < 0.1);
}

/// Returns an SVG chart of the measured and computed run-up on logarithmic axes, with both run-up laws.
fn picture(run_ups: &[RunUp]) -> String {
    let at = |height: f64, run_up: f64| [height.log10(), run_up.log10()];
    let line = |name: &str, points: Vec<[f64; 2]>, colour: usize, dots: bool| Line {
        name: name.to_owned(),
        points,
        colour,
        dots,
        ..Line::default()
    };
    // NaN after each point interrupts the line, so only markers are drawn.
    let markers = |value: fn(&RunUp) -> f64| {
        run_ups.iter().flat_map(|r| [at(r.height, value(r)), [f64::NAN; 2]]).collect::<Vec<[f64; 2]>>()
    };
    let law = |broken: usize, from: f64, to: f64| {
        let heights = (0..=40).map(|k| from * (to / from).powf(f64::from(k) / 40.0));
        heights.map(|height| at(height, run_up_law(height)[broken])).collect::<Vec<[f64; 2]>>()
    };
    let chart = LineChart {
        title: "Run-up of solitary waves on a beach of 1:19.85".to_owned(),
        x_label: "log10 of the height over the depth".to_owned(),
        y_label: "log10 of the run-up over the depth".to_owned(),
        lines: vec![
            line("law of non-breaking waves", law(0, 0.004, 0.06), 2, false),
            line("law of breaking waves", law(1, 0.03, 0.7), 3, false),
            line("laboratory (Synolakis 1987)", markers(|r| r.measured), 0, true),
            line("breakwater", markers(|r| r.computed), 1, true),
        ],
        size: [760.0, 460.0],
        ..LineChart::default()
    };
    standalone(&chart.svg())
}

/// Computes all published waves, which only the full series contains, and writes docs/images/run-up.svg.
#[test]
#[ignore = "10 minutes: \
    cargo test --release --test validation -- --ignored --nocapture all_run_ups_follow_the_laboratory"]
fn all_run_ups_follow_the_laboratory() {
    let pairs = data::series("nthmp_bp04_simple_beach_lab/Lab_runup.txt");
    let Some(pairs) = data::series_or_left_out(pairs) else { return };
    assert!(pairs.len() >= 77);
    let run_ups = run_ups(&pairs);
    let images = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/images");
    std::fs::write(images.join("run-up.svg"), picture(&run_ups)).unwrap();
    assert!(median_error(&run_ups) < 0.1);
}
