//! Points on a cubic lattice, ordered or jittered, and what the theory of sums says of kernels on them.
//!
//! Poisson's summation: on a lattice of spacing dp, dp^3 sum_b f(r_b) = sum_n F(2 pi n / dp), F being the Fourier
//! transform of f and n all triples of whole numbers. The term of n = 0 is the integral, the others are the error.

use std::f64::consts::PI;

use breakwater::sph::terms::kernel::Wendland;
use glam::DVec3;

/// Points dp (i, j, k) from a corner [m], each moved by up to `jitter` dp along each axis.
pub fn points(dp: f64, count: [usize; 3], corner: DVec3, jitter: f64) -> Vec<DVec3> {
    let mut state = 1_u64;
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        2.0 * ((state >> 40) as f64 / (1_u64 << 24) as f64) - 1.0
    };
    let [nx, ny, nz] = count;
    let place = |i: usize| DVec3::new((i % nx) as f64, (i / nx % ny) as f64, (i / nx / ny) as f64);
    (0..nx * ny * nz).map(|i| corner + dp * (place(i) + jitter * DVec3::new(random(), random(), random()))).collect()
}

/// Sum over the points of a lattice with spacing 1 round the origin, as far as the support reaches.
pub fn lattice_sum(kernel: &Wendland, term: impl Fn(DVec3) -> f64) -> f64 {
    let n = kernel.support() as i32 + 1;
    let axis = || (-n..=n).map(f64::from);
    axis().flat_map(|x| axis().flat_map(move |y| axis().map(move |z| DVec3::new(x, y, z)))).map(term).sum()
}

/// W [1/m3] at a distance [m].
pub fn value(kernel: &Wendland, r: f64) -> f64 {
    kernel.value(kernel.closeness(r))
}

/// G [1/m5] at a distance [m]: grad W = G r.
pub fn gradient_factor(kernel: &Wendland, r: f64) -> f64 {
    kernel.gradient_factor(kernel.closeness(r))
}

/// Fourier transform of a function of the distance at the wave number k [1/m], 4 pi / k int f(r) r sin(k r) dr over the
/// support, by Simpson's rule.
pub fn transform(kernel: &Wendland, k: f64, f: impl Fn(f64) -> f64) -> f64 {
    let intervals = 2000;
    let dr = kernel.support() / f64::from(intervals);
    let weight = |i: i32| if i == 0 || i == intervals { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
    let at = |i: i32| {
        let r = dr * f64::from(i);
        weight(i) * f(r) * r * (k * r).sin()
    };
    4.0 * PI / k * (0..=intervals).map(at).sum::<f64>() * dr / 3.0
}

/// Error of the sum of f over a lattice of spacing 1 by Poisson's formula.
pub fn aliasing(kernel: &Wendland, f: impl Fn(f64) -> f64) -> f64 {
    // Transforms of kernels with two continuous derivatives fall with n^-6: what is left out beyond n = 20 is
    // 4 pi / 3 / 20^3 / 6 = 1e-4 of the first terms.
    let most = 20_i32;
    let mut ways = vec![0_u32; (most * most + 1) as usize];
    for (i, j, k) in
        (-most..=most).flat_map(|i| (-most..=most).flat_map(move |j| (-most..=most).map(move |k| (i, j, k))))
    {
        if let Some(ways) = ways.get_mut((i * i + j * j + k * k) as usize) {
            *ways += 1;
        }
    }
    let waves = ways.iter().enumerate().skip(1).filter(|(_, ways)| **ways > 0);
    waves.map(|(square, &ways)| f64::from(ways) * transform(kernel, 2.0 * PI * (square as f64).sqrt(), &f)).sum()
}

/// Mean of f over the difference of two jitters of up to `jitter` along each axis: a triangle for each.
pub fn mean_over_jitter(jitter: f64, f: impl Fn(DVec3) -> f64) -> f64 {
    let n = 24;
    let nodes: Vec<(f64, f64)> = (0..n)
        .map(|i| (f64::from(i) + 0.5) / f64::from(n) * 2.0 - 1.0)
        .map(|t| (2.0 * jitter * t, (1.0 - t.abs()) * 2.0 / f64::from(n)))
        .collect();
    let mut sum = 0.0;
    for (x, of_x) in &nodes {
        for (y, of_y) in &nodes {
            sum += nodes.iter().map(|(z, of_z)| of_x * of_y * of_z * f(DVec3::new(*x, *y, *z))).sum::<f64>();
        }
    }
    sum
}
