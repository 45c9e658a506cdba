//! Water and the constants of the SPH scheme, validated.

use super::check::{Checker, from, show};
use super::file::{Boundary, DensityDiffusion, FluidFile, NumericsFile, Viscosity, WallSlip};

/// Water; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fluid {
    /// Reference density [kg/m3].
    pub rho0: f64,
    /// Gravitational acceleration, positive [m/s2].
    pub gravity: f64,
    /// Polytropic exponent of Tait's equation [-].
    pub gamma: f64,
    /// Speed of sound c0 = factor sqrt(g d), d the water's depth in the domain [m/s].
    pub sound_speed: f64,
}

/// Constants of the SPH scheme; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Numerics {
    /// Smoothing length h = factor sqrt(3) dp [m]; the kernel reaches 2h.
    pub h: f64,
    /// How the water resists shear.
    pub viscosity: Viscosity,
    /// Artificial viscosity [-].
    pub alpha: f64,
    /// Kinematic viscosity [m2/s].
    pub nu: f64,
    /// Kind of density diffusion.
    pub density_diffusion: DensityDiffusion,
    /// Density diffusion [-].
    pub delta: f64,
    /// Coefficient of particle shifting [-], 0 for none.
    pub shifting: f64,
    /// Courant number [-].
    pub cfl: f64,
    /// Boundary condition of walls, wavemaker and units.
    pub boundary: Boundary,
    /// Velocity that boundary particles show to the water.
    pub wall_slip: WallSlip,
    /// Whether water slides along units too, where it slides along walls.
    pub slip_on_units: bool,
    /// Whether bed, walls and other units press on units through gaps that hold no water particle.
    pub gap_pressure: bool,
    /// Layers of particles in walls and bed.
    pub boundary_layers: usize,
    /// Time for which the units are held at the start [s].
    pub hold_units: f64,
}

/// Validate the water's constants; the speed of sound follows from the depth, see [`Fluid`].
pub(super) fn validate_fluid(file: &FluidFile, depth: Option<f64>, check: &mut Checker) -> Option<Fluid> {
    let before = check.count();
    check.number(
        "fluid.density_kg_m3",
        file.density_kg_m3,
        from(1.0).up_to(20_000.0),
        "kg/m3",
        "fresh water has 1000, sea water 1025",
    );
    check.number(
        "fluid.gravity_m_s2",
        file.gravity_m_s2,
        from(0.01).up_to(1000.0),
        "m/s2",
        "write it positive, 9.81 on earth; it acts downwards",
    );
    check.number(
        "fluid.sound_speed_factor",
        file.sound_speed_factor,
        from(5.0).up_to(200.0),
        "",
        "10 to 20 keeps the density within about 1 %; a larger one shortens the time step",
    );
    check.number("fluid.tait_exponent", file.tait_exponent, from(1.0).up_to(10.0), "", "water has 7");
    if check.count() > before {
        return None;
    }
    let sound_speed = file.sound_speed_factor * (file.gravity_m_s2 * depth?).sqrt();
    Some(Fluid { rho0: file.density_kg_m3, gravity: file.gravity_m_s2, gamma: file.tait_exponent, sound_speed })
}

/// Validate the constants of the scheme; `dp` is the particle distance [m], `longest_hold` the time for which
/// units can be held in this run [s].
pub(super) fn validate_numerics(
    file: &NumericsFile,
    dp: f64,
    longest_hold: f64,
    check: &mut Checker,
) -> Option<Numerics> {
    let before = check.count();
    check.number(
        "numerics.smoothing_factor",
        file.smoothing_factor,
        from(0.8).up_to(2.5),
        "",
        "h = factor sqrt(3) dp; 1.2 is usual",
    );
    check.number("numerics.viscosity_alpha", file.viscosity_alpha, from(0.0).up_to(1.0), "", "0.01 to 0.1 is usual");
    check.number(
        "numerics.kinematic_viscosity_m2_s",
        file.kinematic_viscosity_m2_s,
        from(0.0).up_to(1.0),
        "m2/s",
        "water has 1e-6",
    );
    check.number(
        "numerics.shifting_coefficient",
        file.shifting_coefficient,
        from(0.0).up_to(10.0),
        "",
        "0 for none; 2 is usual",
    );
    let wall_slip = validate_slip(file, check);
    check.number("numerics.diffusion_delta", file.diffusion_delta, from(0.0).up_to(1.0), "", "0.1 is usual");
    check.number("numerics.cfl", file.cfl, from(0.001).up_to(0.5), "", "0.2 is usual; a larger one is unstable");
    refuse_unstable_diffusion(file, check);
    warn_of_what_has_no_effect(file, check);
    if !(1..=10).contains(&file.boundary_layers) {
        check.refuse("numerics.boundary_layers", file.boundary_layers, "1 to 10", "3 cover the kernel's reach");
    }
    check.number(
        "numerics.hold_units_s",
        file.hold_units_s,
        from(0.0).up_to(longest_hold),
        "s",
        "hold the units for a part of the run only, e.g. 0.2",
    );
    if check.count() > before {
        return None;
    }
    let h = file.smoothing_factor * 3f64.sqrt() * dp;
    // The outer three tenths of the kernel's reach carry a few per cent of its sum.
    if f64::from(file.boundary_layers) * dp < 0.7 * 2.0 * h {
        check.warn(format!(
            "numerics.boundary_layers = {}: thinner than the kernel's reach, 2h = {:.3} m",
            file.boundary_layers,
            2.0 * h
        ));
    }
    Some(Numerics {
        h,
        viscosity: file.viscosity,
        alpha: file.viscosity_alpha,
        nu: file.kinematic_viscosity_m2_s,
        density_diffusion: file.density_diffusion,
        delta: file.diffusion_delta,
        shifting: file.shifting_coefficient,
        cfl: file.cfl,
        boundary: file.boundary,
        wall_slip,
        slip_on_units: file.slip_on_units,
        gap_pressure: file.gap_pressure,
        boundary_layers: file.boundary_layers as usize,
        hold_units: file.hold_units_s,
    })
}

/// What walls show to the water: free slip if nothing is written. The layer at a wall that the viscosity of the scheme
/// slows down is many times thicker than that of real water, and long waves lose height and speed to it.
fn validate_slip(file: &NumericsFile, check: &mut Checker) -> WallSlip {
    match (file.boundary, file.wall_slip) {
        (Boundary::Mdbc, slip) => slip.unwrap_or(WallSlip::FreeSlip),
        (Boundary::Dbc, None | Some(WallSlip::Original)) => WallSlip::Original,
        (Boundary::Dbc, Some(slip)) => {
            let slip = if slip == WallSlip::NoSlip { "no_slip" } else { "free_slip" };
            let mend = "set numerics.boundary to \"mdbc\"";
            check.refuse("numerics.wall_slip", slip, "\"original\" with \"dbc\"", mend);
            WallSlip::Original
        }
    }
}

/// Density diffusion takes the shortest wave of the particles down at the rate 2 delta h c0 sum_b V_b |G_ab|, at most
/// 7 delta c0 / h, for the kernel's |G| integrates to 7 / (2 h^2). The step multiplies what decays at a rate lambda by
/// 1 - z + z^2 / 2 with z = lambda dt: it grows if z > 2, where dt = cfl h / c0.
fn refuse_unstable_diffusion(file: &NumericsFile, check: &mut Checker) {
    let most = 2.0 / (7.0 * file.cfl);
    if file.density_diffusion != DensityDiffusion::None && file.diffusion_delta <= 1.0 && file.diffusion_delta > most {
        check.refuse(
            "numerics.diffusion_delta",
            file.diffusion_delta,
            format!("at most 2 / (7 cfl) = {} with numerics.cfl = {}", show(most), file.cfl),
            "more is unstable in time; 0.1 is usual",
        );
    }
}

/// Constants that were changed and that the chosen scheme does not read.
fn warn_of_what_has_no_effect(file: &NumericsFile, check: &mut Checker) {
    let usual = NumericsFile::default();
    let artificial = file.viscosity == Viscosity::Artificial;
    let slides = file.boundary == Boundary::Mdbc && matches!(file.wall_slip, None | Some(WallSlip::FreeSlip));
    let no_diffusion = file.density_diffusion == DensityDiffusion::None;
    let unread = [
        (!artificial && file.viscosity_alpha != usual.viscosity_alpha, "viscosity_alpha", "viscosity is laminar"),
        (
            artificial && file.kinematic_viscosity_m2_s != usual.kinematic_viscosity_m2_s,
            "kinematic_viscosity_m2_s",
            "viscosity is artificial",
        ),
        (
            no_diffusion && file.diffusion_delta != usual.diffusion_delta && file.diffusion_delta != 0.0,
            "diffusion_delta",
            "density_diffusion is none",
        ),
        (!file.gap_pressure && file.boundary == Boundary::Dbc, "gap_pressure", "boundary is dbc"),
        (file.slip_on_units && !slides, "slip_on_units", "wall_slip is not free_slip"),
    ];
    for (_, key, reason) in unread.iter().filter(|(unread, ..)| *unread) {
        check.warn(format!("numerics.{key} has no effect: numerics.{reason}"));
    }
    if file.viscosity == Viscosity::Laminar && file.kinematic_viscosity_m2_s == 0.0 {
        check.warn("numerics.kinematic_viscosity_m2_s = 0: nothing damps the water; it has 1e-6 m2/s");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Warnings of a section, and whether it was accepted.
    fn warnings(change: impl FnOnce(&mut NumericsFile)) -> (bool, Vec<String>) {
        let mut file = NumericsFile::default();
        change(&mut file);
        let mut check = Checker::new("x.json");
        let accepted = validate_numerics(&file, 0.01, 1.0, &mut check).is_some();
        (accepted, check.warnings)
    }

    #[test]
    fn constants_without_effect_are_named() {
        assert_eq!(warnings(|_| ()), (true, vec![]));
        let (accepted, of_nu) = warnings(|file| file.kinematic_viscosity_m2_s = 1e-3);
        assert!(accepted && of_nu[0].starts_with("numerics.kinematic_viscosity_m2_s has no effect"), "{of_nu:?}");
        let (accepted, of_alpha) = warnings(|file| {
            file.viscosity = Viscosity::LaminarSps;
            file.viscosity_alpha = 0.1;
        });
        assert!(accepted && of_alpha[0].starts_with("numerics.viscosity_alpha has no effect"), "{of_alpha:?}");
        let (accepted, of_delta) = warnings(|file| {
            file.density_diffusion = DensityDiffusion::None;
            file.diffusion_delta = 0.2;
        });
        assert!(accepted && of_delta[0].starts_with("numerics.diffusion_delta has no effect"), "{of_delta:?}");
        let (accepted, of_slip) =
            warnings(|file| (file.slip_on_units, file.wall_slip) = (true, Some(WallSlip::Original)));
        assert!(accepted && of_slip[0].starts_with("numerics.slip_on_units has no effect"), "{of_slip:?}");
        assert_eq!(warnings(|file| file.slip_on_units = true), (true, vec![]));
        let (accepted, inviscid) = warnings(|file| {
            file.viscosity = Viscosity::Laminar;
            file.kinematic_viscosity_m2_s = 0.0;
        });
        assert!(accepted && inviscid[0].contains("nothing damps the water"), "{inviscid:?}");
    }

    #[test]
    fn diffusion_may_be_as_fast_as_the_step_allows() {
        assert!(warnings(|file| (file.diffusion_delta, file.cfl) = (0.57, 0.5)).0);
        assert!(!warnings(|file| (file.diffusion_delta, file.cfl) = (0.58, 0.5)).0);
        let without = |file: &mut NumericsFile| {
            file.density_diffusion = DensityDiffusion::None;
            (file.diffusion_delta, file.cfl) = (0.58, 0.5);
        };
        assert!(warnings(without).0);
    }
}
