//! Impermeable surfaces: water does not flow through solids.
//!
//! mDBC gives a boundary the pressure of the water in front of it, but no barrier. A water particle that hits an edge
//! or enters the wedge under a unit can pass through. Therefore the kinematic condition of an impermeable surface is
//! imposed on the few particles nearer to a surface than [`NEAREST`]: the part of their relative velocity towards the
//! surface is removed. In calm water no particle is affected: the particles stay half a particle spacing away. A unit
//! receives the momentum that is removed from the water as an impulse.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::{Simulation, Units, absorb::rows};
use crate::{
    case::Sides,
    geometry::{axis_box::AxisBox, convex_part::ConvexPart},
    rigid::{BodyState, Load},
    sph::{
        backend::{DeviceError, Surfaces},
        grid::{Bins, Grid},
        particles::{bed::Outline, water::Water},
    },
    waves::wavemaker::Wavemaker,
};

/// Distance from a surface, in particle spacings, at which the approach of a particle ends: half the distance in calm
/// water.
pub const NEAREST: f64 = 0.25;

impl Simulation {
    /// Removes velocities into bed, walls, wavemaker and units at the end of a time step of length `dt` [s]; adds the
    /// impulses on the units to their loads.
    ///
    /// # Errors
    /// If the device is lost.
    pub(super) fn keep_water_out(&mut self, dt: f64) -> Result<(), DeviceError> {
        let flume_time = self.flume_time() + dt;
        let rows = self.wavemaker.as_ref().map(|wavemaker| rows(wavemaker, &self.absorbed, flume_time, 0.0));
        let rows = rows.unwrap_or_default();
        let near = match self.solver.keeps_water() {
            true => Some(self.solver.take_near(&self.surfaces(&rows))?),
            false => None,
        };
        let Self { case, outline, wavemaker, units, solver, water, .. } = self;
        let dp = case.domain.dp;
        let nearest = NEAREST * dp;
        // Particles from a device are already near a surface; otherwise the bins find those near the units.
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
                load.force += slices * impulse.force / dt;
                load.torque += slices * impulse.torque / dt;
            }
        };
        match near {
            None => keep_out(water, Some(solver.water_bins())),
            Some(mut near) => {
                keep_out(&mut near.water, None);
                self.solver.put_near(&near);
            }
        }
        Ok(())
    }

    /// Returns the impermeable surfaces, with the wavemaker's rows displaced by `rows`.
    fn surfaces(&self, rows: &[[f64; 2]]) -> Surfaces {
        let (case, dp) = (&self.case, self.case.domain.dp);
        let nearest = NEAREST * dp;
        let balls = self.units.iter().flat_map(|units| {
            let of_unit = move |state: &BodyState| {
                let ball = |part: &ConvexPart| {
                    let (centre, radius) = part.bounding_sphere();
                    (state.position + state.rotation * centre, radius + nearest)
                };
                units.shape.parts().iter().map(ball).collect::<Vec<_>>()
            };
            units.states().iter().flat_map(of_unit).collect::<Vec<_>>()
        });
        Surfaces {
            nearest,
            outline: self.outline.pieces().map(|[a, b]| [a.x, a.y, b.x, b.y]).collect(),
            boxes: case.domain.obstacles.iter().map(|obstacle| [obstacle.low, obstacle.high]).collect(),
            balls: balls.collect(),
            wavemaker: self.wavemaker.as_ref().map(|wavemaker| {
                (wavemaker.place_m(), wavemaker.row_heights_m()[0], rows.iter().map(|row| row[0]).collect())
            }),
            sides: (case.domain.sides == Sides::Walls).then_some(case.domain.width),
        }
    }
}

/// Returns the velocity without its part against the unit vector `normal`.
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
        // A cheap test for the many particles far away.
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
    let place = wavemaker.place_m();
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

/// Removes velocities into units; returns the impulse on each [N s] and its moment about the centre of mass [N m s].
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
            impulse.force += taken;
            impulse.torque += arm.cross(taken);
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

/// Returns the outward normal of a unit, if the point `arm` [m] from its centre is within `nearest` [m] of its surface.
fn normal_within(parts: &[ConvexPart], state: &BodyState, arm: DVec3, nearest: f64) -> Option<DVec3> {
    let local = state.rotation.inverse() * arm;
    let distances = parts.iter().map(|part| (part, part.distance(local)));
    let (part, distance) = distances.min_by(|a, b| a.1.total_cmp(&b.1))?;
    // Away from the part's core; inside the core, away from the centre of mass.
    let outwards = (local - part.nearest(local)).try_normalize().or(local.try_normalize())?;
    (distance < nearest).then(|| state.rotation * outwards)
}

/// Returns the water particles in the bins around `centre`; they have hardly moved since they were sorted.
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
