use breakwater::particles::{bed::*, boundary::Boundary, fill::*};
use breakwater::sph::{
    density_diffusion::Diffusion, equation_of_state::Tait, kernel::Wendland, parameters::*, step::Solver,
};
use glam::{DVec2, DVec3};
use std::time::Instant;
fn main() {
    let args: Vec<f64> = std::env::args().skip(1).map(|a| a.parse().unwrap()).collect();
    let (dp, depth, length, t_end) = (args[0], args[1], args[2], args[3]);
    let threads = args.get(4).copied().unwrap_or(2.0) as usize;
    let slope = args.get(5).copied().unwrap_or(0.0);
    rayon::ThreadPoolBuilder::new().num_threads(threads).build_global().unwrap();
    let width = (0.16 / dp).round() * dp;
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
    let bed = |x: f64| slope * x;
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
    let mut boundary = Boundary::new(&fixed, &[], &[], 0, 1000.0);
    let mut solver = Solver::new(
        parameters,
        DVec3::new(-5.0 * dp, 0.0, -5.0 * dp),
        DVec3::new(length + 5.0 * dp, width, 2.0 * depth),
    );
    println!("water {} boundary {}", water.len(), boundary.len());
    let mut t = 0.0;
    let mut n = 0;
    let mut ph = [0.0; 5];
    let start = Instant::now();
    let mut next = 0.0;
    while t < t_end {
        let t0 = Instant::now();
        solver.sort_and_list(&mut water, &boundary);
        let t1 = Instant::now();
        solver.boundary_densities(&water, &mut boundary);
        let t2 = Instant::now();
        solver.rates();
        let t3 = Instant::now();
        let dt = solver.limits().time_step(&parameters);
        if t >= next {
            let ke: f64 = water.velocity.iter().zip(&water.mass).map(|(v, m)| 0.5 * m * v.length_squared()).sum();
            let vmax = water.velocity.iter().map(|v| v.length()).fold(0.0, f64::max);
            let mut err = 0.0f64;
            let mut worst = 0.0f64;
            let mut cnt = 0.0;
            for (p, r) in water.position.iter().zip(&water.density) {
                let e = (tait.pressure(*r) - 9810.0 * (depth - p.z)) / (9810.0 * depth);
                err += e * e;
                cnt += 1.0;
                worst = worst.max(e.abs());
            }
            let k = (0..water.len())
                .max_by(|&a, &b| water.velocity[a].length().total_cmp(&water.velocity[b].length()))
                .unwrap();
            let kb = (0..boundary.len()).max_by(|&a, &b| boundary.density[a].total_cmp(&boundary.density[b])).unwrap();
            let km = (0..boundary.len()).min_by(|&a, &b| boundary.density[a].total_cmp(&boundary.density[b])).unwrap();
            println!(
                "  fastest {:.4} v {:.3}  boundary max {:.1} at {:.4} min {:.1} at {:.4} (n {:.4})",
                water.position[k],
                water.velocity[k],
                boundary.density[kb],
                boundary.position[kb],
                boundary.density[km],
                boundary.position[km],
                boundary.to_surface[km]
            );
            let zmax = water.position.iter().map(|p| p.z).fold(0.0, f64::max);
            println!(
                "t {t:.3} n {n} dt {dt:.3e} ke {ke:.3e} vmax {vmax:.4} p rms {:.4} worst {worst:.4} ztop {:.5} list {:.0}",
                (err / cnt as f64).sqrt(),
                zmax - depth,
                solver.mean_list_length()
            );
            next += t_end / 10.0;
        }
        solver.predict(dt, &water, &mut boundary, |_| ());
        let t4 = Instant::now();
        solver.rates();
        solver.correct(dt, &mut water, &mut boundary);
        let t5 = Instant::now();
        for (k, d) in [t1 - t0, t2 - t1, t3 - t2, t4 - t3, t5 - t4].iter().enumerate() {
            ph[k] += d.as_secs_f64();
        }
        t += dt;
        n += 1;
    }
    let wall = start.elapsed().as_secs_f64();
    println!(
        "{n} steps {wall:.2} s, {:.3} M eval/s, phases list {:.3} mdbc {:.3} rates {:.3} limits+predict {:.3} rates+correct {:.3}",
        2.0 * (n * water.len()) as f64 / wall / 1e6,
        ph[0] / wall,
        ph[1] / wall,
        ph[2] / wall,
        ph[3] / wall,
        ph[4] / wall
    );
}
