//! Validates the properties of the water and the settings of the SPH scheme.

use crate::case::file::{Boundary, DensityDiffusion, FluidFile, NumericsFile, Viscosity, WallSlip};
use crate::case::flume::domain::{Domain, Water};
use crate::case::reading::check::{Checker, at_least, upper_limit};

/// Properties of the water; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fluid {
    /// Reference density [kg/m3].
    pub rho0: f64,
    /// Gravitational acceleration, positive [m/s2].
    pub gravity: f64,
    /// Exponent of Tait's equation of state [-].
    pub gamma: f64,
    /// Speed of sound c0 = `fluid.sound_speed_factor` sqrt(g d) [m/s] with the largest initial water depth d.
    pub sound_speed: f64,
}

/// Settings of the SPH scheme; SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Numerics {
    /// Smoothing length h = `smoothing_factor` sqrt(3) dp [m]; the kernel radius is 2h.
    pub h: f64,
    /// Viscosity model.
    pub viscosity: Viscosity,
    /// Coefficient alpha of artificial viscosity [-].
    pub alpha: f64,
    /// Coefficient beta of the quadratic part of artificial viscosity [-].
    pub beta: f64,
    /// Kinematic viscosity nu of the laminar models [m2/s].
    pub nu: f64,
    /// Form of the density diffusion.
    pub density_diffusion: DensityDiffusion,
    /// Coefficient delta of density diffusion [-].
    pub delta: f64,
    /// Coefficient alpha_2 of the acoustic damping [-]; 0 for no damping.
    pub acoustic_damping: f64,
    /// Largest suction in the water and at walls, divided by rho0 g h [-]. `None`: no limit in the water, and no suction
    /// at walls.
    pub suction_limit: Option<f64>,
    /// Coefficient A of particle shifting [-]; 0 for no shifting.
    pub shifting: f64,
    /// Courant number C, which limits the time step [-].
    pub cfl: f64,
    /// Boundary condition at bed, walls, wavemaker and units.
    pub boundary: Boundary,
    /// Velocity condition at bed and walls.
    pub wall_slip: WallSlip,
    /// Friction coefficient c_f of bed, walls and obstacles [-].
    pub wall_friction: f64,
    /// true: free slip at the units, too. false: boundary particles of a unit have the tangential velocity of the unit.
    pub slip_on_units: bool,
    /// true if water pressure also acts on units in gaps that are too narrow for water particles.
    pub gap_pressure: bool,
    /// Number of particle layers in walls and bed.
    pub boundary_layers: usize,
    /// Time at the start of the run during which the units are fixed [s].
    pub hold_units: f64,
}

/// Default speed of sound / sqrt(g d) [-] for waves in still water of the depth d.
const SOUND_FACTOR_OF_WAVES: f64 = 15.0;

/// Default speed of sound / sqrt(g d) [-] for a block of water of the height d that collapses on a dry bed: ten times
/// the largest speed of its front, 2 sqrt(g d) (Ritter 1892).
const SOUND_FACTOR_OF_BLOCKS: f64 = 20.0;

/// Default friction coefficient of walls along which the water slides [-]. On a smooth plate, the local coefficient is
/// 0.0021 (laminar, Blasius: 0.664 / sqrt(Re)) to 0.0059 (turbulent, Prandtl: 0.059 Re^-1/5) at Re = 1e5, and 0.0037
/// (turbulent) at Re = 1e6.
const SMOOTH: f64 = 0.003;

/// Validates the constants of the water. The speed of sound follows from the largest initial depth in the `domain`.
pub fn validate_fluid(file: &FluidFile, domain: Option<&Domain>, check: &mut Checker) -> Option<Fluid> {
    let before = check.count();
    let is_block = domain.is_some_and(|domain| matches!(domain.water, Water::Block { .. }));
    let default = if is_block { SOUND_FACTOR_OF_BLOCKS } else { SOUND_FACTOR_OF_WAVES };
    let sound_speed_factor = file.sound_speed_factor.unwrap_or(default);
    check.number(
        "fluid.density_kg_m3",
        file.density_kg_m3,
        at_least(1.0).up_to(20_000.0),
        "kg/m3",
        "fresh water has 1000, sea water 1025",
    );
    check.number(
        "fluid.gravity_m_s2",
        file.gravity_m_s2,
        at_least(0.01).up_to(1000.0),
        "m/s2",
        "write a positive number, 9.81 on Earth; gravity acts downwards",
    );
    check.number(
        "fluid.sound_speed_factor",
        sound_speed_factor,
        at_least(5.0).up_to(200.0),
        "",
        "values from 10 to 20 keep density changes below about 1 %; larger values need shorter time steps",
    );
    check.number("fluid.tait_exponent", file.tait_exponent, at_least(1.0).up_to(10.0), "", "water has 7");
    if check.count() > before {
        return None;
    }
    let sound_speed = sound_speed_factor * (file.gravity_m_s2 * domain?.depth).sqrt();
    Some(Fluid { rho0: file.density_kg_m3, gravity: file.gravity_m_s2, gamma: file.tait_exponent, sound_speed })
}

/// Validates the settings of the SPH scheme. `dp` is the particle spacing [m], `longest_hold` the largest allowed value
/// of `hold_units_s` [s].
pub fn validate_numerics(file: &NumericsFile, dp: f64, longest_hold: f64, check: &mut Checker) -> Option<Numerics> {
    let before = check.count();
    let defaults = file.scheme.defaults();
    let alpha = file.viscosity_alpha.unwrap_or(defaults.viscosity_alpha);
    let beta = file.viscosity_beta.unwrap_or(defaults.viscosity_beta);
    let shifting = file.shifting_coefficient.unwrap_or(defaults.shifting_coefficient);
    check.number(
        "numerics.smoothing_factor",
        file.smoothing_factor,
        at_least(0.8).up_to(2.5),
        "",
        "h = smoothing_factor sqrt(3) dp; 1.2 is usual",
    );
    check.number(
        "numerics.viscosity_alpha",
        alpha,
        at_least(0.0).up_to(1.0),
        "",
        "0.005 hardly changes the force on a unit; 0.01 to 0.1 is usual elsewhere",
    );
    check.number("numerics.viscosity_beta", beta, at_least(0.0).up_to(10.0), "", "0 for none");
    check.number(
        "numerics.kinematic_viscosity_m2_s",
        file.kinematic_viscosity_m2_s,
        at_least(0.0).up_to(1.0),
        "m2/s",
        "water has 1e-6",
    );
    check.number(
        "numerics.acoustic_damping",
        file.acoustic_damping.unwrap_or(0.0),
        at_least(0.0).up_to(2.0),
        "",
        "0 for none; 0.5 damps the sound of impacts in a few milliseconds",
    );
    check.number(
        "numerics.suction_limit",
        file.suction_limit.unwrap_or(1.0),
        at_least(0.0).up_to(1e6),
        "",
        "1 is usual: a water column as high as the smoothing length",
    );
    check.number("numerics.shifting_coefficient", shifting, at_least(0.0).up_to(10.0), "", "0 for none; 2 is usual");
    let wall_slip = validate_slip(file, check);
    let slides = matches!(wall_slip, WallSlip::FreeSlip | WallSlip::Inviscid);
    let wall_friction = file.wall_friction.unwrap_or(if slides { SMOOTH } else { 0.0 });
    check.number("numerics.wall_friction", wall_friction, at_least(0.0).up_to(0.5), "", "smooth: 0.002 to 0.006");
    check.number("numerics.diffusion_delta", file.diffusion_delta, at_least(0.0).up_to(1.0), "", "0.1 is usual");
    let advice = "0.4 is usual; 0.2 is the default of DualSPHysics";
    check.number("numerics.cfl", file.cfl, at_least(0.001).up_to(0.5), "", advice);
    refuse_unstable_diffusion(file, check);
    warn_of_ignored_constants(file, wall_slip, check);
    if !(1..=10).contains(&file.boundary_layers) {
        check.reject("numerics.boundary_layers", file.boundary_layers, "1 to 10", "3 layers are usual");
    }
    check.number(
        "numerics.hold_units_s",
        file.hold_units_s,
        at_least(0.0).up_to(longest_hold),
        "s",
        "fix the units only at the start of the run, e.g. for 0.2 s",
    );
    if check.count() > before {
        return None;
    }
    let h = file.smoothing_factor * 3f64.sqrt() * dp;
    // The layers need not cover the outer 30 % of the kernel radius, because this part contributes only a few per
    // cent of the kernel's integral.
    let least = 0.7 * 2.0 * h;
    if f64::from(file.boundary_layers) * dp < least {
        check.warn(format!(
            "numerics.boundary_layers = {}: the layers are thinner than {least:.3} m, 70 % of the kernel radius 2h",
            file.boundary_layers
        ));
    }
    let is_published = wall_slip == WallSlip::Original;
    Some(Numerics {
        h,
        viscosity: file.viscosity,
        alpha,
        beta,
        nu: file.kinematic_viscosity_m2_s,
        density_diffusion: file.density_diffusion,
        delta: file.diffusion_delta,
        acoustic_damping: file.acoustic_damping.unwrap_or(if is_published { 0.0 } else { 0.5 }),
        suction_limit: file.suction_limit.or((!is_published).then_some(1.0)),
        shifting,
        cfl: file.cfl,
        boundary: file.boundary,
        wall_slip,
        wall_friction,
        slip_on_units: file.slip_on_units,
        gap_pressure: file.gap_pressure,
        boundary_layers: file.boundary_layers as usize,
        hold_units: file.hold_units_s,
    })
}

/// Returns the velocity condition at walls.
fn validate_slip(file: &NumericsFile, check: &mut Checker) -> WallSlip {
    match (file.boundary, file.wall_slip) {
        (Boundary::Mdbc, slip) => slip.unwrap_or(file.scheme.defaults().wall_slip),
        (Boundary::Dbc, None) => WallSlip::Original,
        (Boundary::Dbc, Some(slip)) => {
            let slip = match slip {
                WallSlip::NoSlip => "no_slip",
                WallSlip::FreeSlip => "free_slip",
                WallSlip::Inviscid => "inviscid",
                WallSlip::Original => return WallSlip::Original,
            };
            let advice = "set numerics.boundary to \"mdbc\"";
            check.reject("numerics.wall_slip", slip, "\"original\" with \"dbc\"", advice);
            WallSlip::Original
        }
    }
}

/// Refuses unstable density diffusion. At particle a, the shortest density wave decays at the rate
/// lambda = 2 delta h c0 sum_b V_b |G_ab|, with smoothing length h, speed of sound c0, volume V_b of each neighbour b,
/// and kernel gradient G_ab r_ab for the vector r_ab between a and b. lambda is at most 7 delta c0 / h, because |G|
/// integrates to 7 / (2 h^2). One time step dt = cfl h / c0 multiplies the amplitude of this wave by 1 - z + z^2 / 2
/// with z = lambda dt. The wave grows if z > 2.
fn refuse_unstable_diffusion(file: &NumericsFile, check: &mut Checker) {
    let limit = 2.0 / (7.0 * file.cfl);
    if file.density_diffusion != DensityDiffusion::None && file.diffusion_delta <= 1.0 && file.diffusion_delta > limit {
        check.reject(
            "numerics.diffusion_delta",
            file.diffusion_delta,
            format!("at most 2 / (7 cfl) = {} with numerics.cfl = {}", upper_limit(limit), file.cfl),
            "larger values are unstable; 0.1 is usual",
        );
    }
}

/// Warns of constants that the user has changed from their defaults but that the chosen scheme ignores.
fn warn_of_ignored_constants(file: &NumericsFile, slip: WallSlip, check: &mut Checker) {
    let defaults = NumericsFile::default();
    let artificial = file.viscosity == Viscosity::Artificial;
    let slides = matches!(slip, WallSlip::FreeSlip | WallSlip::Inviscid);
    let no_diffusion = file.density_diffusion == DensityDiffusion::None;
    let ignored = [
        (!artificial && file.viscosity_alpha.is_some(), "viscosity_alpha", "viscosity is laminar"),
        (!artificial && file.viscosity_beta.is_some(), "viscosity_beta", "viscosity is laminar"),
        (
            artificial && file.kinematic_viscosity_m2_s != defaults.kinematic_viscosity_m2_s,
            "kinematic_viscosity_m2_s",
            "viscosity is artificial",
        ),
        (
            no_diffusion && file.diffusion_delta != defaults.diffusion_delta && file.diffusion_delta != 0.0,
            "diffusion_delta",
            "density_diffusion is none",
        ),
        (!file.gap_pressure && file.boundary == Boundary::Dbc, "gap_pressure", "boundary is dbc"),
        (file.wall_friction.is_some() && !slides, "wall_friction", "wall_slip is not free_slip or inviscid"),
        (file.slip_on_units && slip != WallSlip::FreeSlip, "slip_on_units", "wall_slip is not free_slip"),
    ];
    for (_, key, reason) in ignored.iter().filter(|(is_ignored, ..)| *is_ignored) {
        check.warn(format!("numerics.{key} has no effect: numerics.{reason}"));
    }
    if file.viscosity == Viscosity::Laminar && file.kinematic_viscosity_m2_s == 0.0 {
        check.warn("numerics.kinematic_viscosity_m2_s = 0: the water has no viscosity; real water has 1e-6 m2/s");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Changes the default settings and validates them. Returns whether they are accepted, and the warnings.
    fn warnings(change: impl FnOnce(&mut NumericsFile)) -> (bool, Vec<String>) {
        let mut file = NumericsFile::default();
        change(&mut file);
        let mut check = Checker::new("x.json");
        let accepted = validate_numerics(&file, 0.01, 1.0, &mut check).is_some();
        (accepted, check.warnings)
    }

    #[test]
    fn ignored_constants_give_a_warning() {
        assert_eq!(warnings(|_| ()), (true, vec![]));
        let (accepted, found) = warnings(|file| file.kinematic_viscosity_m2_s = 1e-3);
        assert!(accepted && found[0].starts_with("numerics.kinematic_viscosity_m2_s has no effect"), "{found:?}");
        let (accepted, found) = warnings(|file| {
            file.viscosity = Viscosity::LaminarSps;
            file.viscosity_alpha = Some(0.1);
        });
        assert!(accepted && found[0].starts_with("numerics.viscosity_alpha has no effect"), "{found:?}");
        let (accepted, found) = warnings(|file| {
            file.density_diffusion = DensityDiffusion::None;
            file.diffusion_delta = 0.2;
        });
        assert!(accepted && found[0].starts_with("numerics.diffusion_delta has no effect"), "{found:?}");
        let (accepted, found) =
            warnings(|file| (file.slip_on_units, file.wall_slip) = (true, Some(WallSlip::Original)));
        assert!(accepted && found[0].starts_with("numerics.slip_on_units has no effect"), "{found:?}");
        let slides = |file: &mut NumericsFile| (file.slip_on_units, file.wall_slip) = (true, Some(WallSlip::FreeSlip));
        assert_eq!(warnings(slides), (true, vec![]));
        let (accepted, found) = warnings(|file| {
            file.viscosity = Viscosity::Laminar;
            file.kinematic_viscosity_m2_s = 0.0;
        });
        assert!(accepted && found[0].contains("the water has no viscosity"), "{found:?}");
    }

    #[test]
    fn density_diffusion_that_is_unstable_at_the_time_step_is_refused() {
        assert!(warnings(|file| (file.diffusion_delta, file.cfl) = (0.57, 0.5)).0);
        assert!(!warnings(|file| (file.diffusion_delta, file.cfl) = (0.58, 0.5)).0);
        let no_diffusion = |file: &mut NumericsFile| {
            file.density_diffusion = DensityDiffusion::None;
            (file.diffusion_delta, file.cfl) = (0.58, 0.5);
        };
        assert!(warnings(no_diffusion).0);
    }
}
