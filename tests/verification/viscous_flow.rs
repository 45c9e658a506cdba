//! Both forms of laminar viscosity, with walls that hold the water and walls that let it slide, against exact
//! solutions.

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

/// Particles across the box, which is periodic: as few as the kernel's reach allows.
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
fn the_stress_of_monaghan_and_gingold_resists_both_ways_and_spares_rotation() {
    let (nu, h, r2, rho_a, rho_b) = (0.01_f32, 0.02_f32, 1e-4_f64, 1000.0, 1010.0);
    // K = 10 in three dimensions.
    let stress = |v_dot_r: f64| monaghan_gingold_stress(10.0 * nu, approach_rate(h, v_dot_r, r2), rho_a, rho_b);
    // rho_a rho_b 4 (D + 2) nu / (rho_a + rho_b) (v . r) / (r^2 + 0.01 h^2); 1e-6: constants in single precision.
    let exact = rho_a * rho_b * 20.0 * 0.01 / (rho_a + rho_b) * 1e-3 / (r2 + 0.01 * 0.02 * 0.02);
    assert!((stress(-1e-3) / exact - 1.0).abs() < 1e-6 && (stress(1e-3) / exact + 1.0).abs() < 1e-6);
    assert_eq!(stress(0.0), 0.0);
}

/// Velocity in a square duct of side 1 under a body force, in units of force / nu: the series of Boussinesq (1868).
fn duct(x: f64, z: f64) -> f64 {
    let term = |n: u32| {
        let k = f64::from(2 * n + 1) * PI;
        4.0 / k.powi(3) * (1.0 - ((k * (z - 0.5)).cosh() / (0.5 * k).cosh())) * (k * x).sin()
    };
    // cosh / cosh is even and at most 1: the terms fall with k^-3.
    (0..40).map(term).sum()
}

#[test]
fn series_of_the_duct() {
    // White, Viscous Fluid Flow: 0.0737 of side^2 force / nu in the middle; nothing on the walls.
    assert!((duct(0.5, 0.5) - 0.07367).abs() < 2e-5);
    assert!(duct(0.5, 0.0).abs() < 1e-12 && duct(0.0, 0.3).abs() < 1e-12);
}

/// Largest error of the flow in a duct with a number of particles a side, as a share of the velocity in the middle.
fn error_in_the_duct(particles: f64, form: fn(f64) -> Viscosity) -> f64 {
    let (dp, nu, fastest) = (SIDE / particles, 0.1, 1.0);
    let force = fastest * nu / duct(0.5, 0.5);
    let mut tank = BareTank::closed([SIDE, ACROSS * dp], dp, 10.0 * fastest, &[], viscous(form(nu), WallSlip::NoSlip));
    let mut time = 0.0;
    // The slowest mode dies with 2 pi^2 nu / side^2: e^-8 is left.
    while time < 4.0 {
        let dt = tank.step(|_| ());
        tank.water.velocity.iter_mut().for_each(|v| v.y += force * dt);
        time += dt;
    }
    let exact = |x: f64, z: f64| fastest * duct(x / SIDE, z / SIDE) / duct(0.5, 0.5);
    let errors = tank.water.position.iter().zip(&tank.water.velocity).map(|(p, v)| v.y - exact(p.x, p.z));
    let (mut largest, mut square) = (0.0_f64, 0.0);
    errors.for_each(|error| (largest, square) = (largest.max(error.abs()), square + error * error));
    let rms = (square / tank.water.len() as f64).sqrt();
    let form = form(nu);
    println!(
        "duct, {particles} a side, {form:?}: largest error {:.2} %, rms {:.2} % of the largest",
        100.0 * largest,
        100.0 * rms
    );
    largest
}

#[test]
fn force_driven_flow_in_a_duct_sticks_to_the_walls() {
    // 2 %: a twentieth of the box lies between particles.
    assert!(error_in_the_duct(20.0, lo_shao) < 0.02);
}

#[test]
fn force_driven_flow_in_a_duct_with_the_viscosity_of_monaghan_and_gingold() {
    // 3.5 %: 2.8 % is seen, 2.4 % with 28 particles a side. The walls make the water too stiff by about 2.7 and 1.9 %.
    // To this the sum over the particles adds 0.1 and 0.5 % here, more with more particles (1.1 % at this h / dp and
    // no dp); that of Lo & Shao takes 1.4 % away with 20 a side, so that there the errors partly cancel.
    assert!(error_in_the_duct(20.0, monaghan_gingold) < 0.035);
}

/// How the particles of a Taylor-Green vortex stand at its start.
#[derive(Clone, Copy)]
enum Start {
    Lattice,
    /// In the even disorder to which a flow brings them: moved off the lattice at random, then left to settle.
    Settled,
}

/// A Taylor-Green vortex of the speed 1 m/s that fills the box.
struct Vortex {
    tank: BareTank,
    /// Rate at which its energy falls, 4 nu (pi / side)^2 [1/s].
    rate: f64,
}

impl Vortex {
    /// With Reynolds number 100 and a number of particles a side.
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
            // Pressure of the vortex, and enough besides to keep it positive.
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

    /// Power that viscosity takes at the start over that of theory, -1.
    fn excess_of_power(mut self) -> f64 {
        let exact = self.rate * self.energy();
        let mut powers = Powers::default();
        self.tank.step(|tank| powers = tank.solver.powers(&tank.water));
        -powers.viscosity / exact - 1.0
    }

    /// Rate at which the energy falls over 2 s, to e^-0.8, over that of theory, -1.
    fn excess_of_decay(mut self) -> f64 {
        let (start, mut time) = (self.energy(), 0.0);
        while time < 2.0 {
            time += self.tank.step(|_| ());
        }
        -(self.energy() / start).ln() / time / self.rate - 1.0
    }
}

/// Move the particles by up to `most` [m] along each axis, the same way each time (the generator is Knuth's MMIX), and
/// let them settle under a pressure [Pa], without which nothing would drive them apart.
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
    // 0.3 s: sound has crossed the box three times, and viscosity has brought the particles to a fiftieth of the speed
    // that the vortex will have.
    while time < 0.3 {
        time += tank.step(|_| ());
    }
}

#[test]
fn the_power_of_viscosity_in_a_taylor_green_vortex() {
    for (form, name) in [(lo_shao as fn(f64) -> _, "Lo & Shao"), (monaghan_gingold, "Monaghan & Gingold")] {
        let excess = Vortex::new(40.0, form, Start::Lattice).excess_of_power();
        println!("Taylor-Green, {name}: power of viscosity at the start {:+.2} %", 100.0 * excess);
        // 2 %: without walls the sum over a lattice misses nu laplace v by -0.3 % (Lo & Shao) and +0.9 % (Monaghan &
        // Gingold); one part falls with (kh)^2, the other, +0.2 and +1.1 %, depends on h / dp alone. The walls, whose
        // velocities are interpolated over the kernel, add 0.7 %, three times as much with half as many particles.
        assert!(excess.abs() < 0.02, "{name}: {excess}");
    }
}

#[test]
fn a_taylor_green_vortex_decays_at_its_rate() {
    for (form, name) in [(lo_shao as fn(f64) -> _, "Lo & Shao"), (monaghan_gingold, "Monaghan & Gingold")] {
        let excess = Vortex::new(20.0, form, Start::Settled).excess_of_decay();
        println!("Taylor-Green, {name}, 20 particles a side: decay {:+.1} %", 100.0 * excess);
        // 8 %. The sum for the viscosity and the walls make 1.4 % (test above, settled particles). The strain of the
        // vortex pushes particles together, they give way sideways, and viscosity takes the energy of this noise: 4 %.
        // Pressure, with which the water answers the noise, takes 1 %. All this falls with dp: over the first second
        // 5.7 and 4.2 % are seen with 20 and 30 particles a side, the power 0.8.
        // Started on the lattice the vortex decays 23 and 21 % too fast with 20 and with 40 particles a side: its
        // strain deforms the lattice until it collapses, all at once, between 0.3 and 0.6 s; for a moment viscosity
        // then takes twice what it should. Density diffusion after Antuono et al. (2010) or a correction of the
        // velocity for the shift (Lind et al. 2012) change that by 2 % at most; a threefold shift with the largest
        // speed in place of the local one halves it.
        assert!(excess.abs() < 0.08, "{name}: {excess}");
    }
}

/// `cargo test --release --test verification -- --ignored --nocapture taylor_green_vortex_on_finer`
#[test]
#[ignore = "10 minutes"]
fn a_taylor_green_vortex_on_finer_particles() {
    for (start, name) in [(Start::Settled, "settled"), (Start::Lattice, "on a lattice")] {
        let excess = [20.0, 30.0, 40.0].map(|particles| {
            let excess = Vortex::new(particles, lo_shao, start).excess_of_decay();
            println!("Taylor-Green, {name}, {particles} particles a side: decay {:+.1} %", 100.0 * excess);
            excess
        });
        if let Start::Settled = start {
            // First order is a half with half of dp; between that and the same lies what single runs scatter by.
            assert!(excess[2] < 0.75 * excess[0], "{excess:?}");
        }
    }
}
