//! What the scheme may not create or lose: mass, energy, momentum, angular momentum.

use breakwater::simulation::flume::balance::Balance;
use breakwater::sph::particles::{boundary::Boundary, water::Water};
use breakwater::sph::{
    parameters::Parameters,
    solver::step::Solver,
    terms::{
        density_diffusion::{DensityDiffusion, Diffusion},
        shifting::Shifting,
        turbulence::Smagorinsky,
        viscosity::Viscosity,
    },
};
use glam::DVec3;

use super::tanks::{BareTank, GRAVITY, RHO0, dam_break, parameters, run_until, simulation};
use super::two_dimensional::in_two_dimensions;

#[test]
fn a_breaking_dam_keeps_its_mass_and_gains_no_energy() {
    // 5e-5 and 3.4e-4 are reached, in the first 50 ms: the pressure wave of the release runs to and fro through the column,
    // does work on bed and wall and gets it back. Walls that mirror the water's velocity take part in it: they give 0.3 %
    // of the energy in that time, and nothing afterwards.
    for (slip, most) in [("original", 3e-4), ("free_slip", 6e-4)] {
        let mut case = in_two_dimensions(dam_break(0.025, 0.5));
        case["numerics"] = serde_json::json!({ "wall_slip": slip });
        let mut dam = simulation(&case);
        let mass: f64 = dam.water.mass.iter().sum();
        let start = dam.energy();
        let (mut last, mut rise, mut lowest) = (start.total(), 0.0_f64, start.total());
        run_until(&mut dam, 0.5, |now| {
            let total = now.energy().total();
            rise = rise.max(total - lowest);
            lowest = lowest.min(total);
            last = total;
        });
        let end = dam.energy();
        println!(
            "dam break, {slip}: total {:.1} to {last:.1} J, highest above an earlier lowest {rise:.2e} J, kinetic {:.1} J",
            start.total(),
            end.kinetic
        );
        assert!(end.kinetic > 0.1 * start.potential);
        assert!(rise < most * start.potential);
        assert!(last < start.total());
        // The sum runs over the same masses, sorted otherwise: rounding.
        assert!((dam.water.mass.iter().sum::<f64>() / mass - 1.0).abs() < 1e-12);
    }
}

/// A ball of water of a radius [m] that spins, flies and swings; no two particles alike.
fn drop_of_water(radius: f64, dp: f64, rho: impl Fn(f64) -> f64) -> Water {
    let mut water = Water::default();
    let count = (radius / dp) as i32 + 1;
    for (i, j, k) in
        (-count..count).flat_map(|i| (-count..count).flat_map(move |j| (-count..count).map(move |k| (i, j, k))))
    {
        let place = dp * (DVec3::new(f64::from(i), f64::from(j), f64::from(k)) + 0.5);
        if place.length() < radius {
            let swing = 0.1 * DVec3::new((40.0 * place.y).sin(), (50.0 * place.z).sin(), (30.0 * place.x).sin());
            water.position.push(place);
            water.velocity.push(DVec3::new(0.3, -0.2, 0.1) + DVec3::new(0.5, 1.0, 2.0).cross(place) + swing);
            water.density.push(rho(place.x));
            water.mass.push(RHO0 * dp.powi(3) * (1.0 + 0.1 * (70.0 * place.x).sin()));
        }
    }
    water.id = (0..water.len() as u32).collect();
    water
}

fn momentum(water: &Water) -> DVec3 {
    water.mass.iter().zip(&water.velocity).map(|(&m, &v)| m * v).sum()
}

fn angular_momentum(water: &Water) -> DVec3 {
    (0..water.len()).map(|i| water.mass[i] * water.position[i].cross(water.velocity[i])).sum()
}

/// Radius of the drop [m].
const RADIUS: f64 = 0.1;

/// What a drop gained that nothing gave it, at the worst moment of a run.
struct Drift {
    /// |momentum - that at the start| / sum |m v|.
    momentum: f64,
    /// |angular momentum - that at the start| / sum |m r x v|.
    angular: f64,
    /// Mean impulse that a particle got in a step over that which it carries [-].
    push: f64,
}

/// Let a drop of particles a distance `dp` [m] apart spin, fly and swing without weight for a number of steps. At the
/// start its density varies by the share `squeezed`; `adjust` changes the scheme.
fn drift(dp: f64, steps: u32, squeezed: f64, adjust: impl FnOnce(&mut Parameters)) -> Drift {
    let mut parameters = parameters(dp, 0.2, 0.0, None);
    adjust(&mut parameters);
    let mut water = drop_of_water(RADIUS, dp, |x| RHO0 * (1.0 + squeezed * (60.0 * x).cos()));
    let mut boundary = Boundary::new(&[], &[], &[], 0, RHO0);
    let mut solver = Solver::new(parameters, DVec3::splat(-0.3), DVec3::splat(0.3));
    let start = (momentum(&water), angular_momentum(&water));
    let each = |of: &dyn Fn(usize) -> DVec3, water: &Water| {
        (0..water.len()).map(|i| water.mass[i] * of(i).length()).sum::<f64>()
    };
    let carried = each(&|i| water.velocity[i], &water);
    let turning = each(&|i| water.position[i].cross(water.velocity[i]), &water);
    let mut drift = Drift { momentum: 0.0, angular: 0.0, push: 0.0 };
    for _ in 0..steps {
        solver.sort(&mut water, &boundary);
        solver.build_neighbour_lists(&water, &boundary);
        solver.boundary_densities(&mut boundary);
        solver.rates();
        let dt = solver.limits().time_step(&parameters);
        let before = water.velocity.clone();
        solver.predict(dt, &water, &mut boundary, |_| ());
        solver.rates();
        solver.correct(dt, &mut water, &mut boundary);
        // The water is not sorted in this half of a step.
        drift.push += each(&|i| water.velocity[i] - before[i], &water) / carried / f64::from(steps);
        drift.momentum = drift.momentum.max((momentum(&water) - start.0).length() / carried);
        drift.angular = drift.angular.max((angular_momentum(&water) - start.1).length() / turning);
    }
    println!(
        "drop of {} particles, {steps} steps: momentum off by {:.1e} of sum |m v|, angular momentum by {:.1e} of \
         sum |m r x v|; a step changes the momentum of a particle by {:.1e} of itself",
        water.len(),
        drift.momentum,
        drift.angular,
        drift.push
    );
    drift
}

/// Forces act at the half step, where the step leaves momentum and angular momentum as they are: only the forces of a
/// pair could change them. Those of pressure and artificial viscosity are V_a V_b (p_a + p_b + ...) G r_ab in both
/// directions, and differ by rounding to single precision only: the some 280 parts of a force are rounded one by one
/// as they are summed, and the places from which arms are taken are rounded as well. Both are as often too large as too
/// small, so that the share that is left falls with the number of particles: 1,600, 4,200, 12,000 and 34,000 of them
/// lose 4.7e-10, 1.9e-10, 1.4e-10 and 0.5e-10 of the angular momentum in 1,000 steps.
#[test]
fn a_drop_without_gravity_keeps_momentum_and_angular_momentum() {
    let drift = drift(RADIUS / 20.0, 1000, 0.0, |_| ());
    // 3.7e-11 and 4.8e-11 were reached.
    assert!(drift.momentum < 1e-10, "{}", drift.momentum);
    assert!(drift.angular < 1e-10, "{}", drift.angular);
}

/// | term | momentum | angular momentum |
/// | --- | --- | --- |
/// | pressure, artificial viscosity, density diffusion of any kind | kept | kept |
/// | laminar viscosity: along v_ab, not along r_ab | kept | not |
/// | sub-particle-scale stress: along tau r_ab | kept | not |
/// | shifting: moves particles and leaves their velocities | kept | not |
#[test]
fn which_terms_keep_momentum_and_angular_momentum() {
    let dp = RADIUS / 10.0;
    // The squeezed drop exchanges ten times as much as the other: 1e-10 to 3e-10 were reached.
    let rounding = 1e-9;
    let run = |name: &str, adjust: &dyn Fn(&mut Parameters)| {
        println!("{name}:");
        drift(dp, 100, 0.002, |parameters| adjust(parameters))
    };
    let keeps = |name: &str, adjust: &dyn Fn(&mut Parameters)| {
        let drift = run(name, adjust);
        assert!(drift.momentum < rounding && drift.angular < rounding, "{name}");
    };
    keeps("as usual", &|_| ());
    keeps("no diffusion", &|p| p.diffusion = Diffusion::none());
    keeps("diffusion of Antuono et al.", &|p| {
        p.diffusion = Diffusion::new(DensityDiffusion::Antuono, 0.1, p.kernel.h, &p.tait, 0.0);
    });
    let loses_turn = |name: &str, adjust: &dyn Fn(&mut Parameters)| {
        let drift = run(name, adjust);
        assert!(drift.momentum < rounding && drift.angular > 1e-7, "{name}");
    };
    let laminar = |nu, turbulence| Viscosity::Laminar { nu, turbulence };
    loses_turn("laminar, viscous", &|p| p.viscosity = laminar(1e-3, None));
    loses_turn("laminar, water", &|p| p.viscosity = laminar(1e-6, None));
    loses_turn("turbulence", &|p| p.viscosity = laminar(0.0, Some(Smagorinsky::new(dp))));
    loses_turn("shifting", &|p| p.shifting = Some(Shifting { coefficient: 2.0, h: p.kernel.h, dp, dimensions: 3 }));
}

/// Water that sloshes in a tank: what its energy loses is what walls, viscosity and diffusion take.
#[test]
fn the_energy_balance_closes() {
    let (side, dp) = (0.4, 0.02);
    let mut tank = BareTank::new(side, 0.3, dp, &[]);
    let wave = std::f64::consts::PI / side;
    for (velocity, position) in tank.water.velocity.iter_mut().zip(&tank.water.position) {
        let (x, z) = (wave * position.x, wave * position.z);
        velocity.x = 0.4 * x.sin() * z.cos();
        velocity.z = -0.4 * x.cos() * z.sin();
    }
    let energy = |tank: &BareTank| {
        let (water, tait) = (&tank.water, tank.solver.parameters.tait);
        let of = |i: usize| {
            let kinetic = 0.5 * water.velocity[i].length_squared();
            water.mass[i] * (kinetic + GRAVITY * water.position[i].z + tait.internal_energy(water.density[i]))
        };
        (0..water.len()).map(of).sum::<f64>()
    };
    let mut balance = Balance::default();
    let (mut time, mut start, mut end) = (0.0, None, 0.0);
    while time < 0.3 {
        let now = time;
        time += tank.step(|tank| {
            balance.add(now, tank.solver.powers(&tank.water));
            end = energy(tank);
            start.get_or_insert(end);
        });
    }
    let change = end - start.unwrap();
    let left = change - (balance.boundary + balance.viscosity + balance.diffusion);
    println!(
        "energy changed by {change:.5} J: walls {:.5}, viscosity {:.5}, diffusion {:.5}, not explained {left:.5}",
        balance.boundary, balance.viscosity, balance.diffusion
    );
    assert!(balance.viscosity < 0.0 && change < 0.0);
    // 1 %: the step is of second order, and the powers are found at its start.
    assert!(left.abs() < 0.01 * balance.viscosity.abs());
}
