//! Contact detection: finds all pairs of intersecting boxes with a hierarchy of grids, one per box size.
//!
//! Munjiza & Andrews (1998), "NBS contact detection algorithm for bodies of similar size", IJNME 43, 131-149, with a
//! hierarchy for bodies of different size: Ericson (2005), "Real-Time Collision Detection", section 7.2. A box is
//! stored on the level whose cells are just larger than the box, in the cells that it covers there (at most eight). It
//! is tested against the boxes in the cells that it covers on its own level and on the coarser levels. The hash table
//! has as many buckets as entries, so work and memory are linear in the number of boxes, however far apart they are.

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

    /// Longest side [m].
    fn size(&self) -> f64 {
        (self.high - self.low).max_element()
    }

    /// Whether two boxes have a point in common.
    fn meets(&self, other: &Self) -> bool {
        self.low.cmple(other.high).all() && other.low.cmple(self.high).all()
    }
}

/// Boxes per task of the thread pool.
const CHUNK: usize = 1024;
/// Number of levels; the cell size doubles from level to level.
const LEVELS: usize = 32;
/// Cell size of the finest level over the median box size [-]; the fastest value for meshes.
const FINEST: f64 = 1.25;

/// Reusable workspace of the contact detection.
#[derive(Debug, Default)]
pub struct Detection {
    grids: Grids,
    table: Table,
    /// Pairs found by each chunk of boxes.
    found: Vec<Vec<[u32; 2]>>,
    pairs: Vec<[u32; 2]>,
}

impl Detection {
    /// Returns the pairs (i, j), i < j, of intersecting boxes for which `keep(i, j)` is true. They are in ascending
    /// order for any number of threads. The boxes must be finite.
    pub fn pairs(&mut self, boxes: &[Bounds], keep: impl Fn(u32, u32) -> bool + Sync) -> &[[u32; 2]] {
        self.grids.fit(boxes);
        self.table.fill(&self.grids, boxes);
        let (grids, table) = (&self.grids, &self.table);
        self.found.resize_with(boxes.len().div_ceil(CHUNK), Vec::new);
        self.found.par_iter_mut().enumerate().for_each(|(chunk, found)| {
            found.clear();
            let first = chunk * CHUNK;
            for number in first..boxes.len().min(first + CHUNK) {
                grids.visit_pairs(table, boxes, number as u32, |i, j| {
                    if keep(i, j) {
                        found.push([i, j]);
                    }
                });
            }
        });
        self.pairs.clear();
        self.pairs.extend(self.found.iter().flatten());
        self.pairs.par_sort_unstable();
        &self.pairs
    }
}

/// Hash table from cells to the boxes stored in them.
#[derive(Debug, Default)]
struct Table {
    /// Ordered by bucket.
    entries: Vec<Entry>,
    /// Start of the entries of each bucket, and the end of the last bucket.
    starts: Vec<u32>,
}

/// A box stored in a cell.
#[derive(Debug, Clone, Copy, Default)]
struct Entry {
    /// Key of the cell.
    key: u64,
    /// Number of the box.
    number: u32,
}

impl Table {
    /// Sorts the boxes by the buckets of their cells (counting sort).
    fn fill(&mut self, grids: &Grids, boxes: &[Bounds]) {
        let count: usize = boxes.iter().map(|own| grids.home_cells(own).count()).sum();
        self.starts.clear();
        self.starts.resize(count.next_power_of_two() + 1, 0);
        for key in boxes.iter().flat_map(|own| grids.home_cells(own)) {
            let bucket = self.bucket(key);
            self.starts[bucket] += 1;
        }
        let mut end = 0;
        for start in &mut self.starts {
            end += *start;
            *start = end;
        }
        // Filling each bucket backwards turns the ends into starts.
        self.entries.resize(count, Entry::default());
        for (number, own) in boxes.iter().enumerate() {
            for key in grids.home_cells(own) {
                let bucket = self.bucket(key);
                self.starts[bucket] -= 1;
                self.entries[self.starts[bucket] as usize] = Entry { key, number: number as u32 };
            }
        }
    }

    /// Bucket of a cell: multiplicative hash (Knuth 1973, "The Art of Computer Programming" 3, section 6.4).
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
#[derive(Debug, Default)]
struct Grids {
    /// Edge of the cells of the finest level [m].
    finest: f64,
    /// Whether any box is stored on a level.
    occupied: [bool; LEVELS],
    /// Workspace for the median of the box sizes [m].
    sizes: Vec<f64>,
}

impl Grids {
    /// Chooses the cell sizes for the boxes.
    fn fit(&mut self, boxes: &[Bounds]) {
        self.occupied = [false; LEVELS];
        self.sizes.clear();
        self.sizes.extend(boxes.iter().map(Bounds::size));
        if boxes.is_empty() {
            return;
        }
        let (_, median, _) = self.sizes.select_nth_unstable_by(boxes.len() / 2, f64::total_cmp);
        let median = *median;
        let largest = self.sizes.iter().copied().fold(0.0, f64::max);
        assert!(largest.is_finite(), "contact detection: a bounding box is not finite");
        // The largest box must fit the coarsest level. Boxes of zero size fit any cell size.
        let finest = (FINEST * median).max(largest / f64::from(1u32 << (LEVELS - 1)));
        self.finest = if finest > 0.0 { finest } else { 1.0 };
        for own in boxes {
            self.occupied[self.level(own)] = true;
        }
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

    /// Calls `found` with the numbers, in ascending order, of each pair of intersecting boxes that belongs to box
    /// `own_number`: this box is on the finer level or, on the same level, has the lower number.
    fn visit_pairs(&self, table: &Table, boxes: &[Bounds], own_number: u32, mut found: impl FnMut(u32, u32)) {
        let own = &boxes[own_number as usize];
        let own_level = self.level(own);
        for level in (own_level..LEVELS).filter(|level| self.occupied[*level]) {
            for cell in self.covered(own, level) {
                for number in table.in_cell(key(level, cell)).filter(|number| level > own_level || *number > own_number)
                {
                    let other = &boxes[number as usize];
                    // Two boxes may share several cells: only the cell of their lowest common point reports the pair.
                    if own.meets(other) && self.cell(own.low.max(other.low), level) == cell {
                        found(own_number.min(number), own_number.max(number));
                    }
                }
            }
        }
    }
}

/// Key of a cell: 5 bits for the level, 19 for each coordinate. Two cells of the same box never share a key.
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
        // The workspace is shared: no cloud may leave anything behind for the next one.
        let mut detection = Detection::default();
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
            assert_eq!(detection.pairs(&boxes, |_, _| true), expected);
            let even: Vec<_> = expected.into_iter().filter(|[i, j]| (i + j).is_multiple_of(2)).collect();
            assert_eq!(detection.pairs(&boxes, |i, j| (i + j).is_multiple_of(2)), even);
        }
    }

    #[test]
    fn pairs_do_not_depend_on_the_number_of_threads() {
        let boxes = cloud(6, 20_000, |number| if number.is_multiple_of(100) { 1.0 } else { 0.1 });
        let pairs_with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| Detection::default().pairs(&boxes, |_, _| true).to_vec())
        };
        let serial = pairs_with(1);
        assert!(serial.len() > 20_000);
        assert!(pairs_with(2) == serial && pairs_with(5) == serial);
    }

    /// cargo test --release detection -- --ignored --nocapture
    #[test]
    #[ignore = "timing: a minute"]
    fn time_is_linear_in_the_number_of_boxes() {
        for (name, large) in [("boxes of similar size", 0.0), ("1 % of the boxes ten times larger", 0.01)] {
            for count in [10_000, 100_000, 1_000_000] {
                let boxes = as_in_a_mesh(count, large);
                let mut detection = Detection::default();
                let mut best = std::time::Duration::MAX;
                for _ in 0..3 {
                    let start = std::time::Instant::now();
                    detection.pairs(&boxes, |_, _| true);
                    best = best.min(start.elapsed());
                }
                let nanoseconds = best.as_nanos() as f64 / count as f64;
                println!("{name}: {count} boxes, {} pairs, {nanoseconds:.0} ns per box", detection.pairs.len());
            }
        }
    }

    /// Boxes as dense as the bounding boxes of a mesh of tetrahedra with edges of 1 m, numbered along rows.
    fn as_in_a_mesh(count: usize, large: f64) -> Vec<Bounds> {
        let mut random = SplitMix64::new(7);
        // Volume of a regular tetrahedron: 0.118 m3.
        let row = (count as f64).cbrt().ceil();
        let spacing = (0.118 * count as f64).cbrt() / row;
        let place = |number: f64| DVec3::new(number % row, (number / row).floor() % row, (number / row / row).floor());
        (0..count)
            .map(|number| {
                let about = spacing * (place(number as f64) + 0.5 * random_point(&mut random));
                let half = 0.32 + 0.16 * random.next_share();
                let half = if random.next_share() < large { 10.0 * half } else { half };
                Bounds { low: about - half, high: about + half }
            })
            .collect()
    }
}
