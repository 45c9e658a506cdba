//! Constants of the scheme in the layout of `parameters.wgsl`.

use bytemuck::{Pod, Zeroable};
use glam::DVec3;

use crate::sph::{
    boundary::mdbc::{CENTROID_LIMITS, DRY_LIMIT, LONGEST_WAY, MIN_DETERMINANT, SPREAD_LIMITS},
    neighbours::grid::Grid,
    parameters::Parameters,
    terms::{density_diffusion::Diffusion, equation_of_state::Tait, viscosity::Viscosity},
};

/// The struct `Parameters` of the shaders, with the same fields in the same order.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct Constants {
    count: [i32; 3],
    water: u32,
    size: [f32; 3],
    boundary: u32,
    width: f32,
    h: f32,
    inv_2h: f32,
    kernel_scale: f32,
    gradient_scale: f32,
    rho0: f32,
    alpha: f32,
    diffusion: f32,
    hydrostatic: f32,
    curvature: f32,
    gravity: f32,
    density_slope: f32,
    beta: f32,
    longest_way: f32,
    centroid_limits: [f32; 2],
    spread_limits: [f32; 2],
    least_determinant: f32,
    dry: f32,
    bounds_low: [f32; 3],
    padding_low: f32,
    bounds_high: [f32; 3],
    padding_high: f32,
    pressure: [f32; 8],
    sound: [f32; 8],
}

/// The struct `Step` of the shaders, with the same fields in the same order.
#[derive(Debug, Clone, Copy, PartialEq, Pod, Zeroable)]
#[repr(C)]
pub struct StepConstants {
    /// Time step [s].
    pub dt: f32,
    /// Kernel support plus the distance that a particle can have moved since sorting [m].
    pub reach: f32,
}

impl Constants {
    /// Creates the constants. `particles` are the numbers of water and boundary particles. All particles must stay in
    /// the box `bounds` [m].
    pub fn new(parameters: &Parameters, grid: &Grid, bounds: [DVec3; 2], particles: [usize; 2]) -> Self {
        let [water, boundary] = particles.map(|n| n as u32);
        let Parameters { kernel, tait, gravity, .. } = *parameters;
        let [alpha, beta] = match parameters.viscosity {
            Viscosity::Artificial { alpha, beta } => [alpha as f32, beta as f32],
            Viscosity::Laminar { .. } | Viscosity::MonaghanGingold { .. } => [0.0; 2],
        };
        let [hydrostatic, curvature] = parameters.diffusion.hydrostatic();
        let [low, high] = bounds.map(|point| (point - grid.low).as_vec3().to_array());
        Self {
            count: grid.count.map(|n| n as i32),
            water,
            size: grid.size.as_vec3().to_array(),
            boundary,
            width: grid.periodic_width.unwrap_or(0.0) as f32,
            h: kernel.h as f32,
            inv_2h: (0.5 / kernel.h) as f32,
            kernel_scale: kernel.scale(),
            gradient_scale: kernel.gradient_scale(),
            rho0: tait.rho0 as f32,
            alpha,
            diffusion: parameters.diffusion.factor(),
            hydrostatic,
            curvature,
            gravity: gravity as f32,
            density_slope: (-tait.rho0 * gravity / tait.c0.powi(2)) as f32,
            beta,
            longest_way: (LONGEST_WAY * kernel.h) as f32,
            centroid_limits: CENTROID_LIMITS.map(|t| t as f32),
            spread_limits: SPREAD_LIMITS.map(|t| t as f32),
            least_determinant: MIN_DETERMINANT as f32,
            dry: DRY_LIMIT as f32,
            bounds_low: low,
            padding_low: 0.0,
            bounds_high: high,
            padding_high: 0.0,
            pressure: pressure_series(&tait),
            sound: sound_series(&tait),
        }
    }

    /// Returns true if the flume is periodic across its width.
    pub fn is_periodic(&self) -> bool {
        self.width > 0.0
    }

    /// Returns the constants with which the shader computes the rates of the water without viscosity and diffusion.
    /// They set `boundary` to 0, so that the shader computes no rates of boundary particles.
    pub fn of_pressure_alone(self) -> Self {
        let [hydrostatic, curvature] = Diffusion::none().hydrostatic();
        Self { boundary: 0, alpha: 0.0, beta: 0.0, diffusion: 0.0, hydrostatic, curvature, ..self }
    }
}

/// Returns the coefficients of the pressure p in powers 1 to 8 of (rho - rho0) / rho0 [Pa]. For gamma = 7, the series
/// is exact. For other exponents, the truncation error is 1e-9 of p at a compression of 5 %.
fn pressure_series(tait: &Tait) -> [f32; 8] {
    let binomials = binomials(tait.gamma);
    let stiffness = tait.c0 * tait.c0 * tait.rho0 / tait.gamma;
    std::array::from_fn(|k| (stiffness * binomials[k + 1]) as f32)
}

/// Returns the coefficients of the speed of sound c in powers 0 to 7 of (rho - rho0) / rho0 [m/s].
fn sound_series(tait: &Tait) -> [f32; 8] {
    let binomials = binomials(0.5 * (tait.gamma - 1.0));
    std::array::from_fn(|k| (tait.c0 * binomials[k]) as f32)
}

/// Returns the binomial coefficients (exponent over k) for k from 0 to 8.
fn binomials(exponent: f64) -> [f64; 9] {
    let mut all = [1.0; 9];
    for k in 1..9 {
        all[k] = all[k - 1] * (exponent - (k - 1) as f64) / k as f64;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    fn evaluate_series(series: &[f32; 8], e: f64) -> f64 {
        series.iter().rev().fold(0.0, |sum, &a| sum * e + f64::from(a))
    }

    #[test]
    fn series_match_the_equation_of_state() {
        for gamma in [7.0, 6.3] {
            let tait = Tait { rho0: 1000.0, c0: 15.0, gamma };
            for e in [-0.05, -1e-3, 1e-6, 2e-3, 0.05] {
                let rho = tait.rho0 * (1.0 + e);
                // Limit 1e-6: single-precision coefficients, and rounding errors of the exact p near rho0.
                assert!((evaluate_series(&pressure_series(&tait), e) * e / tait.pressure(rho) - 1.0).abs() < 1e-6);
                assert!((evaluate_series(&sound_series(&tait), e) / tait.sound_speed(rho) - 1.0).abs() < 1e-6);
            }
        }
    }
}
