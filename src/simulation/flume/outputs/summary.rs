//! The summary of a flume run.

use std::path::Path;

use crate::simulation::flume::Simulation;
use crate::{
    case::{Case, Gauge, Part, Quantity, Sides, UnitGroup, UnitModel, Wave, Wavemaker},
    output::{
        BodySummary, ContactSummary, EnergySummary, Execution, ForceSummary, GaugeSummary, GroupSummary, OutputError,
        ParticleCounts, PressureSummary, SectionSummary, Stopped, Summary, Table, TimeStepSummary, UnitSummary,
        WaveSummary, columns,
    },
    waves::theory::solitary::PistonTheory,
};

/// Summarises a run; reads the results of the gauges from the gauge tables in the run folder `dir`.
///
/// # Errors
/// If the gauge tables cannot be read.
pub fn summarise(simulation: &Simulation, stopped: Stopped, dir: &Path) -> Result<Summary, OutputError> {
    let (case, statistics) = (&simulation.case, &simulation.statistics);
    let counts = particle_counts(simulation);
    let steps_run = statistics.steps.max(1) as f64;
    let mut summary = Summary {
        title: case.title.clone(),
        breakwater_version: env!("CARGO_PKG_VERSION").to_owned(),
        case_hash: case.hash.clone(),
        wave: wave(case),
        contacts: ContactSummary {
            with_bed: statistics.contacts.iter().map(|c| c[0]).sum(),
            between_units: statistics.contacts.iter().map(|c| c[1]).sum(),
            peak_force_n: statistics.peak_contact,
            peak_normal_velocity_m_s: statistics.fastest_contact,
        },
        // A graphics card has the present water of a run in progress.
        energy: (statistics.energy_start.filter(|_| stopped != Stopped::Running))
            .map(|start_j| EnergySummary { start_j, end_j: simulation.energy().total() }),
        assumptions: case.assumptions.clone(),
        warnings: case.warnings.iter().chain(&statistics.warnings).cloned().collect(),
        largest_mach: Some(statistics.largest_mach),
        particles: counts.water + counts.bed + counts.wavemaker + counts.units,
        particle_counts: counts,
        dp_m: case.domain.dp,
        speed_of_sound_m_s: case.fluid.sound_speed,
        still_water_level_m: case.flume.still_water_level,
        domain_x_m: case.domain.x,
        domain_width_m: case.domain.width,
        side_walls: case.domain.sides == Sides::Walls,
        two_dimensional: case.domain.sides == Sides::TwoDimensional,
        obstacles_m: case
            .flume
            .parts
            .iter()
            .filter_map(Part::as_box)
            .map(|o| [o.low, o.high].map(Into::into))
            .collect(),
        sections: case.flume.parts.iter().filter_map(section_of).collect(),
        bodies: case.flume.parts.iter().filter_map(body_of).collect(),
        steps: simulation.steps,
        simulated_s: simulation.time,
        start_s: simulation.start,
        time_step_s: TimeStepSummary {
            min: statistics.shortest_step,
            mean: simulation.time / steps_run,
            max: statistics.longest_step,
        },
        stopped,
        execution: Execution {
            outputs_s: Some(statistics.outputs_s),
            ..Execution::here(statistics.wall_s, steps_run, Some(simulation.solver().name()))
        },
        ..Summary::default()
    };
    set_gauges(&mut summary, case, dir)?;
    if let Some(units) = &case.units {
        summary.set_groups(units.groups.iter().map(group_of).collect(), units_of(simulation));
    }
    Ok(summary)
}

/// Counts the particles of all regions, with their buffers.
fn particle_counts(simulation: &Simulation) -> ParticleCounts {
    let mut counts = ParticleCounts::default();
    for Simulation { water, boundary, .. } in simulation.regions() {
        counts.water += water.len() as u64;
        counts.bed += boundary.pistons().start as u64;
        counts.wavemaker += boundary.pistons().len() as u64;
        counts.units += (boundary.len() - boundary.walls().end) as u64;
    }
    counts
}

fn wave(case: &Case) -> Option<WaveSummary> {
    let (kind, theory) = match (&case.wave, case.wavemaker) {
        (Wave::None, _) => return None,
        (Wave::Solitary(wave), _) if wave.theory == PistonTheory::Boussinesq => ("solitary", "boussinesq"),
        (Wave::Solitary(_), _) => ("solitary", "rayleigh"),
        (Wave::SolitaryInflow(_), _) => ("solitary", "third_order"),
        (Wave::Regular { .. }, Wavemaker::MlPiston { .. } | Wavemaker::OpenEnds { .. }) => {
            ("regular", "stream_function")
        }
        (Wave::Regular { .. }, Wavemaker::Piston { .. }) => ("regular", "madsen"),
        (Wave::Regular { .. }, Wavemaker::Flap { .. }) => ("regular", "biesel"),
        (Wave::Irregular { .. }, _) => ("irregular", "jonswap"),
        // The height of a wave from files is not known.
        (Wave::External(_), _) => return None,
    };
    let (kind, theory) = (kind.to_owned(), theory.to_owned());
    Some(WaveSummary { kind, theory, height_m: case.wave.height()?, period_s: case.wave.period() })
}

fn section_of(part: &Part) -> Option<SectionSummary> {
    let points_m = part.section()?.points().iter().map(|point| point.to_array()).collect();
    Some(SectionSummary { name: part.name.clone(), points_m })
}

fn body_of(part: &Part) -> Option<BodySummary> {
    let body = part.as_body()?;
    Some(BodySummary {
        name: part.name.clone(),
        file: body.file_name.clone(),
        scale: body.scale,
        origin_m: body.origin.to_array(),
        side_view_m: body.side_view(),
    })
}

fn group_of(group: &UnitGroup) -> GroupSummary {
    GroupSummary {
        name: group.name.clone(),
        units: [group.members.start as u32 + 1, group.members.end as u32],
        fixed: group.is_fixed,
        nominal_diameter_m: group.nominal_diameter,
        models: group.models.len() as u32,
        damage_measure: group.limits.measure,
        damage_distance_m: group.limits.distance,
        rotation_limit_deg: group.limits.rotation_deg,
        rocking_limit_deg: group.limits.rocking_deg,
        ..GroupSummary::default()
    }
}

fn units_of(simulation: &Simulation) -> Vec<UnitSummary> {
    let Some(units) = &simulation.units else { return Vec::new() };
    let statistics = &simulation.statistics;
    let summary_of = |(k, (group, _)): (usize, (&UnitGroup, &UnitModel))| {
        let (now, start) = (&units.states()[k], &units.start[k]);
        let turned = (now.rotation * start.rotation.inverse()).normalize();
        let angle = 2.0 * turned.xyz().length().atan2(turned.w.abs());
        let (from, to) = (start.position.to_array(), now.position.to_array());
        UnitSummary {
            peak_fluid_force_n: statistics.peak_fluid_force[k],
            peak_contact_force_n: statistics.peak_contact_force[k],
            bed_contacts: statistics.contacts[k][0],
            unit_contacts: statistics.contacts[k][1],
            rocking_movements: statistics.rocking[k].movements(),
            largest_rocking_deg: statistics.rocking[k].largest_angle.to_degrees(),
            ..UnitSummary::moved(k as u32 + 1, from, to, angle.to_degrees(), group.limits)
        }
    };
    units.each().enumerate().map(summary_of).collect()
}

/// Sets the results of the gauges, read from the gauge tables: highest elevations and pressures, extremes and impulses
/// of forces. A resumed run has the same tables, so these results need no state of their own.
fn set_gauges(summary: &mut Summary, case: &Case, dir: &Path) -> Result<(), OutputError> {
    let particles = Table::read_if_present(&dir.join("gauges.csv"))?;
    let flume = Table::read_if_present(&dir.join("flume_gauges.csv"))?;
    let highest = |table: &Option<Table>, column: &str| {
        let series = table.as_ref()?.get(column)?;
        series.iter().copied().filter(|value| value.is_finite()).reduce(f64::max)
    };
    for Gauge { name, quantity, at, in_domain, .. } in &case.gauges {
        match quantity {
            Quantity::Elevation => summary.gauges.push(GaugeSummary {
                name: name.clone(),
                x_m: at[0],
                crest_sph_m: highest(&particles, &columns::elevation(name)),
                crest_flume_m: highest(&flume, &columns::elevation(name)),
            }),
            Quantity::Pressure if *in_domain => {
                let [highest_pa, highest_mean_pa] = columns::pressure(name).map(|column| highest(&particles, &column));
                let pressure = PressureSummary { name: name.clone(), at_m: *at, highest_mean_pa, highest_pa };
                summary.pressure_gauges.push(pressure);
            }
            Quantity::Force(_) | Quantity::PartForce(_) => {
                if let Some(table) = &particles {
                    summary.force_gauges.push(ForceSummary::from_table(name, *at, table)?);
                }
            }
            Quantity::Pressure | Quantity::Velocity => {}
        }
    }
    Ok(())
}
