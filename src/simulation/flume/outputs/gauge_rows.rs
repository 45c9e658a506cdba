//! Rows of `gauges.csv`.

use std::ops::Range;

use glam::DVec3;

use crate::{
    case::{Case, Gauge, Quantity},
    output::columns,
    rigid::Load,
    simulation::flume::{Simulation, Units},
};

/// Returns the gauges in the particle domain.
fn wet_gauges(case: &Case) -> impl Iterator<Item = &Gauge> {
    case.gauges.iter().filter(|gauge| gauge.in_domain)
}

/// Returns the column names of `gauges.csv`.
pub(super) fn gauge_columns(case: &Case) -> Vec<String> {
    let names = wet_gauges(case).flat_map(|gauge| match &gauge.quantity {
        Quantity::Elevation => vec![columns::elevation(&gauge.name), columns::wetted_length(&gauge.name)],
        Quantity::Pressure => columns::pressure(&gauge.name).to_vec(),
        Quantity::Velocity => columns::velocity(&gauge.name).to_vec(),
        Quantity::Force(_) | Quantity::PartForce(_) => columns::force(&gauge.name).to_vec(),
    });
    ["time_s".to_owned()].into_iter().chain(names).collect()
}

/// Returns a row of `gauges.csv`. Gauges without water have NaN, but a wetted length of zero. Gauges behind the
/// wavemaker or less than the smoothing length in front of it have NaN. `values` lists the values of the gauges as
/// [`Simulation::gauge_values`], first at this time, then averaged since the last row; the second list is empty if the
/// device does not compute means. `loads` lists the mean loads of water and contact on each unit.
pub(super) fn gauge_row(simulation: &Simulation, values: [&[Option<f64>]; 2], loads: &[[Load; 2]]) -> Vec<f64> {
    let case = &simulation.case;
    let is_between = |x: f64| simulation.is_between_moving_ends(x);
    let mut next = 0;
    let mut row = vec![simulation.flume_time()];
    for gauge in wet_gauges(case) {
        let at = simulation.gauge_position(gauge);
        let sampler = simulation.region_at(at.x).sampler();
        let sample = || sampler.sample(at).filter(|_| is_between(at.x));
        match &gauge.quantity {
            Quantity::Elevation => {
                let bed = case.flume.level(at.x, at.y);
                let level = sampler.surface(at.truncate(), bed).filter(|_| is_between(at.x));
                row.push(level.map_or(f64::NAN, |z| z - case.flume.still_water_level));
                let wetted = is_between(at.x).then(|| sampler.wetted_length(at.truncate(), bed));
                row.push(wetted.unwrap_or(f64::NAN));
            }
            Quantity::Pressure => {
                let value = |list: &[Option<f64>]| list.get(next).copied().flatten().unwrap_or(f64::NAN);
                row.extend(values.map(value));
                next += 1;
            }
            Quantity::Velocity => row.extend(sample().map_or([f64::NAN; 3], |s| s.velocity.to_array())),
            Quantity::PartForce(_) => {
                let [now, means] = values.map(|list| list.get(next..next + 6));
                row.extend(means.or(now).into_iter().flatten().map(|value| value.unwrap_or(f64::NAN)));
                next += 6;
            }
            Quantity::Force(members) => {
                let Load { force, torque } = load_about(simulation, members.clone(), at, loads);
                row.extend(force.to_array().into_iter().chain(torque.to_array()));
            }
        }
    }
    row
}

/// Returns the force of the water on some units, and its moment about a point [m].
fn load_about(simulation: &Simulation, members: Range<usize>, about: DVec3, loads: &[[Load; 2]]) -> Load {
    let mut sum = Load::default();
    for (state, [fluid, _]) in
        simulation.units.iter().flat_map(Units::states).zip(loads).skip(members.start).take(members.len())
    {
        sum += Load { force: fluid.force, torque: fluid.torque + (state.position - about).cross(fluid.force) };
    }
    sum
}
