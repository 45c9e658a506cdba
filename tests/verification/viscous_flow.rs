//! Both forms of laminar viscosity with no-slip and free-slip walls, compared with exact solutions.

use std::f64::consts::PI;

use breakwater::sph::{
    parameters::Parameters,
    solver::power::Powers,
    terms::{
        shifting::Shifting,
        viscosity::{Viscosity, approach_rate, monaghan_gingold_stress},
        wall_slip::WallSlip,
    },
};
use glam::DVec3;

use super::tanks::BareTank;

/// Side of the box [m].
const SIDE: f64 = 1.0;

/// Particles across the periodic box, the smallest number that the kernel support allows.
const ACROSS: f64 = 10.0;

fn lo_shao(nu: f64) -> Viscosity {
    Viscosity::Laminar { nu, turbulence: None }
}

fn monaghan_gingold(nu: f64) -> Viscosity {
    Viscosity::MonaghanGingold { nu }
}

fn viscous(viscosity: Viscosity, slip: WallSlip) -> impl FnOnce(&mut Parameters) {
    move |parameters| {
        parameters.viscosity = viscosity;
        parameters.slip = slip;
        let (h, dp) = (parameters.kernel.h, parameters.dp);
        parameters.shifting = Some(Shifting { coefficient: 2.0, h, dp, dimensions: 3 });
    }
}

#[test]
fn monaghan_gingold_stress_resists_compression_and_expansion_and_ignores_rotation() {
    let (nu, h, r2, rho_a, rho_b) = (0.01_f32, 0.02_f32, 1e-4_f64, 1000.0, 1010.0);
    // K = 10 in three dimensions.
    let stress = |v_dot_r: f64| monaghan_gingold_stress(10.0 * nu, approach_rate(h, v_dot_r, r2), rho_a, rho_b);
    // Viscous stress of Monaghan & Gingold in D = 3 dimensions:
    // -rho_a rho_b 4 (D + 2) nu / (rho_a + rho_b) (v . r) / (r^2 + 0.01 h^2), positive when the particles approach.
    // `exact` is its value for v . r = -1e-3 m2/s. Limit 1e-6 for the stress: single precision.
    let exact = rho_a * rho_b * 20.0 * 0.01 / (rho_a + rho_b) * 1e-3 / (r2 + 0.01 * 0.02 * 0.02);
    assert!((stress(-1e-3) / exact - 1.0).abs() < 1e-6 && (stress(1e-3) / exact + 1.0).abs() < 1e-6);
    assert_eq!(stress(0.0), 0.0);
}

/// Returns the velocity in a square duct of side 1 under a body force, divided by force / nu. Source: the series of
/// Boussinesq (1868).
fn duct(x: f64, z: f64) -> f64 {
    let term = |n: u32| {
        let k = f64::from(2 * n + 1) * PI;
        4.0 / k.powi(3) * (1.0 - ((k * (z - 0.5)).cosh() / (0.5 * k).cosh())) * (k * x).sin()
    };
    // The ratio of both cosh is at most 1, so the terms fall with k^-3, and 40 terms are enough.
    (0..40).map(term).sum()
}

#[test]
fn duct_series_equals_published_values() {
    // White, Viscous Fluid Flow: 0.0737 side^2 force / nu in the middle; zero on the walls.
    assert!((duct(0.5, 0.5) - 0.07367).abs() < 2e-5);
    assert!(duct(0.5, 0.0).abs() < 1e-12 && duct(0.0, 0.3).abs() < 1e-12);
}

/// Returns the largest velocity error in a duct with a number of particles per side, divided by the velocity in the
/// middle [-].
fn error_in_the_duct(particles: f64, form: fn(f64) -> Viscosity) -> f64 {
    let (dp, nu, fastest) = (SIDE / particles, 0.1, 1.0);
    let force = fastest * nu / duct(0.5, 0.5);
    let mut tank = BareTank::closed([SIDE, ACROSS * dp], dp, 10.0 * fastest, &[], viscous(form(nu), WallSlip::NoSlip));
    let exact = |x: f64, z: f64| fastest * duct(x / SIDE, z / SIDE) / duct(0.5, 0.5);
    // The flow starts with the exact velocities and approaches the steady flow of the particles. The slowest mode of
    // the difference decays with 2 pi^2 nu / side^2, here to e^-3 = 5 %.
    for (velocity, position) in tank.water.velocity.iter_mut().zip(&tank.water.position) {
        velocity.y = exact(position.x, position.z);
    }
    let mut time = 0.0;
    while time < 1.5 {
        let dt = tank.step(|_| ());
        tank.water.velocity.iter_mut().for_each(|v| v.y += force * dt);
        time += dt;
    }
    let errors = tank.water.position.iter().zip(&tank.water.velocity).map(|(p, v)| v.y - exact(p.x, p.z));
    let (mut largest, mut square) = (0.0_f64, 0.0);
    errors.for_each(|error| (largest, square) = (largest.max(error.abs()), square + error * error));
    let rms = (square / tank.water.len() as f64).sqrt();
    let form = form(nu);
    println!(
        "duct, {particles} particles per side, {form:?}: largest error {:.2} %, rms {:.2} % of the velocity in the middle",
        100.0 * largest,
        100.0 * rms
    );
    largest
}

#[test]
fn duct_flow_with_lo_and_shao_equals_the_exact_solution() {
    // Limit 2 % for the velocity error: the particle spacing is a twentieth of the side.
    assert!(error_in_the_duct(20.0, lo_shao) < 0.02);
}

#[test]
fn duct_flow_with_monaghan_and_gingold_equals_the_exact_solution() {
    // Reached: errors of 2.84 % with 20 particles per side and 2.4 % with 28. The walls make the flow too slow by about
    // 2.7 and 1.9 % respectively. The viscosity sum over the particles adds errors of 0.1 and 0.5 % respectively, or
    // 1.1 % in the limit of small dp at this h / dp.
    // For Lo & Shao, the error of this sum is -1.4 % with 20 particles per side and partly cancels the error of the
    // walls.
    assert!(error_in_the_duct(20.0, monaghan_gingold) < 0.035);
}

/// Initial arrangement of the particles of a Taylor-Green vortex.
#[derive(Clone, Copy)]
enum Start {
    Lattice,
    /// Uniform disorder as in a flow: random shifts off the lattice, then settled.
    Settled,
}

/// A Taylor-Green vortex that fills the box with a largest velocity of 1 m/s.
struct Vortex {
    tank: BareTank,
    /// Exact decay rate of the kinetic energy, 4 nu (pi / side)^2 [1/s].
    rate: f64,
}

impl Vortex {
    /// Creates the vortex with Reynolds number 100 and a number of particles per side.
    fn new(particles: f64, form: fn(f64) -> Viscosity, start: Start) -> Self {
        let (dp, nu, speed, wave) = (SIDE / particles, 0.01, 1.0, PI / SIDE);
        let mut tank =
            BareTank::closed([SIDE, ACROSS * dp], dp, 10.0 * speed, &[], viscous(form(nu), WallSlip::FreeSlip));
        let tait = tank.solver.parameters.tait;
        if let Start::Settled = start {
            settle(&mut tank, 0.5 * dp, tait.rho0 * speed * speed);
        }
        let water = &mut tank.water;
        for ((velocity, density), p) in water.velocity.iter_mut().zip(&mut water.density).zip(&water.position) {
            let (x, z) = (wave * p.x, wave * p.z);
            *velocity = speed * DVec3::new(x.sin() * z.cos(), 0.0, -x.cos() * z.sin());
            // Pressure of the vortex plus a constant that keeps it positive.
            let shape = (2.0 * x).cos() + (2.0 * z).cos() + 4.0;
            *density = tait.density(0.25 * tait.rho0 * speed * speed * shape);
        }
        Self { tank, rate: 4.0 * nu * wave * wave }
    }

    /// Kinetic energy [J].
    fn energy(&self) -> f64 {
        let water = &self.tank.water;
        water.velocity.iter().zip(&water.mass).map(|(v, m)| 0.5 * m * v.length_squared()).sum()
    }

    /// Returns the power of viscosity at the start, divided by the theoretical power, minus 1 [-].
    fn excess_of_power(mut self) -> f64 {
        let exact = self.rate * self.energy();
        let mut powers = Powers::default();
        self.tank.step(|tank| powers = tank.solver.powers(&tank.water));
        -powers.viscosity / exact - 1.0
    }

    /// Returns the decay rate of the energy, divided by the theoretical rate, minus 1 [-]. The run of 1 s reduces the
    /// energy to about e^-0.4 of its initial value.
    fn excess_of_decay(mut self) -> f64 {
        let (start, mut time) = (self.energy(), 0.0);
        while time < 1.0 {
            time += self.tank.step(|_| ());
        }
        -(self.energy() / start).ln() / time / self.rate - 1.0
    }
}

/// Shifts the particles by up to `most` [m] along each axis with reproducible random numbers (Knuth's MMIX). Then lets
/// them settle under a pressure [Pa], which drives them apart.
fn settle(tank: &mut BareTank, most: f64, pressure: f64) {
    let mut state = 1_u64;
    let mut number = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 * 2.0 - 1.0
    };
    let compressed = tank.solver.parameters.tait.density(pressure);
    let water = &mut tank.water;
    for ((position, density), mass) in water.position.iter_mut().zip(&mut water.density).zip(&mut water.mass) {
        *position += most * DVec3::new(number(), number(), number());
        *mass *= compressed / *density;
        *density = compressed;
    }
    let mut time = 0.0;
    // In 0.3 s, sound crosses the box three times, and viscosity reduces the velocities to a fiftieth of the velocity
    // of the vortex.
    while time < 0.3 {
        time += tank.step(|_| ());
    }
}

#[test]
fn power_of_viscosity_in_a_taylor_green_vortex_agrees_with_theory() {
    for (form, name) in [(lo_shao as fn(f64) -> _, "Lo & Shao"), (monaghan_gingold, "Monaghan & Gingold")] {
        let excess = Vortex::new(40.0, form, Start::Lattice).excess_of_power();
        println!("Taylor-Green, {name}: power of viscosity at the start {:+.2} %", 100.0 * excess);
        // Limit 2 % for the power: without walls the lattice sum of nu laplace v has errors of -0.3 % (Lo & Shao) and
        // +0.9 % (Monaghan & Gingold). One part of the error falls with (kh)^2; the other part, +0.2 and +1.1 %,
        // depends only on h / dp. The wall velocities are interpolated over the kernel and add 0.7 %, or 2.1 % with
        // half as many particles per side.
        assert!(excess.abs() < 0.02, "{name}: {excess}");
    }
}

#[test]
fn a_taylor_green_vortex_decays_at_the_rate_of_theory() {
    let excess = Vortex::new(20.0, monaghan_gingold, Start::Settled).excess_of_decay();
    println!("Taylor-Green, Monaghan & Gingold, 20 particles per side: decay rate {:+.1} %", 100.0 * excess);
    // Limit 8 % for the decay rate. The viscosity sum and the walls cause 1.4 %, which is the excess of the power with
    // settled particles. The strain of the vortex pushes particles together and sideways. Viscosity dissipates this
    // noise (4 %), and the pressure response to the noise takes 1 %. The total falls with dp to the power 0.8: over the
    // first second with Lo & Shao, the total is 5.7 and 4.2 % with 20 and 30 particles per side. If the particles start
    // on a lattice, the vortex decays 23 and 21 % too fast with 20 and 40 particles per side. The strain deforms the
    // lattice, which collapses suddenly between 0.3 and 0.6 s. Meanwhile viscosity dissipates twice the theoretical
    // power. Density diffusion of Antuono et al. (2010) or a velocity correction for the shifting (Lind et al. 2012)
    // changes the decay error of the lattice start by at most 2 %. Three times the shifting, with the largest speed
    // instead of the local speed, halves this error.
    assert!(excess.abs() < 0.08, "{excess}");
}

#[test]
#[ignore = "10 minutes: \
    cargo test --release --test verification -- --ignored --nocapture decay_error_of_a_taylor_green_vortex"]
fn decay_error_of_a_taylor_green_vortex_falls_with_resolution() {
    for (start, name) in [(Start::Settled, "settled"), (Start::Lattice, "on a lattice")] {
        let excess = [20.0, 30.0, 40.0].map(|particles| {
            let excess = Vortex::new(particles, lo_shao, start).excess_of_decay();
            println!("Taylor-Green, {name}, {particles} particles per side: decay rate {:+.1} %", 100.0 * excess);
            excess
        });
        if let Start::Settled = start {
            // First order would give a factor of 0.5 for half the particle spacing; 0.75 allows for scatter of single
            // runs.
            assert!(excess[2] < 0.75 * excess[0], "{excess:?}");
        }
    }
}
