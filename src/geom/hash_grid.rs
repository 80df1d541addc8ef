//! Points in cubic cells, by counting sort: who is near whom.
//!
//! Space is wrapped around a block of cells, so that a table of fixed size holds points wherever they
//! are. Cells that share a place in it are far from each other.

use crate::math::columns::Columns;
use crate::math::simd::{Level, MOST_LANES, Scalar, Simd, vectored};
use core::ops::Range;
use glam::Vec3;

/// Fewer cells than this along a side, and a cell would be its own neighbour's neighbour.
const LEAST_BITS: u32 = 2;

/// The most parts of the grid that are ahead of a cell: one beside it, and three in each of four rows.
const AHEAD: usize = 13;

/// Points sorted into cells.
#[derive(Clone, Debug, Default)]
pub(crate) struct HashGrid {
    /// For each cell, where its points begin; and where the last ones end.
    first: Vec<u32>,
    /// The points, cell by cell, lowest first in each, …
    points: Vec<u32>,
    /// … and where they are; behind the last there is room for a vector.
    x: Columns,
    /// The cell of each point.
    cell: Vec<u32>,
    /// Cells along each side, as powers of two.
    bits: [u32; 3],
    per_length: f32,
}

impl HashGrid {
    /// A grid for so many points.
    pub fn new(capacity: usize) -> Self {
        let all = capacity.next_power_of_two().trailing_zeros() + 2;
        let bits = [all.div_ceil(3), (all + 1) / 3, all / 3].map(|bits| bits.max(LEAST_BITS));
        let cells = 1_usize << bits.iter().sum::<u32>();
        Self {
            first: vec![0; cells + 2],
            points: Vec::with_capacity(capacity),
            x: Columns::with_capacity(capacity + MOST_LANES),
            cell: Vec::with_capacity(capacity),
            bits,
            per_length: 1.0,
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let whole = self.first.len() + self.cell.capacity() + self.points.capacity();
        size_of::<u32>() * whole + self.x.bytes()
    }

    /// Sorts points into cells of such a side [m].
    pub fn fill(&mut self, points: &[Vec3], side: f32) {
        self.per_length = 1.0 / side;
        let mut cell = core::mem::take(&mut self.cell);
        cell.clear();
        cell.extend(points.iter().map(|point| self.index(self.place(*point))));
        self.first.fill(0);
        for cell in &cell {
            self.first[*cell as usize + 2] += 1;
        }
        for at in 2..self.first.len() {
            self.first[at] += self.first[at - 1];
        }
        self.points.clear();
        self.points.resize(cell.len(), 0);
        self.x.resize(cell.len() + MOST_LANES);
        for (point, cell) in cell.iter().enumerate() {
            let next = &mut self.first[*cell as usize + 1];
            self.points[*next as usize] = point as u32;
            self.x.set(*next as usize, points[point]);
            *next += 1;
        }
        self.cell = cell;
    }

    /// Adds the pairs of points that are nearer to each other than the root of `within`, no more than a cell's side
    /// [m²], the lower one first; in no order of theirs.
    pub fn list_pairs(&self, level: Level, within: f32, pairs: &mut Vec<[u32; 2]>) {
        list_pairs(level, self, within, pairs);
    }

    /// Where the points are that are in cells ahead of one: in those that have it behind them where it has them
    /// ahead, so that each two cells side by side meet once. As many as there are, of those that hold any.
    #[inline(always)]
    fn look_ahead(&self, cell: u32, parts: &mut [(u32, u32); AHEAD]) -> usize {
        let [bx, by, _] = self.bits;
        let of = |cell: u32, first: u32, bits: u32| cell >> first & ((1 << bits) - 1);
        let (x, y, z) = (of(cell, 0, bx), of(cell, bx, by), cell >> (bx + by));
        let last = (1 << bx) - 1;
        let mut count = 0;
        let mut add = |from: u32, cells: u32| {
            let (from, to) = (self.first[from as usize], self.first[(from + cells) as usize]);
            parts[count] = (from, to);
            count += usize::from(from < to);
        };
        if x == last {
            add(self.index([0, y, z]), 1);
        } else {
            add(cell + 1, 1);
        }
        for (dy, dz) in [(1, 0), (u32::MAX, 1), (0, 1), (1, 1)] {
            let row = |x: u32| self.index([x, y.wrapping_add(dy), z.wrapping_add(dz)]);
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

    /// The cell of a point along each axis, not wrapped yet.
    #[inline(always)]
    fn place(&self, point: Vec3) -> [u32; 3] {
        point.to_array().map(|c| floor(c * self.per_length) as u32)
    }

    #[inline(always)]
    fn index(&self, [x, y, z]: [u32; 3]) -> u32 {
        let [bx, by, bz] = self.bits;
        let wrap = |c: u32, bits: u32| c & ((1 << bits) - 1);
        (wrap(z, bz) << by | wrap(y, by)) << bx | wrap(x, bx)
    }
}

vectored! {
    /// As [`HashGrid::list_pairs`].
    fn list_pairs(grid: &HashGrid, within: f32, pairs: &mut Vec<[u32; 2]>)
        = list_by_vectors, Avx2, list_by_numbers
}

#[inline(always)]
fn list_by_numbers(grid: &HashGrid, within: f32, pairs: &mut Vec<[u32; 2]>) {
    list_by_vectors(Scalar, grid, within, pairs);
}

#[inline(always)]
fn list_by_vectors<S: Simd>(s: S, grid: &HashGrid, within: f32, pairs: &mut Vec<[u32; 2]>) {
    let (mut parts, mut from) = ([(0, 0); AHEAD], 0);
    while let Some(point) = grid.points.get(from) {
        let cell = grid.cell[*point as usize];
        let to = grid.first[cell as usize + 1] as usize;
        let count = grid.look_ahead(cell, &mut parts);
        for at in from..to {
            list_one(s, grid, within, at, at + 1..to, pairs);
            for (from, to) in &parts[..count] {
                list_one(s, grid, within, at, *from as usize..*to as usize, pairs);
            }
        }
        from = to;
    }
}

/// Adds the pairs of the point at one place with those in a part of the grid.
#[inline(always)]
fn list_one<S: Simd>(
    s: S,
    grid: &HashGrid,
    within: f32,
    one: usize,
    part: Range<usize>,
    pairs: &mut Vec<[u32; 2]>,
) {
    let all = grid.x.all();
    let x = all.map(|x| s.splat(x[one]));
    let i = grid.points[one];
    let (mut at, within) = (part.start, s.splat(within));
    while at < part.end {
        let [x, y, z] = [0, 1, 2].map(|axis| s.load(all[axis], at) - x[axis]);
        let mut near = s.positives(within - (x * x + y * y + z * z));
        let left = part.end - at;
        if left < S::LANES {
            near &= (1 << left) - 1;
        }
        while near != 0 {
            let j = grid.points[at + near.trailing_zeros() as usize];
            pairs.push([i.min(j), i.max(j)]);
            near &= near - 1;
        }
        at += S::LANES;
    }
}

/// The next integer below; the nearest one of what no i32 holds, of what is no number 0.
#[inline(always)]
fn floor(c: f32) -> i32 {
    let toward_zero = c as i32;
    toward_zero.saturating_sub(i32::from(toward_zero as f32 > c))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_rounded_down_is_the_floor() {
        for c in [
            0.0,
            -0.0,
            0.5,
            -0.5,
            1.0,
            -1.0,
            -1.0e-30,
            2.5e9,
            -2.5e9,
            8_388_607.5,
            -8_388_607.5,
            1.0e-9,
        ] {
            assert_eq!(floor(c), c.floor() as i32, "{c}");
        }
        assert_eq!(
            [floor(f32::NAN), floor(f32::INFINITY), floor(-f32::INFINITY)],
            [0, i32::MAX, i32::MIN]
        );
    }

    #[test]
    fn all_points_that_are_near_are_found_once() {
        let point = |i: u32| {
            let c = |k: u32| (i.wrapping_mul(k) % 1009) as f32 * 0.01 - 5.0;
            Vec3::new(c(7919), c(104_729), c(1299))
        };
        let points: Vec<Vec3> = (0..500).map(point).collect();
        let mut grid = HashGrid::new(points.len());
        for shift in [0.0, 1000.0] {
            let moved: Vec<Vec3> = points.iter().map(|p| *p + Vec3::splat(shift)).collect();
            grid.fill(&moved, 0.6);
            for level in Level::all() {
                let mut pairs = Vec::new();
                grid.list_pairs(level, 0.5 * 0.5, &mut pairs);
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
