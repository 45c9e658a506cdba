//! Equations of stream function wave theory and Newton's method, in units of depth and gravity.

use std::f64::consts::{PI, TAU};

use super::MeanFlow;

/// Largest number of Newton iterations; five are enough if the initial guess is good.
const MAX_ITERATIONS: usize = 30;
/// Largest residual of a converged solution: the rounding error of sums of 100 terms of order one.
const SOLVED: f64 = 1e-11;
/// Number of scalar unknowns k, U, c, Q, R. They precede the surface heights in the vector of unknowns.
const SCALARS: usize = 5;

/// Unknowns of a steady wave, in units of depth and gravity.
#[derive(Debug, Clone, PartialEq)]
pub struct SteadyWave {
    /// Wavenumber.
    pub k: f64,
    /// Mean speed U of the water in the frame of the wave.
    pub u: f64,
    /// Celerity.
    pub c: f64,
    /// Volume flux Q in the frame of the wave.
    pub q: f64,
    /// Bernoulli constant R.
    pub r: f64,
    /// Surface heights above the bed at N + 1 points from crest to trough.
    pub surface: Vec<f64>,
    /// Coefficients B_1..B_N.
    pub b: Vec<f64>,
}

impl SteadyWave {
    /// Creates a linear wave with the given height and wavenumber; `order` is N.
    pub fn linear(order: usize, height: f64, k: f64) -> Self {
        let c = (k.tanh() / k).sqrt();
        let surface = (0..=order).map(|m| 1.0 + 0.5 * height * (m as f64 * PI / order as f64).cos()).collect();
        let mut b = vec![0.0; order];
        b[0] = 0.5 * height * c / k.tanh();
        Self { k, u: c, c, q: c, r: 1.0 + 0.5 * c * c, surface, b }
    }

    /// Extrapolates linearly from `earlier` through this wave: adds `share` times (this wave minus `earlier`).
    pub fn extrapolated(&self, earlier: &Self, share: f64) -> Self {
        let (current, previous) = (self.to_vector(), earlier.to_vector());
        let next: Vec<f64> = current.iter().zip(&previous).map(|(a, b)| a + share * (a - b)).collect();
        Self::from_vector(&next)
    }

    /// Returns true if the surface falls monotonically from crest to trough.
    pub fn falls_from_crest_to_trough(&self) -> bool {
        // The tolerance covers rounding in the level trough of a long wave.
        self.surface.windows(2).all(|pair| pair[1] < pair[0] + 1e-6)
    }

    fn to_vector(&self) -> Vec<f64> {
        let scalars = [self.k, self.u, self.c, self.q, self.r];
        scalars.iter().chain(&self.surface).chain(&self.b).copied().collect()
    }

    fn from_vector(x: &[f64]) -> Self {
        let order = (x.len() - SCALARS - 1) / 2;
        let split = SCALARS + order + 1;
        Self {
            k: x[0],
            u: x[1],
            c: x[2],
            q: x[3],
            r: x[4],
            surface: x[SCALARS..split].to_vec(),
            b: x[split..].to_vec(),
        }
    }
}

/// Returns cosh(a y) / cosh(a); the formula avoids the overflow of cosh(a) for large a.
pub fn cosh_ratio(a: f64, y: f64) -> f64 {
    ((a * (y - 1.0)).exp() + (-a * (y + 1.0)).exp()) / (1.0 + (-2.0 * a).exp())
}

/// Returns sinh(a y) / cosh(a); the formula avoids the overflow of cosh(a) for large a.
fn sinh_ratio(a: f64, y: f64) -> f64 {
    ((a * (y - 1.0)).exp() - (-a * (y + 1.0)).exp()) / (1.0 + (-2.0 * a).exp())
}

/// Solves the equations by Newton's method with the initial guess `start`; `None` if it does not converge.
pub fn solve(start: SteadyWave, height: f64, period: f64, mean_flow: MeanFlow) -> Option<SteadyWave> {
    let mut wave = start;
    for _ in 0..MAX_ITERATIONS {
        let (mut matrix, mut residual) = linearise(&wave, height, period, mean_flow);
        let largest = residual.iter().fold(0.0, |most: f64, r| most.max(r.abs()));
        if largest < SOLVED {
            return Some(wave);
        }
        eliminate(&mut matrix, &mut residual)?;
        let x: Vec<f64> = wave.to_vector().iter().zip(&residual).map(|(x, step)| x - step).collect();
        wave = SteadyWave::from_vector(&x);
        let is_plausible = wave.k > 0.0 && wave.surface.iter().all(|y| *y > 0.0 && *y < 2.0);
        if !is_plausible {
            return None;
        }
    }
    None
}

/// Jacobian (row-major) and residual of the 2 N + 6 equations.
fn linearise(wave: &SteadyWave, height: f64, period: f64, mean_flow: MeanFlow) -> (Vec<f64>, Vec<f64>) {
    let order = wave.b.len();
    let size = 2 * order + SCALARS + 1;
    let (mut matrix, mut residual) = (vec![0.0; size * size], vec![0.0; size]);
    for m in 0..=order {
        let (stream, bernoulli) = (m * size, (order + 1 + m) * size);
        let (head, tail) = matrix.split_at_mut(bernoulli);
        let [a, b] = surface_equations(wave, m, &mut head[stream..stream + size], &mut tail[..size]);
        (residual[m], residual[order + 1 + m]) = (a, b);
    }
    let mut row = 2 * order + 2;
    let mut equation = |value: f64, entries: &[(usize, f64)]| {
        residual[row] = value;
        for (column, entry) in entries {
            matrix[row * size + column] = *entry;
        }
        row += 1;
    };
    let weight = |m: usize| if m == 0 || m == order { 0.5 } else { 1.0 } / order as f64;
    let mean: f64 = (0..=order).map(|m| weight(m) * wave.surface[m]).sum();
    let means: Vec<(usize, f64)> = (0..=order).map(|m| (SCALARS + m, weight(m))).collect();
    equation(mean - 1.0, &means);
    equation(wave.surface[0] - wave.surface[order] - height, &[(SCALARS, 1.0), (SCALARS + order, -1.0)]);
    equation(wave.c * wave.k * period - TAU, &[(0, wave.c * period), (2, wave.k * period)]);
    match mean_flow {
        MeanFlow::NoCurrent => equation(wave.c - wave.u, &[(2, 1.0), (1, -1.0)]),
        MeanFlow::NoTransport => equation(wave.c - wave.q, &[(2, 1.0), (3, -1.0)]),
    }
    (matrix, residual)
}

/// Residuals psi + Q and (u^2 + v^2) / 2 + Y - R at surface point m. Writes their derivatives to `stream` and
/// `bernoulli`.
fn surface_equations(wave: &SteadyWave, m: usize, stream: &mut [f64], bernoulli: &mut [f64]) -> [f64; 2] {
    let order = wave.b.len();
    let (k, y) = (wave.k, wave.surface[m]);
    let (mut psi, mut u, mut v) = (-wave.u * y, -wave.u, 0.0);
    let (mut u_y, mut v_y, mut psi_k, mut u_k, mut v_k) = (0.0, 0.0, 0.0, 0.0, 0.0);
    let first_b = SCALARS + order + 1;
    for (i, b) in wave.b.iter().enumerate() {
        let j = (i + 1) as f64;
        let (sin, cos) = (j * m as f64 * PI / order as f64).sin_cos();
        let (s, c, t) = (sinh_ratio(j * k, y), cosh_ratio(j * k, y), (j * k).tanh());
        // Derivatives of s and c with respect to k.
        let (s_k, c_k) = (j * (y * c - s * t), j * (y * s - c * t));
        psi += b * s * cos;
        u += j * k * b * c * cos;
        v += j * k * b * s * sin;
        u_y += (j * k).powi(2) * b * s * cos;
        v_y += (j * k).powi(2) * b * c * sin;
        psi_k += b * s_k * cos;
        u_k += j * b * cos * (c + k * c_k);
        v_k += j * b * sin * (s + k * s_k);
        stream[first_b + i] = s * cos;
    }
    for i in 0..order {
        let j = (i + 1) as f64;
        let (sin, cos) = (j * m as f64 * PI / order as f64).sin_cos();
        bernoulli[first_b + i] = j * k * (u * cosh_ratio(j * k, y) * cos + v * sinh_ratio(j * k, y) * sin);
    }
    (stream[0], stream[1], stream[3], stream[SCALARS + m]) = (psi_k, -y, 1.0, u);
    (bernoulli[0], bernoulli[1], bernoulli[4]) = (u * u_k + v * v_k, -u, -1.0);
    bernoulli[SCALARS + m] = u * u_y + v * v_y + 1.0;
    [psi + wave.q, 0.5 * (u * u + v * v) + y - wave.r]
}

/// Gaussian elimination with partial pivoting; the solution overwrites `right`. `None` if the matrix is singular.
fn eliminate(matrix: &mut [f64], right: &mut [f64]) -> Option<()> {
    let n = right.len();
    for p in 0..n {
        let best = (p..n).max_by(|a, b| matrix[a * n + p].abs().total_cmp(&matrix[b * n + p].abs()))?;
        let pivot = matrix[best * n + p];
        if !pivot.is_finite() || pivot == 0.0 {
            return None;
        }
        if best != p {
            (0..n).for_each(|column| matrix.swap(p * n + column, best * n + column));
            right.swap(p, best);
        }
        for row in p + 1..n {
            let factor = matrix[row * n + p] / matrix[p * n + p];
            if factor != 0.0 {
                (p..n).for_each(|column| matrix[row * n + column] -= factor * matrix[p * n + column]);
                right[row] -= factor * right[p];
            }
        }
    }
    for p in (0..n).rev() {
        let known: f64 = (p + 1..n).map(|column| matrix[p * n + column] * right[column]).sum();
        right[p] = (right[p] - known) / matrix[p * n + p];
    }
    Some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jacobian_is_the_derivative_of_the_residual() {
        let mut wave = SteadyWave::linear(5, 0.2, 0.9);
        wave.b.iter_mut().enumerate().for_each(|(i, b)| *b += 0.02 / (i + 1) as f64);
        let (matrix, _) = linearise(&wave, 0.2, 6.0, MeanFlow::NoTransport);
        let x = wave.to_vector();
        for column in 0..x.len() {
            let shifted = |by: f64| {
                let mut x = x.clone();
                x[column] += by;
                linearise(&SteadyWave::from_vector(&x), 0.2, 6.0, MeanFlow::NoTransport).1
            };
            let (up, down) = (shifted(1e-5), shifted(-1e-5));
            for row in 0..x.len() {
                let slope = (up[row] - down[row]) / 2e-5;
                // The error of the central difference is (1e-5)^2 times a third derivative of up to (N k)^3 = 100.
                assert!((slope - matrix[row * x.len() + column]).abs() < 1e-7, "{row} {column}");
            }
        }
    }
}
