//! Warns of over-viscous water if the Reynolds number of the units is too small with artificial viscosity.

use super::Case;
use crate::case::file::{Sides, Viscosity};
use crate::case::reading::check::{Checker, as_text};
use crate::case::units::UnitPose;
use crate::case::units::group::{UnitGroup, UnitModel};

/// Reynolds number of a unit below which the validation gives a warning [-]. At Reynolds numbers from 40 to 70, the
/// force on a unit at rest is proportional to the velocity of the water. At 160, the force is not proportional to it
/// (docs/validation/fudo-notes.md). In real flumes the Reynolds number is 1e4 or more.
const LEAST_REYNOLDS: f64 = 100.0;
/// Kinematic viscosity of water at 20 degrees [m2/s].
const WATER_VISCOSITY: f64 = 1e-6;

/// Returns the kinematic viscosity to which artificial viscosity with the coefficient alpha is equivalent [m2/s]:
/// alpha h c0 / 20 in three dimensions, alpha h c0 / 16 in two (docs/methods.md, equation 3), with smoothing length h
/// and speed of sound c0. Returns `None` with the other viscosity models.
fn artificial_viscosity(case: &Case) -> Option<f64> {
    let numerics = &case.numerics;
    let divisor = if case.domain.sides == Sides::TwoDimensional { 16.0 } else { 20.0 };
    let is_artificial = numerics.viscosity == Viscosity::Artificial;
    is_artificial.then_some(numerics.alpha * numerics.h * case.fluid.sound_speed / divisor)
}

/// Returns the water velocity in a long wave of height H at x, H sqrt(g / d) [m/s], with the still water depth d at x.
/// Returns `None` if the wave height is not known or the ground at x is dry.
fn long_wave_velocity(case: &Case, x: f64) -> Option<f64> {
    let depth = Some(case.flume.still_depth(x)).filter(|depth| *depth > 0.0)?;
    Some(case.wave.height()? * (case.fluid.gravity / depth).sqrt())
}

/// Returns the largest Reynolds number of all units [-]; its length is the height of a unit.
fn reynolds_number(case: &Case) -> Option<f64> {
    let units = case.units.as_ref()?;
    let of_unit = |(unit, (_, model)): (&UnitPose, (&UnitGroup, &UnitModel))| {
        Some(long_wave_velocity(case, unit.centre.x)? * model.shape.height())
    };
    let largest = units.placements.iter().zip(units.each()).filter_map(of_unit).reduce(f64::max)?;
    Some(largest / artificial_viscosity(case).filter(|nu| *nu > 0.0)?)
}

/// Warns if the flow around the units is too viscous.
pub fn warn(case: &Case, check: &mut Checker) {
    if let (Some(reynolds), Some(nu)) =
        (reynolds_number(case).filter(|re| *re < LEAST_REYNOLDS), artificial_viscosity(case))
    {
        check.warn(format!(
            "numerics.viscosity_alpha = {}: the water is {:.0} times as viscous as real water, and the Reynolds number \
             of a unit is {reynolds:.0}. At Reynolds numbers below {LEAST_REYNOLDS}, the drag is proportional to the \
             velocity instead of its square, so strong waves exert too little force compared with weak waves. Lower \
             viscosity_alpha or `domain.dp_m`",
            as_text(case.numerics.alpha),
            nu / WATER_VISCOSITY,
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn slice(alpha: f64) -> Case {
        let text = include_str!("../../../cases/fudo/H2.6-slice.json");
        let text = text.replace("\"scheme\"", &format!("\"viscosity_alpha\": {alpha}, \"scheme\""));
        Case::from_str(&text, "cases/fudo/test.json").unwrap_or_else(|errors| panic!("{errors}"))
    }

    #[test]
    fn over_viscous_water_gives_a_warning() {
        let warned = |case: &Case| case.warnings.iter().any(|warning| warning.contains("Reynolds number"));
        assert!(warned(&slice(0.04)) && !warned(&slice(0.01)) && !warned(&slice(0.0)));
    }

    #[test]
    fn reynolds_number_uses_the_wave_over_the_mound() {
        // nu = alpha h c0 / 20 with alpha = 0.04, h = 1.2 sqrt(3) 7 mm and c0 = 10 sqrt(g 0.217 m): the depth at
        // x = 36.5 m is 0.217 m. At the units, which are 77 mm high, the depth is 83 mm.
        let depth: f64 = 0.8 - 17.5 / 30.0;
        let nu = 0.002 * 1.2 * 3.0_f64.sqrt() * 0.007 * 10.0 * (9.81 * depth).sqrt();
        let expected = 0.026 * (9.81_f64 / 0.083).sqrt() * 0.077 / nu;
        let found = reynolds_number(&slice(0.04)).unwrap();
        // The tolerance allows for rounding errors in the depth, which comes from the corner points of the bed.
        assert!((found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
    }
}
