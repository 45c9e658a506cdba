use breakwater::geometry::armour_unit::ArmourUnit;
use breakwater::particles::{bed::*, boundary::Boundary, fill::*, unit::*};
use breakwater::rigid::BodyState;
use breakwater::sph::{
    density_diffusion::Diffusion, equation_of_state::Tait, kernel::Wendland, parameters::*, step::Solver,
};
use glam::{DQuat, DVec2, DVec3};
fn main() {
    let args: Vec<f64> = std::env::args().skip(1).map(|a| a.parse().unwrap()).collect();
    let (dp, depth, zc, t_end) = (args[0], args[1], args[2], args[3]);
    let width = (0.2 / dp).round() * dp;
    let length = width;
    let g = 9.81;
    let c0 = 15.0 * (g * depth as f64).sqrt();
    let tait = Tait { rho0: 1000.0, c0, gamma: 7.0 };
    let h = 1.2 * 3f64.sqrt() * dp;
    let parameters = Parameters {
        dp,
        kernel: Wendland::new(h),
        tait,
        alpha: 0.04,
        diffusion: Diffusion::new(0.1, h, c0, 1000.0, 7.0, g),
        gravity: g,
        cfl: 0.2,
        boundary: BoundaryCondition::ModifiedDynamic,
        periodic_width: Some(width),
    };
    let across = Across { width, count: (width / dp).round() as u32, walls: false };
    let bed = |_x: f64| 0.0;
    let basin = Basin {
        x: [0.0, length],
        across,
        dp,
        bed: &bed,
        surface: &|_| depth,
        velocity: &|_, _| DVec2::ZERO,
        gravity: g,
    };
    let mut water = basin.fill(&tait);
    let outline = Outline::new(vec![
        DVec2::new(0.0, 1.5 * depth),
        DVec2::new(0.0, 0.0),
        DVec2::new(length, bed(length)),
        DVec2::new(length, 1.5 * depth),
    ]);
    let fixed = outline_particles(&outline, &across, dp, 3);
    let unit = ArmourUnit::tetrapod(0.077, 0.05).unwrap();
    let solid = unit.solid();
    let [low, high] = solid.bounds();
    let v = solid.volume_properties().volume;
    let up = unit_particles(|p| solid.project(p), low, high, v, dp);
    let zc = if zc < 0.0 { unit.standing_height() } else { zc };
    let c = DVec3::new(0.5 * length + 0.3 * dp, 0.5 * width + 0.1 * dp, zc);
    let before = water.len();
    clear_solid(&mut water, LEAST_DEPTH * dp, |p| {
        let (n, d) = solid.project(p - c);
        (n + c, d)
    });
    println!("water {} removed {} unit {} V/dp3 {:.1}", water.len(), before - water.len(), up.len(), v / dp.powi(3));
    let mut boundary = Boundary::new(&fixed, &[], &up, 1, 1000.0);
    boundary.move_unit(0, &BodyState::at_rest(c, DQuat::IDENTITY));
    let mut solver = Solver::new(
        parameters,
        DVec3::new(-5.0 * dp, 0.0, -5.0 * dp),
        DVec3::new(length + 5.0 * dp, width, 2.0 * depth),
    );
    let (mut t, mut n) = (0.0, 0);
    let mut next = 0.0;
    let (mut sum, mut cnt) = (DVec3::ZERO, 0.0);
    while t < t_end {
        solver.sort_and_list(&mut water, &boundary);
        solver.boundary_densities(&water, &mut boundary);
        solver.rates();
        let dt = solver.limits().time_step(&parameters);
        let f = solver.unit_loads(&boundary, &[c])[0].0;
        sum += f;
        cnt += 1.0;
        if t >= next {
            let vmax = water.velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
            let inside = water.position.iter().filter(|p| solid.signed_distance(**p - c) < 0.0).count();
            let near = water.position.iter().filter(|p| solid.signed_distance(**p - c) < 0.3 * dp).count();
            println!(
                "t {t:.3} n {n} vmax {vmax:.4} F/archimedes {:.4?} inside {inside} near {near}",
                (sum / cnt / (9810.0 * v)).to_array()
            );
            sum = DVec3::ZERO;
            cnt = 0.0;
            next += t_end / 10.0;
            if args.len() > 4 {
                let mut fb = DVec3::ZERO;
                for i in boundary.walls().end..boundary.len() {
                    let p = tait.pressure(boundary.density[i]);
                    let pe = 9810.0 * (depth - boundary.position[i].z);
                    fb += boundary.to_surface[i] * p;
                    if args[4] > 1.0 {
                        println!(
                            "   z {:.4} p/p_exact {:.3} depth {:.4}",
                            boundary.position[i].z - c.z,
                            p / pe,
                            boundary.to_surface[i].length()
                        );
                    }
                }
            }
        }
        solver.predict(dt, &water, &mut boundary, |_| ());
        solver.rates();
        solver.correct(dt, &mut water, &mut boundary);
        t += dt;
        n += 1;
    }
}
