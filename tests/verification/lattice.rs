//! Points on a regular or jittered cubic lattice, and the theory of kernel sums on it.
//!
//! Poisson's summation formula: on a lattice of spacing dp, dp^3 sum_b f(r_b) = sum_n F(2 pi n / dp), where F is the
//! Fourier transform of f and n runs over all integer triples. The term n = 0 is the integral; the sum of the other
//! terms is the lattice error.

use std::f64::consts::PI;

use breakwater::sph::terms::kernel::Wendland;
use glam::DVec3;

/// Returns points at dp (i, j, k) from a corner [m], each shifted by up to `jitter` dp along each axis.
pub fn points(dp: f64, count: [usize; 3], corner: DVec3, jitter: f64) -> Vec<DVec3> {
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        2.0 * ((state >> 40) as f64 / (1_u64 << 24) as f64) - 1.0
    };
    let [nx, ny, nz] = count;
    let index = |i: usize| DVec3::new((i % nx) as f64, (i / nx % ny) as f64, (i / nx / ny) as f64);
    (0..nx * ny * nz).map(|i| corner + dp * (index(i) + jitter * DVec3::new(random(), random(), random()))).collect()
}

/// Sums a term over the lattice points with spacing 1 around the origin, within the support.
pub fn lattice_sum(kernel: &Wendland, term: impl Fn(DVec3) -> f64) -> f64 {
    let n = kernel.support() as i32 + 1;
    let axis = || (-n..=n).map(f64::from);
    axis().flat_map(|x| axis().flat_map(move |y| axis().map(move |z| DVec3::new(x, y, z)))).map(term).sum()
}

/// Returns the kernel W [1/m3] at a distance [m].
pub fn value(kernel: &Wendland, r: f64) -> f64 {
    kernel.value(kernel.closeness(r))
}

/// Returns the gradient factor G [1/m5] at a distance [m]: grad W = G r.
pub fn gradient_factor(kernel: &Wendland, r: f64) -> f64 {
    kernel.gradient_factor(kernel.closeness(r))
}

/// Returns the Fourier transform of a radial function at the wave number k [1/m], 4 pi / k int f(r) r sin(k r) dr over
/// the support, by Simpson's rule.
pub fn transform(kernel: &Wendland, k: f64, f: impl Fn(f64) -> f64) -> f64 {
    let intervals = 2000;
    let dr = kernel.support() / f64::from(intervals);
    let weight = |i: i32| if i == 0 || i == intervals { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
    let integrand = |i: i32| {
        let r = dr * f64::from(i);
        weight(i) * f(r) * r * (k * r).sin()
    };
    4.0 * PI / k * (0..=intervals).map(integrand).sum::<f64>() * dr / 3.0
}

/// Returns the error of the sum of f over a lattice of spacing 1 by Poisson's formula.
pub fn aliasing(kernel: &Wendland, f: impl Fn(f64) -> f64) -> f64 {
    // Transforms of kernels with two continuous derivatives fall with n^-6: the terms beyond n = 20 together are
    // 4 pi / 3 / 20^3 / 6 = 1e-4 of the six first terms.
    let reach = 20_i32;
    let mut counts = vec![0_u32; (reach * reach + 1) as usize];
    for (i, j, k) in
        (-reach..=reach).flat_map(|i| (-reach..=reach).flat_map(move |j| (-reach..=reach).map(move |k| (i, j, k))))
    {
        if let Some(counts) = counts.get_mut((i * i + j * j + k * k) as usize) {
            *counts += 1;
        }
    }
    let waves = counts.iter().enumerate().skip(1).filter(|(_, counts)| **counts > 0);
    waves.map(|(square, &counts)| f64::from(counts) * transform(kernel, 2.0 * PI * (square as f64).sqrt(), &f)).sum()
}

/// Returns the mean of f over the relative shift of two jittered points. Along each axis, the shift is the difference
/// of two uniform jitters of up to `jitter`, with a triangular distribution.
pub fn mean_over_jitter(jitter: f64, f: impl Fn(DVec3) -> f64) -> f64 {
    let n = 24;
    let nodes: Vec<(f64, f64)> = (0..n)
        .map(|i| (f64::from(i) + 0.5) / f64::from(n) * 2.0 - 1.0)
        .map(|t| (2.0 * jitter * t, (1.0 - t.abs()) * 2.0 / f64::from(n)))
        .collect();
    let mut sum = 0.0;
    for (x, wx) in &nodes {
        for (y, wy) in &nodes {
            sum += nodes.iter().map(|(z, wz)| wx * wy * wz * f(DVec3::new(*x, *y, *z))).sum::<f64>();
        }
    }
    sum
}
