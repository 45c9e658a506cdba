//! Bodies that are towed through a closed tank at a constant speed: a square cylinder and a rib in two dimensions, a
//! round cylinder, a cube and a sphere in three. The module `towed_rows` tows rows of bodies.
//!
//! At a Reynolds number of 22,000, the drag coefficient of the square cylinder is 1.9 to 2.2 and the Strouhal number 0.13
//! (ERCOFTAC UFR 2-02). That flow is turbulent and three-dimensional. Between Reynolds numbers of 1e4 and 1e5, the drag
//! coefficient of a round cylinder is 1.2 and the Strouhal number 0.2 (figures not checked in an original). The drag
//! coefficient of a cube is 1.05 (Hoerner 1965; figure not checked in the original), that of a sphere 0.4 to 0.5 at
//! Reynolds numbers from 1e3 to 1e5 (Roos & Willmarth 1971, who measured 0.43 at 2000).
//!
//! A rib that leaves 60 % of the height of a channel has a drag coefficient of 5.64 if it is thin, and of 5.14 if it is as
//! thick as it is high (Idelchik 2006, diagrams 4-14 and 4-15; formulas read in the Modelica library, not in the book).

use breakwater::{
    geometry::{axis_box::AxisBox, outline::Outline},
    rigid::{BodyState, Load},
    sph::{
        parameters::Parameters,
        particles::{
            bed::{Across, outline_particles},
            boundary::{Boundary, BoundaryParticle},
            fill::{Basin, clear_solid},
            obstacle::box_particles,
            unit::unit_particles,
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

pub(super) const RHO0: f64 = 1000.0;
/// Mean pressure of the water, divided by rho U^2: as at the units of the Fudo experiment.
const PRESSURE: f64 = 4.0;

/// Bodies of one shape that are towed side by side, and their tank. The bodies reach their speed on a way of half their
/// size.
pub(super) struct Towed {
    pub(super) name: &'static str,
    pub(super) dimensions: u32,
    /// Size of a body along the way [m] and speed [m/s].
    pub(super) size: f64,
    pub(super) speed: f64,
    /// Speed of sound [m/s].
    pub(super) sound: f64,
    /// Particle spacing [m].
    pub(super) dp: f64,
    /// Width and height of the tank [m], and the length of the water in front of the bodies at the start and behind the
    /// end of their way [m].
    pub(super) width: f64,
    pub(super) height: f64,
    pub(super) room: f64,
    /// Start of each body, from the point (`room`, 0, 0) [m], and its rotation.
    pub(super) places: Vec<(DVec3, DQuat)>,
    /// Boundary particles of a body, and the nearest point of its surface with the distance [m], negative inside. Both
    /// in the axes of the body.
    pub(super) particles: Vec<BoundaryParticle>,
    pub(super) locate: Box<dyn Fn(DVec3) -> (DVec3, f64) + Send + Sync>,
    /// From the times 1 to 4 `size` / `speed`, the bodies move upwards and back by this distance, so that vortices begin
    /// to shed [m].
    pub(super) kick: f64,
}

impl Towed {
    /// A square cylinder with sides of 1 m, in two dimensions.
    fn square_cylinder(particles: f64) -> Self {
        let dp = 1.0 / particles;
        Self { room: 7.0, dimensions: 2, ..Self::cuboid("square cylinder", dp, dp) }
    }

    /// A rib with a square section of 1 m, in two dimensions. It slides on the bed of a tank that is 2.5 m high, so that
    /// it blocks 40 % of it, as the Tetrapods of the Fudo experiment block their row.
    fn rib(particles: f64) -> Self {
        let dp = 1.0 / particles;
        let half = DVec3::new(0.5, 0.5 * dp, 0.5);
        let section = AxisBox { low: -half, high: half, open: [[true; 2], [false; 2], [false, true]] };
        Self {
            name: "rib",
            // The jet above the rib is 2.5 times as fast as the rib.
            sound: 25.0,
            height: 2.5,
            places: vec![(DVec3::new(0.0, 0.5 * dp, 0.5), DQuat::IDENTITY)],
            particles: box_particles(&section, dp, f64::INFINITY),
            locate: Box::new(move |point| section.locate(point)),
            kick: 0.0,
            ..Self::square_cylinder(particles)
        }
    }

    /// A round cylinder with a diameter of 1 m, across a tank that is 2 m wide and 10 m high.
    fn round_cylinder(particles: f64) -> Self {
        let (dp, width, height) = (1.0 / particles, 2.0, 10.0);
        let locate = |point: DVec3| {
            let section = DVec3::new(point.x, 0.0, point.z);
            (0.5 * section.normalize_or(DVec3::X) + point.y * DVec3::Y, section.length() - 0.5)
        };
        // `unit_particles` adds a layer at each end. All layers are between the periodic sides.
        let half = DVec3::new(0.5, 0.5 * width - 1.01 * dp, 0.5);
        let volume = 0.25 * std::f64::consts::PI * width;
        Self {
            name: "round cylinder",
            dimensions: 3,
            width,
            height,
            room: 5.0,
            places: vec![(DVec3::new(0.0, 0.5 * width, 0.5 * height + 0.13 * dp), DQuat::IDENTITY)],
            particles: unit_particles(locate, -half, half, volume, dp),
            locate: Box::new(locate),
            ..Self::square_cylinder(particles)
        }
    }

    /// A cube with sides of 1 m.
    fn cube(particles: f64) -> Self {
        Self::cuboid("cube", 1.0 / particles, 1.0)
    }

    /// A sphere with a diameter of 1 m.
    fn sphere(particles: f64) -> Self {
        let locate = |point: DVec3| (0.5 * point.normalize_or(DVec3::X), point.length() - 0.5);
        let (dp, half, volume) = (1.0 / particles, DVec3::splat(0.5), std::f64::consts::PI / 6.0);
        let particles = unit_particles(locate, -half, half, volume, dp);
        Self { name: "sphere", particles, locate: Box::new(locate), ..Self::cube(particles_in(1.0, dp)) }
    }

    /// A box, 1 m long and high, in the middle of a tank 4 m wide and high. If it is only as wide as `dp`, it fills the
    /// width of its tank, which is 12 m high.
    fn cuboid(name: &'static str, dp: f64, width: f64) -> Self {
        let (half, is_cube) = (0.5 * DVec3::new(1.0, width, 1.0), width > dp);
        let cuboid = AxisBox { low: -half, high: half, open: [[true; 2], [is_cube; 2], [true; 2]] };
        let particles = box_particles(&cuboid, dp, f64::INFINITY);
        let tank: [f64; 2] = if is_cube { [4.0, 4.0] } else { [dp, 12.0] };
        // A little off the lattice.
        let places = vec![(DVec3::new(0.0, 0.5 * tank[0], 0.5 * tank[1] + 0.13 * dp), DQuat::IDENTITY)];
        Self {
            name,
            dimensions: 3,
            size: 1.0,
            speed: 1.0,
            sound: 10.0,
            dp,
            width: tank[0],
            height: tank[1],
            room: 3.0,
            places,
            particles,
            locate: Box::new(move |point| cuboid.locate(point)),
            kick: 0.3,
        }
    }

    /// Returns the scheme with little dissipation.
    fn scheme(&self) -> Parameters {
        let (h, c0, dp) = (1.2 * 3f64.sqrt() * self.dp, self.sound, self.dp);
        let mut parameters = Parameters::published(dp, h, c0, 0.0, (self.dimensions == 3).then_some(self.width));
        if self.dimensions == 2 {
            parameters.kernel = Wendland::in_layer(h, dp);
        }
        parameters.viscosity = Viscosity::Artificial { alpha: 0.005, beta: 0.3 };
        parameters.slip = WallSlip::Inviscid;
        parameters.acoustic_damping = Some(AcousticDamping::new(0.5, h, c0));
        parameters.shifting = Some(Shifting { coefficient: 2.0, h, dp, dimensions: self.dimensions });
        parameters
    }

    /// Returns place and velocity of each body at a time [s].
    fn states(&self, time: f64) -> Vec<BodyState> {
        let unit_time = self.size / self.speed;
        let time = time / unit_time;
        let (way, share) = if time < 1.0 { (0.5 * time * time, time) } else { (time - 0.5, 1.0) };
        let phase = ((time - 1.0) / 3.0).clamp(0.0, 1.0) * std::f64::consts::TAU;
        let up = 0.5 * self.kick * (1.0 - phase.cos());
        let upwards = 0.5 * self.kick * phase.sin() * std::f64::consts::TAU / (3.0 * unit_time);
        let state = |(place, rotation): &(DVec3, DQuat)| {
            let mut state = BodyState::at_rest(*place + DVec3::new(self.room + way * self.size, 0.0, up), *rotation);
            state.velocity = DVec3::new(share * self.speed, 0.0, upwards);
            state
        };
        self.places.iter().map(state).collect()
    }

    /// Moves the boundary particles of the bodies to their places at a time [s].
    fn place(&self, boundary: &mut Boundary, time: f64) {
        self.states(time).iter().enumerate().for_each(|(body, state)| boundary.move_unit(body, state));
    }

    /// Returns the water of a tank of a length [m], and its boundary particles.
    fn tank(&self, parameters: &Parameters, length: f64) -> (Water, Boundary) {
        let dp = self.dp;
        let across = Across { width: self.width, count: (self.width / dp).round() as u32, walls: false };
        let basin = Basin {
            x: [0.0, length],
            across,
            dp,
            bed: &|_, _| 0.0,
            surface: &|_| self.height,
            velocity: &|_, _| DVec2::ZERO,
            gravity: 0.0,
        };
        let (middle, top) = (0.5 * length, self.height);
        let corners = [[middle, top], [0.0, top], [0.0, 0.0], [length, 0.0], [length, top], [middle, top]];
        let outline = Outline::new(&corners.map(DVec2::from_array));
        let walls = outline_particles(&outline, &across, dp, 3, parameters.kernel.support());
        let boundary = Boundary::new(&walls, &[], &vec![&self.particles[..]; self.places.len()], RHO0);
        let mut water = basin.fill(&parameters.tait);
        water.density.fill(parameters.tait.density(PRESSURE * RHO0 * self.speed.powi(2)));
        // Bodies that cross the periodic sides also remove water at the other side.
        let images = if self.places.len() > 1 { vec![-self.width, 0.0, self.width] } else { vec![0.0] };
        for state in self.states(0.0) {
            for image in &images {
                let centre = state.position + image * DVec3::Y;
                clear_solid(&mut water, dp, |point| {
                    let (nearest, distance) = (self.locate)(state.rotation.inverse() * (point - centre));
                    (state.rotation * nearest + centre, distance)
                });
            }
        }
        (water, boundary)
    }

    /// Tows the bodies over `travel` [m]; returns the loads after the first `skip` metres.
    pub(super) fn tow(&self, travel: f64, skip: f64) -> Vec<Reading> {
        let length = particles_in(travel + 2.0 * self.room, self.dp) * self.dp;
        let (mut water, mut boundary) = self.tank(&self.scheme(), length);
        let margin = DVec3::new(5.0 * self.dp, 0.0, 5.0 * self.dp);
        let mut solver = Solver::new(self.scheme(), -margin, DVec3::new(length, self.width, self.height) + margin);
        self.place(&mut boundary, 0.0);
        let (mut time, mut readings) = (0.0, Vec::new());
        rayon::scope(|_| {
            while time < travel / self.speed {
                solver.sort(&mut water, &boundary);
                solver.build_neighbour_lists(&water, &boundary);
                solver.boundary_densities(&mut boundary);
                solver.rates();
                let dt = solver.limits().time_step(&solver.parameters);
                let centres: Vec<DVec3> = self.states(time).iter().map(|state| state.position).collect();
                readings.push(Reading { time, dt, loads: solver.unit_loads(&boundary, &centres) });
                solver.predict(dt, &water, &mut boundary, |boundary| self.place(boundary, time + 0.5 * dt));
                solver.rates();
                solver.correct(dt, &mut water, &mut boundary);
                self.place(&mut boundary, time + dt);
                self.hold_pressure(&mut water, &solver.parameters);
                time += dt;
            }
        });
        readings.retain(|reading| reading.time > skip / self.speed);
        readings
    }

    /// Changes all densities by the same amount, so that the mean pressure keeps its value: the level of the pressure in
    /// a closed tank is arbitrary.
    fn hold_pressure(&self, water: &mut Water, parameters: &Parameters) {
        let sum = water.density.iter().map(|density| parameters.tait.pressure(*density)).sum::<f64>();
        let excess = PRESSURE * RHO0 * self.speed.powi(2) - sum / water.len() as f64;
        let change = excess / parameters.tait.c0.powi(2);
        water.density.iter_mut().for_each(|density| *density += change);
    }
}

/// Returns the number of particles with the spacing `dp` [m] in a length [m].
fn particles_in(length: f64, dp: f64) -> f64 {
    (length / dp).round()
}

/// Loads on the bodies at the start of a time step.
pub(super) struct Reading {
    /// Time and time step [s].
    time: f64,
    dt: f64,
    pub(super) loads: Vec<Load>,
}

/// Returns the mean of a value over time.
pub(super) fn mean(readings: &[Reading], of: impl Fn(&Reading) -> f64) -> f64 {
    let duration: f64 = readings.iter().map(|r| r.dt).sum();
    readings.iter().map(|r| of(r) * r.dt).sum::<f64>() / duration
}

/// Drag coefficient, rms of the lift coefficient, and Strouhal number.
#[derive(Debug)]
struct Flow {
    drag: f64,
    lift: f64,
    strouhal: f64,
}

impl Flow {
    /// Tows a body with the frontal area `front` [m2]. The results are those of the second two thirds of the way.
    fn around(body: &Towed, front: f64, travel: f64) -> Self {
        let readings = body.tow(travel, travel / 3.0);
        let pressure = 0.5 * RHO0 * body.speed.powi(2) * front;
        let lift = |r: &Reading| r.loads[0].force.z / pressure;
        let middle = mean(&readings, lift);
        let flow = Self {
            drag: -mean(&readings, |r| r.loads[0].force.x) / pressure,
            lift: mean(&readings, |r| (lift(r) - middle).powi(2)).sqrt(),
            strouhal: shedding(&readings, |r| lift(r) - middle) * body.size / body.speed,
        };
        let particles = particles_in(body.size, body.dp);
        println!("{}, {particles} particles along its side, towed by {travel} sides: {flow:.3?}", body.name);
        flow
    }
}

/// Returns the frequency at which the Fourier transform of the lift, with a Hann window, is largest [1/s].
fn shedding(readings: &[Reading], lift: impl Fn(&Reading) -> f64) -> f64 {
    let duration: f64 = readings.iter().map(|r| r.dt).sum();
    let amplitude = |frequency: f64| {
        let term = |r: &Reading| {
            let window = 1.0 - (std::f64::consts::TAU * (r.time - readings[0].time) / duration).cos();
            DVec2::from_angle(std::f64::consts::TAU * frequency * r.time) * (window * lift(r) * r.dt)
        };
        readings.iter().map(term).sum::<DVec2>().length()
    };
    let frequencies = (50..350).map(|n| 1e-3 * f64::from(n));
    frequencies.max_by(|a, b| amplitude(*a).total_cmp(&amplitude(*b))).unwrap()
}

#[test]
fn a_coarse_square_cylinder_has_too_little_drag() {
    let body = Towed::square_cylinder(8.0);
    let flow = Flow::around(&body, body.width, 16.0);
    // Reached: 1.26, 1.27 and 1.35 in runs whose alpha differs by at most 4e-5 of its value, and 1.39 on another
    // processor. The limits are 15 % from the middle of this range, to detect a change of the scheme.
    assert!((flow.drag / 1.32 - 1.0).abs() < 0.15, "{flow:?}");
}

#[test]
#[ignore = "50 minutes on one core: \
    cargo test --release --test validation -- --ignored --nocapture square_cylinder"]
fn drag_of_a_square_cylinder_approaches_the_measured_one() {
    let flows = [8.0, 12.0, 16.0].map(|particles| {
        let body = Towed::square_cylinder(particles);
        Flow::around(&body, body.width, 48.0)
    });
    // Reached over 48 sides: 1.36, 1.69 and 2.10; over 36 sides with 12 and 16 particles: 1.73 and 2.07.
    assert!(flows.is_sorted_by(|a, b| a.drag < b.drag));
    let finest = &flows[2];
    // The range of the source. Only three or four vortices shed, at irregular times: over 48 and 36 sides, the Strouhal
    // numbers are 0.13 and 0.09, so the target 0.12 to 0.14 cannot be tested. The limits are those of one vortex less or
    // more in three.
    assert!((1.9..2.2).contains(&finest.drag) && (0.08..0.18).contains(&finest.strouhal), "{finest:?}");
    // Vortices shed: the lift fluctuates by 1.3 to 1.5, but hardly without shedding.
    assert!(finest.lift > 0.65, "{finest:?}");
}

/// Returns the drag coefficient of a thin rib that leaves the share `open` of the height of a channel, by the theory of
/// free streamlines. At the rib, the water contracts to a jet, and the pressure behind the rib is that of the jet.
///
/// The ratio s of the velocity in front of the rib to that of the jet follows from the contraction of a slot across a
/// channel (von Mises 1917), open / s = 1 + 2/pi (1/s - s) atan s. The balance of momentum between the sections in front
/// of the rib and in the jet gives the drag, (1/s - 1)^2 / (1 - open).
fn drag_of_a_rib_by_free_streamlines(open: f64) -> f64 {
    let contracted = |s: f64| open / (1.0 + (1.0 / s - s) * s.atan() * std::f64::consts::FRAC_2_PI);
    let ratio = (0..50).fold(0.5, |s, _| contracted(s));
    (1.0 / ratio - 1.0).powi(2) / (1.0 - open)
}

#[test]
fn a_coarse_rib_has_too_little_drag() {
    let theory = drag_of_a_rib_by_free_streamlines(0.6);
    // The contraction coefficient of von Mises for this slot is 0.662, which gives 5.76.
    assert!((theory - 5.76).abs() < 0.01, "{theory}");
    let body = Towed::rib(8.0);
    let flow = Flow::around(&body, body.width, 16.0);
    // Reached: 2.82. The limits are 15 %, as for the square cylinder.
    assert!((flow.drag / 2.82 - 1.0).abs() < 0.15, "{flow:?}");
}

#[test]
#[ignore = "10 minutes on one core: \
    cargo test --release --test validation -- --ignored --nocapture drag_of_a_rib"]
fn drag_of_a_rib_approaches_that_of_free_streamlines() {
    let drag = [8.0, 12.0, 16.0].map(|particles| {
        let body = Towed::rib(particles);
        Flow::around(&body, body.width, 16.0).drag
    });
    // Reached: 2.82, 4.15 and 4.54. Idelchik has 5.64 for a thin rib, and 5.14 for this one (table in
    // docs/validation/fluid.md). The finest rib is to be within 15 % of the latter.
    assert!(drag.is_sorted() && drag[2] < drag_of_a_rib_by_free_streamlines(0.6), "{drag:?}");
    assert!((drag[2] / 5.14 - 1.0).abs() < 0.15, "{drag:?}");
}

#[test]
#[ignore = "an hour on one core: \
    cargo test --release --test validation -- --ignored --nocapture round_cylinder"]
fn drag_of_a_round_cylinder_is_near_the_measured_one() {
    let drag = [4.0, 6.0, 8.0].map(|particles| {
        let body = Towed::round_cylinder(particles);
        let drag = Flow::around(&body, body.width, 16.0).drag;
        // Drag without the walls of the tank (Allen & Vincenti 1944; formula not checked in the original).
        let blocked = body.size / body.height;
        drag * (1.0 - 0.5 * drag * blocked - 2.5 * blocked.powi(2))
    });
    println!("without the walls of the tank: {drag:.3?}");
    // Reached: 1.46, 1.26 and 1.28. Target: within 15 % of the measured drag with six and eight particles.
    assert!(drag[0] > drag[1] && drag[1..].iter().all(|drag| (drag / 1.2 - 1.0).abs() < 0.15), "{drag:?}");
}

#[test]
#[ignore = "half an hour on one core: \
    cargo test --release --test validation -- --ignored --nocapture cube_and_a_sphere"]
fn drag_of_a_cube_and_a_sphere_is_near_the_measured_one() {
    // Target: within 15 % of the measured drag with ten particles across. Reached: 0.93 (-11 %) and 0.41 (-9 %).
    let deviation = |make: fn(f64) -> Towed, front: f64, measured: f64| {
        let drag = [6.0, 8.0, 10.0].map(|particles| Flow::around(&make(particles), front, 6.0).drag);
        drag[2] / measured - 1.0
    };
    let deviations = [deviation(Towed::cube, 1.0, 1.05), deviation(Towed::sphere, 0.25 * std::f64::consts::PI, 0.45)];
    assert!(deviations.iter().all(|deviation| deviation.abs() < 0.15), "{deviations:?}");
}
