//! A box held at the surface of regular waves: mean and amplitude of the water force.
//!
//! The mean horizontal force equals the momentum that the waves lose: with the amplitudes I of the waves that come from
//! the wavemaker, R of the reflected waves, T of the transmitted waves and B of the waves that come back from the damping
//! zone, it is rho g / 2 (I^2 + R^2 - T^2 - B^2) c_g / c per width (Longuet-Higgins 1977). c_g / c is the ratio of group
//! velocity and phase velocity.

use breakwater::waves::theory::regular::RegularWave;
use glam::DVec2;
use serde_json::json;

use super::regular_waves::{first_harmonic, separate};
use super::tanks::{GRAVITY, RHO0, run_until, simulation, still_tank};
use super::two_dimensional::in_two_dimensions;

const WAVE: RegularWave = RegularWave { height_m: 0.1, period_s: 1.2, depth_m: 0.4, gravity: GRAVITY };
/// Length, width and height of the box [m]; half of its height is under water.
const BOX: [f64; 3] = [0.3, 0.25, 0.2];
/// Middle of the box, x [m].
const MIDDLE: f64 = 4.0;
/// Gauges on the seaward and on the leeward side, x [m].
const SEAWARD: [f64; 3] = [2.0, 2.3, 2.7];
const LEEWARD: [f64; 2] = [4.9, 5.2];
/// Three periods [s], from the time when the waves at the box have their full height. Then the waves that the box
/// reflects begin to return from the wavemaker.
const WINDOW: [f64; 2] = [6.0, 9.6];

/// Time [s], elevation at the gauges [m], horizontal and vertical force per width [N/m].
type Row = (f64, [f64; 5], [f64; 2]);

#[test]
fn mean_wave_force_on_a_box_is_the_momentum_that_the_waves_lose() {
    let mut case = in_two_dimensions(still_tank(8.0, 1.0, WAVE.depth_m, 0.025, WINDOW[1]));
    case["domain"]["damping_zone"] = json!({ "x_m": [5.6, 8.0] });
    case["fluid"] = json!({ "sound_speed_factor": 10.0 });
    case["numerics"] = json!({ "viscosity_alpha": 0.01, "hold_units_s": WINDOW[1] });
    case["wave"] = json!({
        "kind": "regular", "height_m": WAVE.height_m, "period_s": WAVE.period_s, "ramp_periods": 1.0
    });
    case["wavemaker"] = json!({ "kind": "piston" });
    case["units"] = json!({
        "shape": "cuboid", "size_m": BOX, "mass_kg": 7.5, "material": "mortar",
        "centres_m": [[MIDDLE, 0.0, WAVE.depth_m]]
    });
    let mut tank = simulation(&case);
    let mut rows: Vec<Row> = Vec::new();
    run_until(&mut tank, WINDOW[1], |now| {
        if now.time < WINDOW[0] || !now.steps.is_multiple_of(5) {
            return;
        }
        let force = now.units.as_ref().unwrap().fluid_loads[0].force / BOX[1];
        let (time, sampler) = (now.time, now.sampler().unwrap());
        let level = |x: f64| sampler.surface(DVec2::new(x, 0.0), 0.0).unwrap() - WAVE.depth_m;
        let [a, b, c] = SEAWARD.map(level);
        let [d, e] = LEEWARD.map(level);
        rows.push((time, [a, b, c, d, e], [force.x, force.z]));
    });
    let harmonic = |value: &dyn Fn(&Row) -> f64| {
        let series: Vec<[f64; 2]> = rows.iter().map(|row| [row.0, value(row)]).collect();
        first_harmonic(&series, WAVE.angular_frequency())
    };
    let (wavenumber, gauge) = (WAVE.wavenumber_per_m(), |k: usize| harmonic(&|row| row.1[k]));
    let seaward = separate(wavenumber, SEAWARD, [0, 1, 2].map(gauge));
    let leeward = separate(wavenumber, LEEWARD, [3, 4].map(gauge));
    let [incoming, reflected, transmitted, back] =
        [seaward[0], seaward[1], leeward[0], leeward[1]].map(|amplitude| amplitude.length());
    let energy = incoming.powi(2) + reflected.powi(2) - transmitted.powi(2) - back.powi(2);
    let velocity_ratio = WAVE.group_velocity_m_s() * wavenumber / WAVE.angular_frequency();
    let lost = 0.5 * RHO0 * GRAVITY * energy * velocity_ratio;
    // Time steps differ in length, so the mean is an integral by the trapezoidal rule.
    let impulse: f64 = rows.windows(2).map(|w| 0.5 * (w[1].0 - w[0].0) * (w[0].2[0] + w[1].2[0])).sum();
    let mean = impulse / (rows[rows.len() - 1].0 - rows[0].0);
    let amplitudes = [0, 1].map(|k| harmonic(&|row| row.2[k]).length() / incoming);
    println!(
        "incoming {:.1} mm, reflected {:.2}, transmitted {:.2}, force per wave amplitude {:.0} and {:.0} N/m per m; mean \
         force {mean:.2} N/m, momentum lost by the waves {lost:.2} N/m",
        1e3 * incoming,
        reflected / incoming,
        transmitted / incoming,
        amplitudes[0],
        amplitudes[1]
    );
    // Limit 8 %, three times the deviation reached: the formula is of second order, the waves are a quarter as high as the
    // water is deep, and they are not quite steady.
    assert!((mean / lost - 1.0).abs() < 0.08, "{mean} {lost}");
}
