//! Impermeable surfaces: water does not flow through solids.
//!
//! mDBC gives the boundary particles the pressure of the nearby water, but it does not stop every particle. A water
//! particle that hits an edge, or enters the narrow gap under a unit, can pass through the surface. Therefore the few
//! particles within [`NEAREST`] particle spacings of a surface obey the condition of an impermeable surface: they lose
//! the component of their relative velocity towards the surface. In calm water no particle is affected, because all
//! particles stay half a particle spacing away from surfaces. A unit receives the momentum that the water loses.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::{Simulation, Units, wave::ends::MovingEnd};
use crate::{
    case::{BodyPart, Case, Part, Sides, UnitGroup, UnitModel},
    geometry::{axis_box::AxisBox, convex::convex_part::ConvexPart, outline::Outline},
    rigid::{BodyState, Load},
    sph::{
        neighbours::grid::{Bins, Grid},
        particles::water::Water,
        solver::backend::{DeviceError, Surfaces},
    },
};

/// Water particles nearer to a surface than this cannot approach it further: distance divided by the particle spacing
/// [-]. In calm water, the distance of the nearest particles is twice as large.
pub const NEAREST: f64 = 0.25;

/// Number of particles in a chunk.
const CHUNK: usize = 4096;

impl Simulation {
    /// Removes the velocity components of near water particles towards bed, walls, obstacles, wavemaker and units, at
    /// the end of a time step of length `dt` [s]. Adds the impulses on the units, divided by `dt`, to the water loads.
    ///
    /// # Errors
    /// If the device is lost.
    pub(super) fn remove_velocities_into_solids(&mut self, dt: f64) -> Result<(), DeviceError> {
        let flume_time = self.flume_time() + dt;
        let rows: Vec<Vec<[f64; 2]>> = self.ends.iter().map(|end| end.rows(flume_time, 0.0)).collect();
        let Self { case, outline, ends, units, solver, water, bins_near_surfaces, .. } = self;
        let near = match solver.device_memory() {
            Some(memory) => {
                let surfaces = surfaces(case, outline, units.as_ref(), ends, &rows);
                Some(memory.fetch_near_water(&surfaces)?)
            }
            None => None,
        };
        let dp = case.domain.dp;
        let nearest = NEAREST * dp;
        // A graphics card returns only the particles near surfaces. On a processor, the bins give these particles.
        let mut taken = 0.0;
        let mut keep_out = |water: &mut Water, bins: Option<&Bins>| {
            let is_near = |particle: usize| bins.is_none_or(|bins| bins_near_surfaces[bins.bin_at[particle] as usize]);
            taken = keep_out_of_fixed_solids(water, case, outline, is_near, dt);
            for (end, rows) in ends.iter().zip(&rows) {
                keep_out_of_end(water, end, rows, dp, nearest);
            }
            let Some(units) = units else { return };
            let impulses = keep_out_of_units(water, units, solver.grid(), bins, nearest);
            let slices: Vec<f64> = units.each().map(|(group, _)| group.slices).collect();
            for ((load, impulse), slices) in units.fluid_loads.iter_mut().zip(impulses).zip(slices) {
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
        self.statistics.balance.friction -= taken;
        Ok(())
    }
}

/// Returns the impermeable surfaces for a graphics card, which supports only one moving end, a wavemaker. `rows` has the
/// displacement [m] and velocity [m/s] of each row of the moving ends.
fn surfaces(
    case: &Case,
    outline: &Outline,
    units: Option<&Units>,
    ends: &[MovingEnd],
    rows: &[Vec<[f64; 2]>],
) -> Surfaces {
    let nearest = NEAREST * case.domain.dp;
    let bounding_spheres = units.into_iter().flat_map(|units| {
        let of_unit = move |((_, model), state): ((&UnitGroup, &UnitModel), &BodyState)| {
            let bounding_sphere = |part: &ConvexPart| {
                let (centre, radius) = part.bounding_sphere();
                (state.position + state.rotation * centre, radius + nearest)
            };
            model.shape.unit().parts().iter().map(bounding_sphere).collect::<Vec<_>>()
        };
        units.each().zip(units.states()).flat_map(of_unit).collect::<Vec<_>>()
    });
    Surfaces {
        min_distance: nearest,
        outline: outline.segments().iter().map(|[a, b]| [a.x, a.y, b.x, b.y]).collect(),
        obstacles: obstacles(case)
            .map(|obstacle| [obstacle.low, obstacle.high])
            .chain(bodies(case).map(|body| body.solid.bounds()))
            .collect(),
        bounding_spheres: bounding_spheres.collect(),
        wavemaker: ends.first().zip(rows.first()).map(|(end, rows)| {
            (end.wavemaker.rest_x_m(), end.wavemaker.row_heights_m()[0], rows.iter().map(|row| row[0]).collect())
        }),
        sides: (case.domain.sides == Sides::Walls).then_some(case.domain.width),
    }
}

/// Returns the boxes in the water.
fn obstacles(case: &Case) -> impl Iterator<Item = &AxisBox> {
    case.flume.parts.iter().filter_map(Part::as_box)
}

/// Returns the parts of any shape.
fn bodies(case: &Case) -> impl Iterator<Item = &BodyPart> {
    case.flume.parts.iter().filter_map(Part::as_body)
}

/// Returns `velocity` without its component opposite to the unit vector `normal`, if it has such a component.
fn without_approach(velocity: DVec3, normal: DVec3) -> DVec3 {
    velocity - velocity.dot(normal).min(0.0) * normal
}

/// Returns the distance from fixed surfaces within which they act on single water particles [m].
fn reach(case: &Case) -> f64 {
    if case.numerics.wall_friction > 0.0 { case.domain.dp } else { NEAREST * case.domain.dp }
}

/// Returns for each bin whether its particles can be nearer than [`reach`] to bed, end walls, side walls or obstacles
/// at the end of the time step. Half a bin is allowed for their motion since they were sorted into bins.
pub(super) fn bins_near_surfaces(case: &Case, outline: &Outline, grid: &Grid) -> Vec<bool> {
    let [nx, ny, nz] = grid.count;
    let reach = reach(case) + 0.5 * grid.size.length() + 0.5 * grid.size.x;
    let has_side_walls = case.domain.sides == Sides::Walls;
    let middle = |axis: usize, bin: usize| grid.low[axis] + (bin as f64 + 0.5) * grid.size[axis];
    let is_near = |bin: usize| {
        let (ix, iy, iz) = (bin % nx, bin / nx % ny, bin / nx / ny);
        // The outermost bins also contain the particles outside the grid.
        let is_outermost = [(ix, nx), (iz, nz)].iter().any(|(i, n)| *i == 0 || i + 1 == *n);
        let centre = DVec3::new(middle(0, ix), middle(1, iy), middle(2, iz));
        is_outermost
            || outline.normal_within(DVec2::new(centre.x, centre.z), reach).is_some()
            || (has_side_walls && centre.y.min(case.domain.width - centre.y) < reach)
            || obstacles(case).any(|obstacle| obstacle.nearest(centre).distance(centre) < reach)
            || bodies(case).any(|body| body.locate_within(centre, reach).1 < reach)
    };
    (0..grid.bins()).into_par_iter().map(is_near).collect()
}

/// Removes the velocity components towards bed, end walls, side walls and obstacles of the particles for which
/// `is_near` is true, and slows them by the friction of these surfaces during `dt` [s]. Returns the energy that the
/// friction takes from the water [J].
fn keep_out_of_fixed_solids(
    water: &mut Water,
    case: &Case,
    outline: &Outline,
    is_near: impl Fn(usize) -> bool + Sync,
    dt: f64,
) -> f64 {
    let (domain, nearest, reach) = (&case.domain, NEAREST * case.domain.dp, reach(case));
    let slowing = 0.5 * case.numerics.wall_friction * dt / domain.dp;
    // The chunks have a fixed length, so that sums do not depend on the number of threads.
    let chunks = (water.position.par_chunks(CHUNK), water.velocity.par_chunks_mut(CHUNK), water.mass.par_chunks(CHUNK));
    let taken: Vec<f64> = chunks
        .into_par_iter()
        .enumerate()
        .map(|(chunk, (positions, velocities, masses))| {
            let mut taken = 0.0;
            for (k, ((position, velocity), mass)) in positions.iter().zip(velocities).zip(masses).enumerate() {
                if !is_near(chunk * CHUNK + k) {
                    continue;
                }
                let mut meet = |normal: DVec3, distance: f64| {
                    if distance < nearest {
                        *velocity = without_approach(*velocity, normal);
                    }
                    let slower = slowed(*velocity, normal, slowing);
                    taken += 0.5 * mass * (velocity.length_squared() - slower.length_squared());
                    *velocity = slower;
                };
                if let Some((normal, distance)) = outline.normal_within(DVec2::new(position.x, position.z), reach) {
                    meet(DVec3::new(normal.x, 0.0, normal.y), distance);
                }
                if domain.sides == Sides::Walls {
                    for (distance, normal) in [(position.y, DVec3::Y), (domain.width - position.y, DVec3::NEG_Y)] {
                        if distance < reach {
                            meet(normal, distance);
                        }
                    }
                }
                for obstacle in obstacles(case) {
                    if let Some((normal, distance)) = near_obstacle(obstacle, *position, reach) {
                        meet(normal, distance);
                    }
                }
                for body in bodies(case) {
                    let located = body.locate_within(*position, reach);
                    if let Some((normal, distance)) = outwards(*position, located).filter(|near| near.1 < reach) {
                        meet(normal, distance);
                    }
                }
            }
            taken
        })
        .collect();
    taken.iter().sum()
}

/// Returns the velocity after a time step in which a wall slows the water along it. The stress rho / 2 c_f u^2 acts on
/// the layer of water within dp of the wall, so du/dt = -c_f u^2 / (2 dp), with the exact solution
/// u / (1 + u c_f dt / (2 dp)). `slowing` is c_f dt / (2 dp) [s/m].
fn slowed(velocity: DVec3, normal: DVec3, slowing: f64) -> DVec3 {
    let across = velocity.dot(normal) * normal;
    let along = velocity - across;
    across + along / (1.0 + slowing * along.length())
}

/// Returns the outward normal of an obstacle at `position` and the distance from it [m], negative inside; `None` if this
/// point is not within `reach` [m] of the obstacle.
fn near_obstacle(obstacle: &AxisBox, position: DVec3, reach: f64) -> Option<(DVec3, f64)> {
    // Skip particles that are not near the obstacle, before the slower search for the surface point.
    if (position - obstacle.nearest(position)).length_squared() >= reach * reach {
        return None;
    }
    outwards(position, obstacle.locate(position))
}

/// Returns the outward normal of a solid at `position` and the distance from it [m], negative inside, for the nearest
/// point of its surface and this distance.
fn outwards(position: DVec3, (surface, distance): (DVec3, f64)) -> Option<(DVec3, f64)> {
    let normal = (if distance > 0.0 { position - surface } else { surface - position }).try_normalize()?;
    Some((normal, distance))
}

/// Removes the velocity components of near water particles towards the rows of a moving end, which have the
/// displacements [m] and velocities [m/s] `rows`.
fn keep_out_of_end(water: &mut Water, end: &MovingEnd, rows: &[[f64; 2]], dp: f64, nearest: f64) {
    let (place, inwards, lowest) = (end.wavemaker.rest_x_m(), end.inwards, end.wavemaker.row_heights_m()[0]);
    let furthest = rows.iter().map(|row| inwards * row[0]).fold(f64::MIN, f64::max) + nearest;
    (&water.position, &mut water.velocity).into_par_iter().with_min_len(4096).for_each(|(position, velocity)| {
        let inside = inwards * (position.x - place);
        if inside > furthest {
            return;
        }
        let row = ((position.z - lowest) / dp).round().clamp(0.0, (rows.len() - 1) as f64) as usize;
        let [displacement, speed] = rows[row];
        if inside < inwards * displacement + nearest {
            velocity.x = inwards * (inwards * velocity.x).max(inwards * speed);
        }
    });
}

/// A water particle near a unit.
struct NearUnit {
    particle: usize,
    /// Vector from the centre of mass of the unit to the particle [m].
    arm: DVec3,
    /// Outward normal of the unit at the particle.
    normal: DVec3,
}

/// Removes the velocity components of near water particles towards the units. Returns the impulse on each unit [N s],
/// and its moment about the centre of mass [N m s].
fn keep_out_of_units(water: &mut Water, units: &Units, grid: &Grid, bins: Option<&Bins>, nearest: f64) -> Vec<Load> {
    let position = &water.position;
    let near = |(parts, state): &(&[ConvexPart], &BodyState)| -> Vec<NearUnit> {
        let within = |particle| {
            let arm = grid.nearest_image(position[particle] - state.position);
            let normal = normal_within(parts, state, arm, nearest)?;
            Some(NearUnit { particle, arm, normal })
        };
        let reach = parts.iter().map(reach_of).fold(0.0, f64::max) + nearest;
        match bins {
            Some(bins) => candidates(grid, bins, state.position, reach).filter_map(within).collect(),
            None => (0..water.len()).filter_map(within).collect(),
        }
    };
    let parts = units.each().map(|(_, model)| model.shape.unit().parts());
    let each: Vec<(&[ConvexPart], &BodyState)> = parts.zip(units.states()).collect();
    let near: Vec<Vec<NearUnit>> = each.par_iter().map(near).collect();
    let mut keep_out = |(state, near): (&BodyState, &Vec<NearUnit>)| {
        let mut impulse = Load::default();
        for &NearUnit { particle, arm, normal } in near {
            let surface = state.velocity + state.angular_velocity.cross(arm);
            let velocity = surface + without_approach(water.velocity[particle] - surface, normal);
            let taken = water.mass[particle] * (water.velocity[particle] - velocity);
            water.velocity[particle] = velocity;
            impulse += Load::of_force(taken, arm);
        }
        impulse
    };
    units.states().iter().zip(&near).map(&mut keep_out).collect()
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
    let can_be_near = |part: &&ConvexPart| {
        let (centre, radius) = part.bounding_sphere();
        centre.distance_squared(local) < (radius + nearest).powi(2)
    };
    let distances = parts.iter().filter(can_be_near).map(|part| (part, part.distance(local)));
    let (part, distance) = distances.min_by(|a, b| a.1.total_cmp(&b.1))?;
    if distance >= nearest {
        return None;
    }
    // The core is the part without its rounding. Outside the core, the normal points away from the core; inside, it
    // points away from the centre of mass.
    let outwards = (local - part.nearest(local)).try_normalize().or(local.try_normalize())?;
    Some(state.rotation * outwards)
}

/// Returns the water particles in the bins within `reach` [m] of `centre`. A margin of half a bin covers the motion of
/// the particles since they were sorted into bins.
fn candidates<'a>(grid: &Grid, bins: &'a Bins, centre: DVec3, reach: f64) -> impl Iterator<Item = usize> + use<'a> {
    let [nx, ny, _] = grid.count;
    let margin = reach + 0.5 * grid.size.x;
    let along = |axis: usize| grid.along(axis, centre[axis] - margin)..=grid.along(axis, centre[axis] + margin);
    let (x, y, z) = (along(0), grid.rows_across(centre.y - margin, centre.y + margin), along(2));
    let rows = z.flat_map(move |iz| y.clone().map(move |iy| (iz * ny + iy % ny) * nx));
    rows.flat_map(move |row| bins.start[row + x.start()] as usize..bins.start[row + x.end() + 1] as usize)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn friction_slows_the_water_along_the_wall_as_the_exact_solution() {
        let (velocity, steps) = (DVec3::new(3.0, 4.0, 1.0), 7);
        let slower = (0..steps).fold(velocity, |v, _| slowed(v, DVec3::Z, 0.01));
        let exact = DVec3::new(3.0, 4.0, 0.0) / (1.0 + 0.01 * f64::from(steps) * 5.0) + DVec3::Z;
        // Limit 1e-14: rounding.
        assert!((slower - exact).length() < 1e-14);
    }

    #[test]
    fn only_the_velocity_towards_the_surface_is_removed() {
        let normal = DVec3::Z;
        assert_eq!(without_approach(DVec3::new(1.0, 2.0, -3.0), normal), DVec3::new(1.0, 2.0, 0.0));
        assert_eq!(without_approach(DVec3::new(1.0, 2.0, 3.0), normal), DVec3::new(1.0, 2.0, 3.0));
    }
}
