//! Shorelines of the flume model on random beds with random waves.

use breakwater::geometry::profile::Profile;
use breakwater::waves::flume_model::layered::{
    Breaking, Friction, LayeredFlume, LayeredParameters, LeftEnd, Pressure, RightEnd,
};
use proptest::prelude::*;

const GRAVITY: f64 = 9.81;
const CELLS: usize = 40;
/// Lowest and highest level of the bed [m]; still water is at 0.
const LEVELS: [f64; 2] = [-1.0, 0.5];

/// Beds with 3 to 7 corners, wet and dry, with slopes up to 1:0.67. Segments are 1 to 4 m long, so the cell length is
/// at least a twentieth of the depth.
fn beds() -> impl Strategy<Value = Profile> {
    proptest::collection::vec((1.0..4.0f64, LEVELS[0]..LEVELS[1]), 3..8).prop_map(|segments| {
        let mut x = 0.0;
        let mut points: Vec<[f64; 2]> = Vec::new();
        for (length, z) in segments {
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
        // This gives a Courant number of 0.4 for a wave on the largest depth, 1.5 m with the highest hump, that travels
        // with the fastest current of the start, 0.5 sqrt(g). Without the current, one of some ten thousand inputs is
        // unstable.
        step_s: 0.4 * cell_m / (GRAVITY.sqrt() * (1.5f64.sqrt() + 0.5)),
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

    /// A hump of water on any bed keeps its volume and gives only finite values and no negative depth.
    #[test]
    fn a_hump_stays_finite_and_keeps_its_volume_on_any_bed(
        profile in beds(),
        layers in 1..4usize,
        height in 0.0..0.5f64,
        froude in -1.0..1.0f64,
        n_s_m13 in 0.0..0.03f64,
        relative_position in 0.0..1.0f64,
    ) {
        let points = profile.points();
        let length = points[points.len() - 1][0];
        let (centre, width) = (relative_position * length, 0.2 * length);
        let mut flume = flume(profile, layers, Friction::Manning { n_s_m13 });
        let hump = |x: f64| height * (-((x - centre) / width).powi(2)).exp();
        // `froude` = -1 is a long wave to the left, with the velocity u = - eta sqrt(g / d) at the elevation eta and
        // the depth d = 1 m; 1 is a long wave to the right.
        let at_rest_at_walls = |x: f64| (std::f64::consts::PI * x / length).sin();
        flume.set_flow(hump, |x, _| froude * GRAVITY.sqrt() * hump(x) * at_rest_at_walls(x));
        let volume = flume.volume_m2();
        for step in 0..150 {
            flume.step();
            for point in flume.surface_profile() {
                prop_assert!(point.depth_m >= 0.0, "depth {} at step {step}, x = {}", point.depth_m, point.x_m);
            }
            prop_assert!(flume.first_unstable_x_m().is_none(), "unstable at time step {step}, x = {:?}", flume.first_unstable_x_m());
        }
        // Limit 1e-12: rounding; a flux leaves one cell and enters the next.
        prop_assert!((flume.volume_m2() - volume).abs() <= 1e-12 * volume.max(1e-3), "{} {volume}", flume.volume_m2());
    }

    /// Still water stays still on any bed.
    #[test]
    fn lake_at_rest_stays_at_rest_on_any_bed(profile in beds(), layers in 1..4usize) {
        let mut flume = flume(profile, layers, Friction::None);
        (0..100).for_each(|_| flume.step());
        // Limit 1e-12: levels are sums of bed and depth with a rounding of 1e-16 m, which is not amplified.
        prop_assert!(flume.largest_velocity_m_s() < 1e-12, "{}", flume.largest_velocity_m_s());
        prop_assert!(flume.largest_elevation_m() < 1e-12, "{}", flume.largest_elevation_m());
    }
}
