//! Convex parts of units from STL: the parts of catalogue units, cones, round bodies and other shapes fill the unit.

use std::f64::consts::TAU;
use std::time::Instant;

use breakwater::geometry::{
    armour_unit::ArmourUnit,
    convex::{polyhedron::Polyhedron, union},
    decomposition::{MOST_CORNERS, MOST_PARTS, decompose},
    solid::Solid,
};
use glam::{DQuat, DVec3, EulerRot};

/// Decomposes a body for the default rounding radius, 0.05 of the height. Checks the bounds of the parts and returns the
/// volume error [-].
fn volume_error(name: &str, solid: &Solid) -> f64 {
    let [low, high] = solid.bounds();
    let clock = Instant::now();
    let found = decompose(solid, 0.05 / 0.9 * (high.z - low.z));
    let corners: Vec<usize> = found.parts.iter().map(|part| part.corners().len()).collect();
    println!(
        "{name}: {} triangles, {} parts, {} corners, volume error {:.2} %, {:.2} s",
        solid.triangles().len(),
        corners.len(),
        corners.iter().sum::<usize>(),
        100.0 * found.volume_error,
        clock.elapsed().as_secs_f64()
    );
    assert!(corners.len() <= MOST_PARTS && corners.iter().all(|count| *count <= MOST_CORNERS), "{name}: {corners:?}");
    found.volume_error
}

/// The body as a file contains it: turned, scaled and moved, in single precision.
fn as_in_a_file(solid: &Solid, scale: f64, shift: DVec3) -> Solid {
    let turn = DQuat::from_euler(EulerRot::XYZ, 0.3, 0.7, 1.1);
    let vertices = solid.vertices().iter().map(|v| (turn * *v * scale + shift).as_vec3().as_dvec3()).collect();
    Solid::new(vertices, solid.triangles().to_vec()).unwrap()
}

fn of_blocks(blocks: &[Polyhedron]) -> Solid {
    let (vertices, triangles) = union::surface(blocks);
    Solid::new(vertices, triangles).unwrap()
}

fn block(low: [f64; 3], high: [f64; 3]) -> Polyhedron {
    let corner = |n: usize| DVec3::from_array(std::array::from_fn(|k| [low[k], high[k]][n >> k & 1]));
    Polyhedron::hull(&(0..8).map(corner).collect::<Vec<_>>()).unwrap()
}

/// Surface with the given distance from the origin in each direction, from rings of points.
fn star(around: usize, rings: usize, radius: impl Fn(DVec3) -> f64) -> Solid {
    let direction = |row: usize, k: usize| {
        let [a, b] = [TAU * k as f64 / around as f64, 0.5 * TAU * row as f64 / rings as f64];
        DVec3::new(a.cos() * b.sin(), a.sin() * b.sin(), -b.cos())
    };
    let number = |row: usize, k: usize| ((row - 1) * around + k % around) as u32;
    let mut directions: Vec<DVec3> = (1..rings).flat_map(|row| (0..around).map(move |k| direction(row, k))).collect();
    directions.extend([DVec3::NEG_Z, DVec3::Z]);
    let [bottom, top] = [directions.len() - 2, directions.len() - 1].map(|v| v as u32);
    let mut triangles = Vec::new();
    for k in 0..around {
        for row in 1..rings - 1 {
            triangles.push([number(row, k), number(row, k + 1), number(row + 1, k + 1)]);
            triangles.push([number(row, k), number(row + 1, k + 1), number(row + 1, k)]);
        }
        triangles
            .extend([[bottom, number(1, k + 1), number(1, k)], [top, number(rings - 1, k), number(rings - 1, k + 1)]]);
    }
    Solid::new(directions.into_iter().map(|d| radius(d) * d).collect(), triangles).unwrap()
}

fn tetrahedron_axes() -> [DVec3; 4] {
    [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]].map(|a| DVec3::from(a).normalize())
}

/// Frustum along an axis from the origin, with the given length, end radii and number of sides.
fn frustum(axis: DVec3, length: f64, radii: [f64; 2], sides: usize) -> Polyhedron {
    let (u, v) = axis.any_orthonormal_pair();
    let ring = |along: f64, radius: f64| -> Vec<DVec3> {
        let angles = (0..sides).map(|k| TAU * k as f64 / sides as f64);
        angles.map(|a| along * axis + radius * (a.cos() * u + a.sin() * v)).collect()
    };
    Polyhedron::hull_of_polygons(&ring(0.0, radii[0]), &ring(length, radii[1])).unwrap()
}

/// Maximum of two numbers, rounded where they differ by less than `width`.
fn smooth_maximum(a: f64, b: f64, width: f64) -> f64 {
    a.max(b) + 0.25 * width * (1.0 - (a - b).abs() / width).max(0.0).powi(2)
}

/// Tetrapod of four cones with rounded joints and rims.
fn rounded_tetrapod(around: usize) -> Solid {
    let cone = |p: DVec3, axis: DVec3| {
        let along = p.dot(axis);
        let side = (p - axis * along).length() - (0.264 - 0.175 * along);
        smooth_maximum(smooth_maximum(side, along - 0.644, 0.08), -along - 0.2, 0.05)
    };
    let axes = tetrahedron_axes();
    let distance = |p: DVec3| {
        let parts = axes.iter().map(|axis| -cone(p, *axis));
        -parts.reduce(|a, b| smooth_maximum(a, b, 0.08)).unwrap_or(f64::MIN)
    };
    star(around, around, |direction| {
        let outermost = (0..=120).rev().map(|n| 0.01 * f64::from(n)).find(|r| distance(*r * direction) < 0.0);
        let (mut low, mut high) = (outermost.unwrap(), outermost.unwrap() + 0.01);
        for _ in 0..30 {
            let middle = 0.5 * (low + high);
            *(if distance(middle * direction) < 0.0 { &mut low } else { &mut high }) = middle;
        }
        low
    })
}

/// Largest allowed error in these tests. The program refuses 0.05; the search stops at 0.015, and the simplification of
/// round parts adds up to 0.02.
const LIMIT: f64 = 0.035;

#[test]
fn catalogue_units_are_divided() {
    let dolos = |waist: f64| (format!("Dolos {waist}"), ArmourUnit::dolos(1.0, waist, 0.03).unwrap());
    let mut units = vec![
        ("cube".to_owned(), ArmourUnit::cuboid(DVec3::ONE, 0.03).unwrap()),
        ("cuboid".to_owned(), ArmourUnit::cuboid(DVec3::new(0.05, 0.2, 0.1), 0.03).unwrap()),
        ("grooved cube".to_owned(), ArmourUnit::grooved_cube(0.04, 0.03).unwrap()),
        ("Core-Loc".to_owned(), ArmourUnit::core_loc(3.0, 0.03).unwrap()),
        ("Tetrapod".to_owned(), ArmourUnit::tetrapod(0.1, 0.03).unwrap()),
    ];
    units.extend([0.3, 0.34, 0.4].map(dolos));
    for (name, unit) in units {
        let error = volume_error(&name, unit.solid());
        assert!(error < LIMIT, "{name}: {error}");
    }
    let core_loc = as_in_a_file(ArmourUnit::core_loc(1.0, 0.03).unwrap().solid(), 1.0, DVec3::new(3.0, 1.0, 1.0));
    assert!(volume_error("turned Core-Loc", &core_loc) < LIMIT);
}

#[test]
fn cone_tetrapods_are_divided() {
    let sharp = of_blocks(&tetrahedron_axes().map(|axis| frustum(axis, 0.644, [0.264, 0.151], 40)));
    assert!(volume_error("cone Tetrapod", &sharp) < LIMIT);
    assert!(volume_error("rounded Tetrapod", &rounded_tetrapod(48)) < LIMIT);
}

#[test]
fn convex_bodies_with_fine_meshes_are_a_single_part() {
    let cylinder = star(400, 40, |d| (0.3 / d.x.hypot(d.y)).min(0.5 / d.z.abs()));
    // The rims of this cylinder are not exactly at points of the mesh, so its faces have small dents.
    assert!(volume_error("cylinder", &cylinder) < LIMIT);
    let smooth = of_blocks(&[frustum(DVec3::Z, 1.0, [0.3, 0.3], 400)]);
    assert!(volume_error("smooth cylinder", &smooth) < LIMIT);
    assert!(volume_error("sphere", &star(50, 50, |_| 0.5)) < LIMIT);
    assert_eq!(decompose(&smooth, 0.05).parts.len(), 1);
}

#[test]
fn other_shapes_are_divided() {
    let angle = of_blocks(&[block([0.0; 3], [1.0, 0.4, 0.5]), block([0.0; 3], [0.4, 1.0, 0.5])]);
    let frame = of_blocks(&[
        block([0.0, 0.0, 0.0], [1.0, 0.25, 1.0]),
        block([0.0, 0.75, 0.0], [1.0, 1.0, 1.0]),
        block([0.0, 0.25, 0.0], [0.25, 0.75, 1.0]),
        block([0.75, 0.25, 0.0], [1.0, 0.75, 1.0]),
    ]);
    let arms = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]).map(|axis| frustum(axis, 0.5, [0.16, 0.14], 12));
    let star_shaped = of_blocks(&arms.collect::<Vec<_>>());
    let bodies = [
        ("angle", angle.clone()),
        ("turned angle far from the origin", as_in_a_file(&angle, 1.0, DVec3::new(300.0, -100.0, 20.0))),
        ("hollow block", frame.clone()),
        ("turned hollow block in millimetres", as_in_a_file(&frame, 1000.0, DVec3::ZERO)),
        ("six arms", star_shaped),
        ("waist", star(60, 60, |d| 0.3 + 0.25 * d.z * d.z)),
    ];
    for (name, body) in bodies {
        let error = volume_error(name, &body);
        assert!(error < LIMIT, "{name}: {error}");
    }
}
