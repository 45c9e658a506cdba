//! Sets up particles, bodies and wavemaker of a validated case.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use thiserror::Error;

use super::{
    Simulation, Units,
    impermeable::bins_near_surfaces,
    measures::{part_faces::part_faces, statistics::Statistics},
    porous::{leave_pores, porous_field},
    regions::buffer::Buffer,
    scheme::parameters,
    standing::{add_body, cover_standing_units},
    standing_cuboids::StandingCuboids,
    unit_setup::{clear_units, set_up_units, unit_in_place},
    water_at_start::{basin, clear_part, fill},
    wave::{
        ends::MovingEnd,
        incoming::{ends, particle_start, passing_time, run_flume},
    },
};
use crate::{
    case::{self, Case, Part, PartShape, Region, group},
    geometry::{axis_box::AxisBox, outline::Outline, profile::Profile},
    rigid::RigidError,
    sph::{
        device::Device,
        particles::{
            bed::{Across, outline_particles, side_wall_particles},
            boundary::{Boundary, BoundaryParticle},
            obstacle::{box_particles, cover},
        },
        solver::backend::DeviceError,
        terms::wall_slip::Mirroring,
    },
    waves::{flume_model::FlumeError, flume_model::record::FlumeRecord, generation::wavemaker::Wavemaker},
};

/// Largest number of particles of one region. Particles of different regions have different identification numbers.
const IDS_PER_REGION: u32 = 1 << 29;

/// Reason why a case cannot be set up.
#[derive(Debug, Error)]
pub enum SetupError {
    /// The flume model failed.
    #[error(transparent)]
    Flume(#[from] FlumeError),
    /// The wavemaker would reach the mound or an obstacle.
    #[error(
        "domain.x_m[0] = {place}: the wavemaker moves shoreward by {travel:.2} m, to x = {:.2} m, and would reach the \
         mound or an obstacle at x = {toe:.2} m; use at most {:.1} m", place + travel, toe - 1.2 * travel
    )]
    WavemakerReachesMound {
        /// Position x of the wavemaker at the start [m].
        place: f64,
        /// Largest shoreward displacement of the wavemaker [m].
        travel: f64,
        /// Position x of the toe of the mound or of the seaward face of an obstacle [m].
        toe: f64,
    },
    /// The wave files end before the run ends.
    #[error(
        "stop.duration_s = {duration}: the files of `wave.source` end at {end:.3} s, but the particles start \
         at {start:.3} s; use a duration of at most {:.3} s, an earlier `domain.start_s`, or longer files", end - start
    )]
    WaveEnds {
        /// Duration of the run [s].
        duration: f64,
        /// Start of the particles, in the time of the wave files [s].
        start: f64,
        /// Last time for which the wave files contain data [s].
        end: f64,
    },
    /// The units overlap each other or the bed too much.
    #[error(transparent)]
    Rigid(#[from] RigidError),
    /// The device cannot compute the case.
    #[error(transparent)]
    Device(#[from] DeviceError),
}

impl Simulation {
    /// Sets up the simulation of a case at its start; the processor computes the water.
    ///
    /// # Errors
    /// If the flume model fails, or the units overlap each other or the bed too much.
    pub fn new(case: Arc<Case>) -> Result<Self, SetupError> {
        Self::on(&Device::Cpu, case)
    }

    /// Sets up the simulation of a case at its start; `device` computes the water.
    ///
    /// # Errors
    /// As for [`Self::new`], and if the device does not support the scheme of the case or has too little memory.
    pub fn on(device: &Device, case: Arc<Case>) -> Result<Self, SetupError> {
        let flume = run_flume(&case)?.map(Arc::new);
        let start = particle_start(&case, flume.as_deref());
        Self::in_regions(device, case, flume, start, [0.0; 2], true)
    }

    /// Sets up the simulation as [`Self::on`]; the particles start at the flume time `start` [s], and the ends of the
    /// finest region have moved by `moved` [m].
    pub(super) fn starting_at(
        device: &Device,
        case: Arc<Case>,
        start: f64,
        moved: [f64; 2],
    ) -> Result<Self, SetupError> {
        let flume = run_flume(&case)?.map(Arc::new);
        Self::in_regions(device, case, flume, start, moved, true)
    }

    /// Sets up the simulation as [`Self::starting_at`], with the record of the flume model. Placed units settle first
    /// if `settles` is true.
    pub(super) fn in_regions(
        device: &Device,
        case: Arc<Case>,
        flume: Option<Arc<FlumeRecord>>,
        start: f64,
        moved: [f64; 2],
        settles: bool,
    ) -> Result<Self, SetupError> {
        check_times(&case, start)?;
        let regions = Region::moved(&case.domain.regions, moved);
        let region = |number: usize| -> Result<Self, SetupError> {
            let of_region = Arc::new(case.of_region(&regions[number]));
            let buffers = Buffer::of_region(&regions[number], &regions, &of_region);
            let units = of_region.units.as_ref().map(|units| set_up_units(&case, units, settles)).transpose()?;
            let (units, warning) = units.unzip();
            let mut region = Self::of_region(device, of_region, flume.clone(), start, number as u32, buffers, units)?;
            region.statistics.warnings.extend(warning.flatten());
            Ok(region)
        };
        let mut simulation = region(0)?;
        simulation.coarse = (1..regions.len()).map(region).collect::<Result<_, _>>()?;
        // Parts of the bed can extend beyond the finest region.
        simulation.part_faces = part_faces(&case, &outline(&case, [None; 2]));
        simulation.case = case.clone();
        simulation.moved = moved;
        Ok(simulation)
    }

    /// Sets up the simulation of the region `number`, which has the case `case` and these `units`.
    fn of_region(
        device: &Device,
        case: Arc<Case>,
        flume: Option<Arc<FlumeRecord>>,
        start: f64,
        number: u32,
        buffers: Vec<Buffer>,
        units: Option<Units>,
    ) -> Result<Self, SetupError> {
        let ends = ends(&case, flume.as_deref(), start);
        for end in ends.iter().filter(|end| end.open.is_none()) {
            check_travel(&case, &end.wavemaker)?;
        }
        let reach = reach_of(&case, &ends);

        let (across, outline) = (across(&case), outline(&case, reach));
        let groups = units.as_ref().map_or(&[][..], |units| &units.groups);
        let unit_particles: Vec<_> =
            group::models(groups).map(|(_, model)| unit_in_place(model.shape.unit(), &case)).collect();
        let mut fixed = fixed_particles(&case, &outline, &across, reach);
        let particles_of_each = match &units {
            Some(units) => cover_standing_units(&mut fixed, &unit_particles, units, &case),
            None => Vec::new(),
        };
        let boundary = Boundary::new(
            &fixed,
            &ends.iter().map(|end| end_particles(&case, &across, end)).collect::<Vec<_>>(),
            &particles_of_each.iter().map(|particles| &particles[..]).collect::<Vec<_>>(),
            case.fluid.rho0,
        );
        let mut water = fill(&case, &across, flume.as_deref(), start);
        for part in &case.flume.parts {
            clear_part(&mut water, part, &outline, case.domain.dp);
        }
        if let Some(units) = &units {
            clear_units(&mut water, units, &case);
        }
        let porous = porous_field(&case, &outline);
        if let Some(field) = &porous {
            leave_pores(&mut water, field);
        }
        // Regions do not share identification numbers.
        water.id.iter_mut().for_each(|id| *id += number * IDS_PER_REGION);

        let shoreward = units.iter().flat_map(Units::states).map(|state| state.position.x).reduce(f64::max);
        let passing_time = shoreward.map_or(0.0, |x| passing_time(&case, flume.as_deref(), start, x));
        let [low, high] = bounds(&case, reach);
        let allowed = [low, high + DVec3::Z * (case.domain.top_z - case.domain.bottom_z)];
        let next_id = number * IDS_PER_REGION + water.len() as u32;
        let mut solver = device.solver(parameters(&case), [low, high], allowed)?;
        if let Some(field) = &porous {
            solver.set_porous(field.clone())?;
        }
        let standing = units.as_ref().map(|units| StandingCuboids::new(units, &boundary, &case)).unwrap_or_default();
        let mut simulation = Self {
            bins_near_surfaces: bins_near_surfaces(&case, &outline, solver.grid()),
            part_faces: Vec::new(),
            solver,
            porous,
            statistics: Statistics::new(units.as_ref().map_or(&[], Units::states)),
            bounds: allowed,
            case,
            coarse: Vec::new(),
            moved: [0.0; 2],
            buffers,
            flume,
            water,
            standing,
            boundary,
            units,
            time: 0.0,
            steps: 0,
            start,
            passing_time,
            ends,
            next_id,
            outline,
        };
        simulation.place_boundary();
        simulation.load()?;
        Ok(simulation)
    }
}

/// Checks that the wave files do not end before the end of the run. The particles start at the file time `start` [s].
///
/// # Errors
/// If the wave files end before the end of the run.
pub fn check_times(case: &Case, start: f64) -> Result<(), SetupError> {
    let case::Wave::External(wave) = &case.wave else { return Ok(()) };
    let ([_, end], duration) = (wave.times(), case.stop.duration);
    if start + duration <= end { Ok(()) } else { Err(SetupError::WaveEnds { duration, start, end }) }
}

/// Checks that the wavemaker does not reach the mound or an obstacle during the run.
fn check_travel(case: &Case, wavemaker: &Wavemaker) -> Result<(), SetupError> {
    let place = case.domain.x[0];
    let toe_of = |mound: &case::Mound| {
        let before_crest = case.flume.profile.points().iter().rfind(|point| point[0] < mound.crest_x[0]);
        before_crest.map_or(mound.crest_x[0], |point| point[0])
    };
    let toes = case.flume.mound.iter().map(toe_of).chain(in_water(case).map(|part| part.x()[0]));
    let toe = toes.fold(f64::INFINITY, f64::min);
    let travel = wavemaker.max_shoreward_displacement_m();
    if place + travel < toe { Ok(()) } else { Err(SetupError::WavemakerReachesMound { place, travel, toe }) }
}

pub(super) fn across(case: &Case) -> Across {
    Across { width: case.domain.width, count: case.domain.ny as u32, walls: case.domain.sides == case::Sides::Walls }
}

/// Returns for the seaward and the shoreward end how far its rows move out of the domain [m]; 0 for an end where water
/// of another region continues; `None` for an end with a wall.
fn reach_of(case: &Case, ends: &[MovingEnd]) -> [Option<f64>; 2] {
    [(1.0, 0), (-1.0, 1)].map(|(inwards, end)| {
        let moving = ends.iter().find(|end| end.inwards == inwards).map(MovingEnd::reach);
        moving.or(case.domain.continues[end].then_some(0.0))
    })
}

/// Returns the box around all water and boundary particles [m]; for `reach` see [`reach_of`].
fn bounds(case: &Case, reach: [Option<f64>; 2]) -> [DVec3; 2] {
    let margin = (case.numerics.boundary_layers as f64 + 2.0) * case.domain.dp;
    let beyond = if case.domain.sides == case::Sides::Walls { margin } else { 0.0 };
    let [x0, x1] = case.domain.x;
    [
        DVec3::new(x0 - margin - reach[0].unwrap_or(0.0), -beyond, case.domain.bottom_z - margin),
        DVec3::new(x1 + margin + reach[1].unwrap_or(0.0), case.domain.width + beyond, case.domain.top_z + margin),
    ]
}

/// Returns the corner points (x, z) of the bed from x = `from` to x = `to` [m], and its points at these two ends.
fn bed_between(profile: &Profile, from: f64, to: f64) -> impl Iterator<Item = DVec2> {
    let inner = profile.points().iter().filter(move |p| p[0] > from && p[0] < to);
    let points: Vec<DVec2> = inner.map(|&p| DVec2::from_array(p)).collect();
    let end = |x: f64| DVec2::new(x, profile.z(x));
    [end(from)].into_iter().chain(points).chain([end(to)])
}

/// Returns the outline of bed, mound, end walls and parts that are the same across the flume. A moving end, or water of
/// another region, replaces the wall, and the bed continues below it; for `reach` see [`reach_of`].
fn outline(case: &Case, reach: [Option<f64>; 2]) -> Outline {
    let ([x0, x1], top) = (case.domain.x, case.domain.top_z);
    let thickness = case.numerics.boundary_layers as f64 * case.domain.dp;
    let [from, to] = reach.map(|reach| reach.map_or(0.0, |reach| thickness + reach));
    let mut points: Vec<DVec2> = Vec::new();
    if reach[0].is_none() {
        points.push(DVec2::new(x0, top));
    }
    points.extend(bed_between(&case.flume.profile, x0 - from, x1 + to));
    if reach[1].is_none() {
        points.push(DVec2::new(x1, top));
    }
    case.flume.parts.iter().filter_map(Part::section).fold(Outline::new(&points), |outline, part| outline.with(part))
}

/// Returns the parts that are not part of the bed profile.
fn in_water(case: &Case) -> impl Iterator<Item = &Part> {
    case.flume.parts.iter().filter(|part| !matches!(part.shape, PartShape::Bed(_)))
}

/// Returns the boundary particles of bed, mound, walls and obstacles. The side walls extend beyond the ends of the
/// domain by `reach`; see [`reach_of`].
fn fixed_particles(case: &Case, outline: &Outline, across: &Across, reach: [Option<f64>; 2]) -> Vec<BoundaryParticle> {
    let (domain, layers) = (&case.domain, case.numerics.boundary_layers as u32);
    let mut particles = outline_particles(outline, across, domain.dp, layers, 2.0 * case.numerics.h);
    let bed = |x: f64, _: f64| case.flume.profile.z(x);
    let (top, at_rest) = (|_: f64| domain.top_z, |_: f64, _: f64| DVec2::ZERO);
    let mut sides = basin(case, across, &bed, &top, &at_rest);
    sides.x = [domain.x[0] - reach[0].unwrap_or(0.0), domain.x[1] + reach[1].unwrap_or(0.0)];
    let mut section = sides.side_section(domain.top_z);
    if case.flume.parts.iter().any(|part| part.section().is_some()) {
        // Behind the sides of a part, the outline has its own particles.
        section.retain(|(at, _)| !outline.is_solid(*at));
    }
    particles.extend(side_wall_particles(&section, across, layers));
    let obstacles: Vec<&AxisBox> = case.flume.parts.iter().filter_map(Part::as_box).collect();
    for obstacle in &obstacles {
        cover(&mut particles, obstacle);
    }
    let thickness = f64::from(layers) * domain.dp;
    for obstacle in &obstacles {
        let solid = box_particles(obstacle, domain.dp, thickness).into_iter();
        // On a slope, a corner of the obstacle can be below the bed, where the bed already has particles.
        particles.extend(solid.filter(|particle| particle.position.z > bed(particle.position.x, 0.0)));
    }
    for body in case.flume.parts.iter().filter_map(Part::as_body) {
        add_body(&mut particles, body, across, case);
    }
    particles
}

/// Returns the boundary particles of a moving end, each with the index of its row.
fn end_particles(case: &Case, across: &Across, end: &MovingEnd) -> Vec<(u32, BoundaryParticle)> {
    let (dp, layers) = (case.domain.dp, case.numerics.boundary_layers as u32);
    let mut particles = Vec::new();
    for (row, &z) in end.wavemaker.row_heights_m().iter().enumerate() {
        for layer in 0..layers {
            let inside = end.inwards * (f64::from(layer) + 0.5) * dp;
            for y in across.rows(layers) {
                particles.push((
                    row as u32,
                    BoundaryParticle {
                        position: DVec3::new(end.wavemaker.rest_x_m() - inside, y, z),
                        to_surface: DVec3::new(inside, across.to_inside(y), 0.0),
                        volume: dp * dp * across.spacing(),
                        mirroring: Mirroring::Full,
                    },
                ));
            }
        }
    }
    particles
}
