//! Order of convergence of the flume model in space and time, with cells and time steps halved together.

use breakwater::geometry::profile::Profile;
use breakwater::waves::flume_model::layered::{
    Breaking, Friction, LayeredFlume, LayeredParameters, LeftEnd, Pressure, RightEnd,
};
use breakwater::waves::theory::solitary::ThirdOrderSolitary;

const GRAVITY: f64 = 9.81;

/// Returns the surface elevation at the time `end_s` at points 0.1 m apart, without the last metre at each end.
fn surface(profile: &Profile, wave: &ThirdOrderSolitary, centre: f64, cell_m: f64, end_s: f64) -> Vec<f64> {
    let points = profile.points();
    let length = points[points.len() - 1][0];
    let steps = (end_s / (0.4 * cell_m / (GRAVITY * 1.1 * wave.depth_m).sqrt())).ceil();
    let step_s = end_s / steps;
    let mut flume = LayeredFlume::new(LayeredParameters {
        profile: profile.clone(),
        still_level_m: 0.0,
        gravity_m_s2: GRAVITY,
        layers: 2,
        cell_m,
        step_s,
        left_end: LeftEnd::Wall,
        right_end: RightEnd::Wall,
        pressure: Pressure::NonHydrostatic,
        friction: Friction::None,
        breaking: Breaking::Unlimited,
    });
    flume.set_flow(
        |x| wave.elevation_m(x - centre),
        |x, z| wave.velocity_m_s(x - centre + 0.5 * wave.celerity_m_s() * step_s, z),
    );
    (0..steps as usize).for_each(|_| flume.step());
    (10..(10.0 * length) as usize - 10).map(|i| flume.surface_m(0.1 * i as f64)).collect()
}

/// Returns the order of convergence from runs on three grids, each with half the cell length of the previous grid.
fn order(runs: &[Vec<f64>; 3]) -> f64 {
    let difference = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    (difference(&runs[0], &runs[1]) / difference(&runs[1], &runs[2])).log2()
}

#[test]
fn solitary_wave_converges_with_second_order() {
    let level = Profile::new(vec![[0.0, -0.8], [32.0, -0.8]]);
    // The bed rises by 0.3 m over 8 m along half a cosine, without corners.
    let rise = |x: f64| 0.15 * (1.0 - (std::f64::consts::PI * ((x - 13.0) / 8.0).clamp(0.0, 1.0)).cos());
    let slope = Profile::new((0..=640).map(|i| 0.05 * f64::from(i)).map(|x| [x, rise(x) - 0.8]).collect());
    for (name, profile) in [("level", level), ("slope", slope)] {
        let wave = ThirdOrderSolitary { height_m: 0.08, depth_m: 0.8, gravity: GRAVITY };
        let runs = [0.2, 0.1, 0.05].map(|cell_m| surface(&profile, &wave, 12.0, cell_m, 4.0));
        let order = order(&runs);
        println!("{name}: order {order:.2}");
        // In theory, the order is 2. On the coarsest grid, with 20 cells for half the wave, error terms of higher order
        // still contribute.
        assert!(order > 1.8, "{name}: {order}");
    }
}
