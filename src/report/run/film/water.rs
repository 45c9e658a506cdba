//! Water of the film: its surface if the run recorded it, otherwise its particles.

use serde_json::Value;

use super::super::folder::RunFolder;
use super::super::scene::bed_in;
use super::super::water::round_up;
use crate::case::Case;
use crate::output::{OutputError, PolyDataMoments};
use crate::report::film::{BUDGET, DENSE, Field, Mesh, Seen, Series, packed_size, thinned};

/// Edge lengths of the cells in which points of the surface are merged, if the film would be too large [particle
/// spacings].
const CELLS: [f32; 6] = [0.0, 1.6, 2.2, 3.0, 4.5, 6.0];
/// A point within this distance of a side wall or of the bed lies on it [particle spacings].
const AT_SIDE: f64 = 1.0;
const AT_BED: f64 = 1.0;
/// Edge length of the cells in which points at the side walls are merged [particle spacings].
const WALL_CELL: f32 = 2.0;
/// Share of the values within a colour scale [-]; higher values get its last colour.
const SHARE_IN_SCALE: f64 = 0.995;

/// Files with the water of a run.
pub struct Water {
    file: PolyDataMoments,
    is_surface: bool,
    /// Finest particle spacing [m].
    spacing: f32,
    /// Particle spacing [m] and range of x [m] of each region of coarser water.
    coarse: Vec<(f64, [f64; 2])>,
}

/// How a frame is simplified.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Detail {
    /// Points of the surface are merged in cells of this size [m]; 0 for all points.
    Cell(f32),
    /// One of so many particles is shown.
    OneOf(usize),
}

impl Water {
    /// Opens the file with the surface of the water or, if there is none, the file with its particles. Returns `None`
    /// if the run recorded neither of them with velocities.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn open(run: &RunFolder) -> Result<Option<Self>, OutputError> {
        for (name, is_surface) in [(RunFolder::SURFACE, true), (RunFolder::WATER, false)] {
            if !run.has(name) {
                continue;
            }
            let file = PolyDataMoments::open(&run.dir.join(name))?;
            if file.has("velocity") && !file.times_s().is_empty() {
                return Ok(Some(Self {
                    file,
                    is_surface,
                    spacing: run.summary.dp_m as f32,
                    coarse: coarse_regions(run),
                }));
            }
        }
        Ok(None)
    }

    /// Returns the recorded times [s].
    pub fn times_s(&self) -> &[f64] {
        self.file.times_s()
    }

    /// Returns the series of the water at some of the recorded times `frames`, and these times: the particles, or the
    /// free surface and the water at the side walls. Points are merged, and then frames left out, until the water fits
    /// into its part of the page.
    ///
    /// # Errors
    /// If the file cannot be read.
    pub fn series(&self, run: &RunFolder, frames: &[usize]) -> Result<(Vec<Series>, Vec<usize>), OutputError> {
        let samples = [frames.len() / 3, frames.len() / 2, frames.len() - 1].map(|index| frames[index]);
        let sampled = samples.iter().map(|frame| self.parts(run, *frame)).collect::<Result<Vec<_>, _>>()?;
        let mut series = self.without_frames(&sampled);
        let details: Vec<Detail> = match self.is_surface {
            true => CELLS.iter().map(|cells| Detail::Cell(cells * self.spacing)).collect(),
            false => (0..8).map(|power| Detail::OneOf(1 << power)).collect(),
        };
        // Number of frames that fit into the page with a detail.
        let affordable = |detail: Detail| {
            let size = |parts: &Vec<Mesh>| {
                series.iter().zip(parts).map(|(series, mesh)| packed_size(series, &simplified(mesh, detail))).sum()
            };
            BUDGET / sampled.iter().map(size).max().unwrap_or(0).max(1_usize)
        };
        let choose = |detail: &Detail| affordable(*detail) >= frames.len();
        let detail = details.iter().copied().find(choose).unwrap_or(details[details.len() - 1]);
        let most = affordable(detail).clamp(2, frames.len().max(2));
        let chosen: Vec<usize> = thinned(frames.len(), most).into_iter().map(|index| frames[index]).collect();
        for frame in &chosen {
            for (series, mesh) in series.iter_mut().zip(self.parts(run, *frame)?) {
                series.frames.push(simplified(&mesh, detail));
            }
        }
        Ok((series, chosen))
    }

    /// Particle spacing at a position along the flume [m].
    fn spacing_at(&self, x: f32) -> f64 {
        let x = f64::from(x);
        let region = self.coarse.iter().find(|(_, [from, to])| (*from..*to).contains(&x));
        region.map_or(f64::from(self.spacing), |(spacing, _)| *spacing)
    }

    fn without_frames(&self, sampled: &[Vec<Mesh>]) -> Vec<Series> {
        let top = |field: usize| {
            let highest = |mesh: &Mesh| {
                let mut values = mesh.values[field].clone();
                values.sort_by(f32::total_cmp);
                values.get((SHARE_IN_SCALE * values.len() as f64) as usize).copied().unwrap_or(0.0)
            };
            round_up(f64::from(sampled.iter().flatten().map(highest).fold(0.0, f32::max))) as f32
        };
        let count = sampled[0][0].values.len();
        let names = [("speed", "m/s"), ("pressure", "Pa")].into_iter().take(count).enumerate();
        let fields: Vec<Field> =
            names.map(|(index, (name, unit))| Field::numbers(name, unit, [0.0, top(index)], &DENSE)).collect();
        let named = |name: &'static str, opacity: f32| Series {
            fields: fields.clone(),
            ..Series::new(name, "#5b9bd5", opacity, Vec::new())
        };
        if self.is_surface {
            let walls = Series { seen: Seen::Inside, smooth: true, ..named("Water", 1.0) };
            let surface = Series { smooth: true, ..named("Water", 0.72) };
            vec![surface, walls]
        } else {
            vec![Series { dot: 0.95 * self.spacing, ..named("Water", 1.0) }]
        }
    }

    /// Reads a frame with speed and pressure of its points: the particles, or the free surface and the parts of the
    /// surface at the two side walls. The part on the bed is left out.
    fn parts(&self, run: &RunFolder, frame: usize) -> Result<Vec<Mesh>, OutputError> {
        let speed = |v: &[f32; 3]| v.iter().map(|c| c * c).sum::<f32>().sqrt();
        let mut values = vec![self.file.vectors(frame, "velocity")?.iter().map(speed).collect()];
        if self.file.has("pressure") {
            values.push(self.file.numbers::<f32>(frame, "pressure")?);
        }
        let points = self.file.points(frame)?;
        if !self.is_surface {
            return Ok(vec![Mesh { points, triangles: Vec::new(), values }]);
        }
        let mesh = Mesh { triangles: self.file.triangles(frame)?, points, values };
        let width = run.summary.domain_width_m;
        let bed = Bed::new(run);
        let at_side =
            |corner: &[f32; 3], side: f64| (f64::from(corner[1]) - side).abs() < AT_SIDE * self.spacing_at(corner[0]);
        let at_bed = |corner: &[f32; 3]| {
            f64::from(corner[2]) < bed.z(f64::from(corner[0])) + AT_BED * self.spacing_at(corner[0])
        };
        // The edge between a side wall and the bed belongs to the wall.
        let is_at = |corners: &[[f32; 3]; 3], side: f64| {
            corners.iter().all(|corner| at_side(corner, side) || at_bed(corner))
                && corners.iter().any(|corner| at_side(corner, side))
        };
        let is_edge = |corner: &[f32; 3]| at_side(corner, 0.0) || at_side(corner, width) || at_bed(corner);
        let free = mesh.filtered(|corners| !corners.iter().all(is_edge));
        let mut walls = Mesh { values: vec![Vec::new(); mesh.values.len()], ..Mesh::default() };
        for (side, outwards) in [(0.0, -1.0), (width, 1.0)] {
            let wall = mesh.filtered(|corners| is_at(corners, side)).clustered(WALL_CELL * self.spacing);
            // Merged points can turn a triangle over: it would be seen from outside.
            walls.append(&wall.filtered(|corners| outwards * normal(corners)[1] > 0.0));
        }
        Ok(vec![free, walls])
    }
}

/// Normal of a triangle, of any length.
fn normal(corners: &[[f32; 3]; 3]) -> [f32; 3] {
    let [a, b, c] = corners.map(glam::Vec3::from_array);
    (b - a).cross(c - a).to_array()
}

/// Returns particle spacing and range of x of the regions of coarser water [m].
fn coarse_regions(run: &RunFolder) -> Vec<(f64, [f64; 2])> {
    let path = run.dir.join("case.json");
    let keys: Value = std::fs::read(&path).ok().and_then(|text| serde_json::from_slice(&text).ok()).unwrap_or_default();
    // Most cases have water of one spacing. To read a case completely may take seconds.
    if keys["domain"]["fine_x_m"].as_array().is_none_or(Vec::is_empty) {
        return Vec::new();
    }
    let of_case = |case: Case| {
        let coarse = case.domain.regions.iter().filter(|region| region.coarseness > 1);
        coarse.map(|region| (f64::from(region.coarseness) * case.domain.dp, region.x)).collect()
    };
    Case::load(&path).map(of_case).unwrap_or_default()
}

fn simplified(mesh: &Mesh, detail: Detail) -> Mesh {
    match detail {
        Detail::Cell(0.0) | Detail::OneOf(1) => mesh.clone(),
        Detail::Cell(cell) => mesh.clustered(cell),
        Detail::OneOf(count) => {
            fn every<T: Copy>(list: &[T], count: usize) -> Vec<T> {
                list.iter().copied().step_by(count).collect()
            }
            let values = mesh.values.iter().map(|list| every(list, count)).collect();
            Mesh { points: every(&mesh.points, count), triangles: Vec::new(), values }
        }
    }
}

/// The bed profile, for many positions.
struct Bed {
    points: Vec<[f64; 2]>,
}

impl Bed {
    fn new(run: &RunFolder) -> Self {
        let [begin, end] = run.summary.domain_x_m;
        Self { points: bed_in(run, [begin, end]) }
    }

    /// Height of the bed [m]; negative infinity beyond its ends.
    fn z(&self, x: f64) -> f64 {
        let after = self.points.partition_point(|point| point[0] < x);
        let (Some([x1, z1]), Some([x0, z0])) = (self.points.get(after), self.points.get(after.wrapping_sub(1))) else {
            return f64::NEG_INFINITY;
        };
        z0 + (z1 - z0) * (x - x0) / (x1 - x0)
    }
}
