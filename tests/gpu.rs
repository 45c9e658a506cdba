//! Compares the time step on a graphics card with the time step on the processor.
//!
//! The tests run on any graphics card, or with a software driver (Debian's mesa-vulkan-drivers). If there is neither
//! card nor software driver, the tests print "skipped" and pass, or fail if BREAKWATER_NEEDS_CARD is set.

#![cfg(feature = "gpu")]

use std::{path::Path, sync::Arc};

use breakwater::case::Case;
use breakwater::simulation::flume::Simulation;
use breakwater::simulation::flume::outputs::checkpoint::Checkpoint;
use breakwater::simulation::flume::outputs::recorder_state::RecorderState;
use breakwater::sph::device::{Device, DeviceChoice};
use breakwater::sph::solver::backend::Surfaces;
use glam::DVec3;
use serde_json::{Value, json};

/// Opens the first card; `None` if there is none.
fn card() -> Option<Device> {
    match Device::open(DeviceChoice::Gpu(0), None) {
        Ok((device, _)) => Some(device),
        Err(error) => {
            assert!(std::env::var_os("BREAKWATER_NEEDS_CARD").is_none(), "{error}");
            println!("skipped: {error}");
            None
        }
    }
}

fn case(value: &Value) -> Arc<Case> {
    Arc::new(Case::from_str(&value.to_string(), "test").unwrap_or_else(|errors| panic!("{errors}")))
}

fn case_file(name: &str) -> Arc<Case> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases").join(name);
    Arc::new(Case::load(&path).unwrap_or_else(|errors| panic!("{errors}")))
}

/// Returns the case of a tank; with `column`, a dam break from a column of this length and height [m].
fn tank(column: Option<[f64; 2]>) -> Value {
    let mut tank = json!({
        "title": "Tank",
        "flume": { "bed_m": [[0.0, 0.0], [0.6, 0.0]], "still_water_level_m": 0.2, "material": "mortar" },
        "domain": { "x_m": [0.0, 0.6], "width_m": 0.25, "sides": "periodic", "top_z_m": 0.4, "dp_m": 0.025 },
        "numerics": { "scheme": "mitsui_2023" },
        "materials": [{ "name": "mortar", "young_modulus_pa": 1e8, "poisson_ratio": 0.2, "restitution": 0.5 }],
        "friction": [{ "between": ["mortar", "mortar"], "coefficient": 0.5 }],
        "stop": { "duration_s": 1.0 }
    });
    if let Some([length, height]) = column {
        tank["domain"]["water"] = json!({ "kind": "block", "x_m": [0.0, length], "top_z_m": height });
    }
    tank
}

fn steps(simulation: &mut Simulation, count: u32) {
    for _ in 0..count {
        simulation.step().unwrap();
    }
}

/// Computes the first half of a time step. Returns acceleration and density rate of each particle, in the order of the
/// particle numbers, and force and torque on each unit. Before that, `before` time steps on the processor move the
/// water off its lattice.
fn first_half(device: &Device, case: &Arc<Case>, before: u32) -> (Vec<[f64; 4]>, Vec<[DVec3; 2]>) {
    let mut start = Simulation::new(case.clone()).unwrap();
    steps(&mut start, before);
    let mut simulation = Simulation::on(device, case.clone()).unwrap();
    simulation.water = start.water;
    simulation.boundary = start.boundary;
    simulation.load().unwrap();
    simulation.begin_step().unwrap();
    simulation.fetch().unwrap();
    let rates = simulation.water_rates().unwrap();
    let mut by_number = vec![[0.0; 4]; rates.len()];
    for (rate, &id) in rates.iter().zip(&simulation.water.id) {
        let [x, y, z] = rate.acceleration.map(f64::from);
        by_number[id as usize] = [x, y, z, f64::from(rate.density)];
    }
    let loads = simulation.units.iter().flat_map(|units| &units.fluid_loads).map(|load| [load.force, load.torque]);
    (by_number, loads.collect())
}

/// Returns the relative rms difference of the vectors (the first three numbers) and of the fourth numbers [-].
fn relative(values: &[[f64; 4]], others: &[[f64; 4]]) -> [f64; 2] {
    let sum_of =
        |term: &dyn Fn(&[f64; 4], &[f64; 4]) -> f64| values.iter().zip(others).map(|(a, b)| term(a, b)).sum::<f64>();
    let vector_error = sum_of(&|a, b| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum());
    let vector_norm = sum_of(&|_, b| (0..3).map(|k| b[k] * b[k]).sum());
    let fourth_error = sum_of(&|a, b| (a[3] - b[3]).powi(2));
    let fourth_norm = sum_of(&|_, b| b[3] * b[3]);
    [(vector_error / vector_norm).sqrt(), (fourth_error / fourth_norm).sqrt()]
}

#[test]
fn rates_on_card_and_processor_agree() {
    let Some(device) = card() else { return };
    let cases = [
        ("still water", case(&tank(None)), 30),
        ("dam break", case(&tank(Some([0.2, 0.25]))), 60),
        ("quick look", case_file("fudo/quick-look.json"), 10),
    ];
    for (name, case, before) in cases {
        let (gpu, gpu_loads) = first_half(&device, &case, before);
        let (cpu, cpu_loads) = first_half(&Device::Cpu, &case, before);
        let [acceleration, density] = relative(&gpu, &cpu);
        println!("{name}, {} particles: acceleration {acceleration:.1e}, density {density:.1e}", cpu.len());
        // Target: relative differences of the rates below 1e-5 between card and processor.
        assert!(acceleration < 1e-5 && density < 1e-5);
        for (gpu, cpu) in gpu_loads.iter().zip(&cpu_loads) {
            let [force, torque] = [0, 1].map(|k| (gpu[k] - cpu[k]).length() / cpu[k].length());
            println!("  loads of a unit: force {force:.1e}, torque {torque:.1e}");
            // Limits: 1e-5 for the force, as for the rates of the water; 1e-4 for the torque, a difference of opposing
            // forces.
            assert!(force < 1e-5 && torque < 1e-4);
        }
    }
}

#[test]
fn dam_breaks_on_card_and_processor_agree() {
    let Some(device) = card() else { return };
    let case = case(&tank(Some([0.2, 0.25])));
    let end = |device: &Device| {
        let mut simulation = Simulation::on(device, case.clone()).unwrap();
        steps(&mut simulation, 500);
        simulation.fetch().unwrap();
        let tip = simulation.water.position.iter().map(|p| p.x).fold(0.0, f64::max);
        (simulation.time, tip, simulation.energy().total(), simulation.energy().kinetic)
    };
    let ((gpu_time, gpu_tip, gpu_energy, gpu_kinetic), (time, tip, energy, kinetic)) =
        (end(&device), end(&Device::Cpu));
    println!(
        "after {time:.4} s: tip {gpu_tip:.5} and {tip:.5} m, energy {gpu_energy:.5} and {energy:.5} J, kinetic {gpu_kinetic:.5} and {kinetic:.5} J"
    );
    // Target: tip and energy on card and processor differ by less than 1e-3. The time has the same limit.
    assert!((gpu_time / time - 1.0).abs() < 1e-3);
    assert!((gpu_tip / tip - 1.0).abs() < 1e-3);
    assert!((gpu_energy / energy - 1.0).abs() < 1e-3);
}

#[test]
fn bits_repeat_and_particles_are_sorted_into_their_bins() {
    let Some(device) = card() else { return };
    let case = case(&tank(Some([0.2, 0.25])));
    let end = || {
        let mut simulation = Simulation::on(&device, case.clone()).unwrap();
        steps(&mut simulation, 100);
        simulation.begin_step().unwrap();
        simulation.fetch().unwrap();
        simulation
    };
    let (first, second) = (end(), end());
    assert_eq!(first.water, second.water);
    assert_eq!(first.boundary.density, second.boundary.density);
    let bins = first.solver().water_bins();
    let grid = first.solver().grid();
    for bin in 0..grid.bins() {
        for i in bins.start[bin]..bins.start[bin + 1] {
            // At the edge of a bin, rounding of the position may select the neighbouring bin.
            let place = first.water.position[i as usize];
            let near = |shift: f64| grid.bin(place + DVec3::splat(shift)) as usize == bin;
            assert!(near(0.0) || near(1e-8) || near(-1e-8), "{place}");
        }
    }
}

#[test]
fn a_checkpoint_resumes_with_the_same_bits_and_on_the_other_device() {
    let Some(device) = card() else { return };
    let folder = tempfile::tempdir().unwrap();
    let case = case(&tank(Some([0.2, 0.25])));
    let mut uninterrupted = Simulation::on(&device, case.clone()).unwrap();
    steps(&mut uninterrupted, 20);
    uninterrupted.begin_step().unwrap();
    uninterrupted.fetch().unwrap();
    let outputs = RecorderState::new(&case.output);
    Checkpoint::of(&uninterrupted, &outputs).write(folder.path(), Checkpoint::FILE).unwrap();
    // A run reloads its state after writing a checkpoint.
    uninterrupted.load().unwrap();
    let end = |mut simulation: Simulation| {
        steps(&mut simulation, 20);
        simulation.fetch().unwrap();
        simulation
    };
    let resumed = |device: &Device| {
        let checkpoint = Checkpoint::read(folder.path(), &case.identity).unwrap();
        let mut simulation = checkpoint.set_up(device, case.clone()).unwrap();
        checkpoint.restore(&mut simulation, folder.path()).unwrap();
        simulation.load().unwrap();
        simulation
    };
    let (uninterrupted, on_card, on_cpu) = (end(uninterrupted), end(resumed(&device)), end(resumed(&Device::Cpu)));
    assert_eq!(on_card.water, uninterrupted.water);
    assert_eq!((on_card.time, on_card.steps), (uninterrupted.time, uninterrupted.steps));
    let energies = [&on_card, &on_cpu].map(|simulation| simulation.energy().total());
    // Limit 1e-5 for the energy: the rates on card and processor agree to 1e-5.
    assert!((energies[0] / energies[1] - 1.0).abs() < 1e-5, "{energies:?}");
}

/// Returns two simulations with the same state, `before` time steps after the start of a case: the first on the card,
/// the second on the processor.
fn both(device: &Device, case: &Arc<Case>, before: u32) -> [Simulation; 2] {
    [device, &Device::Cpu].map(|device| {
        let mut start = Simulation::new(case.clone()).unwrap();
        steps(&mut start, before);
        let mut simulation = Simulation::on(device, case.clone()).unwrap();
        std::mem::swap(&mut simulation.water, &mut start.water);
        std::mem::swap(&mut simulation.boundary, &mut start.boundary);
        simulation.load().unwrap();
        simulation
    })
}

/// Returns the largest distance between the positions of the same particle in two simulations [m].
fn furthest_apart(a: &Simulation, b: &Simulation) -> f64 {
    let mut places = vec![DVec3::ZERO; a.water.len()];
    a.water.id.iter().zip(&a.water.position).for_each(|(&id, place)| places[id as usize] = *place);
    let apart = |(&id, place): (&u32, &DVec3)| {
        let mut r = places[id as usize] - *place;
        // The particle may have crossed a periodic side in one of the simulations.
        r.y -= a.case.domain.width * (r.y / a.case.domain.width).round();
        r.length()
    };
    b.water.id.iter().zip(&b.water.position).map(apart).fold(0.0, f64::max)
}

#[test]
fn walls_obstacles_and_two_dimensions_agree_on_card_and_processor() {
    let Some(device) = card() else { return };
    let mut walled = tank(Some([0.2, 0.25]));
    walled["domain"]["sides"] = json!("walls");
    walled["domain"]["obstacles"] = json!([{ "low_m": [0.3, 0.0, 0.0], "high_m": [0.4, 0.125, 0.2] }]);
    let mut flat = tank(Some([0.2, 0.25]));
    flat["domain"]["sides"] = json!("two_dimensional");
    flat["domain"].as_object_mut().unwrap().remove("width_m");
    for (name, value) in [("walls and an obstacle", walled), ("two dimensions", flat)] {
        let [mut gpu, mut cpu] = both(&device, &case(&value), 500);
        for simulation in [&mut gpu, &mut cpu] {
            steps(simulation, 40);
        }
        let [gpu_result, cpu_result] =
            [&mut gpu, &mut cpu].map(|simulation| simulation.begin_step().unwrap().powers().unwrap());
        let apart = furthest_apart(&gpu, &cpu);
        println!("{name}: positions {apart:.1e} m apart, powers {gpu_result:?}, {cpu_result:?}");
        // A relative error of 1e-5 of accelerations of some 100 m/s2 changes positions by 1e-7 m in 13 ms. Because of
        // the walls, the limit is a hundred times larger.
        assert!(apart < 1e-5);
        let all = cpu_result.boundary.abs() + cpu_result.viscosity.abs() + cpu_result.diffusion.abs();
        for (gpu, cpu) in [
            (gpu_result.boundary, cpu_result.boundary),
            (gpu_result.viscosity, cpu_result.viscosity),
            (gpu_result.diffusion, cpu_result.diffusion),
        ] {
            // Limit 1e-3 for each power: the power is a small difference of large sums.
            assert!((gpu - cpu).abs() < 1e-3 * all, "{gpu} {cpu}");
        }
    }
}

#[test]
fn units_and_wavemaker_move_alike_on_card_and_processor() {
    let Some(device) = card() else { return };
    let mut value: Value =
        serde_json::from_str(include_str!("../cases/fudo/quick-look.json")).expect("the quick look is JSON");
    value["numerics"]["hold_units_s"] = json!(0.0);
    value.as_object_mut().unwrap().remove("reference");
    let [mut gpu, mut cpu] = both(&device, &case(&value), 0);
    for simulation in [&mut gpu, &mut cpu] {
        steps(simulation, 8);
        simulation.fetch().unwrap();
    }
    let apart = furthest_apart(&gpu, &cpu);
    let [gpu_result, cpu_result] = [&gpu, &cpu].map(|simulation| simulation.units.as_ref().unwrap().states().to_vec());
    let units =
        gpu_result.iter().zip(&cpu_result).map(|(a, b)| (a.velocity - b.velocity).length() / b.velocity.length());
    let units = units.fold(0.0, f64::max);
    println!("water positions {apart:.1e} m apart, relative difference of unit velocities {units:.1e}");
    // Errors of the accelerations change positions by 1e-7 m; loads on the units agree to 1e-5. The limits are ten
    // times these values.
    assert!(apart < 1e-6 && units < 1e-4);
}

#[test]
fn unstable_water_names_the_particle() {
    let Some(device) = card() else { return };
    let failure_after = |corrupt: fn(&mut Simulation)| {
        let mut simulation = Simulation::on(&device, case(&tank(None))).unwrap();
        corrupt(&mut simulation);
        simulation.load().unwrap();
        let done = simulation.step();
        done.unwrap_err().to_string()
    };
    let message = failure_after(|simulation| simulation.water.velocity[700].x = f64::NAN);
    assert!(message.contains("no longer a finite number") && message.contains("water particle"), "{message}");
    let message = failure_after(|simulation| simulation.water.position[700].z = 3.0);
    assert!(message.contains("has left the domain") && message.contains("z = 3.000 m"), "{message}");
    let message = failure_after(|simulation| simulation.water.density[700] = 1500.0);
    assert!(message.contains("water particle"), "{message}");
}

#[test]
fn velocities_of_all_water_near_surfaces_can_be_read_and_written() {
    let Some(device) = card() else { return };
    let case = case_file("fudo/quick-look.json");
    let start = Simulation::new(case).unwrap();
    let (mut water, mut boundary) = (start.water.clone(), start.boundary.clone());
    let grid = start.solver().grid().clone();
    let high = grid.low + grid.size * DVec3::from_array(grid.count.map(|n| n as f64));
    let mut solver = device.solver(*start.solver().parameters(), [grid.low, high], [grid.low, high]).unwrap();
    solver.device_memory().unwrap().load(&water, &boundary).unwrap();
    solver.sort(&mut water, &boundary);
    // This is more water than the initial buffer can contain.
    let everywhere = Surfaces { bounding_spheres: vec![(high, 100.0)], ..Surfaces::default() };
    let memory = solver.device_memory().unwrap();
    let mut near = memory.fetch_near_water(&everywhere).unwrap();
    assert!(near.indices.iter().copied().eq(0..water.len() as u32));
    let given = |id: u32| DVec3::new(f64::from(id % 512), 1.0, -2.0);
    near.water.velocity = near.indices.iter().map(|&place| given(place)).collect();
    memory.write_near_velocities(&near);
    memory.fetch(&mut water, &mut boundary).unwrap();
    assert!(water.velocity.iter().enumerate().all(|(i, velocity)| *velocity == given(i as u32)));
}
