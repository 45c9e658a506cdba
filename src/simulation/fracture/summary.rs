//! Summary of a fracture run.

use std::path::Path;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use super::{fragments::Fragment, initiation::initiations, peak_stress::PeakStress, run_state::Watched};
use crate::case::FractureCase;
use crate::femdem::world::energy_balance::EnergyBalance;
use crate::femdem::world::{Failure, World};
use crate::output::{Execution, OutputError, write_atomically};

const SUMMARY_FILE: &str = "summary.json";

/// Content of `summary.json` of a fracture run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FractureSummary {
    /// Title of the case.
    pub title: String,
    /// Version of breakwater that computed the run.
    pub breakwater_version: String,
    /// Hash of case and mesh.
    pub case_hash: String,
    /// Number of tetrahedra.
    pub tets: usize,
    /// Number of faces between tetrahedra in bodies that can crack.
    pub joints: usize,
    /// Simulated time [s].
    pub simulated_s: f64,
    /// Time step [s].
    pub dt_s: f64,
    /// Number of time steps.
    pub steps: u64,
    /// Number of tetrahedra times number of time steps, divided by the wall-clock time [1/s].
    pub tet_steps_per_s: f64,
    /// Largest residual of the energy balance, divided by the largest kinetic energy [-].
    pub energy_residual_ratio: f64,
    /// Largest residual of the energy balance, divided by the kinetic energy at the start [-]; none if the bodies start
    /// at rest.
    pub energy_residual_of_start: Option<f64>,
    /// Time at which two bodies first touched [s]; none if no two bodies touched.
    pub impact_s: Option<f64>,
    /// Area of the faces that failed [m2].
    pub crack_area_m2: f64,
    /// Energy dissipated in failed faces, minus the energy of their springs on release, divided by (failed area times
    /// fracture energy G_f) [-]. G_f is the smallest fracture energy in mode I of all bodies. None if no face failed.
    pub energy_over_g_f: Option<f64>,
    /// Energies at the end [J].
    pub energy_j: EnergyAtEnd,
    /// The bodies, in the order of the mesh.
    pub bodies: Vec<BodySummary>,
    /// Pieces of the bodies that can crack, the heaviest first.
    pub fragments: Vec<FragmentSummary>,
    /// Beginnings of the cracks, in order of time.
    pub initiation: Vec<InitiationSummary>,
    /// Assumptions listed in the case file.
    pub assumptions: Vec<String>,
    /// Warnings.
    pub warnings: Vec<String>,
    /// Wall-clock time and machine.
    pub execution: Execution,
}

/// Energies at the end of a run [J].
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct EnergyAtEnd {
    /// Kinetic energy.
    pub kinetic: f64,
    /// Elastic energy of strain, joints and contacts.
    pub stored: f64,
    /// Potential energy in the gravity field, zero at the start.
    pub gravity: f64,
    /// Energy dissipated by viscosity.
    pub viscous: f64,
    /// Energy dissipated by fracture.
    pub fracture: f64,
    /// Energy dissipated by friction.
    pub friction: f64,
    /// Work of constraints and loads.
    pub work: f64,
    /// Energy of the springs of tied joints at the moment of their release.
    #[serde(rename = "freed")]
    pub released: f64,
}

/// Summary of a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BodySummary {
    /// Name of the body.
    pub name: String,
    /// Mass [kg].
    pub mass_kg: f64,
    /// Velocity of the centre of mass at the end [m/s].
    pub velocity_m_s: [f64; 3],
    /// Largest tension in the body: stress, time and position.
    pub peak: PeakStress,
    /// Area of the failed faces of the body [m2].
    pub crack_area_m2: f64,
}

/// Summary of a piece of a body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FragmentSummary {
    /// Name of the body.
    pub body: String,
    /// Number of tetrahedra.
    pub tets: usize,
    /// Mass [kg].
    pub mass_kg: f64,
    /// Centre of mass at the end [m].
    pub centre_m: [f64; 3],
    /// Velocity of the centre of mass at the end [m/s].
    pub velocity_m_s: [f64; 3],
}

/// Summary of the beginning of a crack.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct InitiationSummary {
    /// Time at which the first face of the crack failed [s].
    pub t_s: f64,
    /// Time from the first contact of two bodies to `t_s` [s]; none if no two bodies touched.
    pub since_impact_s: Option<f64>,
    /// Name of the body.
    pub body: String,
    /// Position of the first failed face in the undeformed body [m].
    pub place: [f64; 3],
    /// Name of the nearest landmark; none if the case has no landmarks.
    pub near: Option<String>,
    /// Distance from this landmark [m]; zero inside the box of the landmark.
    pub distance_m: Option<f64>,
    /// `opening` (mode I) or `sliding` (mode II).
    pub mode: String,
    /// Area of the crack at the end [m2].
    pub area_m2: f64,
}

impl FractureSummary {
    /// Summarises a run that has ended with these fragments.
    pub fn of(
        case: &FractureCase,
        world: &World,
        balance: &EnergyBalance,
        watched: &Watched,
        fragments: &[Fragment],
    ) -> Self {
        let area = world.crack_area();
        let taken: f64 = world.failures.iter().map(|failure| failure.dissipated - failure.released).sum();
        let energies = case.setup.bodies.iter().filter_map(|body| body.cohesion).map(|c| c.strength.opening_energy);
        let g_f = energies.fold(f64::MAX, f64::min);
        let name = |body: usize| case.names[body].clone();
        let fragment = |f: &Fragment| FragmentSummary {
            body: name(f.body),
            tets: f.tets,
            mass_kg: f.mass,
            centre_m: f.centre.to_array(),
            velocity_m_s: f.velocity.to_array(),
        };
        let initiation = |i: super::initiation::Initiation| {
            let distances = case.landmarks.iter().map(|landmark| (landmark, landmark.distance(i.first.centroid)));
            let nearest = distances.min_by(|a, b| a.1.total_cmp(&b.1));
            InitiationSummary {
                t_s: i.first.time,
                since_impact_s: watched.impact.map(|impact| i.first.time - impact),
                body: name(i.body),
                place: i.first.centroid.to_array(),
                near: nearest.map(|(landmark, _)| landmark.name.clone()),
                distance_m: nearest.map(|(_, distance)| distance),
                mode: if i.first.by_sliding { "sliding" } else { "opening" }.to_owned(),
                area_m2: i.area,
            }
        };
        let failed_in = |body: usize| {
            let within = |f: &&Failure| {
                case.setup.bodies[body].tets.contains(&(case.setup.interfaces[f.interface as usize].tets[0] as usize))
            };
            world.failures.iter().filter(within).fold(0.0, |area, failure| area + failure.area)
        };
        let body = |(number, peak): (usize, &PeakStress)| BodySummary {
            name: name(number),
            velocity_m_s: mean_velocity(world, number).to_array(),
            mass_kg: case.setup.bodies[number].elastic.density * case.mesh.quality[number].volume,
            peak: *peak,
            crack_area_m2: failed_in(number),
        };
        let ratio = |kinetic: f64| (kinetic > 0.0).then_some(watched.residual / kinetic);
        let tets = world.tets.nodes.len();
        Self {
            title: case.title.clone(),
            breakwater_version: env!("CARGO_PKG_VERSION").to_owned(),
            case_hash: case.hash.clone(),
            tets,
            joints: world.joints.count(),
            simulated_s: world.time,
            dt_s: world.dt,
            steps: watched.steps,
            tet_steps_per_s: tets as f64 * watched.steps as f64 / watched.wall.max(1e-9),
            energy_residual_ratio: ratio(watched.kinetic[1]).unwrap_or(0.0),
            energy_residual_of_start: ratio(watched.kinetic[0]),
            impact_s: watched.impact,
            crack_area_m2: area,
            energy_over_g_f: (area > 0.0).then_some(taken / (area * g_f)),
            energy_j: EnergyAtEnd {
                kinetic: balance.kinetic,
                stored: balance.strain + balance.joint + balance.contact,
                gravity: balance.gravity,
                viscous: balance.viscous,
                fracture: balance.fracture,
                friction: balance.friction,
                work: balance.work,
                released: balance.released,
            },
            bodies: watched.peaks.iter().enumerate().map(body).collect(),
            fragments: fragments.iter().map(fragment).collect(),
            initiation: initiations(world).into_iter().map(initiation).collect(),
            assumptions: case.assumptions.clone(),
            warnings: case.warnings.clone(),
            execution: Execution::here(watched.wall, watched.steps as f64, None),
        }
    }

    /// Returns the summary of the body called `name`.
    pub fn body(&self, name: &str) -> Option<&BodySummary> {
        self.bodies.iter().find(|body| body.name == name)
    }

    /// Reads `summary.json` of a run folder.
    ///
    /// # Errors
    /// If the file is missing or does not belong to a fracture run.
    pub fn read(dir: &Path) -> Result<Self, OutputError> {
        let path = dir.join(SUMMARY_FILE);
        let text = std::fs::read_to_string(&path).map_err(OutputError::io(&path))?;
        serde_json::from_str(&text).map_err(OutputError::json(&path))
    }

    /// Writes `summary.json` into the run folder.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&self, dir: &Path) -> Result<(), OutputError> {
        let path = dir.join(SUMMARY_FILE);
        let mut text = serde_json::to_string_pretty(self).map_err(OutputError::json(&path))?;
        text.push('\n');
        write_atomically(&path, text.as_bytes())
    }
}

/// Computes the velocity of the centre of mass of a body of uniform density [m/s].
fn mean_velocity(world: &World, body: usize) -> DVec3 {
    let (mut flow, mut volume) = (DVec3::ZERO, 0.0);
    for tet in world.setup().bodies[body].tets.clone() {
        let own = world.tets.shape[tet].volume;
        let velocities = world.tets.nodes[tet].map(|node| world.nodes.velocity[node as usize]);
        flow += velocities.iter().sum::<DVec3>() * (0.25 * own);
        volume += own;
    }
    flow / volume
}
