//! A uniform grid with wrapped cell coordinates: all pairs of points within a radius.
//!
//! Points are sorted into cubic cells by counting sort. The grid is a torus of 2ᵃ × 2ᵇ × 2ᶜ cells:
//! coordinates are taken modulo the size, so a table of fixed size holds points at any position.
//! Cells that share an entry are far from each other in space.
//!
//! ```text
//! each cell is paired with itself and 13 of its 26 neighbours: every pair of cells meets once
//!
//!   layer z:    · ■ →          layer z + 1:   ■ ■ ■       first ■: the cell; others: paired
//!               ■ ■ ■ (y + 1)                 ■ ■ ■
//!                                             ■ ■ ■
//! ```
//! Reads positions; writes its own tables and pushes pairs to the list of the caller.
//! Invariant: every pair of points nearer than the radius is pushed exactly once, at every SIMD
//! level.

use crate::math::columns::Columns;
use crate::math::heap_bytes::heap_bytes;
use crate::math::simd::{Level, MAX_LANES, Scalar, Simd, vectored};
use glam::Vec3;

/// With fewer than 2² cells along an axis, two neighbours of a cell would be the same cell.
const MIN_BITS: u32 = 2;

/// Largest number of ranges of points that a cell reads: its own, one beside it, and three in each
/// of four rows.
const MAX_RANGES: usize = 14;

/// Points that are tested in one batch: one bit of a `u64` each.
const BATCH: usize = u64::BITS as usize;

/// 1.5 · 2²³: adding it rounds a much smaller number to an integer, which then stands in the low
/// bits.
const ROUNDING: f32 = 12_582_912.0;

/// The points of one cell and of its neighbours ahead, copied together. Padded by one vector.
#[derive(Clone, Debug, Default)]
struct Neighbourhood {
    points: Vec<u32>,
    x: Columns,
}

/// Points sorted by cell.
#[derive(Clone, Debug, Default)]
pub(crate) struct HashGrid {
    /// For each cell the index of its first point in `points`, and one end index.
    first: Vec<u32>,
    /// The points, cell by cell, in ascending order within a cell. Padded by one vector.
    points: Vec<u32>,
    /// The positions of `points` [m].
    x: Columns,
    neighbourhood: Neighbourhood,
    /// The cell of each point.
    cell: Vec<u32>,
    /// The binary logarithm of the number of cells along each axis.
    bits: [u32; 3],
    /// Cells per metre.
    per_length: f32,
}

heap_bytes!(Neighbourhood { points, x } plain {});
heap_bytes!(HashGrid { first, points, x, neighbourhood, cell } plain { bits, per_length });

impl HashGrid {
    /// Allocates a grid for at most `capacity` points.
    pub fn new(capacity: usize) -> Self {
        let all = capacity.next_power_of_two().trailing_zeros() + 1;
        let bits = [all.div_ceil(3), (all + 1) / 3, all / 3].map(|bits| bits.max(MIN_BITS));
        let cells = 1_usize << bits.iter().sum::<u32>();
        let padded = capacity + MAX_LANES;
        Self {
            first: vec![0; cells + 2],
            points: Vec::with_capacity(padded),
            x: Columns::with_capacity(padded),
            neighbourhood: Neighbourhood {
                points: Vec::with_capacity(padded),
                x: Columns::with_capacity(padded),
            },
            cell: Vec::with_capacity(capacity),
            bits,
            per_length: 1.0,
        }
    }

    /// Sorts `points` into cells with sides of `side` [m]. There are at most as many as the
    /// capacity.
    pub fn rebuild(&mut self, points: &[Vec3], side: f32) {
        self.per_length = 1.0 / side;
        let mut cell = core::mem::take(&mut self.cell);
        cell.clear();
        cell.extend(points.iter().map(|point| self.cell_index(self.cell_coordinates(*point))));
        self.first.fill(0);
        for cell in &cell {
            self.first[*cell as usize + 2] += 1;
        }
        for at in 2..self.first.len() {
            self.first[at] += self.first[at - 1];
        }
        let padded = cell.len() + MAX_LANES;
        for (points, x) in [
            (&mut self.points, &mut self.x),
            (&mut self.neighbourhood.points, &mut self.neighbourhood.x),
        ] {
            points.resize(padded, 0);
            x.resize(padded);
        }
        for (point, cell) in cell.iter().enumerate() {
            let next = &mut self.first[*cell as usize + 1];
            self.points[*next as usize] = point as u32;
            self.x.set(*next as usize, points[point]);
            *next += 1;
        }
        self.cell = cell;
    }

    /// Pushes all pairs of points whose squared distance is below `radius2` [m²], each with the
    /// lower index first. The radius is at most the side of a cell. The pairs come in the order of
    /// the cells.
    pub fn push_close_pairs(&mut self, level: Level, radius2: f32, pairs: &mut Vec<[u32; 2]>) {
        push_close_pairs(level, self, radius2, pairs);
    }

    /// Writes the ranges of points of a cell and of the 13 neighbours ahead of it to `ranges`, and
    /// returns how many there are. None is empty.
    #[inline(always)]
    fn collect_ranges(&self, cell: u32, ranges: &mut [(u32, u32); MAX_RANGES]) -> usize {
        let [bx, by, _] = self.bits;
        let of = |cell: u32, first: u32, bits: u32| cell >> first & ((1 << bits) - 1);
        let (x, y, z) = (of(cell, 0, bx), of(cell, bx, by), cell >> (bx + by));
        let last = (1 << bx) - 1;
        let mut count = 0;
        let mut add = |from: u32, cells: u32| {
            let (from, to) = (self.first[from as usize], self.first[(from + cells) as usize]);
            ranges[count] = (from, to);
            count += usize::from(from < to);
        };
        if x == last {
            add(cell, 1);
            add(self.cell_index([0, y, z]), 1);
        } else {
            add(cell, 2);
        }
        for (dy, dz) in [(1, 0), (u32::MAX, 1), (0, 1), (1, 1)] {
            let row = |x: u32| self.cell_index([x, y.wrapping_add(dy), z.wrapping_add(dz)]);
            if x > 0 && x < last {
                // Three cells side by side.
                add(row(x - 1), 3);
            } else {
                for x in [x.wrapping_sub(1), x, x.wrapping_add(1)] {
                    add(row(x), 1);
                }
            }
        }
        count
    }

    /// Returns the cell of a point along each axis, not wrapped yet.
    #[inline(always)]
    fn cell_coordinates(&self, point: Vec3) -> [u32; 3] {
        point.to_array().map(|c| (c * self.per_length + ROUNDING).to_bits())
    }

    #[inline(always)]
    fn cell_index(&self, [x, y, z]: [u32; 3]) -> u32 {
        let [bx, by, bz] = self.bits;
        let wrap = |c: u32, bits: u32| c & ((1 << bits) - 1);
        (wrap(z, bz) << by | wrap(y, by)) << bx | wrap(x, bx)
    }
}

vectored! {
    /// As [`HashGrid::push_close_pairs`].
    fn push_close_pairs(grid: &mut HashGrid, radius2: f32, pairs: &mut Vec<[u32; 2]>)
        = push_pairs_simd, push_pairs_scalar
}

#[inline(always)]
fn push_pairs_scalar(grid: &mut HashGrid, radius2: f32, pairs: &mut Vec<[u32; 2]>) {
    push_pairs_simd(Scalar, grid, radius2, pairs);
}

#[inline(always)]
fn push_pairs_simd<S: Simd>(s: S, grid: &mut HashGrid, radius2: f32, pairs: &mut Vec<[u32; 2]>) {
    let (mut ranges, mut from) = ([(0, 0); MAX_RANGES], 0);
    while from < grid.cell.len() {
        let cell = grid.cell[grid.points[from] as usize];
        let to = grid.first[cell as usize + 1] as usize;
        let count = grid.collect_ranges(cell, &mut ranges);
        let all = grid.gather_neighbourhood(s, &ranges[..count]);
        for one in 0..to - from {
            grid.neighbourhood.push_pairs_of(s, one, all, radius2, pairs);
        }
        from = to;
    }
}

impl HashGrid {
    /// Copies the points of some ranges into `neighbourhood`, and returns how many there are.
    #[inline(always)]
    fn gather_neighbourhood<S: Simd>(&mut self, s: S, ranges: &[(u32, u32)]) -> usize {
        let Neighbourhood { points, x } = &mut self.neighbourhood;
        let from = self.x.slices();
        let mut count = 0;
        for range in ranges {
            let (mut at, mut end) = (range.0 as usize, count);
            count += (range.1 - range.0) as usize;
            while end < count {
                for (axis, to) in x.slices_mut().into_iter().enumerate() {
                    s.store(to, end, s.load(from[axis], at));
                }
                points[end..end + S::LANES].copy_from_slice(&self.points[at..at + S::LANES]);
                (at, end) = (at + S::LANES, end + S::LANES);
            }
        }
        count
    }
}

impl Neighbourhood {
    /// Pushes the close pairs of point `one` with the points after it, of `all` points.
    #[inline(always)]
    fn push_pairs_of<S: Simd>(
        &self,
        s: S,
        one: usize,
        all: usize,
        radius2: f32,
        pairs: &mut Vec<[u32; 2]>,
    ) {
        let (i, columns) = (self.points[one], self.x.slices());
        let x = columns.map(|column| s.splat(column[one]));
        let (mut at, radius2) = (one + 1, s.splat(radius2));
        while at < all {
            // Branches on the outcome are unpredictable, so a whole batch is tested before any
            // branch.
            let (mut near, mut tested) = (0, 0);
            while tested < BATCH && at + tested < all {
                let difference = |axis: usize| s.load(columns[axis], at + tested) - x[axis];
                let [x, y, z] = [difference(0), difference(1), difference(2)];
                near |= u64::from(s.positive_mask(radius2 - (x * x + y * y + z * z))) << tested;
                tested += S::LANES;
            }
            if all - at < BATCH {
                near &= (1 << (all - at)) - 1;
            }
            while near != 0 {
                let j = self.points[at + near.trailing_zeros() as usize];
                pairs.push([i.min(j), i.max(j)]);
                near &= near - 1;
            }
            at += BATCH;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbouring_cells_have_consecutive_coordinates() {
        let mut grid = HashGrid::new(1);
        grid.per_length = 1.0;
        let number = |c: i32| grid.cell_coordinates(Vec3::splat(c as f32))[0];
        for c in [-2_000_000, -77, -1, 0, 1, 5, 2_000_000] {
            assert_eq!(number(c + 1), number(c) + 1, "{c}");
        }
    }

    #[test]
    fn every_close_pair_is_pushed_exactly_once_at_every_level() {
        let point = |i: u32| {
            let c = |k: u32| (i.wrapping_mul(k) % 1009) as f32 * 0.01 - 5.0;
            Vec3::new(c(7919), c(104_729), c(1299))
        };
        let points: Vec<Vec3> = (0..500).map(point).collect();
        let mut grid = HashGrid::new(points.len());
        for shift in [0.0, 1000.0] {
            let moved: Vec<Vec3> = points.iter().map(|p| *p + Vec3::splat(shift)).collect();
            grid.rebuild(&moved, 0.6);
            for level in Level::available() {
                let mut pairs = Vec::new();
                grid.push_close_pairs(level, 0.5 * 0.5, &mut pairs);
                pairs.sort_unstable();
                let all = (0..500).flat_map(|i| (i + 1..500).map(move |j| [i, j]));
                let is_near = |[i, j]: &[u32; 2]| {
                    (moved[*j as usize] - moved[*i as usize]).length_squared() < 0.5 * 0.5
                };
                assert_eq!(pairs, all.filter(is_near).collect::<Vec<_>>(), "{level:?}");
            }
        }
    }
}
