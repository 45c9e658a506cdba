//! Kernel sums of the solver compared with exact values: moments of the kernel, gradients, divergence.

use std::f64::consts::PI;

use breakwater::sph::{
    pairs::rate::Rate,
    parameters::Parameters,
    terms::{kernel::Wendland, turbulence::Smagorinsky, viscosity::Viscosity},
};
use glam::DVec3;

use super::blocks::{
    DP, JITTER, USUAL, block, gradients_of_block, ideal, inside, lattice_error_of_gradient, rates, rates_of_block, rms,
    whole_axes,
};
use super::lattice::{aliasing, gradient_factor, lattice_sum, mean_over_jitter, value};
use super::tanks::RHO0;

#[test]
fn kernel_moments_on_a_lattice_have_the_error_of_theory() {
    for factor in [0.8, 1.0, 1.2, 1.5, 2.0].map(|factor| factor * 3f64.sqrt()) {
        let kernel = Wendland::new(factor);
        let (w, g) = (|r: DVec3| value(&kernel, r.length()), |r: DVec3| gradient_factor(&kernel, r.length()));
        let zeroth = lattice_sum(&kernel, w) - 1.0;
        let of_gradient = lattice_error_of_gradient(factor);
        let expected = aliasing(&kernel, |r| value(&kernel, r));
        // By symmetry, the moment along one axis is a third of the trace -G r^2.
        let expected_of_gradient = aliasing(&kernel, |r| -gradient_factor(&kernel, r) * r * r / 3.0);
        println!(
            "h = {factor:.3} dp: sum V W = 1 {zeroth:+.2e} (theory {expected:+.2e}), first moment of grad W = \
             1 {of_gradient:+.2e} (theory {expected_of_gradient:+.2e})"
        );
        // Limit 3e-6: the kernel constants have rounding errors of 1e-7 (single precision). The lattice error is up to
        // 1e-2, and `aliasing` omits 1e-4 of it.
        assert!((zeroth - expected).abs() < 3e-6, "{factor}");
        assert!((of_gradient - expected_of_gradient).abs() < 3e-6, "{factor}");
        // Limit 1e-14: rounding; odd moments vanish by symmetry.
        assert!(lattice_sum(&kernel, |r| w(r) * r.x).abs() < 1e-14);
        assert!(lattice_sum(&kernel, |r| g(r) * r.y).abs() < 1e-14);
        assert!(lattice_sum(&kernel, |r| g(r) * r.x * r.z).abs() < 1e-14);
    }
    // With the default h / dp, a gradient is 4e-4 too large on a lattice.
    assert!((lattice_error_of_gradient(USUAL) - 3.6e-4).abs() < 1e-5);
}

/// Theory for a jittered lattice with the variance s^2 = (jitter dp)^2 / 3 along each axis:
/// - The distance of a particle to itself does not vary, so sum V W and the first moment of the gradient have the error
///   V (f(0) - mean of f over the jitter), where f is the summand.
/// - To first order, the variance of both is V^2 s^2 sum |grad f|^2 over the neighbours, plus the variance from the
///   particle's own jitter.
#[test]
fn kernel_moments_on_a_jittered_lattice_scatter_as_in_theory() {
    let kernel = Wendland::new(USUAL);
    let w = |r: f64| value(&kernel, r);
    let trace = |r: f64| -gradient_factor(&kernel, r) * r * r;
    let self_term = |f: &dyn Fn(f64) -> f64| f(0.0) - mean_over_jitter(JITTER, |r| f(r.length()));
    let variance = JITTER * JITTER / 3.0;
    let spread = |f: &dyn Fn(f64) -> f64| (variance * lattice_sum(&kernel, |r| slope(f, r.length()).powi(2))).sqrt();
    let spread_of_gradient = (variance * (lattice_sum(&kernel, |r| scatter(&kernel, r)) + own_scatter(&kernel))).sqrt();

    let water = block(JITTER, |_| RHO0, |_| DVec3::ZERO);
    let (gradients, order) = gradients_of_block(&water);
    let inner: Vec<usize> = (0..order.len()).filter(|&i| inside(water.position[order[i]])).collect();
    let zeroth =
        |i: &usize| water.position.iter().map(|p| w((*p - water.position[order[*i]]).length() / DP)).sum::<f64>();
    let zeroth: Vec<f64> = inner.iter().map(|i| zeroth(i) - 1.0).collect();
    let first: Vec<f64> = inner.iter().map(|&i| gradients.order(i).divergence - 3.0).collect();
    let gradient = inner.iter().flat_map(|&i| gradients.order(i).concentration_gradient.to_array()).map(|g| DP * g);
    let measured_gradient = rms(gradient);
    println!("jitter of {JITTER} dp, {} particles:", inner.len());
    let check = |name: &str, values: &[f64], on_a_lattice: f64, f: &dyn Fn(f64) -> f64| {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let deviation = rms(values.iter().map(|value| value - mean));
        let (expected, expected_deviation) = (on_a_lattice + self_term(f), spread(f));
        println!("{name} = {mean:.2e} +- {deviation:.2e}, theory {expected:.2e} +- {expected_deviation:.2e}");
        // Limit: a tenth of the scatter. To first order, a particle's jitter cancels in the mean if all its neighbours
        // are included, so only particles near the faces contribute.
        assert!((mean - expected).abs() < 0.1 * expected_deviation, "{name}");
        // Limit 15 % for the scatter: effects of second order in the jitter, and the finite sample.
        assert!((deviation / expected_deviation - 1.0).abs() < 0.15, "{name}");
    };
    check("sum V W - 1", &zeroth, aliasing(&kernel, w), &w);
    check("div r - 3", &first, 3.0 * lattice_error_of_gradient(USUAL), &trace);
    println!("dp grad C = {measured_gradient:.2e}, theory {spread_of_gradient:.2e}");
    assert!((measured_gradient / spread_of_gradient - 1.0).abs() < 0.15);
}

/// Returns df/dr of a radial function that is even in r.
fn slope(f: &dyn Fn(f64) -> f64, r: f64) -> f64 {
    (f(r + 1e-5) - f((r - 1e-5).abs())) / 2e-5
}

/// Returns |grad (G x)|^2 of a neighbour [1/m10] for spacing 1.
fn scatter(kernel: &Wendland, r: DVec3) -> f64 {
    let distance = r.length();
    if distance == 0.0 {
        return 0.0;
    }
    let g = gradient_factor(kernel, distance);
    let slope = slope(&|r| gradient_factor(kernel, r), distance);
    g * g + r.x * r.x * (2.0 * g * slope / distance + slope * slope)
}

/// Returns |grad (G x)|^2 of the particle itself. The second derivatives of its neighbours' kernels sum to minus the
/// second derivative of its own kernel.
fn own_scatter(kernel: &Wendland) -> f64 {
    gradient_factor(kernel, 0.0).powi(2)
}

#[test]
fn renormalised_gradients_of_linear_fields_are_exact() {
    let slope = DVec3::new(60.0, -30.0, 80.0);
    let shear = [[0.0, 0.0, 3.0], [0.0; 3], [0.0; 3]];
    for jitter in [0.0, JITTER] {
        let water = block(jitter, |p| RHO0 + slope.dot(p), |p| DVec3::new(3.0 * p.z, 0.0, 0.0));
        let (gradients, order) = gradients_of_block(&water);
        let (mut worst, mut worst_inside, mut worst_stress) = (0.0_f64, 0.0_f64, 0.0_f64);
        for (extra, &particle) in gradients.neighbour_data().iter().zip(&order) {
            let found = DVec3::from_array(extra.density_gradient.map(f64::from));
            let error = (found - slope).length() / slope.length();
            // At edges and corners, the gradients are not renormalised.
            if whole_axes(water.position[particle]) >= 2 {
                worst = worst.max(error);
            }
            let exact = Smagorinsky::new(DP).specific_stress(shear, water.density[particle]);
            let stress_error = |k: usize| (f64::from(extra.stress[k]) - exact[k]).abs() / exact[4];
            if inside(water.position[particle]) {
                worst_inside = worst_inside.max(error);
                worst_stress = (0..6).map(stress_error).fold(worst_stress, f64::max);
            }
        }
        println!(
            "renormalised gradient, jitter {jitter} dp: error {worst_inside:.1e} inside, {worst:.1e} at faces; \
             turbulent stress of a shear flow {worst_stress:.1e}"
        );
        // Limits 2e-6 and 4e-6, from single precision: positions have errors of 1e-8 m or 5e-7 h, which average out
        // over some 280 neighbours. Sums have errors of 1e-7 of the terms that cancel.
        assert!(worst_inside < 2e-6 && worst_stress < 4e-6);
        // The limit is twice as large at faces, where half of the neighbourhood is empty along the normal.
        assert!(worst < 4e-6);
    }
}

#[test]
fn pressure_gradient_of_a_linear_field_has_the_lattice_error() {
    let tait = ideal(DP, None).tait;
    let (mean, slope) = (500.0, DVec3::new(1000.0, -2000.0, 3000.0));
    let (water, rates) = rates_of_block(block(0.0, |p| tait.density(mean + slope.dot(p)), |_| DVec3::ZERO));
    let error = lattice_error_of_gradient(USUAL);
    let mut worst = 0.0_f64;
    for (i, rate) in rates.iter().enumerate().filter(|(i, _)| inside(water.position[*i])) {
        let found = -water.density[i] * DVec3::from_array(rate.acceleration.map(f64::from));
        worst = worst.max((found - (1.0 + error) * slope).length() / slope.length());
    }
    println!("pressure gradient on a lattice: deviation {worst:.1e} from (1 {error:+.2e}) times the exact value");
    // Limit 2e-5 of the slope. The terms of 2 p_a sum V grad W cancel except for the rounding of some 280 terms,
    // 6e-8 sqrt(280) = 1e-6 of 2 p / h. For the largest pressure p, 830 Pa, 2 p / h is 8e4 Pa/m, 22 times the slope.
    assert!(worst < 2e-5, "{worst}");
}

/// A constant pressure accelerates unevenly spaced particles: dv/dt = -2 p / rho grad C, with the concentration
/// C = sum V W, does not vanish with dp.
#[test]
fn constant_pressure_accelerates_jittered_particles() {
    let tait = ideal(DP, None).tait;
    let pressure = 1000.0;
    let water = block(JITTER, |_| tait.density(pressure), |_| DVec3::ZERO);
    let (gradients, order) = gradients_of_block(&water);
    let (sorted, rates) = rates_of_block(water);
    let mut worst = 0.0_f64;
    for (i, rate) in rates.iter().enumerate() {
        assert_eq!(sorted.id[i] as usize, order[i]);
        let expected = -2.0 * pressure / sorted.density[i] * gradients.order(i).concentration_gradient;
        let found = DVec3::from_array(rate.acceleration.map(f64::from));
        worst = worst.max((found - expected).length() * sorted.density[i] * DP / pressure);
    }
    println!("acceleration by a constant pressure: deviation {worst:.1e} p / (rho dp) from theory");
    // Limit 2e-6 for the deviation: sums of some 280 terms of up to 0.02 p / dp in single precision.
    assert!(worst < 2e-6, "{worst}");
}

#[test]
fn density_rate_of_a_linear_velocity_has_the_lattice_error() {
    let error = lattice_error_of_gradient(USUAL);
    // Rows of the velocity gradient d v_i / d x_j [1/s].
    let grad_v = [DVec3::new(3.0, 1.0, -2.0), DVec3::new(0.5, -1.0, 4.0), DVec3::new(2.0, 0.0, 2.0)];
    let flow = |p: DVec3| DVec3::new(1.0, -2.0, 0.5) + DVec3::new(grad_v[0].dot(p), grad_v[1].dot(p), grad_v[2].dot(p));
    let (water, rates) = rates_of_block(block(0.0, |_| RHO0, flow));
    let (divergence, size) = (3.0 - 1.0 + 2.0, 6.3);
    let inner = |(i, _): &(usize, &Rate)| inside(water.position[*i]);
    let deviation =
        |(_, rate): (usize, &Rate)| (f64::from(rate.density) / -RHO0 - (1.0 + error) * divergence).abs() / size;
    let worst = rates.iter().enumerate().filter(inner).map(deviation).fold(0.0, f64::max);
    // In rigid rotation v_ab is perpendicular to r_ab, so the density does not change, even with jitter.
    let rotation = |p: DVec3| DVec3::new(1.0, -2.0, 0.5) + DVec3::new(1.0, -2.0, 3.0).cross(p);
    let (_, rates) = rates_of_block(block(JITTER, |_| RHO0, rotation));
    let rotating = rates.iter().map(|rate| f64::from(rate.density).abs() / RHO0).fold(0.0, f64::max) / 3.7;
    println!(
        "divergence of a linear velocity: deviation {worst:.1e} from (1 {error:+.2e}) times the exact value; in rigid \
         rotation {rotating:.1e}"
    );
    // Limit 2e-6: in single precision, velocities of 2 m/s have errors of 1.2e-7 m/s and positions of 0.1 m errors of
    // 7e-9 m. The differences between neighbours are about 0.1 m/s and 0.02 m.
    assert!(worst < 2e-6 && rotating < 2e-6, "{worst} {rotating}");
}

/// In the shear flow u = S z + K z^2 / 2, the acceleration by a viscosity nu is nu K; by a viscosity C h^2 |du/dz|, it is
/// 2 C h^2 S K in the middle. Artificial viscosity acts only on the half of the pairs that approach each other. With the
/// means of n_x^2 n_z^2 and |n_x n_z|^3 over all directions, 1/15 and 8/(105 pi), and the integral of -G r^2 over space,
/// which is 3, the viscosities are alpha h c0 / 20 and 2/(35 pi) beta h^2 |du/dz|.
#[test]
fn artificial_viscosity_acts_like_a_viscosity_in_shear() {
    const SHEAR: f64 = 10.0;
    const CURVATURE: f64 = 20.0;
    let acceleration = |alpha: f64, beta: f64| {
        let parameters = Parameters { viscosity: Viscosity::Artificial { alpha, beta }, ..ideal(DP, None) };
        let flow = |p: DVec3| DVec3::X * (SHEAR * p.z + 0.5 * CURVATURE * p.z * p.z);
        let (water, rates) = rates(parameters, block(0.0, |_| RHO0, flow), DVec3::splat(-0.15), DVec3::splat(0.15));
        let inner = || (0..rates.len()).filter(|&i| inside(water.position[i]));
        inner().map(|i| f64::from(rates[i].acceleration[0])).sum::<f64>() / inner().count() as f64
    };
    let (h, c0) = (USUAL * DP, ideal(DP, None).tait.c0);
    let (alpha, beta) = (0.04, 0.3);
    let linear = acceleration(alpha, 0.0) / (alpha * h * c0 / 20.0 * CURVATURE);
    let quadratic = acceleration(0.0, beta) / (2.0 * 2.0 / (35.0 * PI) * beta * h * h * SHEAR * CURVATURE);
    println!("acceleration over that of theory: alpha {linear:.4}, beta {quadratic:.4}");
    // Limit 5 %: the term 0.01 h^2 in mu weakens the nearest pairs by 4 %.
    assert!((linear - 1.0).abs() < 0.05 && (quadratic - 1.0).abs() < 0.05, "{linear} {quadratic}");
}
