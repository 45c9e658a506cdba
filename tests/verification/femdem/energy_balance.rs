//! Energy balance of bodies that crack, break into fragments and collide.

use super::*;
use std::path::Path;

/// Results of a run.
struct Run {
    /// Largest residual of the energy balance, divided by the energy input: the initial kinetic energy, or the work if
    /// it is larger [-].
    residual: f64,
    /// Number of failed faces.
    failed: usize,
    /// Energy dissipated by fracture and by friction, divided by the energy input [-].
    lost: [f64; 2],
}

/// Advances a world until a time [s].
fn run_until(mut world: World, until: f64) -> Run {
    let first = world.step_with_energies().unwrap();
    let mut largest_residual = 0.0f64;
    while world.time < until {
        for _ in 0..9 {
            world.step().unwrap();
        }
        largest_residual = largest_residual.max((world.step_with_energies().unwrap().total() - first.total()).abs());
    }
    let last = world.step_with_energies().unwrap();
    let input = first.kinetic.max(last.work);
    Run {
        residual: largest_residual / input,
        failed: world.failures.len(),
        lost: [last.fracture / input, last.friction / input],
    }
}

/// Runs an undamped block of 12 x 8 x 8 cm that hits a plate obliquely at 8 m/s and breaks into fragments.
fn run_thrown_block(penalty: f64, tied: bool, share: f64) -> Run {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/meshes/block_on_plate.msh");
    let mesh = breakwater::femdem::mesh::read(&file, 1.0).unwrap();
    let mut bodies: Vec<Body> =
        mesh.mesh.bodies.iter().map(|body| Body::at_rest(body.tets.clone(), CONCRETE)).collect();
    let number = mesh.mesh.bodies.iter().position(|body| body.name == "block").unwrap();
    bodies[number] = Body {
        cohesion: cohesion(penalty, tied),
        velocity: DVec3::new(2.0, 1.0, -8.0),
        angular_velocity: DVec3::new(5.0, 20.0, 0.0),
        pivot: DVec3::new(0.06, 0.04, 0.04),
        ..bodies[number].clone()
    };
    let mut setup = Setup::of_mesh(&mesh, bodies);
    setup.friction = vec![vec![0.6; 2]; 2];
    let bottom = mesh.faces.boundaries.iter().find(|set| set.name == "plate_bottom").unwrap();
    let nodes: std::collections::BTreeSet<u32> = bottom
        .faces
        .iter()
        .map(|face| &mesh.faces.exteriors[*face as usize])
        .flat_map(|face| face.nodes.map(|k| mesh.mesh.tets[face.tet as usize][usize::from(k)]))
        .collect();
    setup.constraints = vec![constant_velocity(nodes.into_iter().collect(), [Some(0.0); 3])];
    run_until(World::new(setup, share), 3e-4)
}

#[test]
fn energy_balance_of_a_shattering_block_closes_better_with_shorter_time_steps() {
    for (penalty, tied) in [(10.0, true), (50.0, false)] {
        let [long, short] = [0.8, 0.2].map(|share| run_thrown_block(penalty, tied, share));
        println!(
            "p0 = {penalty} E, tied {tied}: residual {:.2e}, with a quarter of the time step {:.1e}; {} failed faces, \
             dissipated by fracture {:.1} %, by friction {:.1} %",
            long.residual,
            short.residual,
            long.failed,
            100.0 * long.lost[0],
            100.0 * long.lost[1]
        );
        // Target: residual below 1 % of the energy input. With a quarter of the time step, the residual is 1/16 as
        // large; with friction on rotating fragments, the residual falls only to 1/4.
        assert!(long.residual < 0.01 && short.residual < 0.5 * long.residual && short.residual < 1e-3);
        assert!(long.failed > 20 && long.lost[0] > 0.02);
    }
}

/// Compresses a prism of 50 x 50 x 100 mm beyond its collapse.
fn run_crushed_prism(penalty: f64, tied: bool) -> Run {
    let mesh = mesh(DVec3::new(0.05, 0.05, 0.1), [2, 2, 4]);
    let mut setup = setup(&mesh, cohesion(penalty, tied));
    setup.friction = vec![vec![0.6]];
    let nodes_at = |z: f64| -> Vec<u32> {
        (0..mesh.mesh.nodes.len() as u32).filter(|n| (mesh.mesh.nodes[*n as usize].z - z).abs() < 1e-9).collect()
    };
    let velocity = History::new([(0.0, [0.0]), (2e-4, [-0.5])]).unwrap();
    setup.constraints = vec![
        constant_velocity(nodes_at(0.0), [None, None, Some(0.0)]),
        Constraint { nodes: nodes_at(0.1), velocity: [None, None, Some(velocity)] },
    ];
    run_until(World::new(setup, 0.8), 9e-4)
}

#[test]
fn energy_balance_of_a_collapsed_prism_closes() {
    for (penalty, tied) in [(2.0, true), (50.0, false)] {
        let run = run_crushed_prism(penalty, tied);
        println!(
            "p0 = {penalty} E, tied {tied}: residual {:.1e}; {} failed faces, dissipated by fracture {:.0} %, by friction {:.0} %",
            run.residual,
            run.failed,
            100.0 * run.lost[0],
            100.0 * run.lost[1]
        );
        // Target: residual below 1 % of the energy input.
        assert!(run.residual < 0.01 && run.failed > 100 && run.lost[1] > 0.05);
    }
}
