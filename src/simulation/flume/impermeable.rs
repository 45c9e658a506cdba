//! Impermeable surfaces: water does not flow through solids.
//!
//! mDBC gives the boundary particles the pressure of the nearby water, but it does not stop every particle. A water
//! particle that hits an edge, or enters the narrow gap under a unit, can pass through the surface. Therefore the few
//! particles within [`NEAREST`] particle spacings of a surface obey the condition of an impermeable surface: they lose
//! the component of their relative velocity towards the surface. In calm water no particle is affected, because all
//! particles stay half a particle spacing away from surfaces. A unit receives the momentum that the water loses.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::{Simulation, Units, wave::absorb::rows};
use crate::{
    case::{Case, Sides},
    geometry::{axis_box::AxisBox, convex::convex_part::ConvexPart},
    rigid::{BodyState, Load},
    sph::{
        neighbours::grid::{Bins, Grid},
        particles::{bed::Outline, water::Water},
        solver::backend::{DeviceError, Surfaces},
    },
    waves::generation::wavemaker::Wavemaker,
};

/// Water particles nearer to a surface than this cannot approach it further: distance divided by the particle spacing
/// [-]. In calm water, the distance of the nearest particles is twice as large.
pub const NEAREST: f64 = 0.25;

impl Simulation {
    /// Removes the velocity components of near water particles towards bed, walls, obstacles, wavemaker and units, at
    /// the end of a time step of length `dt` [s]. Adds the impulses on the units, divided by `dt`, to the water loads.
    ///
    /// # Errors
    /// If the device is lost.
    pub(super) fn remove_velocities_into_solids(&mut self, dt: f64) -> Result<(), DeviceError> {
        let flume_time = self.flume_time() + dt;
        let rows = self.wavemaker.as_ref().map(|wavemaker| rows(wavemaker, &self.absorbed, flume_time, 0.0));
        let rows = rows.unwrap_or_default();
        let Self { case, outline, wavemaker, units, solver, water, .. } = self;
        let near = match solver.device_memory() {
            Some(memory) => {
                let surfaces = surfaces(case, outline, units.as_ref(), wavemaker.as_ref(), &rows);
                Some(memory.fetch_near_water(&surfaces)?)
            }
            None => None,
        };
        let dp = case.domain.dp;
        let nearest = NEAREST * dp;
        // A graphics card returns only the particles near surfaces. On a processor, the bins give those near the units.
        let mut keep_out = |water: &mut Water, bins: Option<&Bins>| {
            keep_out_of_walls(water, outline, nearest);
            if case.domain.sides == Sides::Walls {
                keep_out_of_sides(water, case.domain.width, nearest);
            }
            for obstacle in &case.domain.obstacles {
                keep_out_of_obstacle(water, obstacle, nearest);
            }
            if let Some(wavemaker) = wavemaker {
                keep_out_of_wavemaker(water, wavemaker, &rows, dp, nearest);
            }
            let Some(units) = units else { return };
            let impulses = keep_out_of_units(water, units, solver.grid(), bins, nearest);
            let slices = case.units.as_ref().map_or(1.0, |units| units.slices);
            for (load, impulse) in units.fluid_loads.iter_mut().zip(impulses) {
                *load += impulse.map(|sum| slices * sum / dt);
            }
        };
        match near {
            None => keep_out(water, Some(solver.water_bins())),
            Some(mut near) => {
                keep_out(&mut near.water, None);
                if let Some(memory) = solver.device_memory() {
                    memory.write_near_velocities(&near);
                }
            }
        }
        Ok(())
    }
}

/// Returns the impermeable surfaces for a graphics card. `rows` has the displacement [m] and velocity [m/s] of each row
/// of the wavemaker.
fn surfaces(
    case: &Case,
    outline: &Outline,
    units: Option<&Units>,
    wavemaker: Option<&Wavemaker>,
    rows: &[[f64; 2]],
) -> Surfaces {
    let nearest = NEAREST * case.domain.dp;
    let bounding_spheres = units.into_iter().flat_map(|units| {
        let of_unit = move |state: &BodyState| {
            let bounding_sphere = |part: &ConvexPart| {
                let (centre, radius) = part.bounding_sphere();
                (state.position + state.rotation * centre, radius + nearest)
            };
            units.shape.parts().iter().map(bounding_sphere).collect::<Vec<_>>()
        };
        units.states().iter().flat_map(of_unit).collect::<Vec<_>>()
    });
    Surfaces {
        min_distance: nearest,
        outline: outline.segments().map(|[a, b]| [a.x, a.y, b.x, b.y]).collect(),
        obstacles: case.domain.obstacles.iter().map(|obstacle| [obstacle.low, obstacle.high]).collect(),
        bounding_spheres: bounding_spheres.collect(),
        wavemaker: wavemaker.map(|wavemaker| {
            (wavemaker.rest_x_m(), wavemaker.row_heights_m()[0], rows.iter().map(|row| row[0]).collect())
        }),
        sides: (case.domain.sides == Sides::Walls).then_some(case.domain.width),
    }
}

/// Returns `velocity` without its component opposite to the unit vector `normal`, if it has such a component.
fn without_approach(velocity: DVec3, normal: DVec3) -> DVec3 {
    velocity - velocity.dot(normal).min(0.0) * normal
}

fn keep_out_of_walls(water: &mut Water, outline: &Outline, nearest: f64) {
    (&water.position, &mut water.velocity).into_par_iter().with_min_len(4096).for_each(|(position, velocity)| {
        let place = DVec2::new(position.x, position.z);
        if let Some(normal) = outline.normal_within(place, nearest) {
            *velocity = without_approach(*velocity, DVec3::new(normal.x, 0.0, normal.y));
        }
    });
}

fn keep_out_of_obstacle(water: &mut Water, obstacle: &AxisBox, nearest: f64) {
    (&water.position, &mut water.velocity).into_par_iter().with_min_len(4096).for_each(|(position, velocity)| {
        // Skip the many particles that are not near the obstacle, before the slower search for the surface point.
        if (*position - obstacle.nearest(*position)).length_squared() >= nearest * nearest {
            return;
        }
        let (surface, distance) = obstacle.locate(*position);
        let outwards = if distance > 0.0 { *position - surface } else { surface - *position };
        if let Some(normal) = outwards.try_normalize() {
            *velocity = without_approach(*velocity, normal);
        }
    });
}

fn keep_out_of_sides(water: &mut Water, width: f64, nearest: f64) {
    (&water.position, &mut water.velocity).into_par_iter().with_min_len(4096).for_each(|(position, velocity)| {
        if position.y < nearest {
            velocity.y = velocity.y.max(0.0);
        }
        if position.y > width - nearest {
            velocity.y = velocity.y.min(0.0);
        }
    });
}

fn keep_out_of_wavemaker(water: &mut Water, wavemaker: &Wavemaker, rows: &[[f64; 2]], dp: f64, nearest: f64) {
    let place = wavemaker.rest_x_m();
    let furthest = rows.iter().map(|row| row[0]).fold(f64::MIN, f64::max) + place + nearest;
    let lowest = wavemaker.row_heights_m()[0];
    (&water.position, &mut water.velocity).into_par_iter().with_min_len(4096).for_each(|(position, velocity)| {
        if position.x > furthest {
            return;
        }
        let row = ((position.z - lowest) / dp).round().clamp(0.0, (rows.len() - 1) as f64) as usize;
        let [displacement, speed] = rows[row];
        if position.x < place + displacement + nearest {
            velocity.x = velocity.x.max(speed);
        }
    });
}

/// Removes the velocity components of near water particles towards the units. Returns the impulse on each unit [N s],
/// and its moment about the centre of mass [N m s].
fn keep_out_of_units(water: &mut Water, units: &Units, grid: &Grid, bins: Option<&Bins>, nearest: f64) -> Vec<Load> {
    let reach = units.shape.parts().iter().map(reach_of).fold(0.0, f64::max) + nearest;
    let keep_out = |state: &BodyState| {
        let mut impulse = Load::default();
        let near: Vec<usize> = match bins {
            Some(bins) => candidates(grid, bins, state.position, reach).collect(),
            None => (0..water.len()).collect(),
        };
        for particle in near {
            let mut arm = water.position[particle] - state.position;
            if let Some(width) = grid.periodic_width {
                arm.y -= width * (arm.y / width).round();
            }
            if arm.length_squared() > reach * reach {
                continue;
            }
            let Some(normal) = normal_within(units.shape.parts(), state, arm, nearest) else { continue };
            let surface = state.velocity + state.angular_velocity.cross(arm);
            let velocity = surface + without_approach(water.velocity[particle] - surface, normal);
            let taken = water.mass[particle] * (water.velocity[particle] - velocity);
            water.velocity[particle] = velocity;
            impulse += Load::of_force(taken, arm);
        }
        impulse
    };
    units.states().iter().map(keep_out).collect()
}

/// Returns the radius of the sphere around the centre of mass that contains the part [m].
fn reach_of(part: &ConvexPart) -> f64 {
    let (centre, radius) = part.bounding_sphere();
    centre.length() + radius
}

/// Returns the outward normal of a unit at the point `arm` [m] from its centre of mass; `None` if this point is not
/// within `nearest` [m] of the surface.
fn normal_within(parts: &[ConvexPart], state: &BodyState, arm: DVec3, nearest: f64) -> Option<DVec3> {
    let local = state.rotation.inverse() * arm;
    let distances = parts.iter().map(|part| (part, part.distance(local)));
    let (part, distance) = distances.min_by(|a, b| a.1.total_cmp(&b.1))?;
    // The core is the part without its rounding. Outside the core, the normal points away from the core; inside, it
    // points away from the centre of mass.
    let outwards = (local - part.nearest(local)).try_normalize().or(local.try_normalize())?;
    (distance < nearest).then(|| state.rotation * outwards)
}

/// Returns the water particles in the bins within `reach` [m] of `centre`. A margin of half a bin covers the motion of
/// the particles since they were sorted into bins.
fn candidates<'a>(grid: &Grid, bins: &'a Bins, centre: DVec3, reach: f64) -> impl Iterator<Item = usize> + use<'a> {
    let [nx, ny, _] = grid.count;
    let margin = reach + 0.5 * grid.size.x;
    let along = |axis: usize| grid.along(axis, centre[axis] - margin)..=grid.along(axis, centre[axis] + margin);
    let (x, z) = (along(0), along(2));
    let y = if grid.periodic_width.is_some() { 0..=ny - 1 } else { along(1) };
    let rows = z.flat_map(move |iz| y.clone().map(move |iy| (iz * ny + iy) * nx));
    rows.flat_map(move |row| bins.start[row + x.start()] as usize..bins.start[row + x.end() + 1] as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_velocity_towards_the_surface_is_removed() {
        let normal = DVec3::Z;
        assert_eq!(without_approach(DVec3::new(1.0, 2.0, -3.0), normal), DVec3::new(1.0, 2.0, 0.0));
        assert_eq!(without_approach(DVec3::new(1.0, 2.0, 3.0), normal), DVec3::new(1.0, 2.0, 3.0));
    }
}
