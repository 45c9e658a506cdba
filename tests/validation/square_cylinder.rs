//! A square cylinder that is towed through a closed tank at a constant speed, in two dimensions.
//!
//! At a Reynolds number of 22,000, the drag coefficient is 1.9 to 2.2 and the Strouhal number 0.13 (ERCOFTAC UFR 2-02).
//! That flow is turbulent and three-dimensional.

use breakwater::{
    geometry::axis_box::AxisBox,
    rigid::BodyState,
    sph::{
        parameters::Parameters,
        particles::{
            bed::{Across, Outline, outline_particles},
            boundary::Boundary,
            fill::{Basin, clear_solid},
            obstacle::box_particles,
            water::Water,
        },
        solver::step::Solver,
        terms::{
            acoustic_damping::AcousticDamping, kernel::Wendland, shifting::Shifting, viscosity::Viscosity,
            wall_slip::WallSlip,
        },
    },
};
use glam::{DQuat, DVec2, DVec3};

/// Side of the cylinder [m], its speed [m/s] and the density of the water [kg/m3].
const SIDE: f64 = 1.0;
const SPEED: f64 = 1.0;
const RHO0: f64 = 1000.0;
/// Height of the tank [m]. Water in front of the cylinder at the start, and behind the end of its way [m].
const HEIGHT: f64 = 12.0;
const MARGIN: f64 = 7.0;
/// Mean pressure of the water [Pa]: 4 rho U^2, as at the units of the Fudo experiment.
const PRESSURE: f64 = 4.0 * RHO0 * SPEED * SPEED;
/// Time in which the cylinder reaches its speed [s].
const RAMP: f64 = 1.0;
/// The cylinder moves across the tank and back by this distance, from 1 to 4 s, so that vortices begin to shed [m].
const KICK: f64 = 0.3;

/// Drag coefficient, rms of the lift coefficient, and Strouhal number.
#[derive(Debug)]
struct Flow {
    drag: f64,
    lift: f64,
    strouhal: f64,
}

/// Drag and lift coefficient at the start of a time step.
struct Reading {
    /// Time and time step [s].
    time: f64,
    dt: f64,
    drag: f64,
    lift: f64,
}

/// Returns the scheme with little dissipation.
fn scheme(dp: f64) -> Parameters {
    let (h, c0) = (1.2 * 3f64.sqrt() * dp, 10.0 * SPEED);
    let mut parameters = Parameters::published(dp, h, c0, 0.0, None);
    parameters.kernel = Wendland::in_layer(h, dp);
    parameters.viscosity = Viscosity::Artificial { alpha: 0.005, beta: 0.3 };
    parameters.slip = WallSlip::Inviscid;
    parameters.acoustic_damping = Some(AcousticDamping::new(0.5, h, c0));
    parameters.shifting = Some(Shifting { coefficient: 2.0, h, dp, dimensions: 2 });
    parameters
}

/// Returns place and velocity of the cylinder at a time [s].
fn motion(start: DVec3, time: f64) -> BodyState {
    let (x, speed) = if time < RAMP {
        (0.5 * SPEED * time * time / RAMP, SPEED * time / RAMP)
    } else {
        (SPEED * (time - 0.5 * RAMP), SPEED)
    };
    let phase = ((time - 1.0) / 3.0).clamp(0.0, 1.0) * std::f64::consts::TAU;
    let (z, across) = (0.5 * KICK * (1.0 - phase.cos()), 0.5 * KICK * phase.sin() * std::f64::consts::TAU / 3.0);
    let mut state = BodyState::at_rest(start + DVec3::new(x, 0.0, z), DQuat::IDENTITY);
    state.velocity = DVec3::new(speed, 0.0, across);
    state
}

/// Returns the water of the tank and its boundary particles. The cylinder is at `start` [m].
fn tank(parameters: &Parameters, length: f64, start: DVec3) -> (Water, Boundary) {
    let dp = parameters.dp;
    let across = Across { width: dp, count: 1, walls: false };
    let basin = Basin {
        x: [0.0, length],
        across,
        dp,
        bed: &|_| 0.0,
        surface: &|_| HEIGHT,
        velocity: &|_, _| DVec2::ZERO,
        gravity: 0.0,
    };
    let middle = 0.5 * length;
    let corners = [[middle, HEIGHT], [0.0, HEIGHT], [0.0, 0.0], [length, 0.0], [length, HEIGHT], [middle, HEIGHT]];
    let outline = Outline::new(corners.map(DVec2::from_array).to_vec());
    let walls = outline_particles(&outline, &across, dp, 3, parameters.kernel.support());
    let half = DVec3::new(0.5 * SIDE, 0.5 * dp, 0.5 * SIDE);
    let square = AxisBox { low: -half, high: half, open: [[true; 2], [false; 2], [true; 2]] };
    let boundary = Boundary::new(&walls, &[], &box_particles(&square, dp, f64::INFINITY), 1, RHO0);
    let mut water = basin.fill(&parameters.tait);
    water.density.fill(parameters.tait.density(PRESSURE));
    let around = AxisBox { low: start - half, high: start + half, ..square };
    clear_solid(&mut water, dp, |point| around.locate(point));
    (water, boundary)
}

/// Tows a cylinder, with a number of particles along its side, over `travel` [m]. The results are those of the second
/// two thirds of the way.
fn tow(particles: f64, travel: f64) -> Flow {
    let dp = SIDE / particles;
    let length = ((travel + 2.0 * MARGIN) * particles).round() * dp;
    // A little off the lattice and the middle.
    let start = DVec3::new(MARGIN, 0.5 * dp, 0.5 * HEIGHT + 0.13 * dp);
    let parameters = scheme(dp);
    let (mut water, mut boundary) = tank(&parameters, length, start);
    let margin = DVec3::new(5.0 * dp, 0.0, 5.0 * dp);
    let mut solver = Solver::new(parameters, -margin, DVec3::new(length, dp, HEIGHT) + margin);
    boundary.move_unit(0, &motion(start, 0.0));
    let (mut time, mut readings) = (0.0, Vec::new());
    rayon::scope(|_| {
        while time < travel / SPEED {
            solver.sort(&mut water, &boundary);
            solver.build_neighbour_lists(&water, &boundary);
            solver.boundary_densities(&mut boundary);
            solver.rates();
            let dt = solver.limits().time_step(&solver.parameters);
            let force = solver.unit_loads(&boundary, &[motion(start, time).position])[0].force;
            let coefficients = force / (0.5 * RHO0 * SPEED * SPEED * SIDE * dp);
            readings.push(Reading { time, dt, drag: -coefficients.x, lift: coefficients.z });
            solver
                .predict(dt, &water, &mut boundary, |boundary| boundary.move_unit(0, &motion(start, time + 0.5 * dt)));
            solver.rates();
            solver.correct(dt, &mut water, &mut boundary);
            boundary.move_unit(0, &motion(start, time + dt));
            hold_pressure(&mut water, &solver.parameters);
            time += dt;
        }
    });
    let flow = Flow::of(&readings[readings.iter().position(|r| r.time > travel / SPEED / 3.0).unwrap()..]);
    println!("square cylinder, {particles} particles along its side, towed by {travel} sides: {flow:.3?}");
    flow
}

/// Changes all densities by the same amount, so that the mean pressure keeps its value: the level of the pressure in a
/// closed tank is arbitrary.
fn hold_pressure(water: &mut Water, parameters: &Parameters) {
    let mean = water.density.iter().map(|density| parameters.tait.pressure(*density)).sum::<f64>() / water.len() as f64;
    let change = (PRESSURE - mean) / parameters.tait.c0.powi(2);
    water.density.iter_mut().for_each(|density| *density += change);
}

impl Flow {
    /// The Strouhal number is the frequency at which the Fourier transform of the lift, with a Hann window, is largest.
    fn of(readings: &[Reading]) -> Self {
        let duration: f64 = readings.iter().map(|r| r.dt).sum();
        let mean = |of: &dyn Fn(&Reading) -> f64| readings.iter().map(|r| of(r) * r.dt).sum::<f64>() / duration;
        let lift = mean(&|r| r.lift);
        let amplitude = |frequency: f64| {
            let term = |r: &Reading| {
                let window = 1.0 - (std::f64::consts::TAU * (r.time - readings[0].time) / duration).cos();
                DVec2::from_angle(std::f64::consts::TAU * frequency * r.time) * (window * (r.lift - lift) * r.dt)
            };
            readings.iter().map(term).sum::<DVec2>().length()
        };
        let frequencies = (50..350).map(|n| 1e-3 * f64::from(n) * SPEED / SIDE);
        let shedding = frequencies.max_by(|a, b| amplitude(*a).total_cmp(&amplitude(*b))).unwrap();
        Self {
            drag: mean(&|r| r.drag),
            lift: mean(&|r| (r.lift - lift).powi(2)).sqrt(),
            strouhal: shedding * SIDE / SPEED,
        }
    }
}

#[test]
fn a_coarse_square_cylinder_has_too_little_drag() {
    let flow = tow(8.0, 16.0);
    // Reached: 1.39. The limits are 15 % from this value, to detect a change of the scheme.
    assert!((flow.drag / 1.39 - 1.0).abs() < 0.15, "{flow:?}");
}

#[test]
#[ignore = "45 minutes on 2 cores: \
    cargo test --release --test validation -- --ignored --nocapture square_cylinder"]
fn drag_of_a_square_cylinder_approaches_the_measured_one() {
    // Not yet run to its end. Trials with the same scheme: 1.76 with 12 particles, 2.10 and St = 0.131 with 16.
    let flows = [8.0, 12.0, 16.0].map(|particles| tow(particles, 36.0));
    assert!(flows.is_sorted_by(|a, b| a.drag < b.drag && a.lift < b.lift));
    let finest = &flows[2];
    // The ranges of the source, the Strouhal number with 6 % more.
    assert!((1.9..2.2).contains(&finest.drag) && (0.12..0.14).contains(&finest.strouhal), "{finest:?}");
}
