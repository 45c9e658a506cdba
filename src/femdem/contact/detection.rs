//! Contact detection: finds all pairs of intersecting boxes with a hierarchy of grids, one level per range of box
//! sizes.
//!
//! Method: Munjiza & Andrews (1998), "NBS contact detection algorithm for bodies of similar size", IJNME 43, 131-149.
//! Hierarchy for boxes of different size: Ericson (2005), "Real-Time Collision Detection", section 7.2. A box is stored
//! on the finest level whose cells are not smaller than the box, in the cells that it covers there (at most eight). The
//! box is compared with all boxes stored in the cells that it covers on this level and on all coarser levels. The hash
//! table has one to two buckets per entry, so work and memory are linear in the number of boxes, even if boxes are far
//! apart.

use glam::{DVec3, I64Vec3};
use rayon::prelude::*;

/// An axis-aligned box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Least coordinates [m].
    pub low: DVec3,
    /// Greatest coordinates [m].
    pub high: DVec3,
}

impl Bounds {
    /// Returns the bounding box of points [m], enlarged by `skin` [m] on each side.
    pub fn about(points: &[DVec3], skin: f64) -> Self {
        let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
        let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
        Self { low: low - skin, high: high + skin }
    }

    /// Returns the length of the longest side [m].
    fn size(&self) -> f64 {
        (self.high - self.low).max_element()
    }

    /// Returns true if two boxes have a point in common.
    fn meets(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }
}

/// Smallest number of boxes per task of the thread pool.
const CHUNK: usize = 1024;
/// Number of levels; the cell size doubles from level to level.
const LEVELS: usize = 32;
/// Cell size of the finest level, divided by the median box size [-]. For meshes, detection is fastest with this value.
const FINEST: f64 = 1.25;

/// Returns the pairs (i, j), i < j, of intersecting boxes for which `keep(i, j)` is true. They are in ascending order
/// for any number of threads. The boxes must be finite.
pub fn intersecting_pairs(boxes: &[Bounds], keep: impl Fn(u32, u32) -> bool + Sync) -> Vec<[u32; 2]> {
    let grids = Grids::new(boxes);
    let table = Table::new(&grids, boxes);
    let numbers = (0..boxes.len() as u32).into_par_iter().with_min_len(CHUNK);
    let mut pairs: Vec<[u32; 2]> = numbers
        .fold(Vec::new, |mut found, number| {
            grids.visit_pairs(&table, boxes, number, |i, j| {
                if keep(i, j) {
                    found.push([i, j]);
                }
            });
            found
        })
        .flatten_iter()
        .collect();
    pairs.par_sort_unstable();
    pairs
}

/// Hash table from cells to the boxes stored in them.
struct Table {
    /// Stored boxes, ordered by bucket.
    entries: Vec<Entry>,
    /// Index of the first entry of each bucket, and the end of the last bucket.
    starts: Vec<u32>,
}

/// A box stored in a cell.
#[derive(Clone, Copy, Default)]
struct Entry {
    /// Key of the cell.
    key: u64,
    /// Number of the box.
    number: u32,
}

impl Table {
    /// Sorts the boxes by the buckets of their cells (counting sort).
    fn new(grids: &Grids, boxes: &[Bounds]) -> Self {
        let count: usize = boxes.iter().map(|own| grids.home_cells(own).count()).sum();
        let starts = vec![0; count.next_power_of_two() + 1];
        let mut table = Self { entries: vec![Entry::default(); count], starts };
        for key in boxes.iter().flat_map(|own| grids.home_cells(own)) {
            let bucket = table.bucket(key);
            table.starts[bucket] += 1;
        }
        let mut end = 0;
        for start in &mut table.starts {
            end += *start;
            *start = end;
        }
        // `starts` now contains the end of each bucket. Filling each bucket backwards turns the ends into starts.
        for (number, own) in (0..).zip(boxes) {
            for key in grids.home_cells(own) {
                let bucket = table.bucket(key);
                table.starts[bucket] -= 1;
                table.entries[table.starts[bucket] as usize] = Entry { key, number };
            }
        }
        table
    }

    /// Returns the bucket of the cell with a key, by multiplicative hashing (Knuth 1973, "The Art of Computer
    /// Programming" 3, section 6.4).
    fn bucket(&self, key: u64) -> usize {
        let buckets = self.starts.len() - 1;
        ((key.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32) as usize * buckets) >> 32
    }

    /// Returns the numbers of the boxes stored in a cell.
    fn in_cell(&self, key: u64) -> impl Iterator<Item = u32> {
        let bucket = self.bucket(key);
        let entries = &self.entries[self.starts[bucket] as usize..self.starts[bucket + 1] as usize];
        entries.iter().filter(move |entry| entry.key == key).map(|entry| entry.number)
    }
}

/// The grids of all levels.
struct Grids {
    /// Edge length of the cells of the finest level [m].
    finest: f64,
    /// For each level, true if at least one box is stored on it.
    occupied: [bool; LEVELS],
}

impl Grids {
    /// Chooses the cell sizes for the boxes.
    fn new(boxes: &[Bounds]) -> Self {
        let mut grids = Self { finest: 1.0, occupied: [false; LEVELS] };
        let mut sizes: Vec<f64> = boxes.iter().map(Bounds::size).collect();
        if boxes.is_empty() {
            return grids;
        }
        let (_, median, _) = sizes.select_nth_unstable_by(boxes.len() / 2, f64::total_cmp);
        let median = *median;
        let largest = sizes.iter().copied().fold(0.0, f64::max);
        assert!(largest.is_finite(), "contact detection: a bounding box is not finite");
        // The cells of the coarsest level must be at least as large as the largest box. If all boxes have zero size,
        // any cell size is suitable.
        let finest = (FINEST * median).max(largest / f64::from(1u32 << (LEVELS - 1)));
        grids.finest = if finest > 0.0 { finest } else { 1.0 };
        for own in boxes {
            grids.occupied[grids.level(own)] = true;
        }
        grids
    }

    /// Returns the level of a box: the finest whose cells are no smaller than the box.
    fn level(&self, own: &Bounds) -> usize {
        ((own.size() / self.finest).log2().ceil().max(0.0) as usize).min(LEVELS - 1)
    }

    /// Returns the cell of a point on a level.
    fn cell(&self, point: DVec3, level: usize) -> I64Vec3 {
        (point / (self.finest * f64::from(1u32 << level))).floor().as_i64vec3()
    }

    /// Returns the cells that a box covers on a level.
    fn covered(&self, own: &Bounds, level: usize) -> impl Iterator<Item = I64Vec3> {
        let (low, high) = (self.cell(own.low, level), self.cell(own.high, level));
        (low.z..=high.z)
            .flat_map(move |z| (low.y..=high.y).flat_map(move |y| (low.x..=high.x).map(move |x| I64Vec3::new(x, y, z))))
    }

    /// Returns the keys of the cells in which a box is stored.
    fn home_cells(&self, own: &Bounds) -> impl Iterator<Item = u64> {
        let level = self.level(own);
        self.covered(own, level).map(move |cell| key(level, cell))
    }

    /// Calls `found` for each pair of intersecting boxes that box `own_number` reports, with the lower number first.
    /// The box on the finer level reports the pair. If both boxes are on the same level, the box with the lower number
    /// reports it.
    fn visit_pairs(&self, table: &Table, boxes: &[Bounds], own_number: u32, mut found: impl FnMut(u32, u32)) {
        let own = &boxes[own_number as usize];
        let own_level = self.level(own);
        for level in (own_level..LEVELS).filter(|level| self.occupied[*level]) {
            for cell in self.covered(own, level) {
                for number in table.in_cell(key(level, cell)).filter(|number| level > own_level || *number > own_number)
                {
                    let other = &boxes[number as usize];
                    // Two boxes may share several cells. The pair is reported only for the cell with their lowest
                    // common point.
                    if own.meets(other) && self.cell(own.low.max(other.low), level) == cell {
                        found(own_number.min(number), own_number.max(number));
                    }
                }
            }
        }
    }
}

/// Returns the key of a cell: 5 bits for the level, 19 for each coordinate. Two cells of one box never share a key.
fn key(level: usize, cell: I64Vec3) -> u64 {
    let [x, y, z] = (cell & I64Vec3::splat((1 << 19) - 1)).to_array().map(|c| c as u64);
    ((level as u64) << 57) | (x << 38) | (y << 19) | z
}

#[cfg(test)]
mod tests {
    use super::super::samples::random_point;
    use super::*;
    use crate::random::SplitMix64;

    /// Boxes with edges of up to `size(number)` around random points of the cube -1..1.
    fn cloud(seed: u64, count: usize, size: impl Fn(usize) -> f64) -> Vec<Bounds> {
        let mut random = SplitMix64::new(seed);
        (0..count)
            .map(|number| {
                let (about, half) = (random_point(&mut random), 0.5 * size(number) * random_point(&mut random).abs());
                Bounds { low: about - half, high: about + half }
            })
            .collect()
    }

    fn brute_force(boxes: &[Bounds]) -> Vec<[u32; 2]> {
        let count = boxes.len() as u32;
        let all = (0..count).flat_map(|i| (i + 1..count).map(move |j| [i, j]));
        all.filter(|[i, j]| boxes[*i as usize].meets(&boxes[*j as usize])).collect()
    }

    #[test]
    fn pairs_equal_those_of_a_brute_force_search() {
        let scattered = |boxes: Vec<Bounds>| -> Vec<Bounds> {
            let shift = |n: usize| if n.is_multiple_of(50) { 1e7 } else { -3.0 };
            boxes.iter().enumerate().map(|(n, b)| Bounds { low: b.low + shift(n), high: b.high + shift(n) }).collect()
        };
        let clouds = [
            cloud(1, 2500, |_| 0.2),
            cloud(2, 2500, |number| if number.is_multiple_of(100) { 2.0 } else { 0.1 }),
            cloud(3, 2000, |number| 1e-4 * 1.005f64.powi(number as i32)),
            cloud(4, 500, |_| 0.0),
            vec![Bounds { low: DVec3::ZERO, high: DVec3::ONE }; 100],
            vec![Bounds { low: DVec3::ZERO, high: DVec3::ZERO }; 100],
            scattered(cloud(5, 2000, |_| 0.3)),
            Vec::new(),
        ];
        for boxes in clouds {
            let expected = brute_force(&boxes);
            assert_eq!(intersecting_pairs(&boxes, |_, _| true), expected);
            let even: Vec<_> = expected.into_iter().filter(|[i, j]| (i + j).is_multiple_of(2)).collect();
            assert_eq!(intersecting_pairs(&boxes, |i, j| (i + j).is_multiple_of(2)), even);
        }
    }

    #[test]
    fn pairs_do_not_depend_on_the_number_of_threads() {
        let boxes = cloud(6, 20_000, |number| if number.is_multiple_of(100) { 1.0 } else { 0.1 });
        let pairs_with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| intersecting_pairs(&boxes, |_, _| true))
        };
        let serial = pairs_with(1);
        assert!(serial.len() > 20_000);
        assert!(pairs_with(2) == serial && pairs_with(5) == serial);
    }
}
