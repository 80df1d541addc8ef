//! Points in cubic cells, by counting sort: who is near whom.
//!
//! Space is wrapped around a block of cells, so that a table of fixed size holds points wherever they
//! are. Cells that share a place in it are far from each other.

use glam::Vec3;

/// Fewer cells than this along a side, and a cell would be its own neighbour's neighbour.
const LEAST_BITS: u32 = 2;

/// Points sorted into cells.
#[derive(Clone, Debug, Default)]
pub(crate) struct HashGrid {
    /// For each cell, where its points begin; and where the last ones end.
    first: Vec<u32>,
    /// The points, cell by cell, lowest first in each, and where they are.
    points: Vec<(Vec3, u32)>,
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
            cell: Vec::with_capacity(capacity),
            bits,
            per_length: 1.0,
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of::<u32>() * (self.first.len() + self.cell.capacity())
            + size_of::<(Vec3, u32)>() * self.points.capacity()
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
        self.points.resize(cell.len(), (Vec3::ZERO, 0));
        for (point, cell) in cell.iter().enumerate() {
            let next = &mut self.first[*cell as usize + 1];
            self.points[*next as usize] = (points[point], point as u32);
            *next += 1;
        }
        self.cell = cell;
    }

    /// Visits the points in the cell of a point and the 26 around it, those of cells that share their
    /// places as well.
    pub fn visit_near(&self, point: Vec3, mut visit: impl FnMut(Vec3, u32)) {
        let [x, y, z] = self.place(point);
        let last = (1 << self.bits[0]) - 1;
        for (dy, dz) in (0..9).map(|k| (k % 3, k / 3)) {
            let row = |x: u32| {
                let (y, z) =
                    (y.wrapping_add(dy).wrapping_sub(1), z.wrapping_add(dz).wrapping_sub(1));
                self.index([x, y, z]) as usize
            };
            let column = x & last;
            if column > 0 && column < last {
                // Three cells side by side.
                let cells = row(x.wrapping_sub(1));
                self.visit_range(self.first[cells], self.first[cells + 3], &mut visit);
            } else {
                for x in [x.wrapping_sub(1), x, x.wrapping_add(1)] {
                    let cell = row(x);
                    self.visit_range(self.first[cell], self.first[cell + 1], &mut visit);
                }
            }
        }
    }

    #[inline(always)]
    fn visit_range(&self, from: u32, to: u32, visit: &mut impl FnMut(Vec3, u32)) {
        self.points[from as usize..to as usize].iter().for_each(|(at, point)| visit(*at, *point));
    }

    /// The cell of a point along each axis, not wrapped yet.
    #[inline(always)]
    fn place(&self, point: Vec3) -> [u32; 3] {
        // Of numbers that no i32 holds the conversion makes the nearest, of none 0.
        point.to_array().map(|c| (c * self.per_length).floor() as i32 as u32)
    }

    #[inline(always)]
    fn index(&self, [x, y, z]: [u32; 3]) -> u32 {
        let [bx, by, bz] = self.bits;
        let wrap = |c: u32, bits: u32| c & ((1 << bits) - 1);
        (wrap(z, bz) << by | wrap(y, by)) << bx | wrap(x, bx)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_points_within_a_cell_are_found_once() {
        let point = |i: u32| {
            let c = |k: u32| (i.wrapping_mul(k) % 1009) as f32 * 0.01 - 5.0;
            Vec3::new(c(7919), c(104_729), c(1299))
        };
        let points: Vec<Vec3> = (0..500).map(point).collect();
        let mut grid = HashGrid::new(points.len());
        for shift in [0.0, 1000.0] {
            let moved: Vec<Vec3> = points.iter().map(|p| *p + Vec3::splat(shift)).collect();
            grid.fill(&moved, 0.6);
            for (i, point) in moved.iter().enumerate() {
                let mut found = Vec::new();
                grid.visit_near(*point, |_, other| found.push(other));
                found.sort_unstable();
                assert!(found.windows(2).all(|pair| pair[0] != pair[1]), "{i} sees one twice");
                let near = |j: &u32| (moved[*j as usize] - *point).length() < 0.6;
                let exact: Vec<u32> = (0..500).filter(near).collect();
                assert!(exact.iter().all(|j| found.contains(j)), "{i} misses one");
            }
        }
    }
}
