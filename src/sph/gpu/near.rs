//! The card finds the water particles near surfaces. The host, which knows the exact shapes, removes the velocity
//! components of these particles towards the surfaces.

use bytemuck::{Pod, Zeroable};
use glam::{DVec3, Vec3};

use super::card::{Card, groups};
use super::memory::Memory;
use super::shaders::{Bound, Kernel, NEAR, Shader};
use super::state::CardState;
use crate::sph::neighbours::grid::Grid;
use crate::sph::solver::backend::{DeviceError, NearWater, Surfaces};

/// Initial capacity of the buffers for particles near surfaces.
const INITIAL_ROOM: usize = 4096;

/// Distance that is added to the search distance, because single-precision positions have rounding errors in a long
/// flume [dp].
const ALLOWANCE: f64 = 0.01;

/// The struct `Surfaces` of `near.wgsl`, with the same fields in the same order.
#[derive(Debug, Clone, Copy, Default, Pod, Zeroable)]
#[repr(C)]
pub(super) struct SurfaceConstants {
    segments: u32,
    obstacles: u32,
    spheres: u32,
    rows: u32,
    min_distance: f32,
    place: f32,
    lowest: f32,
    dp: f32,
    sides: f32,
    low_side: f32,
    room: u32,
    padding: u32,
}

/// The struct `Near` of `near.wgsl`: a particle near a surface.
#[derive(Debug, Clone, Copy, Pod, Zeroable)]
#[repr(C)]
pub(super) struct NearParticle {
    cell: [i32; 4],
    offset: [f32; 4],
    motion: [f32; 4],
}

/// Search for water near surfaces.
pub(super) struct NearSearch {
    find: Kernel,
    put: Kernel,
    constants: wgpu::Buffer,
    /// Constants for writing velocities back to the card; `room` is the number of velocities.
    put_constants: wgpu::Buffer,
    memory: SearchMemory,
}

/// Buffers that grow on demand, and the kernels bound to these buffers.
struct SearchMemory {
    shapes: wgpu::Buffer,
    shapes_room: usize,
    near: wgpu::Buffer,
    changes: wgpu::Buffer,
    room: usize,
    find: Bound,
    put: Bound,
}

impl NearSearch {
    /// Creates a search among the water particles of `memory`.
    pub fn new(card: &Card, memory: &Memory) -> Result<Self, DeviceError> {
        let shader = Shader::new(card, NEAR).periodic(memory.is_periodic);
        let [find, put] = ["find_near", "put_velocities"].map(|name| shader.kernel(name));
        let constants = card.uniform("surfaces", &SurfaceConstants::default());
        let put_constants = card.uniform("velocities", &SurfaceConstants::default());
        let own = SearchMemory::new(card, memory, [&find, &put], [&constants, &put_constants], [64, INITIAL_ROOM])?;
        Ok(Self { find, put, constants, put_constants, memory: own })
    }

    fn grow(&mut self, card: &Card, memory: &Memory, shapes: usize, room: usize) -> Result<(), DeviceError> {
        let constants = [&self.constants, &self.put_constants];
        self.memory = SearchMemory::new(card, memory, [&self.find, &self.put], constants, [shapes, room])?;
        Ok(())
    }

    /// Executes the commands in `encoder` and finds the water near surfaces. Returns the extreme values of the water
    /// (see `extremes` in `step.wgsl`) and the particles near surfaces, in ascending order of their indices.
    pub fn find(
        &mut self,
        card: &Card,
        memory: &Memory,
        grid: &Grid,
        dp: f64,
        surfaces: &Surfaces,
        mut encoder: wgpu::CommandEncoder,
    ) -> Result<([u32; 5], CardState), DeviceError> {
        let (mut constants, shapes) = shapes_of(grid, dp, surfaces);
        if shapes.len() > self.memory.shapes_room {
            self.grow(card, memory, 2 * shapes.len(), self.memory.room)?;
        }
        loop {
            constants.room = self.memory.room as u32;
            card.write(&self.constants, 0, &[constants]);
            card.write(&self.memory.shapes, 0, &shapes);
            self.memory.find.run(&mut encoder, groups(memory.water, 64));
            let extremes: Vec<u32> = card.read(encoder, &memory.extremes, 0, 5)?;
            let extremes: [u32; 5] = std::array::from_fn(|k| extremes[k]);
            let count = extremes[4] as usize;
            if count <= self.memory.room {
                let mut near: Vec<NearParticle> = card.read(card.encoder(), &self.memory.near, 0, count)?;
                // The card lists the particles in no fixed order.
                near.sort_unstable_by_key(|particle| particle.cell[3]);
                return Ok((
                    extremes,
                    CardState {
                        offset: near.iter().map(|particle| particle.offset).collect(),
                        cell: near.iter().map(|particle| particle.cell).collect(),
                        motion: near.iter().map(|particle| particle.motion).collect(),
                    },
                ));
            }
            self.grow(card, memory, self.memory.shapes_room, 2 * count)?;
            card.write(&memory.extremes, 4, &[0_u32]);
            encoder = card.encoder();
        }
    }

    /// Adds commands to `encoder` that write back the velocities of the water near surfaces.
    pub fn put(
        &mut self,
        card: &Card,
        near: &NearWater,
        encoder: &mut wgpu::CommandEncoder,
    ) -> Result<(), DeviceError> {
        let change = |(&place, velocity): (&u32, &DVec3)| {
            let [x, y, z] = velocity.as_vec3().to_array().map(f32::to_bits);
            [x, y, z, place]
        };
        let changes: Vec<[u32; 4]> = near.indices.iter().zip(&near.water.velocity).map(change).collect();
        let constants = SurfaceConstants { room: changes.len() as u32, ..SurfaceConstants::default() };
        card.write(&self.put_constants, 0, &[constants]);
        card.write(&self.memory.changes, 0, &changes);
        self.memory.put.run(encoder, groups(changes.len(), 64));
        card.check()
    }
}

impl SearchMemory {
    fn new(
        card: &Card,
        memory: &Memory,
        [find, put]: [&Kernel; 2],
        [constants, put_constants]: [&wgpu::Buffer; 2],
        [shapes_room, room]: [usize; 2],
    ) -> Result<Self, DeviceError> {
        let shapes = card.buffer::<[f32; 4]>("shapes", shapes_room)?;
        let near = card.buffer::<NearParticle>("water near surfaces", room)?;
        let changes = card.buffer::<[u32; 4]>("velocities near surfaces", room)?;
        let water = [(0, &memory.parameters), (2, &memory.offset), (3, &memory.cell), (4, &memory.motion)];
        let found = [(1, constants), (5, &shapes), (6, &near), (7, &memory.extremes)];
        let find = find.bind(card, &[&water[..], &found[..]].concat());
        let put = put.bind(card, &[(1, put_constants), (4, &memory.motion), (8, &changes)]);
        Ok(Self { shapes, shapes_room, near, changes, room, find, put })
    }
}

/// Returns the surfaces in the layout of the shader, relative to the low corner of the grid [m].
fn shapes_of(grid: &Grid, dp: f64, surfaces: &Surfaces) -> (SurfaceConstants, Vec<[f32; 4]>) {
    let vector = |point: DVec3, w: f64| (point - grid.low).as_vec3().extend(w as f32).to_array();
    let (low_x, low_z) = (grid.low.x, grid.low.z);
    let min_distance = surfaces.min_distance + ALLOWANCE * dp;
    let segments = surfaces
        .outline
        .iter()
        .map(|&[x0, z0, x1, z1]| [x0 - low_x, z0 - low_z, x1 - low_x, z1 - low_z].map(|value| value as f32));
    let obstacles = surfaces.obstacles.iter().flatten().map(|&corner| vector(corner, 0.0));
    let spheres = surfaces.bounding_spheres.iter().map(|&(centre, radius)| vector(centre, radius + ALLOWANCE * dp));
    let nothing = (0.0, 0.0, Vec::new());
    let (place, lowest, rows) = surfaces.wavemaker.as_ref().unwrap_or(&nothing);
    let displacements = rows.iter().map(|&row| Vec3::new(row as f32, 0.0, 0.0).extend(0.0).to_array());
    let constants = SurfaceConstants {
        segments: surfaces.outline.len() as u32,
        obstacles: surfaces.obstacles.len() as u32,
        spheres: surfaces.bounding_spheres.len() as u32,
        rows: rows.len() as u32,
        min_distance: min_distance as f32,
        place: (place - low_x) as f32,
        lowest: (lowest - low_z) as f32,
        dp: dp as f32,
        sides: surfaces.sides.unwrap_or(-1.0) as f32,
        low_side: -grid.low.y as f32,
        ..SurfaceConstants::default()
    };
    (constants, segments.chain(obstacles).chain(spheres).chain(displacements).collect())
}
