//! Bed friction.
//!
//! ```text
//! du_m/dt = - c_f |U| u_m / H
//! rough:   c_f = g n^2 / H^(1/3)                        Manning
//! smooth:  c_f = max(3 / Re, 0.0279 Re^(-1/4)),  Re = |U| H / nu
//! ```
//!
//! with the mean velocity U over the depth H, Manning's n and the kinematic viscosity nu. The bed shear stress
//! rho c_f |U| U is distributed over the layers in proportion to their velocity. The model has no turbulent stress
//! between layers, so a stress on the lowest layer alone would let the other layers slide over it. With one layer, this
//! is equation 6 of Zijlema, Stelling & Smit (2011).
//!
//! On a smooth bed the stress is the larger of 3 rho nu U / H (laminar film) and Blasius's (1913) law. Blasius's law
//! for smooth walls is f = 0.316 (4 Re)^(-1/4) with c_f = f / 8 (Chow 1959, equation 1-8). Manning's law is valid for
//! rough beds; it would slow shallow water on glass too much.

use super::{DRY_DEPTH_M, Friction, LayeredFlume};

impl LayeredFlume {
    /// Damping rate of friction and sponge at a face [1/s].
    pub(super) fn damping_rate(&self, face: usize) -> f64 {
        let depth = self.friction_depth(face).max(DRY_DEPTH_M);
        let speed = self.mean_velocity(face).abs();
        let friction = match self.friction {
            Friction::None => 0.0,
            Friction::SmoothBed { viscosity_m2_s } => {
                smooth_coefficient(speed * depth / viscosity_m2_s) * speed / depth
            }
            Friction::Manning { n_s_m13 } => manning_coefficient(self.gravity, n_s_m13, depth) * speed / depth,
        };
        friction + self.sponge_rate[face]
    }

    /// Depth for friction at a face [m]: the mean of both cells, or the larger depth if one cell has only a film or is
    /// dry.
    fn friction_depth(&self, face: usize) -> f64 {
        let inner = face.clamp(1, self.grid.cells() - 1);
        let [left, right] = [self.depth[inner - 1], self.depth[inner]];
        if left.min(right) > self.hydrostatic_below_m { 0.5 * (left + right) } else { left.max(right) }
    }
}

/// Friction coefficient of Manning's law [-]: c_f = g n^2 / H^(1/3).
fn manning_coefficient(gravity: f64, n: f64, depth: f64) -> f64 {
    gravity * n * n / depth.cbrt()
}

/// Friction coefficient of a smooth bed [-]: c_f = max(3 / Re, 0.0279 Re^(-1/4)). It is finite in still water, where
/// friction has no effect.
fn smooth_coefficient(reynolds: f64) -> f64 {
    let reynolds = reynolds.max(1e-6);
    (3.0 / reynolds).max(0.0279 * reynolds.powf(-0.25))
}

#[cfg(test)]
mod tests {
    use super::{manning_coefficient, smooth_coefficient};

    #[test]
    fn smooth_bed_follows_laminar_film_and_smooth_pipe() {
        // A laminar film of depth H on the slope S has the mean velocity U = g S H^2 / (3 nu); c_f U^2 balances g H S.
        let (depth, nu, slope) = (5e-4f64, 1e-6, 0.01);
        let velocity = 9.81 * slope * depth * depth / (3.0 * nu);
        let c_f = smooth_coefficient(velocity * depth / nu);
        assert!((c_f * velocity * velocity / (9.81 * depth * slope) - 1.0).abs() < 1e-12);
        // The Darcy friction factor 8 c_f of a smooth pipe at 4 Re = 1e5 is 0.018.
        assert!((8.0 * smooth_coefficient(2.5e4) - 0.018).abs() < 5e-4);
    }

    #[test]
    fn uniform_flow_has_mannings_velocity() {
        // On a slope S the weight g H S balances c_f U^2, so U = H^(2/3) S^(1/2) / n.
        let (depth, slope, n) = (0.3f64, 1e-3, 0.012);
        let velocity = (9.81 * depth * slope / manning_coefficient(9.81, n, depth)).sqrt();
        assert!((velocity - depth.powf(2.0 / 3.0) * slope.sqrt() / n).abs() < 1e-12);
    }
}
