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

    /// The points behind a point of the grid that are nearer to it than the root of `within`, no more than a cell's
    /// side [m²]; in no order of theirs, in room that is there to be used again.
    pub fn list_near<'a>(
        &self,
        point: u32,
        x: Vec3,
        within: f32,
        room: &'a mut Vec<u32>,
    ) -> &'a mut [u32] {
        let mut parts = [(0, 0); 27];
        let (mut count, mut all) = (0, 0);
        self.visit_cells(self.cell[point as usize], |from, to| {
            parts[count] = (from as usize, to as usize);
            (count, all) = (count + 1, all + to as usize - from as usize);
        });
        if room.len() < all {
            room.resize(all, 0);
        }
        // Who is near and who is not follows no rule that a processor could learn: so each is written down, and the
        // next one over it if it is not.
        let mut found = 0;
        for (from, to) in &parts[..count] {
            for (at, other) in &self.points[*from..*to] {
                room[found] = *other;
                let is_near = (*at - x).length_squared() < within;
                found += usize::from(is_near & (*other > point));
            }
        }
        &mut room[..found]
    }

    /// Visits where the points of a cell and of the 26 around it are, and those of cells that share their places.
    #[inline(always)]
    fn visit_cells(&self, cell: u32, mut visit: impl FnMut(u32, u32)) {
        let [bx, by, _] = self.bits;
        let of = |cell: u32, first: u32, bits: u32| cell >> first & ((1 << bits) - 1);
        let (x, y, z) = (of(cell, 0, bx), of(cell, bx, by), cell >> (bx + by));
        let last = (1 << bx) - 1;
        for (dy, dz) in (0..9).map(|k| (k % 3, k / 3)) {
            let row = |x: u32| {
                let (y, z) = (y.wrapping_add(dy), z.wrapping_add(dz));
                self.index([x, y.wrapping_sub(1), z.wrapping_sub(1)]) as usize
            };
            if x > 0 && x < last {
                // Three cells side by side.
                let cells = row(x - 1);
                visit(self.first[cells], self.first[cells + 3]);
            } else {
                for x in [x.wrapping_sub(1), x, x.wrapping_add(1)] {
                    let cell = row(x);
                    visit(self.first[cell], self.first[cell + 1]);
                }
            }
        }
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
            let mut room = Vec::new();
            for (i, point) in moved.iter().enumerate() {
                let found = grid.list_near(i as u32, *point, 0.5 * 0.5, &mut room);
                found.sort_unstable();
                let is_near = |j: &u32| (moved[*j as usize] - *point).length_squared() < 0.5 * 0.5;
                let exact: Vec<u32> = (i as u32 + 1..500).filter(is_near).collect();
                assert_eq!(found, exact, "{i}");
            }
        }
    }
}
