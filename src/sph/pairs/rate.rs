//! Result of a loop over pairs.

/// Acceleration and density rate of one target.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Rate {
    /// Acceleration without gravity [m/s2].
    pub acceleration: [f32; 3],
    /// d rho / dt [kg/(m3 s)].
    pub density: f32,
    /// Compression, -rho div v: d rho / dt without density diffusion [kg/(m3 s)].
    pub compression: f32,
    /// Largest |mu_ab| of equation 3 over all neighbours b, also those that move away [m/s].
    pub approach: f32,
}
