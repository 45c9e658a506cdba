//! Rows of `diagnostics.csv`, checks of the water, and warnings about fast water.

use glam::DVec3;

use super::{
    Simulation,
    failure::{self, Failure, LARGEST_COMPRESSION, Particle},
    measures::extremes::Extremes,
};
use crate::sph::{
    particles::{sums::sums, water::Water},
    solver::backend::WaterExtremes,
};

/// Mach number above which the water is no longer nearly incompressible [-]. The relative change of density is about
/// the square of the Mach number; weakly compressible SPH allows 1 % (Monaghan 1994).
pub const LARGEST_MACH: f64 = 0.1;

impl Simulation {
    /// Checks the water at the end of a time step: fails if it is unstable, records its extremes, warns of fast water.
    ///
    /// # Errors
    /// If a particle has left the domain or has an impossible density, or the device is lost.
    pub(super) fn watch_water(&mut self) -> Result<(), Failure> {
        if let Some(memory) = self.solver.device_memory() {
            let water = memory.water_extremes()?;
            return self.check_device_extremes(&water);
        }
        if let Some(failure) = failure::find_escape(self) {
            return Err(failure);
        }
        let Some(extremes) = Extremes::of(&self.water) else { return Ok(()) };
        if let Some(failure) = failure::find_wrong_density(self, &extremes) {
            return Err(failure);
        }
        let mach = extremes.fastest.0 / self.case.fluid.sound_speed;
        if mach > LARGEST_MACH && self.statistics.largest_mach <= LARGEST_MACH {
            self.statistics.warnings.push(mach_warning(self, &Particle::of(&self.water, extremes.fastest.1)));
        }
        self.statistics.count_water(mach, extremes.lightest.0, extremes.densest.0);
        Ok(())
    }

    /// Like [`Self::watch_water`], for extremes that a graphics card has computed. Particles are copied from the card
    /// only if a message must name a particle.
    fn check_device_extremes(&mut self, water: &WaterExtremes) -> Result<(), Failure> {
        let mach = water.largest_speed / self.case.fluid.sound_speed;
        let rho0 = self.case.fluid.rho0;
        let compressed = [water.lowest_density, water.highest_density]
            .iter()
            .any(|rho| (rho / rho0 - 1.0).abs() > LARGEST_COMPRESSION);
        let fast = mach > LARGEST_MACH && self.statistics.largest_mach <= LARGEST_MACH;
        if water.is_unstable || compressed || fast {
            self.fetch()?;
            if let Some(failure) = failure::find_escape(self) {
                return Err(failure);
            }
            let Some(extremes) = Extremes::of(&self.water) else { return Ok(()) };
            if let Some(failure) = failure::find_wrong_density(self, &extremes) {
                return Err(failure);
            }
            // The graphics card computes the extremes before velocity components into solids are removed: check again.
            if fast && extremes.fastest.0 > LARGEST_MACH * self.case.fluid.sound_speed {
                self.statistics.warnings.push(mach_warning(self, &Particle::of(&self.water, extremes.fastest.1)));
            }
        }
        self.statistics.count_water(mach, water.lowest_density, water.highest_density);
        Ok(())
    }

    /// Returns a row of `diagnostics.csv`; `dt` is the length of the next time step [s], and `divergence` [1/s] is
    /// [`crate::sph::solver::power::Powers::divergence`]. Mach number and densities are extremes since the last row.
    pub(super) fn diagnostics_row(&mut self, dt: f64, divergence: f64) -> [f64; 10] {
        let volume = self.water_volume();
        let particles = self.regions().map(|region| region.water.len() as u64).sum::<u64>();
        let start = *self.statistics.water_start.get_or_insert((volume, particles));
        let of_now = |water| {
            let extremes = Extremes::of(water)?;
            Some([extremes.fastest.0 / self.case.fluid.sound_speed, extremes.lightest.0, extremes.densest.0])
        };
        let since_row = self.statistics.take_water_since_row();
        let [mach, lowest, highest] = since_row.or_else(|| of_now(&self.water)).unwrap_or([f64::NAN; 3]);
        let [released, taken] = self.statistics.exchanged.map(|count| count as f64);
        // Particles also enter and leave buffers between regions.
        let expected = if self.coarse.is_empty() { start.1 as f64 + released - taken } else { particles as f64 };
        let lost = expected - particles as f64;
        let steps = self.steps as f64;
        [self.flume_time(), volume, volume - start.0, mach, lowest, highest, divergence, steps, dt, lost]
    }

    /// Returns the volume of the water of all regions, without their buffers: the sum of m / rho [m3].
    fn water_volume(&self) -> f64 {
        let of_region = |region: &Self| -> f64 {
            let Water { position, mass, density, .. } = &region.water;
            let [from, to] = region.own_x();
            let of_particle = |i: usize| [if (from..to).contains(&position[i].x) { mass[i] / density[i] } else { 0.0 }];
            let [volume] = sums(position.len(), of_particle);
            volume
        };
        self.regions().map(of_region).sum()
    }
}

fn mach_warning(simulation: &Simulation, fastest: &Particle) -> String {
    let (case, DVec3 { x, y, z }) = (&simulation.case, fastest.place);
    // Rounding to three decimals gives the number of the case file, without rounding errors.
    let factor = case.fluid.sound_speed / (case.fluid.gravity * case.domain.depth).sqrt();
    let factor = (1e3 * factor).round() / 1e3;
    format!(
        "at {:.3} s water moves at {:.2} m/s near x = {x:.3}, y = {y:.3}, z = {z:.3} m (particle {}), faster than a \
         tenth of the speed of sound of the run, {:.1} m/s: its density changes by more than 1 %, and pressures and \
         forces of its impact are unreliable. If this water is more than spray, raise fluid.sound_speed_factor (now \
         {}); the computing time rises in proportion",
        simulation.flume_time(),
        fastest.speed,
        fastest.id,
        case.fluid.sound_speed,
        factor,
    )
}

#[cfg(test)]
mod tests {
    use super::{super::failure::tests::tank, *};

    #[test]
    fn fast_water_causes_one_warning_with_position_and_time() {
        let mut simulation = tank();
        let sound = simulation.case.fluid.sound_speed;
        simulation.watch_water().unwrap();
        assert!(simulation.statistics.warnings.is_empty());
        simulation.water.velocity[7] = DVec3::X * 0.12 * sound;
        simulation.watch_water().unwrap();
        simulation.water.velocity[8] = DVec3::X * 0.2 * sound;
        simulation.watch_water().unwrap();
        let [warning] = &simulation.statistics.warnings[..] else { panic!("one warning") };
        let DVec3 { x, y, z } = simulation.water.position[7];
        assert!(warning.contains(&format!("near x = {x:.3}, y = {y:.3}, z = {z:.3} m")), "{warning}");
        assert!(
            warning.starts_with("at 0.000 s") && warning.contains("fluid.sound_speed_factor (now 15)"),
            "{warning}"
        );
        assert!((simulation.statistics.largest_mach - 0.2).abs() < 1e-12);
    }

    #[test]
    fn a_diagnostics_row_has_the_extremes_since_the_previous_row() {
        let mut simulation = tank();
        let sound = simulation.case.fluid.sound_speed;
        let [_, volume, change, mach, lowest, highest, divergence, steps, dt, lost] =
            simulation.diagnostics_row(1e-4, 0.3);
        assert_eq!((change, mach, divergence, steps, dt, lost), (0.0, 0.0, 0.3, 0.0, 1e-4, 0.0));
        // The tank contains 0.5 m x 0.2 m x 0.2 m of water, slightly compressed by its weight.
        assert!((volume / 0.02 - 1.0).abs() < 0.01, "{volume}");
        assert!(lowest <= highest && lowest > 990.0);
        simulation.water.velocity[3] = DVec3::Y * 0.05 * sound;
        simulation.watch_water().unwrap();
        simulation.water.velocity[3] = DVec3::ZERO;
        simulation.watch_water().unwrap();
        simulation.water.density.iter_mut().for_each(|rho| *rho *= 1.01);
        let [_, _, change, mach, ..] = simulation.diagnostics_row(1e-4, 0.0);
        assert!((mach - 0.05).abs() < 1e-12);
        assert!((change / volume + 0.01 / 1.01).abs() < 1e-12);
        let [_, _, _, mach, ..] = simulation.diagnostics_row(1e-4, 0.0);
        assert_eq!(mach, 0.0);
    }
}
