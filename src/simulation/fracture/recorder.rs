//! Writes the tables of a fracture run, and files of its surfaces and cracks for ParaView.

use std::path::Path;

use glam::DVec3;

use super::detail::DetailRecorder;
use super::fragments::pieces;
use super::run_state::RunState;
use crate::case::FractureCase;
use crate::femdem::element::{self, Moduli};
use crate::femdem::principal_stresses::principal_stresses;
use crate::femdem::world::World;
use crate::femdem::world::body_energy::BodyEnergy;
use crate::femdem::world::energy_balance::EnergyBalance;
use crate::output::{Cells, CsvSeries, FieldKind, FieldValues, OutputError, PolyDataSeries, columns, write_atomically};

const ENERGY_FILE: &str = "energy.csv";
const BODIES_FILE: &str = "bodies.csv";
const SURFACES_FILE: &str = "surfaces.vtkhdf";
const CRACKS_FILE: &str = "cracks.vtkhdf";

const SURFACE_FIELDS: [(&str, FieldKind); 5] = [
    ("velocity", FieldKind::Vector),
    ("sigma_1", FieldKind::Scalar),
    ("sigma_1_minus_sigma_3", FieldKind::Scalar),
    ("body", FieldKind::Integer),
    ("fragment", FieldKind::Integer),
];
const CRACK_FIELDS: [(&str, FieldKind); 3] =
    [("time_s", FieldKind::Scalar), ("mode", FieldKind::Integer), ("body", FieldKind::Integer)];

/// Open output files of a fracture run.
pub struct FractureRecorder {
    energy: CsvSeries,
    bodies: CsvSeries,
    surfaces: Option<[PolyDataSeries; 2]>,
    /// Output files of the failed faces, the cut plane and the tetrahedra.
    pub detail: DetailRecorder,
}

impl FractureRecorder {
    /// Creates the files in the run folder, and writes the files that do not change during the run.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn create(case: &FractureCase, dir: &Path) -> Result<Self, OutputError> {
        write_atomically(&dir.join("case.json"), case.text.as_bytes())?;
        write_atomically(&dir.join(FractureCase::MESH), &case.mesh_file)?;
        let series = |_| -> Result<[PolyDataSeries; 2], OutputError> {
            Ok([
                PolyDataSeries::create(&dir.join(SURFACES_FILE), Cells::Triangles, &SURFACE_FIELDS)?,
                PolyDataSeries::create(&dir.join(CRACKS_FILE), Cells::Triangles, &CRACK_FIELDS)?,
            ])
        };
        Ok(Self {
            energy: CsvSeries::create(&dir.join(ENERGY_FILE), &columns::FRACTURE_ENERGY)?,
            bodies: CsvSeries::create(&dir.join(BODIES_FILE), &columns::FRACTURE_BODIES)?,
            surfaces: case.surfaces_interval.map(series).transpose()?,
            detail: DetailRecorder::create(case, dir)?,
        })
    }

    /// Opens the files of an interrupted run, and truncates them to their lengths at its checkpoint.
    ///
    /// # Errors
    /// If a file is missing or shorter than at the checkpoint.
    pub fn reopen(case: &FractureCase, dir: &Path, state: &RunState) -> Result<Self, OutputError> {
        let steps = state.frames.count as usize;
        let series = |_| -> Result<[PolyDataSeries; 2], OutputError> {
            let open = |file, fields| PolyDataSeries::reopen(&dir.join(file), Cells::Triangles, fields, steps);
            Ok([open(SURFACES_FILE, &SURFACE_FIELDS[..])?, open(CRACKS_FILE, &CRACK_FIELDS[..])?])
        };
        let [energy, bodies] = state.bytes;
        Ok(Self {
            energy: CsvSeries::open_truncated(&dir.join(ENERGY_FILE), &columns::FRACTURE_ENERGY, energy)?,
            bodies: CsvSeries::open_truncated(&dir.join(BODIES_FILE), &columns::FRACTURE_BODIES, bodies)?,
            surfaces: case.surfaces_interval.map(series).transpose()?,
            detail: DetailRecorder::reopen(case, dir, &state.detail)?,
        })
    }

    /// Returns the lengths of the tables of the energy balance and of the bodies [bytes].
    pub fn bytes(&self) -> [u64; 2] {
        [&self.energy, &self.bodies].map(CsvSeries::bytes)
    }

    /// Appends a row for each body at `time` [s], with its energies and its largest first principal stress.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn record_bodies(
        &mut self,
        time: f64,
        bodies: &[BodyEnergy],
        stresses: &[(f64, usize)],
    ) -> Result<(), OutputError> {
        bodies.iter().zip(stresses).enumerate().try_for_each(|(number, (body, (sigma_1, _)))| {
            let BodyEnergy { kinetic, strain, joint, gravity, fracture } = *body;
            self.bodies.append(&[time, number as f64, kinetic, strain, joint, gravity, fracture, *sigma_1])
        })
    }

    /// Appends a row of the energy balance at `time` [s], and the faces that failed since the last row.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn record_energy(
        &mut self,
        world: &World,
        time: f64,
        balance: &EnergyBalance,
        residual: f64,
    ) -> Result<(), OutputError> {
        self.detail.record_cracks(world)?;
        let area = world.crack_area();
        self.energy.append(&[
            time,
            balance.kinetic,
            balance.strain,
            balance.joint,
            balance.contact,
            balance.gravity,
            balance.viscous,
            balance.fracture,
            balance.friction,
            balance.work,
            balance.released,
            residual,
            area,
            world.contacts.scalars.touching as f64,
        ])
    }

    /// Appends the surfaces of the bodies, the crack faces and the cut plane in their current state.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn record_surfaces(&mut self, case: &FractureCase, world: &World) -> Result<(), OutputError> {
        let Some([surfaces, cracks]) = &mut self.surfaces else { return Ok(()) };
        self.detail.record_section(world)?;
        let single = |v: DVec3| v.as_vec3().to_array();
        let setup = world.setup();
        let (mut points, mut velocity, mut first, mut difference) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let (mut body, mut fragment) = (Vec::new(), Vec::new());
        let piece_of_tet = pieces(world).of_tet;
        for face in &case.mesh.faces.exteriors {
            let tet = face.tet as usize;
            let number = usize::from(world.tets.body[tet]);
            let places = world.tets.nodes[tet].map(|node| world.nodes.position[node as usize]);
            let moduli = Moduli::from(&setup.bodies[number].elastic);
            let [sigma_1, _, sigma_3] = principal_stresses(element::stress(&world.tets.shape[tet], &moduli, &places));
            for corner in face.nodes.map(usize::from) {
                points.push(single(places[corner]));
                velocity.push(single(world.nodes.velocity[world.tets.nodes[tet][corner] as usize]));
                first.push(sigma_1 as f32);
                difference.push((sigma_1 - sigma_3) as f32);
                body.push(number as i32);
                fragment.push(piece_of_tet[tet] as i32);
            }
        }
        let values = [
            FieldValues::Vector(&velocity),
            FieldValues::Scalar(&first),
            FieldValues::Scalar(&difference),
            FieldValues::Integer(&body),
            FieldValues::Integer(&fragment),
        ];
        surfaces.append(world.time, &points, &corners_in_threes(points.len()), &values)?;

        let (mut points, mut time, mut mode, mut body) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        let opened = setup.cracks.iter().map(|face| (*face as usize, 0.0, 0));
        let failed = world.failures.iter().map(|f| (f.interface as usize, f.time, if f.by_sliding { 2 } else { 1 }));
        for (number, at, how) in opened.chain(failed) {
            let interface = &setup.interfaces[number];
            for side in 0..2 {
                let tet = interface.tets[side] as usize;
                for corner in interface.nodes[side].map(usize::from) {
                    points.push(single(world.nodes.position[world.tets.nodes[tet][corner] as usize]));
                    time.push(at as f32);
                    mode.push(how);
                    body.push(i32::from(world.tets.body[tet]));
                }
            }
        }
        let values = [FieldValues::Scalar(&time), FieldValues::Integer(&mode), FieldValues::Integer(&body)];
        cracks.append(world.time, &points, &corners_in_threes(points.len()), &values)
    }
}

/// Returns triangles that each connect three successive points.
fn corners_in_threes(points: usize) -> Vec<[u32; 3]> {
    (0..points as u32 / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect()
}
