//! The layered flume with shores: any bed, any wave.

use breakwater::geometry::profile::Profile;
use breakwater::waves::flume_model::layered::{
    Breaking, Friction, LayeredFlume, LayeredParameters, LeftEnd, Pressure, RightEnd,
};
use proptest::prelude::*;

const GRAVITY: f64 = 9.81;
const CELLS: usize = 40;
/// Levels of the bed [m] about still water at 0; the lowest also sets the step.
const LEVELS: [f64; 2] = [-1.0, 0.5];

/// A bed of 3 to 8 corners, each piece 1 to 4 m long, so that cells are at least a twentieth of the depth; slopes up to
/// 1:0.67, wet and dry.
fn beds() -> impl Strategy<Value = Profile> {
    proptest::collection::vec((1.0..4.0f64, LEVELS[0]..LEVELS[1]), 3..8).prop_map(|pieces| {
        let mut x = 0.0;
        let mut points: Vec<[f64; 2]> = Vec::new();
        for (length, z) in pieces {
            points.push([x, z]);
            x += length;
        }
        Profile::new(points)
    })
}

/// A flume with walls at both ends.
fn flume(profile: Profile, layers: usize, friction: Friction) -> LayeredFlume {
    let points = profile.points();
    let cell_m = (points[points.len() - 1][0] - points[0][0]) / CELLS as f64;
    LayeredFlume::new(LayeredParameters {
        still_level_m: 0.0,
        gravity_m_s2: GRAVITY,
        layers,
        cell_m,
        // Courant number 0.4 for a depth with the highest hump on it.
        step_s: 0.4 * cell_m / (GRAVITY * 1.5f64).sqrt(),
        left_end: LeftEnd::Wall,
        right_end: RightEnd::Wall,
        pressure: Pressure::NonHydrostatic,
        friction,
        breaking: Breaking::default(),
        profile,
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    /// A hump of water that runs to one side or falls apart, on any bed: no depth below zero, no number lost, no water
    /// lost.
    #[test]
    fn water_stays_water_on_any_bed(
        profile in beds(),
        layers in 1..4usize,
        height in 0.0..0.5f64,
        froude in -1.0..1.0f64,
        n_s_m13 in 0.0..0.03f64,
        place in 0.0..1.0f64,
    ) {
        let points = profile.points();
        let length = points[points.len() - 1][0];
        let (centre, width) = (place * length, 0.2 * length);
        let mut flume = flume(profile, layers, Friction::Manning { n_s_m13 });
        let hump = |x: f64| height * (-((x - centre) / width).powi(2)).exp();
        // From a long wave to the left, u = - eta sqrt(g / d), to one to the right; nothing moves at the walls.
        let at_rest_at_walls = |x: f64| (std::f64::consts::PI * x / length).sin();
        flume.set_flow(hump, |x, _| froude * GRAVITY.sqrt() * hump(x) * at_rest_at_walls(x));
        let volume = flume.volume_m2();
        for step in 0..150 {
            flume.step();
            for point in flume.surface_profile() {
                prop_assert!(point.depth_m >= 0.0, "depth {} at step {step}, x = {}", point.depth_m, point.x_m);
            }
            prop_assert!(flume.first_unstable_x_m().is_none(), "astray at step {step}, x = {:?}", flume.first_unstable_x_m());
        }
        // Fluxes are shared by two cells: rounding.
        prop_assert!((flume.volume_m2() - volume).abs() <= 1e-12 * volume.max(1e-3), "{} {volume}", flume.volume_m2());
    }

    /// Still water on any bed stays still.
    #[test]
    fn lake_at_rest_stays_at_rest_on_any_bed(profile in beds(), layers in 1..4usize) {
        let mut flume = flume(profile, layers, Friction::None);
        (0..100).for_each(|_| flume.step());
        // Levels are sums of bed and depth: rounding of 1e-16 m, not amplified.
        prop_assert!(flume.largest_velocity_m_s() < 1e-12, "{}", flume.largest_velocity_m_s());
        prop_assert!(flume.largest_elevation_m() < 1e-12, "{}", flume.largest_elevation_m());
    }
}
