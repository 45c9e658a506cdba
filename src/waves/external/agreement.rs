//! Test: if the files of different programs contain the same velocity, all readers return the same table.

use std::fs::{self, File};
use std::path::Path;

use super::openfoam::{Frame, Up, Vertical, probes};
use super::swash::{self, Heading};
use super::table::{Layers, Place, VelocityTable};
use super::velx;

const PLACE: Place = Place { bed_z_m: -0.8, still_water_z_m: 0.0, gravity_m_s2: 9.81, layers: Layers::AtLeastTwo };
const LAYERS: usize = 8;

/// Velocity under the node of a standing wave 4 m long in 0.8 m of water [m/s]; the surface there does not move.
fn velocity(z: f64, t: f64) -> f64 {
    let k = std::f64::consts::TAU / 4.0;
    let omega = (PLACE.gravity_m_s2 * k * (k * PLACE.depth_m()).tanh()).sqrt();
    0.3 * (k * (z - PLACE.bed_z_m)).cosh() / (k * PLACE.depth_m()).cosh() * (omega * t).cos()
}

/// Levels z at mid-height of the layers [m], from the bed upwards.
fn levels() -> Vec<f64> {
    (0..LAYERS).map(|k| PLACE.bed_z_m + (k as f64 + 0.5) * PLACE.depth_m() / LAYERS as f64).collect()
}

fn table() -> VelocityTable {
    let times_s: Vec<f64> = (0..200).map(|i| 0.02 * f64::from(i)).collect();
    VelocityTable {
        surface_z_m: Some(vec![PLACE.still_water_z_m; times_s.len()]),
        heights_m: vec![levels(); times_s.len()],
        velocities_m_s: times_s.iter().map(|&t| levels().iter().map(|&z| velocity(z, t)).collect()).collect(),
        times_s,
    }
}

fn through_velx(folder: &Path) -> VelocityTable {
    let path = folder.join("wave_velx.csv");
    table().velx([3.0, 0.0], &levels()).write(File::create(&path).unwrap()).unwrap();
    velx::read(&path, None, &PLACE).unwrap().0
}

fn through_swash(folder: &Path) -> VelocityTable {
    let (level, velocity) = (folder.join("level.tbl"), folder.join("velocity.tbl"));
    let shares = [1.0 / LAYERS as f64; LAYERS];
    swash::write_level(&table(), &PLACE, Heading::Names, File::create(&level).unwrap()).unwrap();
    swash::write_velocities(&table(), &PLACE, &shares, Heading::Names, File::create(&velocity).unwrap()).unwrap();
    let file = |path| swash::TableFile { path, columns: &[] };
    let tables = swash::Tables {
        level: file(&level),
        velocity: file(&velocity),
        layer_shares: &[],
        row_times: None,
        origin_z_m: PLACE.still_water_z_m,
    };
    swash::read(&tables, &PLACE).unwrap()
}

fn through_probes(folder: &Path) -> VelocityTable {
    let frame = Frame { up: Up::Z, origin_z_m: PLACE.bed_z_m };
    fs::create_dir(folder.join("0")).unwrap();
    probes::write_velocities(&table(), &levels(), 3.0, frame, File::create(folder.join("0/U")).unwrap()).unwrap();
    probes::write_water(&table(), &levels(), 3.0, frame, File::create(folder.join("0/alpha.water")).unwrap()).unwrap();
    let probes = Vertical { folder, velocity: "U", water: Some("alpha.water"), frame, surface: None };
    probes::read(&probes, &PLACE).unwrap()
}

#[test]
fn same_velocity_in_all_file_formats_gives_the_same_table() {
    let folder = tempfile::tempdir().unwrap();
    let tables = [through_velx(folder.path()), through_swash(folder.path()), through_probes(folder.path())];
    for i in 0..=100 {
        for j in 0..=20 {
            let (t, z) = (0.039 * f64::from(i), PLACE.bed_z_m + 0.04 * f64::from(j));
            let u = tables[0].velocity_m_s(z, t);
            // Limit 1e-6 m/s: the files contain all digits; only the conversion between origins of z rounds the levels.
            assert!(tables.iter().all(|table| (table.velocity_m_s(z, t) - u).abs() < 1e-6));
            if (levels()[0]..=levels()[LAYERS - 1]).contains(&z) {
                // Linear interpolation has the errors u_zz dz^2 / 8 = 1e-3 m/s (dz = 0.1 m) and
                // u_tt dt^2 / 8 = 2e-4 m/s (dt = 0.02 s).
                assert!((u - velocity(z, t)).abs() < 1.5e-3);
            }
        }
    }
}
