//! Equation 6: Tait's equation of state, p = c0^2 rho0 / gamma [(rho/rho0)^gamma - 1].

/// Tait's equation of state.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tait {
    /// Reference density rho0 [kg/m3].
    pub rho0: f64,
    /// Speed of sound at rho0 [m/s].
    pub c0: f64,
    /// Polytropic exponent gamma [-].
    pub gamma: f64,
}

impl Tait {
    /// Returns the factor c0^2 rho0 / gamma of the pressure [Pa].
    fn stiffness(&self) -> f64 {
        self.c0 * self.c0 * self.rho0 / self.gamma
    }

    /// Returns the pressure [Pa] at the density [kg/m3].
    pub fn pressure(&self, rho: f64) -> f64 {
        self.stiffness() * (self.power(rho / self.rho0, self.gamma) - 1.0)
    }

    /// Returns the density [kg/m3] at the pressure [Pa].
    pub fn density(&self, p: f64) -> f64 {
        self.rho0 * (1.0 + p / self.stiffness()).powf(1.0 / self.gamma)
    }

    /// Returns the density of water under the suction s rho0 g h [kg/m3], the pressure of a water column s times as
    /// high as the smoothing length h [m]. Returns 0 if this suction is impossible.
    pub fn density_under_suction(&self, s: f64, g: f64, h: f64) -> f64 {
        let suction = s * self.rho0 * g * h;
        if suction < self.stiffness() { self.density(-suction) } else { 0.0 }
    }

    /// Returns the speed of sound c = c0 (rho/rho0)^((gamma-1)/2) [m/s].
    pub fn sound_speed(&self, rho: f64) -> f64 {
        self.c0 * self.power(rho / self.rho0, 0.5 * (self.gamma - 1.0))
    }

    /// Returns the internal energy of compression per mass, the integral of p / rho^2 d rho from rho0 to `rho` [J/kg].
    pub fn internal_energy(&self, rho: f64) -> f64 {
        let ratio = rho / self.rho0;
        let b = self.stiffness() / self.rho0;
        b * ((self.power(ratio, self.gamma - 1.0) - 1.0) / (self.gamma - 1.0) + 1.0 / ratio - 1.0)
    }

    /// Returns base^exponent; integer exponents, the usual case, avoid the slower `powf`.
    fn power(&self, base: f64, exponent: f64) -> f64 {
        if exponent.fract() == 0.0 { base.powi(exponent as i32) } else { base.powf(exponent) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WATER: Tait = Tait { rho0: 1000.0, c0: 20.0, gamma: 7.0 };

    #[test]
    fn density_inverts_pressure() {
        for p in [-100.0, 0.0, 3000.0, 2e4] {
            // Limit: 1e-9 of the factor c0^2 rho0 / gamma = 6e4 Pa, for rounding.
            assert!((WATER.pressure(WATER.density(p)) - p).abs() < 1e-9 * 6e4);
        }
    }

    #[test]
    fn suction_is_a_column_of_water() {
        let lowest = WATER.density_under_suction(2.0, 9.81, 0.03);
        assert!((WATER.pressure(lowest) + 2.0 * 1000.0 * 9.81 * 0.03).abs() < 1e-6);
        assert_eq!(WATER.density_under_suction(1e6, 9.81, 0.03), 0.0);
    }

    #[test]
    fn sound_speed_is_the_derivative_of_pressure() {
        let rho = 1013.0;
        let slope = (WATER.pressure(rho + 1e-3) - WATER.pressure(rho - 1e-3)) / 2e-3;
        // Limit 1e-6: error of the difference quotient.
        assert!((slope.sqrt() / WATER.sound_speed(rho) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn internal_energy_increases_by_the_work_of_pressure() {
        let rho = 1013.0;
        let slope = (WATER.internal_energy(rho + 1e-2) - WATER.internal_energy(rho - 1e-2)) / 2e-2;
        assert!((slope * rho * rho / WATER.pressure(rho) - 1.0).abs() < 1e-5);
    }
}
