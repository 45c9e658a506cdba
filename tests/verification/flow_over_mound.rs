//! Flow of the Fudo waves over the bare mound, compared with the inviscid flume model. The drag on the units is
//! proportional to the square of the velocity at their height. In the flume of the experiment, friction slows only a
//! layer of about sqrt(nu t) = 2 mm at the bed, with the viscosity nu of water and the duration t of the flow. In the
//! particle domain, the numerical viscosity alpha h c0 / 16 determines the thickness of this layer.

use serde_json::json;

use super::tanks::{UNIT_HEIGHT, run_until, simulation};
use breakwater::simulation::flume::Simulation;
use glam::DVec3;

const CREST_Z: f64 = 0.717;
const MIDDLE_X: f64 = 39.0;

/// Settings of the particle simulation.
#[derive(Debug, Clone, Copy)]
struct Scheme {
    /// Key `numerics.scheme`.
    name: &'static str,
    slip: &'static str,
    alpha: f64,
    beta: f64,
    /// Speed of sound divided by sqrt(g d), with the largest depth d of the domain [-].
    sound: f64,
    /// Ends of the particle domain [m].
    domain: [f64; 2],
}

/// No slip, as in the published cases. The reflection from the end of the domain arrives after the time range that
/// [`drag_share`] evaluates.
const NO_SLIP: Scheme =
    Scheme { name: "mitsui_2023", slip: "original", alpha: 0.04, beta: 0.0, sound: 10.0, domain: [36.5, 42.0] };
/// Free slip, with a quarter of the viscosity of [`NO_SLIP`].
const FREE_SLIP: Scheme = Scheme { slip: "free_slip", alpha: 0.01, ..NO_SLIP };
/// The same with inviscid walls.
const INVISCID: Scheme = Scheme { slip: "inviscid", ..FREE_SLIP };
/// The default scheme.
const DEFAULT: Scheme = Scheme { name: "low_dissipation", alpha: 0.005, beta: 0.3, ..INVISCID };

/// Creates the simulation of a wave of a height [m] over the mound without units.
fn over_the_mound(scheme: Scheme, height: f64, dp: f64) -> Simulation {
    simulation(&json!({
        "title": "A wave of the Fudo experiment over the bare mound",
        "flume": {
            "bed_m": [[0.0, 0.0], [19.0, 0.0], [55.0, 1.2]], "still_water_level_m": 0.8,
            "mound": {
                "centre_x_m": MIDDLE_X, "crest_width_m": 0.32, "crest_z_m": CREST_Z, "seaward_run_per_rise": 2.0,
                "lee_run_per_rise": 2.0
            }
        },
        "domain": { "x_m": scheme.domain, "sides": "two_dimensional", "top_z_m": 1.1, "dp_m": dp },
        "fluid": { "sound_speed_factor": scheme.sound },
        "numerics": {
            "scheme": scheme.name, "wall_slip": scheme.slip, "viscosity_alpha": scheme.alpha,
            "viscosity_beta": scheme.beta, "wall_friction": 0.0
        },
        "wave": { "kind": "solitary", "height_m": height },
        "stop": { "duration_s": 20.0 }
    }))
}

/// Returns the mean of u |u| [m2/s2] over the height of a unit, from the velocity at a height above the crest [m].
fn mean_u_abs_u(velocity: impl Fn(f64) -> f64) -> f64 {
    let points = 7;
    let height = |k: i32| UNIT_HEIGHT * (f64::from(k) + 0.5) / f64::from(points);
    (0..points).map(|k| velocity(height(k))).map(|u| u * u.abs()).sum::<f64>() / f64::from(points)
}

/// Returns the ratio of the drag impulses in the particle domain and in the flume model [-]. The drag impulse is the
/// time integral of u |u| above the middle of the crest, while the velocity exceeds half of its maximum.
fn drag_share(scheme: Scheme, height: f64, dp: f64) -> f64 {
    let mut flow = over_the_mound(scheme, height, dp);
    let record = flow.flume.clone().unwrap();
    let times = record.times_s();
    let speed: Vec<f64> = times.iter().map(|&t| record.mean_velocity(MIDDLE_X, t)).collect();
    let fastest = (0..times.len()).max_by(|&a, &b| speed[a].total_cmp(&speed[b])).unwrap();
    let is_slow = |k: &usize| speed[*k] < 0.5 * speed[fastest];
    let from = times[(0..fastest).rev().find(is_slow).unwrap()];
    let to = times[(fastest..times.len()).find(is_slow).unwrap()];
    let (mut computed, mut expected, mut before) = (0.0, 0.0, None);
    let end = to - flow.start;
    run_until(&mut flow, end, |now| {
        let time = now.flume_time();
        // Twenty time steps are about 0.01 s; the crest passes within a second.
        if time < from || time > to || !now.steps.is_multiple_of(20) {
            return;
        }
        let interval = time - before.replace(time).unwrap_or(time);
        let sampler = now.sampler().unwrap();
        let in_particles =
            |z: f64| sampler.sample(DVec3::new(MIDDLE_X, 0.0, CREST_Z + z)).map_or(0.0, |water| water.velocity.x);
        computed += mean_u_abs_u(in_particles) * interval;
        expected += mean_u_abs_u(|z| record.velocity(MIDDLE_X, CREST_Z + z, time).0) * interval;
    });
    println!(
        "H = {height} m, dp = {dp} m, {scheme:?}: {:.3} of the drag of the flume model ({from:.2} to {to:.2} s)",
        computed / expected
    );
    computed / expected
}

#[test]
fn drag_over_the_mound_needs_slip() {
    let [no_slip, default] = [NO_SLIP, DEFAULT].map(|scheme| drag_share(scheme, 0.045, 0.016));
    // Reached: 0.59 with no slip, 0.94 with the default scheme. The limit for the default scheme is the reached value
    // minus 0.03, the difference between particle spacings of 14 and 16 mm. The drag on a unit is known to 10 %, so a
    // run that loses 40 % of the drag is not useful.
    assert!(no_slip < 0.7 && default > 0.91 && default < 1.03);
}

/// Computes the three waves with each combination of slip and viscosity.
#[test]
#[ignore = "6 minutes on one core: \
    cargo test --release --test verification -- --ignored --nocapture drag_over_the_mound_grows_with_slip"]
fn drag_over_the_mound_grows_with_slip_and_lower_viscosity() {
    for height in [0.026, 0.045, 0.064] {
        let share = |scheme| drag_share(scheme, height, 0.014);
        let no_slip = share(NO_SLIP);
        let low_viscosity = share(Scheme { alpha: 0.01, ..NO_SLIP });
        let slip_only = share(Scheme { alpha: 0.04, ..FREE_SLIP });
        let free_slip = share(FREE_SLIP);
        // Free slip or low viscosity alone recover part of the drag; both together recover most.
        assert!(no_slip < low_viscosity.min(slip_only) && low_viscosity.max(slip_only) < free_slip && free_slip < 1.03);
    }
}

/// Computes the published scheme with a speed of sound that the published runs may have had: 36 m/s. This is
/// 20 sqrt(g d) for the depth of 0.333 m in the published domain, and 25 sqrt(g d) for the 0.217 m in this domain.
#[test]
#[ignore = "10 minutes on one core: \
    cargo test --release --test verification -- --ignored --nocapture drag_over_the_mound_grows_with_res"]
fn drag_over_the_mound_grows_with_resolution() {
    let published = Scheme { sound: 25.0, ..NO_SLIP };
    let shares = [0.014, 0.009, 0.007].map(|dp| drag_share(published, 0.026, dp));
    // The numerical viscosity is proportional to dp, so the drag grows with the resolution.
    assert!(shares.is_sorted() && shares[2] < 0.8);
}

/// Computes the three waves with the default scheme, but without friction, like the flume model.
#[test]
#[ignore = "4 minutes on one core: \
    cargo test --release --test verification -- --ignored --nocapture the_default_scheme_keeps"]
fn the_default_scheme_keeps_the_drag_over_the_mound() {
    for height in [0.026, 0.045, 0.064] {
        let [coarse, fine] = [0.014, 0.009].map(|dp| drag_share(DEFAULT, height, dp));
        // Reached: 0.976, 0.952 and 0.953 at 14 mm, 0.971, 0.970 and 0.976 at 9 mm. The limits 0.93 and 0.97 are aims:
        // the drag on a unit is known to 10 %, so the loss of push should be smaller, and fall with the spacing.
        assert!(coarse > 0.93 && fine > 0.97 && fine < 1.03);
    }
}
