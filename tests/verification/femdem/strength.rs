//! Strength of slowly loaded bodies: compression, bending, splitting.

use super::*;
use breakwater::femdem::mesh;
use std::path::Path;

/// Load-displacement curve of a body that a constraint loads downwards.
struct Curve {
    /// Displacement [m], mean force since the previous row [N], and the value of `watch` in [`load`].
    rows: Vec<[f64; 3]>,
    world: World,
    /// Largest residual of the energy balance until the largest force, divided by the work [-].
    residual: f64,
    /// Kinetic energy divided by strain energy, at the largest force [-].
    swing: f64,
}

impl Curve {
    fn peak(&self) -> f64 {
        self.rows.iter().map(|row| row[1]).fold(0.0, f64::max)
    }

    /// Returns the slope of the force against the watched value [N/m], by least squares over the rows in which the
    /// force is between two shares of its peak.
    fn slope(&self, from: f64, to: f64) -> f64 {
        let peak = self.peak();
        let top = self.rows.iter().position(|row| row[1] == peak).unwrap();
        let used = || self.rows[..top].iter().filter(|row| row[1] > from * peak && row[1] < to * peak);
        let count = used().count() as f64;
        let mean = |k: usize| used().map(|row| row[k]).sum::<f64>() / count;
        let [x, y] = [mean(2), mean(1)];
        used().map(|row| (row[2] - x) * (row[1] - y)).sum::<f64>() / used().map(|row| (row[2] - x).powi(2)).sum::<f64>()
    }
}

/// Returns a downward velocity history that reaches a speed [m/s] after a time [s].
fn downwards(speed: f64, after: f64) -> History<1> {
    History::new([(0.0, [0.0]), (after, [-speed])]).unwrap()
}

/// Advances until the force has fallen to 0.6 of its peak; `row` is the time between rows [s]. The force is the
/// increase of work divided by the increase of displacement, so only the constraint with this velocity may do work.
fn load(setup: Setup, share: f64, velocity: &History<1>, row: f64, watch: impl Fn(&World) -> f64 + Send) -> Curve {
    rayon::scope(|_| load_in_the_pool(setup, share, velocity, row, watch))
}

fn load_in_the_pool(setup: Setup, share: f64, velocity: &History<1>, row: f64, watch: impl Fn(&World) -> f64) -> Curve {
    let mut world = World::new(setup, share);
    let mut rows: Vec<[f64; 3]> = Vec::new();
    let (mut displacement, mut before, mut peak) = (0.0, [0.0; 2], 0.0f64);
    let (mut residual, mut largest, mut swing) = (0.0f64, 0.0f64, 0.0);
    let first = world.step_with_energies().unwrap().total();
    // While the velocity still rises, waves lower the force repeatedly, so the run continues.
    let rises = |world: &World| velocity.at(world.time)[0] > velocity.at(f64::MAX)[0];
    while rises(&world) || rows.last().is_none_or(|row| row[1] > 0.6 * peak || row[1] < 1e-3 * peak) {
        let until = world.time + row;
        while world.time < until {
            displacement -= velocity.at(world.time - 0.5 * world.dt)[0] * world.dt;
            world.step().unwrap();
        }
        displacement -= velocity.at(world.time - 0.5 * world.dt)[0] * world.dt;
        let energies = world.step_with_energies().unwrap();
        let force = (energies.work - before[1]) / (displacement - before[0]);
        before = [displacement, energies.work];
        rows.push([displacement, force, watch(&world)]);
        residual = residual.max((energies.total() - first).abs());
        if force > peak {
            (peak, swing) = (force, energies.kinetic / energies.strain);
            largest = residual / energies.work;
        }
    }
    Curve { rows, world, residual: largest, swing }
}

fn nodes_where(mesh: &PreparedMesh, is_there: impl Fn(DVec3) -> bool) -> Vec<u32> {
    (0..mesh.mesh.nodes.len() as u32).filter(|n| is_there(mesh.mesh.nodes[*n as usize])).collect()
}

fn material(strength: Strength, penalty: f64, tied: bool, mesh: &PreparedMesh) -> Setup {
    let cohesion = Some(Cohesion { strength, penalty: penalty * CONCRETE.young_modulus, range: Range::Exact, tied });
    let mut setup = setup(mesh, cohesion);
    setup.friction = vec![vec![0.6]];
    setup
}

/// Returns the largest stress of a prism of 50 x 50 x 100 mm between smooth platens [Pa].
fn crush_prism(file: &Path, penalty: f64, tied: bool) -> f64 {
    let mesh = mesh::read(file, 1.0).unwrap();
    let mut setup = material(STRENGTH, penalty, tied, &mesh);
    // The load is slow: a wave passes through the prism sixty times before the prism breaks.
    let velocity = downwards(0.15, 5e-4);
    setup.constraints = vec![
        constant_velocity(nodes_where(&mesh, |x| x.z < 1e-9), [None, None, Some(0.0)]),
        Constraint { nodes: nodes_where(&mesh, |x| x.z > 0.1 - 1e-9), velocity: [None, None, Some(velocity.clone())] },
    ];
    let curve = load(setup, 0.8, &velocity, 2e-5, |world| world.time);
    let slid = curve.world.failures.iter().filter(|failure| failure.by_sliding).count();
    println!(
        "{}, tied {tied}: strength {:.2} MPa, {} of {} faces failed by sliding, kinetic over strain energy {:.1e}, residual {:.1e}",
        file.file_name().unwrap().display(),
        curve.peak() / 25e-4 / 1e6,
        slid,
        curve.world.failures.len(),
        curve.swing,
        curve.residual
    );
    assert!(curve.swing < 0.05 && slid * 10 > curve.world.failures.len() * 9);
    curve.peak() / 25e-4
}

/// Returns the Mohr-Coulomb strength 2 c cos(phi) / (1 - sin(phi)) for the concrete of Guo, Latham & Xiang (2015),
/// table 2: 57.16 MPa.
fn uniaxial_strength() -> f64 {
    let phi = STRENGTH.friction.atan();
    2.0 * STRENGTH.cohesion * phi.cos() / (1.0 - phi.sin())
}

fn coarse(name: &str) -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("cases/fracture/meshes/{name}-coarse.msh"))
}

/// Strength reached with elements of 12.5 mm: 58.6 MPa with tied faces; with joints, 55.1 MPa for the penalty
/// p_0 = 50 E and 47.7 MPa for p_0 = 20 E.
#[test]
#[ignore = "minutes: \
    cargo test --release --test verification -- --ignored --nocapture femdem::strength::a_prism"]
fn a_prism_is_crushed_at_the_uniaxial_strength() {
    for (penalty, tied) in [(2.0, true), (50.0, false)] {
        let found = crush_prism(&coarse("compression"), penalty, tied);
        // Target: within 10 % of the Mohr-Coulomb strength.
        assert!((found / uniaxial_strength() - 1.0).abs() < 0.1, "{:.2} MPa", found / 1e6);
    }
}

/// Reached strength: 58.0 MPa. This command makes the mesh:
/// tools/mesh/make.py compression --size 0.0075 --out runs/meshes/compression-7.5mm.msh
#[test]
#[ignore = "minutes, needs a mesh of 7.5 mm: \
    cargo test --release --test verification -- --ignored --nocapture femdem::strength::a_finer_prism"]
fn a_finer_prism_is_crushed_at_the_uniaxial_strength() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("runs/meshes/compression-7.5mm.msh");
    let found = crush_prism(&file, 2.0, true);
    assert!((found / uniaxial_strength() - 1.0).abs() < 0.1, "{:.2} MPa", found / 1e6);
}

/// Creates Guo's beam of 320 x 40 x 20 mm on supports 314 mm apart, from cells of 24 tetrahedra, with `cells` cells
/// over the height. The mesh has half the width of the beam; y = 0 is a plane of symmetry.
fn beam(cells: usize) -> PreparedMesh {
    let (length, height, span) = (0.32, 0.04, 0.314);
    let mut mesh = block(DVec3::new(length, 0.01, height), [8 * cells, cells / 4, cells], Pattern::Centred);
    let cell = height / cells as f64;
    let overhang = 0.5 * (length - span);
    for node in &mut mesh.nodes {
        // Moves nodes along x, so that the second node from each end is at a support.
        let inner = overhang + (node.x - cell) * span / (length - 2.0 * cell);
        let end = if node.x < 0.5 * length { node.x } else { length - node.x };
        let x = if end >= cell { inner } else { end * overhang / cell };
        node.x = if end < cell && node.x > 0.5 * length { length - x } else { x } - 0.5 * length;
    }
    mesh.sets.clear();
    prepare(mesh).unwrap()
}

/// Returns largest load [N] and stiffness [N/m] of the whole beam in three-point bending.
fn bend_beam(cells: usize, penalty: f64, tied: bool, speed: f64) -> [f64; 2] {
    let mesh = beam(cells);
    let strength = Strength {
        tensile: 3e6,
        cohesion: 10.5e6,
        friction: STRENGTH.friction,
        opening_energy: 30.0,
        sliding_energy: 30.0,
    };
    let mut setup = material(strength, penalty, tied, &mesh);
    setup.bodies[0].contact_penalty *= 0.05;
    // The velocity rises over one period of the beam, so the beam does not oscillate.
    let velocity = downwards(speed, 1.6e-3);
    let near = 1e-7;
    let is_support = |x: DVec3| (x.x.abs() - 0.157).abs() < near && x.z.abs() < near;
    let is_load = |x: DVec3| x.x.abs() < near && (x.z - 0.04).abs() < near;
    let on_plane = |x: DVec3| x.y < near;
    let constrain = |is_there: &dyn Fn(DVec3) -> bool, velocity: [Option<History<1>>; 3]| {
        let split_by_plane = |plane: bool| Constraint {
            nodes: nodes_where(&mesh, |x| is_there(x) && on_plane(x) == plane),
            velocity: [velocity[0].clone(), plane.then(|| 0.0.into()), velocity[2].clone()],
        };
        [split_by_plane(true), split_by_plane(false)]
    };
    let plane = nodes_where(&mesh, |x| on_plane(x) && !is_support(x) && !is_load(x));
    setup.constraints = [
        constrain(&is_support, [None, None, Some(0.0.into())]),
        constrain(&is_load, [Some(0.0.into()), None, Some(velocity.clone())]),
    ]
    .concat();
    setup.constraints.push(constant_velocity(plane, [None, Some(0.0), None]));
    // The deflection is measured at nodes at half the height, which excludes local dents at load and supports.
    let axis: Vec<usize> = [0.0, -0.157, 0.157]
        .map(|x| {
            let found = nodes_where(&mesh, |at| (at - DVec3::new(x, 0.0, 0.02)).length() < near);
            found[0]
        })
        .map(|node| mesh.mesh.tets.iter().position(|tet| tet.contains(&node)).map(|t| (t, node)).unwrap())
        .map(|(t, node)| 4 * t + mesh.mesh.tets[t].iter().position(|n| *n == node).unwrap())
        .to_vec();
    let deflection = |world: &World| {
        let z = |copy: usize| world.nodes.position[world.tets.nodes[copy / 4][copy % 4] as usize].z;
        0.5 * (z(axis[1]) + z(axis[2])) - z(axis[0])
    };
    let curve = load(setup, 0.8, &velocity, 2e-6 / speed, deflection);
    // The stiffness is the slope of the load against the deflection before the first faces fail.
    let (peak, stiffness) = (2.0 * curve.peak(), 2.0 * curve.slope(0.1, 0.4));
    println!(
        "{cells} cells, tied {tied}: {peak:.1} N, {:.3} MN/m, {} faces failed, kinetic over strain energy {:.1e}, residual {:.1e}",
        stiffness / 1e6,
        curve.world.failures.len(),
        curve.swing,
        curve.residual
    );
    [peak, stiffness]
}

/// Largest load of the beam in these tests [N], computed with a fictitious crack of the same softening in plane stress
/// (tools/fictitious-crack/beam). Guo's results are 298.8 N with elements of 2.5 mm and 279.3 N with 5 mm.
const BY_FICTITIOUS_CRACK: f64 = 308.1;

/// Largest load reached with cells of 10 mm and joints of the penalty p_0 = 20 E: 338.8 N, 10 % above the load of the
/// fictitious crack. At half the loading speed, the loads are 331 and 328 N on cells of 10 and 5 mm respectively. With
/// p_0 = 50 E and cells of 10 mm, the load is 339.8 N, and 334.5 N at half the loading speed.
#[test]
fn a_beam_breaks_at_the_load_of_a_fictitious_crack() {
    let [peak, _] = bend_beam(4, 20.0, false, 0.05);
    // Target: within 15 % of the load of the fictitious crack.
    assert!((peak / BY_FICTITIOUS_CRACK - 1.0).abs() < 0.15, "{peak:.1} N");
}

/// Guo's beam has a stiffness of 2.0 MN/m, half of the stiffness by beam theory, because its joints are soft. With
/// equally soft joints, the beam of this test has the same largest load as Guo's beam.
#[test]
#[ignore = "10 minutes: \
    cargo test --release --test verification -- --ignored --nocapture femdem::strength::a_beam_of_soft_joints"]
fn a_beam_of_soft_joints_breaks_at_the_published_load() {
    let [peak, _] = bend_beam(8, 2.0, false, 0.025);
    // Target: largest load within 15 % of Guo's 279.3 N for elements of 5 mm.
    assert!((peak / 279.3 - 1.0).abs() < 0.15, "{peak:.1} N");
}

/// The test does not check the largest load. Tied faces open by the mean stress of two tetrahedra, which is less than
/// the largest stress on the plane between them. A node splits only after the faces around it have failed. With cells
/// of 10 and 5 mm, the beam breaks at 429 and 360 N, 39 and 17 % above the load of the fictitious crack.
#[test]
fn a_beam_bends_with_the_stiffness_of_beam_theory() {
    let [_, stiffness] = bend_beam(4, 10.0, true, 0.05);
    // Target: stiffness within 3 % of Timoshenko's 4.07 MN/m.
    assert!((stiffness / 4.07e6 - 1.0).abs() < 0.03, "{:.3} MN/m", stiffness / 1e6);
}

/// Returns the largest force on a disc of 40 mm diameter, 15 mm thick, loaded on arcs of 10 degrees [N].
fn split_disc(penalty: f64, tied: bool, opening_energy: f64) -> f64 {
    let mesh = mesh::read(&coarse("disc"), 1.0).unwrap();
    let strength = Strength {
        tensile: 3e6,
        cohesion: 15e6,
        friction: STRENGTH.friction,
        opening_energy,
        sliding_energy: opening_energy,
    };
    let mut setup = material(strength, penalty, tied, &mesh);
    setup.bodies[0].contact_penalty *= 0.1;
    let velocity = downwards(0.1, 1e-4);
    let set = |name: &str| -> Vec<u32> {
        let set = mesh.faces.boundaries.iter().find(|set| set.name == name).unwrap();
        let corners = set.faces.iter().flat_map(|face| {
            let exterior = &mesh.faces.exteriors[*face as usize];
            exterior.nodes.map(|k| mesh.mesh.tets[exterior.tet as usize][usize::from(k)])
        });
        let nodes: std::collections::BTreeSet<u32> = corners.collect();
        nodes.into_iter().collect()
    };
    setup.constraints = vec![
        constant_velocity(set("bottom"), [None, None, Some(0.0)]),
        Constraint { nodes: set("top"), velocity: [None, None, Some(velocity.clone())] },
    ];
    let curve = load(setup, 0.8, &velocity, 5e-6, |world| world.time);
    println!(
        "G_f {opening_energy}, tied {tied}: {:.0} N, {} faces failed, kinetic over strain energy {:.1e}, residual {:.1e}",
        curve.peak(),
        curve.world.failures.len(),
        curve.swing,
        curve.residual
    );
    curve.peak()
}

/// This test fails: the disc is smaller than the characteristic length E G_f / f_t^2 = 144 mm (modulus E, fracture
/// energy G_f, tensile strength f_t), so it does not split at its tensile strength. With G_f = 5 J/m2 and joints only
/// in the middle plane, the largest load is 1.1 times the expected load.
#[test]
#[ignore = "minutes, known to fail: \
    cargo test --release --test verification -- --ignored --nocapture femdem::strength::a_disc"]
fn a_disc_splits_at_its_tensile_strength() {
    let found = split_disc(2.0, true, 50.0);
    // Target: within 15 % of P = 2827 N, from 2 P / (pi D L) = f_t with the diameter D and the thickness L.
    assert!((found / 2827.0 - 1.0).abs() < 0.15, "{found:.0} N");
}
