//! Converts the numerical settings of a case to the parameters of the SPH solver.

use crate::{
    case::{self, Case},
    sph::{
        parameters::{BoundaryCondition, Parameters},
        solver::backend,
        terms::{
            acoustic_damping::AcousticDamping,
            density_diffusion::{DensityDiffusion, Diffusion},
            equation_of_state::Tait,
            kernel::Wendland,
            shifting::Shifting,
            turbulence::Smagorinsky,
            viscosity::Viscosity,
            wall_slip::WallSlip,
        },
    },
};

/// Returns the parameters of the SPH scheme.
pub fn parameters(case: &Case) -> Parameters {
    let (fluid, numerics, dp) = (&case.fluid, &case.numerics, case.domain.dp);
    let periodic = case.domain.sides == case::Sides::Periodic;
    let tait = tait(case);
    let diffusion = match numerics.density_diffusion {
        case::DensityDiffusion::None => DensityDiffusion::None,
        case::DensityDiffusion::MolteniColagrossi => DensityDiffusion::MolteniColagrossi,
        case::DensityDiffusion::Fourtakas => DensityDiffusion::Fourtakas,
        case::DensityDiffusion::Antuono => DensityDiffusion::Antuono,
    };
    let kernel = match case.domain.sides {
        case::Sides::TwoDimensional => Wendland::in_layer(numerics.h, case.domain.width),
        case::Sides::Periodic | case::Sides::Walls => Wendland::new(numerics.h),
    };
    let shifting = Shifting { coefficient: numerics.shifting, h: numerics.h, dp, dimensions: kernel.dimensions() };
    let damping = AcousticDamping::new(numerics.acoustic_damping, numerics.h, tait.c0);
    let laminar = |turbulence| Viscosity::Laminar { nu: numerics.nu, turbulence };
    Parameters {
        dp,
        kernel,
        viscosity: match numerics.viscosity {
            case::Viscosity::Artificial => Viscosity::Artificial { alpha: numerics.alpha, beta: numerics.beta },
            case::Viscosity::Laminar => laminar(None),
            case::Viscosity::LaminarMonaghanGingold => Viscosity::MonaghanGingold { nu: numerics.nu },
            case::Viscosity::LaminarSps => laminar(Some(Smagorinsky::new(dp))),
        },
        diffusion: Diffusion::new(diffusion, numerics.delta, numerics.h, &tait, fluid.gravity),
        lowest_density: numerics
            .suction_limit
            .map(|limit| tait.density_under_suction(limit, fluid.gravity, numerics.h)),
        tait,
        slip: match numerics.wall_slip {
            case::WallSlip::Original => WallSlip::Original,
            case::WallSlip::NoSlip => WallSlip::NoSlip,
            case::WallSlip::FreeSlip => WallSlip::FreeSlip,
            case::WallSlip::Inviscid => WallSlip::Inviscid,
        },
        gap_pressure: numerics.gap_pressure,
        acoustic_damping: (numerics.acoustic_damping > 0.0).then_some(damping),
        shifting: (numerics.shifting > 0.0).then_some(shifting),
        own_x: case.domain.own_x,
        gravity: fluid.gravity,
        cfl: numerics.cfl,
        boundary: match numerics.boundary {
            case::Boundary::Dbc => BoundaryCondition::Dynamic,
            case::Boundary::Mdbc => BoundaryCondition::ModifiedDynamic,
        },
        periodic_width: periodic.then_some(case.domain.width),
    }
}

/// Returns a feature of the case that graphics cards do not support; `None` if they support the whole case.
pub fn unsupported_on_gpu(case: &Case) -> Option<&'static str> {
    if case.domain.damping_zone.is_some() || case.domain.relaxation_zone.is_some() {
        return Some("damping and relaxation zones (domain.damping_zone, domain.relaxation_zone)");
    }
    if matches!(case.wavemaker, case::Wavemaker::OpenEnds { .. }) {
        return Some("open ends (wavemaker.kind = \"open_ends\")");
    }
    if case.wavemaker.absorption_gauge().is_some() {
        return Some("active absorption by the wavemaker (wavemaker.absorption_gauge_m)");
    }
    if case.domain.regions.len() > 1 {
        return Some("regions of different particle spacing (domain.fine_x_m)");
    }
    if case.flume.parts.iter().any(|part| part.medium().is_some()) {
        return Some("porous parts (structure.porous)");
    }
    backend::unsupported_on_gpu(&parameters(case))
}

/// Returns the equation of state of the water.
pub fn tait(case: &Case) -> Tait {
    Tait { rho0: case.fluid.rho0, c0: case.fluid.sound_speed, gamma: case.fluid.gamma }
}
