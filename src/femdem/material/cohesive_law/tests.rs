//! Tests of the cohesive law along paths of opening and slip.

use super::*;

const CONCRETE: Strength = Strength {
    tensile: 3.3e6,
    cohesion: 16.5e6,
    friction: 0.577_350_269_189_625_8,
    opening_energy: 50.0,
    sliding_energy: 50.0,
};
const H: f64 = 0.029;
const PENALTY: f64 = 50.0 * 26e9;

fn law(range: Range) -> CohesiveLaw {
    Cohesion { strength: CONCRETE, penalty: PENALTY, range, tied: false }.law(H)
}

/// Work, dissipation and largest stresses along a path.
#[derive(Default)]
struct Path {
    work: f64,
    dissipated: f64,
    peak: [f64; 2],
    last: Traction,
    stored: f64,
    point: PointState,
}

fn follow_path(law: &CohesiveLaw, path: impl Iterator<Item = (f64, f64)>) -> Path {
    let mut point = PointState::default();
    let mut out = Path { peak: [f64::MIN; 2], ..Path::default() };
    let mut before = (0.0, 0.0);
    for (opening, slip) in path {
        let now = law.respond(&mut point, opening, [0.6 * slip, 0.8 * slip]);
        let tau = |t: &Traction| 0.6 * t.shear[0] + 0.8 * t.shear[1];
        out.work += 0.5 * (now.normal + out.last.normal) * (opening - before.0);
        out.work += 0.5 * (tau(&now) + tau(&out.last)) * (slip - before.1);
        assert!(now.dissipated >= 0.0);
        out.dissipated += now.dissipated;
        out.peak = [out.peak[0].max(now.normal), out.peak[1].max(tau(&now))];
        (before, out.last, out.point) = ((opening, slip), now, point);
        out.stored = law.stored(&point);
    }
    out
}

fn ramp(to: f64, count: u32) -> impl Iterator<Item = f64> {
    (1..=count).map(move |i| to * f64::from(i) / f64::from(count))
}

#[test]
fn tensile_failure_reaches_the_strength_and_dissipates_the_fracture_energy() {
    let path = follow_path(&law(Range::Exact), ramp(1e-4, 40_000).map(|d| (d, 0.0)));
    println!("peak {:.5e} Pa, work {:.4} J/m2, dissipated {:.4}", path.peak[0], path.work, path.dissipated);
    // Required accuracy of peak stress, work and dissipated energy: 0.1 %.
    assert!((path.peak[0] / 3.3e6 - 1.0).abs() < 1e-3);
    assert!((path.work / 50.0 - 1.0).abs() < 1e-3 && (path.dissipated / 50.0 - 1.0).abs() < 1e-3);
    assert_eq!((path.last.normal, path.stored), (0.0, 0.0));
    let published = follow_path(&law(Range::Published), ramp(1e-4, 40_000).map(|d| (d, 0.0)));
    // The expected work is 3 I G_f after the peak, with I = `AREA`, plus 2/3 f_t delta_np before the peak.
    let expected = 3.0 * AREA * 50.0 + 2.0 / 3.0 * 3.3e6 * 2.0 * H * 3.3e6 / PENALTY;
    assert!((published.work / expected - 1.0).abs() < 1e-3, "{}", published.work);
}

#[test]
fn shear_strength_under_pressure_follows_mohr_coulomb() {
    let law = law(Range::Exact);
    for (pressure, expected) in [(0.0, 16.5e6), (10e6, 22.27e6), (50e6, 45.37e6)] {
        let opening = -pressure / law.stiffness();
        let path = follow_path(&law, ramp(4e-5, 40_000).map(|s| (opening, s)));
        println!("{:.0} MPa: {:.4e} Pa, {:.3} J/m2", pressure / 1e6, path.peak[1], path.dissipated);
        // Required accuracy of the shear strength: 0.5 %; of the dissipated energy: 0.1 %.
        assert!((path.peak[1] / expected - 1.0).abs() < 5e-3);
        assert!((path.dissipated / 50.0 - 1.0).abs() < 1e-3, "{}", path.dissipated);
        assert_eq!(path.last.shear, [0.0; 2]);
    }
}

#[test]
fn unloading_follows_the_secant_and_damage_does_not_heal() {
    let law = law(Range::Exact);
    let up = follow_path(&law, ramp(1e-5, 10_000).map(|d| (d, 0.0)));
    let down = ramp(1e-5, 10_000).map(|d| (1e-5 - d, 0.0));
    let again = ramp(1e-5, 10_000).map(|d| (d, 0.0));
    let back = follow_path(&law, ramp(1e-5, 10_000).map(|d| (d, 0.0)).chain(down).chain(again));
    assert_eq!((up.point.damage, up.dissipated), (back.point.damage, back.dissipated));
    assert!((up.last.normal / back.last.normal - 1.0).abs() < 1e-12);
    let mut point = up.point;
    let half = law.respond(&mut point, 0.5e-5, [0.0; 2]);
    assert!((half.normal / (0.5 * up.last.normal) - 1.0).abs() < 1e-12);
    // In compression, damage does not reduce the stiffness.
    assert_eq!(law.respond(&mut point, -1e-7, [0.0; 2]).normal, -1e-7 * law.stiffness());
}

#[test]
fn energy_balances_and_dissipation_is_never_negative_on_any_path() {
    let law = law(Range::Exact);
    for seed in 0..200 {
        let t = |k: f64| f64::from(seed) * k;
        // Opening and slip oscillate with growing amplitudes, so that all combinations of signs occur.
        let path = |i: u32| {
            let s = f64::from(i) / 20_000.0;
            let opening = 2e-5 * s * (7.0 * s + t(1.3)).sin() * t(0.37).cos();
            (opening, 1.5e-5 * s * (11.0 * s + t(0.7)).sin())
        };
        let start = std::iter::once((0.0, 0.0));
        let out = follow_path(&law, start.chain((1..=20_000).map(path)));
        let balance = out.work - out.stored - out.dissipated;
        // Tolerance: error of the trapezoidal rule over 20,000 increments; the yield stress changes in each of them.
        assert!(balance.abs() < 2e-3 * out.work.abs().max(1.0), "{seed}: {balance:.2e} of {:.2e}", out.work);
    }
}

#[test]
fn damage_by_sliding_reduces_the_tensile_strength() {
    let law = law(Range::Exact);
    let slid = (0..=4000).map(|i| (0.0, 1e-9 * f64::from(i)));
    let path = follow_path(&law, slid.chain(ramp(1e-4, 40_000).map(|d| (d, 4e-6))));
    assert!(path.peak[0] < 0.7 * 3.3e6, "{:.3e}", path.peak[0]);
}

#[test]
fn a_released_joint_starts_with_the_stress_of_the_tied_face() {
    let law = Cohesion { strength: CONCRETE, penalty: 2.0 * 26e9, range: Range::Exact, tied: true }.law(H);
    for (normal, shear) in [(3.3e6, [1e6, -2e6]), (1e6, [8e6, 0.0]), (-5e6, [0.0, 3e6])] {
        let (mut point, opening) = law.loaded(normal, shear);
        let now = law.respond(&mut point, opening, [0.0; 2]);
        assert!((now.normal / normal - 1.0).abs() < 1e-9 && (now.shear[1] - shear[1]).abs() < 1e-3, "{now:?}");
    }
    let (mut point, opening) = law.loaded(3.3e6, [0.0; 2]);
    let (mut dissipated, mut stored) = (0.0, 0.0);
    for d in ramp(1e-4, 40_000) {
        let now = law.respond(&mut point, opening + d, [0.0; 2]);
        dissipated += now.dissipated;
        stored = law.stored(&point);
    }
    let initial = 2.0 / 3.0 * 3.3e6 * opening;
    // The joint dissipates all of G_f after the peak, plus the elastic energy that it had when it was released.
    assert!(((dissipated - initial) / 50.0 - 1.0).abs() < 1e-3 && stored == 0.0, "{dissipated}");
}

#[test]
fn at_the_longest_edge_the_softening_range_is_zero() {
    let cohesion = Cohesion { strength: CONCRETE, penalty: 26e9, range: Range::Exact, tied: false };
    let law = cohesion.law(cohesion.longest_edge());
    // Tolerance: rounding, relative to G_f / f_t.
    assert!(law.opening_range.abs() < 1e-12 * 50.0 / 3.3e6);
}
