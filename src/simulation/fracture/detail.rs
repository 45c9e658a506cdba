//! Outputs of a fracture run in addition to energies and surfaces: failed faces, cut plane and tetrahedra.

use std::path::Path;

use glam::DVec3;

use super::fragments::pieces;
use super::run_state::DetailLengths;
use super::section::{SECTION_FIELDS, Section};
use crate::case::FractureCase;
use crate::femdem::element::{self, Moduli};
use crate::femdem::principal_stresses::principal_stresses;
use crate::femdem::world::World;
use crate::output::{
    Cells, CsvSeries, FieldKind, FieldValues, OutputError, PolyDataSeries, TetMoment, TetSeries, columns,
};

const CRACKS_FILE: &str = "cracks.csv";
const SECTION_FILE: &str = "section.vtkhdf";
const TETS_FILE: &str = "tets.vtkhdf";

const TET_FIELDS: [(&str, FieldKind); 5] = [
    ("stress", FieldKind::Tensor),
    ("sigma_1", FieldKind::Scalar),
    ("sigma_1_minus_sigma_3", FieldKind::Scalar),
    ("body", FieldKind::Integer),
    ("fragment", FieldKind::Integer),
];
/// Bytes per tetrahedron and output time in `tets.vtkhdf`: 40 for the fields, 9 for offset and type, and its share of
/// the 24 bytes for position and velocity of a node. Meshes of tools/mesh have one node per five tetrahedra.
const TET_BYTES: f64 = 40.0 + 9.0 + 24.0 / 5.0;
/// Bytes per tetrahedron for the list of its nodes (connectivity), which is written once.
const CONNECTIVITY_BYTES: f64 = 32.0;

/// Open output files of failed faces, cut plane and tetrahedra.
pub struct DetailRecorder {
    cracks: CsvSeries,
    /// Number of failed faces in the table.
    recorded: usize,
    section: Option<(Section, PolyDataSeries)>,
    tets: Option<TetSeries>,
}

impl DetailRecorder {
    /// Creates the files in the run folder.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn create(case: &FractureCase, dir: &Path) -> Result<Self, OutputError> {
        let section = |_| PolyDataSeries::create(&dir.join(SECTION_FILE), Cells::Triangles, &SECTION_FIELDS);
        let tets = |_| TetSeries::create(&dir.join(TETS_FILE), &TET_FIELDS);
        Ok(Self {
            cracks: CsvSeries::create(&dir.join(CRACKS_FILE), &columns::CRACKS)?,
            recorded: 0,
            section: case.surfaces_interval.map(section).transpose()?.map(|series| (cut(case), series)),
            tets: case.tets_interval.map(tets).transpose()?,
        })
    }

    /// Opens the files of an interrupted run, and truncates them to their lengths at a checkpoint.
    ///
    /// # Errors
    /// If a file cannot be opened, or is shorter than at the checkpoint.
    pub fn reopen(case: &FractureCase, dir: &Path, lengths: &DetailLengths) -> Result<Self, OutputError> {
        let (path, steps) = (dir.join(SECTION_FILE), lengths.section_steps);
        let section = |_| PolyDataSeries::reopen(&path, Cells::Triangles, &SECTION_FIELDS, steps);
        let tets = |_| TetSeries::reopen(&dir.join(TETS_FILE), &TET_FIELDS, lengths.tets_steps);
        Ok(Self {
            cracks: CsvSeries::open_truncated(&dir.join(CRACKS_FILE), &columns::CRACKS, lengths.cracks_bytes)?,
            recorded: lengths.cracks,
            section: case.surfaces_interval.map(section).transpose()?.map(|series| (cut(case), series)),
            tets: case.tets_interval.map(tets).transpose()?,
        })
    }

    /// Returns the current lengths of the files.
    pub fn lengths(&self) -> DetailLengths {
        DetailLengths {
            cracks_bytes: self.cracks.bytes(),
            cracks: self.recorded,
            section_steps: self.section.as_ref().map_or(0, |(_, series)| series.steps()),
            tets_steps: self.tets.as_ref().map_or(0, TetSeries::steps),
        }
    }

    /// Appends the faces that failed since the last call.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn record_cracks(&mut self, world: &World) -> Result<(), OutputError> {
        let row = |failure: &crate::femdem::world::Failure| {
            let [x, y, z] = failure.centroid.to_array();
            let tet = world.setup().interfaces[failure.interface as usize].tets[0] as usize;
            let mode = if failure.by_sliding { 2.0 } else { 1.0 };
            [failure.time, x, y, z, failure.area, mode, f64::from(world.tets.body[tet])]
        };
        self.cracks.append_rows(world.failures[self.recorded..].iter().map(row))?;
        self.recorded = world.failures.len();
        Ok(())
    }

    /// Appends the current state of the cut plane.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn record_section(&mut self, world: &World) -> Result<(), OutputError> {
        self.section.as_mut().map_or(Ok(()), |(section, series)| section.record(world, series))
    }

    /// Appends the current state of all tetrahedra, if their file is open.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn record_tets(&mut self, world: &World) -> Result<(), OutputError> {
        self.tets.as_mut().map_or(Ok(()), |series| record_tets(world, series))
    }
}

/// Estimates the size of `tets.vtkhdf` for a run in which nothing cracks [bytes]; 0 if the case does not request the
/// file.
pub fn tets_bytes(case: &FractureCase) -> f64 {
    let moments = case.tets_interval.map_or(0.0, |interval| (case.duration / interval).ceil() + 1.0);
    let tets = case.setup.tets.len() as f64;
    moments * tets * TET_BYTES + if moments > 0.0 { CONNECTIVITY_BYTES * tets } else { 0.0 }
}

fn cut(case: &FractureCase) -> Section {
    Section::new(&case.setup, &case.section)
}

fn record_tets(world: &World, series: &mut TetSeries) -> Result<(), OutputError> {
    let single = |v: &DVec3| v.as_vec3().to_array();
    let points: Vec<[f32; 3]> = world.nodes.position.iter().map(single).collect();
    let velocity: Vec<[f32; 3]> = world.nodes.velocity.iter().map(single).collect();
    let fragment: Vec<i32> = pieces(world).of_tet.into_iter().map(|number| number as i32).collect();
    let count = world.tets.nodes.len();
    let (mut stress, mut first, mut difference, mut body) =
        (Vec::with_capacity(count), Vec::with_capacity(count), Vec::with_capacity(count), Vec::with_capacity(count));
    for (tet, nodes) in world.tets.nodes.iter().enumerate() {
        let number = world.tets.body[tet];
        let moduli = Moduli::from(&world.setup().bodies[usize::from(number)].elastic);
        let places = nodes.map(|node| world.nodes.position[node as usize]);
        let t = element::stress(&world.tets.shape[tet], &moduli, &places);
        let [sigma_1, _, sigma_3] = principal_stresses(t);
        let components = [t.x_axis.x, t.y_axis.y, t.z_axis.z, t.x_axis.y, t.y_axis.z, t.x_axis.z];
        stress.push(components.map(|component| component as f32));
        first.push(sigma_1 as f32);
        difference.push((sigma_1 - sigma_3) as f32);
        body.push(i32::from(number));
    }
    let values = [
        FieldValues::Tensor(&stress),
        FieldValues::Scalar(&first),
        FieldValues::Scalar(&difference),
        FieldValues::Integer(&body),
        FieldValues::Integer(&fragment),
    ];
    let moment = TetMoment {
        time_s: world.time,
        points_m: &points,
        velocity_m_s: &velocity,
        tets: &world.tets.nodes,
        values: &values,
    };
    series.append(&moment)
}
