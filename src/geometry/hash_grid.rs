//! Points in cubic cells, by counting sort: who is near whom.
//!
//! Space is wrapped around a block of cells, so that a table of fixed size holds points wherever they
//! are. Cells that share a place in it are far from each other.

use crate::math::columns::Columns;
use crate::math::simd::{Level, MAX_LANES, Scalar, Simd, vectored};
use glam::Vec3;

/// Fewer cells than this along a side, and a cell would be its own neighbour's neighbour.
const LEAST_BITS: u32 = 2;

/// The most parts of the grid that a cell looks at: itself, one beside it, and three in each of four rows.
const PARTS: usize = 14;

/// As many points are asked about at once as there are bits in a number.
const ASKED: usize = u64::BITS as usize;

/// A number that much smaller ones are rounded to whole ones by, if they are added: those count its last bits up.
const ROUNDS: f32 = 12_582_912.0;

/// The points of a cell and of those ahead of it, and where they are; behind the last there is room for a vector.
#[derive(Clone, Debug, Default)]
struct Around {
    points: Vec<u32>,
    x: Columns,
}

/// Points sorted into cells.
#[derive(Clone, Debug, Default)]
pub(crate) struct HashGrid {
    /// For each cell, where its points begin; and where the last ones end.
    first: Vec<u32>,
    /// The points, cell by cell, lowest first in each, and where they are; behind the last there is room for a
    /// vector.
    points: Vec<u32>,
    x: Columns,
    around: Around,
    /// The cell of each point.
    cell: Vec<u32>,
    /// Cells along each side, as powers of two.
    bits: [u32; 3],
    per_length: f32,
}

impl HashGrid {
    /// A grid for so many points.
    pub fn new(capacity: usize) -> Self {
        let all = capacity.next_power_of_two().trailing_zeros() + 1;
        let bits = [all.div_ceil(3), (all + 1) / 3, all / 3].map(|bits| bits.max(LEAST_BITS));
        let cells = 1_usize << bits.iter().sum::<u32>();
        let room = capacity + MAX_LANES;
        Self {
            first: vec![0; cells + 2],
            points: Vec::with_capacity(room),
            x: Columns::with_capacity(room),
            around: Around { points: Vec::with_capacity(room), x: Columns::with_capacity(room) },
            cell: Vec::with_capacity(capacity),
            bits,
            per_length: 1.0,
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let points = self.points.capacity() + self.around.points.capacity();
        let whole = self.first.len() + self.cell.capacity() + points;
        size_of::<u32>() * whole + self.x.bytes() + self.around.x.bytes()
    }

    /// Sorts points into cells of such a side [m].
    pub fn rebuild(&mut self, points: &[Vec3], side: f32) {
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
        let room = cell.len() + MAX_LANES;
        for (points, x) in
            [(&mut self.points, &mut self.x), (&mut self.around.points, &mut self.around.x)]
        {
            points.resize(room, 0);
            x.resize(room);
        }
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
    pub fn push_close_pairs(&mut self, level: Level, within: f32, pairs: &mut Vec<[u32; 2]>) {
        push_close_pairs(level, self, within, pairs);
    }

    /// Where the points of a cell are, and then those of cells ahead of it: of half of those around it, so that each
    /// two cells side by side meet once. Says how many parts that are; none is empty.
    #[inline(always)]
    fn look_ahead(&self, cell: u32, parts: &mut [(u32, u32); PARTS]) -> usize {
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
            add(cell, 1);
            add(self.index([0, y, z]), 1);
        } else {
            add(cell, 2);
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
        point.to_array().map(|c| (c * self.per_length + ROUNDS).to_bits())
    }

    #[inline(always)]
    fn index(&self, [x, y, z]: [u32; 3]) -> u32 {
        let [bx, by, bz] = self.bits;
        let wrap = |c: u32, bits: u32| c & ((1 << bits) - 1);
        (wrap(z, bz) << by | wrap(y, by)) << bx | wrap(x, bx)
    }
}

vectored! {
    /// As [`HashGrid::push_close_pairs`].
    fn push_close_pairs(grid: &mut HashGrid, within: f32, pairs: &mut Vec<[u32; 2]>)
        = list_by_vectors, Avx2, list_by_numbers
}

#[inline(always)]
fn list_by_numbers(grid: &mut HashGrid, within: f32, pairs: &mut Vec<[u32; 2]>) {
    list_by_vectors(Scalar, grid, within, pairs);
}

#[inline(always)]
fn list_by_vectors<S: Simd>(s: S, grid: &mut HashGrid, within: f32, pairs: &mut Vec<[u32; 2]>) {
    let (mut parts, mut from) = ([(0, 0); PARTS], 0);
    while from < grid.cell.len() {
        let cell = grid.cell[grid.points[from] as usize];
        let to = grid.first[cell as usize + 1] as usize;
        let count = grid.look_ahead(cell, &mut parts);
        let all = grid.bring_together(s, &parts[..count]);
        for one in 0..to - from {
            grid.around.list_with(s, one, all, within, pairs);
        }
        from = to;
    }
}

impl HashGrid {
    /// Brings the points of some parts together, and says how many there are.
    #[inline(always)]
    fn bring_together<S: Simd>(&mut self, s: S, parts: &[(u32, u32)]) -> usize {
        let Around { points, x } = &mut self.around;
        let from = self.x.all();
        let mut count = 0;
        for part in parts {
            let (mut at, mut end) = (part.0 as usize, count);
            count += (part.1 - part.0) as usize;
            while end < count {
                for (axis, to) in x.all_mut().into_iter().enumerate() {
                    s.store(to, end, s.load(from[axis], at));
                }
                points[end..end + S::LANES].copy_from_slice(&self.points[at..at + S::LANES]);
                (at, end) = (at + S::LANES, end + S::LANES);
            }
        }
        count
    }
}

impl Around {
    /// Adds the pairs of one of the points with those behind it.
    #[inline(always)]
    fn list_with<S: Simd>(
        &self,
        s: S,
        one: usize,
        all: usize,
        within: f32,
        pairs: &mut Vec<[u32; 2]>,
    ) {
        let (i, columns) = (self.points[one], self.x.all());
        let x = columns.map(|column| s.splat(column[one]));
        let (mut at, within) = (one + 1, s.splat(within));
        while at < all {
            // Who is near and who is not follows no rule that a processor could learn: so many are asked first.
            let (mut near, mut asked) = (0, 0);
            while asked < ASKED && at + asked < all {
                let way = |axis: usize| s.load(columns[axis], at + asked) - x[axis];
                let [x, y, z] = [way(0), way(1), way(2)];
                near |= u64::from(s.positive_mask(within - (x * x + y * y + z * z))) << asked;
                asked += S::LANES;
            }
            if all - at < ASKED {
                near &= (1 << (all - at)) - 1;
            }
            while near != 0 {
                let j = self.points[at + near.trailing_zeros() as usize];
                pairs.push([i.min(j), i.max(j)]);
                near &= near - 1;
            }
            at += ASKED;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_side_by_side_have_numbers_in_a_row() {
        let mut grid = HashGrid::new(1);
        grid.per_length = 1.0;
        let number = |c: i32| grid.place(Vec3::splat(c as f32))[0];
        for c in [-2_000_000, -77, -1, 0, 1, 5, 2_000_000] {
            assert_eq!(number(c + 1), number(c) + 1, "{c}");
        }
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
            grid.rebuild(&moved, 0.6);
            for level in Level::all() {
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
