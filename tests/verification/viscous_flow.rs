//! Laminar viscosity with walls that hold the water and walls that let it slide, against exact solutions.

use std::f64::consts::PI;

use breakwater::sph::{parameters::Parameters, shifting::Shifting, viscosity::Viscosity, wall_slip::WallSlip};

use super::tanks::BareTank;

/// Side of the box [m] and the width across which it is periodic.
const SIDE: f64 = 1.0;

fn viscous(nu: f64, slip: WallSlip) -> impl FnOnce(&mut Parameters) {
    move |parameters| {
        parameters.viscosity = Viscosity::Laminar { nu, turbulence: None };
        parameters.slip = slip;
        let (h, dp) = (parameters.kernel.h, parameters.dp);
        parameters.shifting = Some(Shifting { coefficient: 2.0, h, dp });
    }
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

#[test]
fn force_driven_flow_in_a_duct_sticks_to_the_walls() {
    let (dp, nu, fastest) = (SIDE / 20.0, 0.1, 1.0);
    let force = fastest * nu / duct(0.5, 0.5);
    let mut tank = BareTank::closed(SIDE, 0.6, dp, 10.0 * fastest, viscous(nu, WallSlip::NoSlip));
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
    println!("duct: largest error {:.2} %, rms {:.2} % of the velocity in the middle", 100.0 * largest, 100.0 * rms);
    // 2 %: a twentieth of the box lies between particles.
    assert!(largest < 0.02, "{largest}");
}

#[test]
fn a_taylor_green_vortex_decays_at_its_rate() {
    let (dp, nu, speed) = (SIDE / 40.0, 0.01, 1.0);
    let mut tank = BareTank::closed(SIDE, 12.0 * dp, dp, 10.0 * speed, viscous(nu, WallSlip::FreeSlip));
    let wave = PI / SIDE;
    for (velocity, position) in tank.water.velocity.iter_mut().zip(&tank.water.position) {
        let (x, z) = (wave * position.x, wave * position.z);
        velocity.x = speed * x.sin() * z.cos();
        velocity.z = -speed * x.cos() * z.sin();
    }
    // Pressure of the vortex, and enough besides to keep it positive.
    let tait = tank.solver.parameters.tait;
    for (density, position) in tank.water.density.iter_mut().zip(&tank.water.position) {
        let (x, z) = (2.0 * wave * position.x, 2.0 * wave * position.z);
        *density = tait.density(0.25 * tait.rho0 * speed * speed * (x.cos() + z.cos() + 4.0));
    }
    let energy = |tank: &BareTank| {
        let parts = tank.water.velocity.iter().zip(&tank.water.mass).map(|(v, m)| 0.5 * m * v.length_squared());
        parts.sum::<f64>()
    };
    let (start, mut time, mut worst) = (energy(&tank), 0.0, 0.0_f64);
    // Energy falls with 4 nu (pi / side)^2: to e^-0.8 in 2 s.
    let rate = 4.0 * nu * wave * wave;
    while time < 2.0 {
        time += tank.step(|_| ());
        worst = worst.max((energy(&tank) / start / (-rate * time).exp() - 1.0).abs());
    }
    let measured = -(energy(&tank) / start).ln() / time;
    println!("Taylor-Green: rate {measured:.4} 1/s, exact {rate:.4} 1/s; energy within {:.1} %", 100.0 * worst);
    // 25 %: at 40 particles a side it decays 19 % too fast. The noise of the particles, which the pressure of the vortex
    // stirs, dissipates besides; how this falls with dp is not measured yet.
    assert!((measured / rate - 1.0).abs() < 0.25, "{measured}");
}
