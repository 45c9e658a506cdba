//! Energy balance of the water: energy that it receives from boundaries, viscosity, density diffusion, porous parts,
//! zones and open ends.
//!
//! The powers [W] are evaluated at each row of `energy.csv` and integrated by the trapezoidal rule. The sum differs
//! from the change of the water's energy for three reasons: time integration and trapezoidal rule have errors;
//! impermeable surfaces remove kinetic energy; and the limit of the suction removes energy of compression. Neither of
//! these two energies is counted here.

use serde::{Deserialize, Serialize};

use crate::sph::solver::power::Powers;

/// Energy received by the water since the start [J]; part of every checkpoint.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Balance {
    /// From bed, walls, wavemaker and units, through pressure.
    pub boundary: f64,
    /// From viscosity; negative for a loss.
    pub viscosity: f64,
    /// From density diffusion.
    pub diffusion: f64,
    /// From the friction of bed and walls, added in every time step; negative for a loss.
    #[serde(default)]
    pub friction: f64,
    /// From the drag of porous parts; negative.
    pub pores: f64,
    /// From damping and relaxation zones, and with the water that flows through open ends, added in every time step.
    pub zones: f64,
    /// Time [s] of the last row, and the powers [W] of boundaries, viscosity, diffusion and porous parts at that time.
    last: Option<(f64, [f64; 4])>,
}

impl Balance {
    /// Adds the energy that the water has received since the last row; `powers` are the current powers, at `time` [s].
    pub fn add(&mut self, time: f64, powers: Powers) {
        let now = [powers.boundary, powers.viscosity, powers.diffusion, powers.pores];
        if let Some((before, last)) = self.last {
            let mean = |k: usize| 0.5 * (time - before) * (last[k] + now[k]);
            self.boundary += mean(0);
            self.viscosity += mean(1);
            self.diffusion += mean(2);
            self.pores += mean(3);
        }
        self.last = Some((time, now));
    }
}
