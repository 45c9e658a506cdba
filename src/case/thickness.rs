//! How thick artificial viscosity makes the water beside the units, as a Reynolds number.

use super::check::{Checker, show};
use super::file::{Sides, Viscosity};
use super::validate::Case;

/// Reynolds number below which a run is warned of [-]. With 20 to 35 the force on a standing unit follows the velocity itself, with
/// 80 no longer (docs/validation.md, what of the wave reaches the units); in the flumes that are modelled it is 1e4 and more.
const LEAST_REYNOLDS: f64 = 50.0;
/// Kinematic viscosity of water at 20 degrees [m2/s].
const WATER: f64 = 1e-6;

/// Kinematic viscosity of the water's particles [m2/s]: alpha h c0 / 10 in three dimensions, / 8 in two (Monaghan 2005).
/// `None` with any but artificial viscosity.
fn viscosity(case: &Case) -> Option<f64> {
    let numerics = &case.numerics;
    let share = if case.domain.sides == Sides::TwoDimensional { 8.0 } else { 10.0 };
    let is_artificial = numerics.viscosity == Viscosity::Artificial;
    is_artificial.then_some(numerics.alpha * numerics.h * case.fluid.sound_speed / share)
}

/// Velocity of the water at a place in a wave that is long there, H sqrt(g / d) [m/s]; `None` without a wave of known height,
/// or where it is dry.
fn velocity(case: &Case, x: f64) -> Option<f64> {
    let depth = Some(case.flume.still_depth(x)).filter(|depth| *depth > 0.0)?;
    Some(case.wave.height()? * (case.fluid.gravity / depth).sqrt())
}

/// Reynolds number of the unit that the wave passes fastest, with its height [-].
fn reynolds(case: &Case) -> Option<f64> {
    let units = case.units.as_ref()?;
    let fastest = units.placements.iter().filter_map(|unit| velocity(case, unit.centre.x)).reduce(f64::max)?;
    Some(fastest * units.shape.height() / viscosity(case).filter(|nu| *nu > 0.0)?)
}

/// Warn where the water creeps round the units.
pub(super) fn warn(case: &Case, check: &mut Checker) {
    if let (Some(reynolds), Some(nu)) = (reynolds(case).filter(|re| *re < LEAST_REYNOLDS), viscosity(case)) {
        check.warn(format!(
            "numerics.viscosity_alpha = {}: makes the water {:.0} times as thick as it is (Reynolds number of a unit {reynolds:.0}), \
             so that its push grows with its velocity and not with the square; below {LEAST_REYNOLDS} strong waves push too \
             little beside weak ones. Lower it, or take smaller particles",
            show(case.numerics.alpha),
            nu / WATER,
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slice(alpha: f64) -> Case {
        let text = include_str!("../../cases/fudo/H2.6-slice.json");
        let text = text.replace("\"wall_slip\"", &format!("\"viscosity_alpha\": {alpha}, \"wall_slip\""));
        Case::from_str(&text, "cases/fudo/test.json").unwrap_or_else(|errors| panic!("{errors}"))
    }

    #[test]
    fn thick_water_is_warned_of() {
        let warned = |case: &Case| case.warnings.iter().any(|warning| warning.contains("Reynolds number"));
        assert!(warned(&slice(0.04)) && !warned(&slice(0.01)) && !warned(&slice(0.0)));
    }

    #[test]
    fn the_reynolds_number_is_that_of_the_wave_over_the_mound() {
        // nu = 0.04 h c0 / 10 with h = 1.2 sqrt(3) 7 mm and c0 = 10 sqrt(g 0.217 m), the depth at x = 36.5 m; the water is 83 mm
        // deep over the units of 77 mm.
        let depth: f64 = 0.8 - 17.5 / 30.0;
        let nu = 0.004 * 1.2 * 3.0_f64.sqrt() * 0.007 * 10.0 * (9.81 * depth).sqrt();
        let expected = 0.026 * (9.81_f64 / 0.083).sqrt() * 0.077 / nu;
        let found = reynolds(&slice(0.04)).unwrap();
        // The depth is taken off a bed of corner points: rounding.
        assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
    }
}
