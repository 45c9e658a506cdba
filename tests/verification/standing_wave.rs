//! Period and decay of the lowest standing wave in a tank with free slip on bed and walls.

use std::f64::consts::PI;

use breakwater::sph::{
    lanes::InstructionSet,
    terms::{viscosity::Viscosity, wall_slip::WallSlip},
};

use super::tanks::{BareTank, GRAVITY, parameters};

const LENGTH: f64 = 1.0;
const DEPTH: f64 = 0.5;

/// Wave number [1/m].
const K: f64 = PI / LENGTH;

/// Kinematic viscosity [m2/s]. It is so large that it dissipates much more energy than the particle noise.
const NU: f64 = 0.02;

/// Period and decay of a sloshing wave.
struct Sloshing {
    /// Mean period over the run [s].
    period: f64,
    /// Rate at which the amplitude falls [1/s].
    decay: f64,
}

/// Returns the angular frequency sigma without viscosity [1/s].
fn frequency() -> f64 {
    (GRAVITY * K * (K * DEPTH).tanh()).sqrt()
}

/// Returns decay and period by theory. With the growth rate n, m^2 = k^2 + n / nu and the frequency sigma without
/// viscosity, the linear Navier-Stokes equations over a free-slip bed give
///
/// (n + 2 nu k^2)^2 + sigma^2 = 4 nu^2 k^3 m tanh(kd) / tanh(md),
///
/// which is the equation of Lamb (1932, article 349) for infinite depth. The function uses the first two terms of n in
/// sqrt(nu k^2 / sigma). The first term is -2 nu k^2 + i sigma, because the power 2 mu S : S of the irrotational flow
/// is the same share of its energy at all depths. The second term is from the vortical layer below the surface. The
/// next term changes the decay by less than 1 %.
fn theory() -> Sloshing {
    let layer_term = 2f64.sqrt() * NU.powf(1.5) * K.powi(3) * (K * DEPTH).tanh() / frequency().sqrt();
    Sloshing { period: 2.0 * PI / (frequency() - layer_term), decay: 2.0 * NU * K * K - layer_term }
}

/// Runs the wave for a number of periods with a particle spacing [m].
fn slosh(dp: f64, viscosity: Viscosity, periods: f64) -> Sloshing {
    // The smallest width that the kernel support allows.
    let width = 10.0 * dp;
    let mut scheme = parameters(dp, DEPTH, GRAVITY, Some(width));
    scheme.viscosity = viscosity;
    scheme.slip = WallSlip::FreeSlip;
    let surface = |x: f64| DEPTH + 0.02 * (K * x).cos();
    let mut tank = BareTank::of(InstructionSet::best(), scheme, [LENGTH, width, DEPTH], &surface, &[]);
    let mass: f64 = tank.water.mass.iter().sum();
    // The displacement of the centre of mass is proportional to the amplitude.
    let centre = |tank: &BareTank| {
        tank.water.position.iter().zip(&tank.water.mass).map(|(p, m)| m * p.x).sum::<f64>() / mass - 0.5 * LENGTH
    };
    let end = periods * 2.0 * PI / frequency();
    let (mut time, mut before) = (0.0, centre(&tank));
    let (mut crossings, mut extremes, mut extreme) = (Vec::new(), Vec::new(), [0.0, before.abs()]);
    while time < end {
        let dt = tank.step(|_| ());
        let now = centre(&tank);
        if now * before < 0.0 {
            crossings.push(time + dt * before / (before - now));
            extremes.push(extreme);
            extreme = [time, 0.0];
        }
        time += dt;
        before = now;
        if now.abs() > extreme[1] {
            extreme = [time, now.abs()];
        }
    }
    let last = crossings.len() - 1;
    let period = 2.0 * (crossings[last] - crossings[0]) / last as f64;
    // The first extreme is the start, before the water has settled, so it is not used.
    let ([t0, a0], [t1, a1]) = (extremes[1], extremes[extremes.len() - 1]);
    Sloshing { period, decay: (a0 / a1).ln() / (t1 - t0) }
}

/// Runs the wave with a number of particles in the depth; returns the errors of period and decay [-].
fn errors(particles: f64, viscosity: Viscosity) -> [f64; 2] {
    let measured = slosh(DEPTH / particles, viscosity, 2.3);
    let theory = theory();
    let (period, decay) = (measured.period / theory.period - 1.0, measured.decay / theory.decay - 1.0);
    println!(
        "standing wave, {particles} particles in the depth, {viscosity:?}: period {:+.2} %, decay {:+.1} %",
        100.0 * period,
        100.0 * decay
    );
    [period, decay]
}

#[test]
fn a_standing_wave_has_the_period_and_decay_of_theory() {
    let [period, decay] = errors(10.0, Viscosity::MonaghanGingold { nu: NU });
    // Limit 1 % for the period: the particle spacing is a tenth of the depth.
    assert!(period.abs() < 0.01, "{period}");
    // Limit 10 % for the decay: particles at the surface lack half of their neighbours, so friction is missing in a
    // layer of about dp / 2. With the height z, the power 2 mu S : S falls as e^(2kz), so the share k dp = 16 % is
    // missing. Particle noise adds dissipation. Reached: +2.3 %, or -1.6 % with 12 particles in the depth.
    assert!(decay.abs() < 0.1, "{decay}");
}

#[test]
fn a_standing_wave_decays_too_slowly_with_lo_and_shao() {
    let [_, decay] = errors(8.0, Viscosity::Laminar { nu: NU, turbulence: None });
    // In irrotational flow the power mu grad v : grad v is half of 2 mu S : S (Colagrossi et al. 2011). Friction is
    // also missing at the surface, so the decay is about a third of the theoretical decay. The test allows decays that
    // are 40 to 80 % slower than in theory.
    assert!((-0.8..-0.4).contains(&decay), "{decay}");
}
