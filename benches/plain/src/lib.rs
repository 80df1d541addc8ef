//! Reference cloth of the benchmarks: one list of links in natural order and one scalar loop over
//! it, as most hand-written cloth has it.
//!
//! Position-based dynamics with Verlet integration (Müller, Heidelberger, Hennix, Ratcliff,
//! "Position based dynamics", 2007). Nothing is slow on purpose: plain arrays, 32-bit indices,
//! precomputed rest lengths, one square root and one division per link, the same compiler. It is a
//! crate of its own so that it can be compiled for wasm without the SIMD instructions that Muslin
//! uses.

#[cfg(target_arch = "wasm32")]
mod wasm;

use glam::Vec3;

/// The order of the list of links. Both are common.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Row by row, with all links of a particle in sequence.
    ByParticle,
    /// All structural links row by row, then all shear links, then all bend links.
    ByKind,
}

/// A grid in the plane z = 0 with its top left particle at the origin.
#[derive(Clone, Copy, Debug)]
pub struct Size {
    /// Number of particles across.
    pub columns: usize,
    /// Number of particles down.
    pub rows: usize,
    /// Distance between neighbours [m].
    pub spacing: f32,
    /// Whether only the corners of the top row are pinned; otherwise the whole row is.
    pub only_corners: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum LinkKind {
    Structural,
    Shear,
    Bend,
}

/// A distance constraint.
struct PlainLink {
    a: u32,
    b: u32,
    rest: f32,
}

/// A grid of particles with structural, shear and bend links.
pub struct PlainSheet {
    x: Vec<Vec3>,
    x_last: Vec<Vec3>,
    /// Inverse masses; 0 for pinned particles.
    w: Vec<f32>,
    links: Vec<PlainLink>,
    /// Indices of the structural links.
    structural: Vec<usize>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<Vec3>,
}

impl PlainSheet {
    /// Creates a sheet at rest.
    pub fn hang(size: Size, order: Order) -> Self {
        let Size { columns, rows, spacing, only_corners } = size;
        let cells = || (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
        let x: Vec<Vec3> = cells()
            .map(|(row, column)| spacing * Vec3::new(column as f32, -(row as f32), 0.0))
            .collect();
        let is_pinned = |(row, column): (usize, usize)| {
            row == 0 && (!only_corners || column == 0 || column + 1 == columns)
        };
        let w = cells().map(|cell| if is_pinned(cell) { 0.0 } else { 1.0 }).collect();
        let mut links = Vec::new();
        let mut triangles = Vec::new();
        for (row, column) in cells() {
            let index = |down: usize, across: usize| ((row + down) * columns + across) as u32;
            let mut add_link = |kind, from: usize, down: usize, to: usize| {
                if row + down < rows && from < columns && to < columns {
                    let (a, b) = (index(0, from), index(down, to));
                    let rest = x[a as usize].distance(x[b as usize]);
                    links.push((kind, PlainLink { a, b, rest }));
                }
            };
            add_link(LinkKind::Structural, column, 0, column + 1);
            add_link(LinkKind::Structural, column, 1, column);
            add_link(LinkKind::Shear, column, 1, column + 1);
            add_link(LinkKind::Shear, column + 1, 1, column);
            add_link(LinkKind::Bend, column, 0, column + 2);
            add_link(LinkKind::Bend, column, 2, column);
            if row + 1 < rows && column + 1 < columns {
                triangles.push([index(0, column), index(1, column), index(0, column + 1)]);
                triangles.push([index(0, column + 1), index(1, column), index(1, column + 1)]);
            }
        }
        if order == Order::ByKind {
            links.sort_by_key(|(kind, _)| *kind); // stable: the order of rows stays
        }
        let structural =
            (0..links.len()).filter(|index| links[*index].0 == LinkKind::Structural).collect();
        let links = links.into_iter().map(|(_, link)| link).collect();
        let normals = vec![Vec3::ZERO; x.len()];
        Self { x_last: x.clone(), x, w, links, structural, triangles, normals }
    }

    /// Returns the number of links.
    pub fn link_count(&self) -> usize {
        self.links.len()
    }

    /// Returns the positions [m].
    pub fn positions(&self) -> &[Vec3] {
        &self.x
    }

    /// Runs a tick of `tick` [s]: in each substep a Verlet step and `iterations` sweeps, at the end
    /// normals.
    pub fn tick(&mut self, tick: f32, substeps: u32, iterations: u32) {
        for _ in 0..substeps {
            self.predict(tick / substeps as f32);
            for _ in 0..iterations {
                self.sweep();
            }
        }
        self.compute_normals();
    }

    /// Moves the particles that are not pinned by a Verlet step of `h` [s], with the damping of
    /// Muslin's default settings.
    pub fn predict(&mut self, h: f32) {
        let fall = Vec3::new(0.0, -9.81, 0.0) * (h * h);
        let damping_factor = 1.0 - 0.5 * h;
        for ((x, x_last), w) in self.x.iter_mut().zip(&mut self.x_last).zip(&self.w) {
            if *w > 0.0 {
                let moved = *x - *x_last;
                *x_last = *x;
                *x += moved * damping_factor + fall;
            }
        }
    }

    /// Projects every link once, in the order of the list.
    #[inline(never)]
    pub fn sweep(&mut self) {
        for link in &self.links {
            let (a, b) = (link.a as usize, link.b as usize);
            let (wa, wb) = (self.w[a], self.w[b]);
            if wa + wb == 0.0 {
                continue;
            }
            let span = self.x[b] - self.x[a];
            let length = span.length();
            let correction = span * ((length - link.rest) / (length * (wa + wb)));
            self.x[a] += correction * wa;
            self.x[b] -= correction * wb;
        }
    }

    fn compute_normals(&mut self) {
        self.normals.fill(Vec3::ZERO);
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|vertex| vertex as usize);
            let normal = (self.x[b] - self.x[a]).cross(self.x[c] - self.x[a]);
            for vertex in [a, b, c] {
                self.normals[vertex] += normal;
            }
        }
        for normal in &mut self.normals {
            *normal = normal.normalize_or_zero();
        }
    }

    /// Returns the largest strain of a structural link: 0.01 is 1 % above its rest length.
    pub fn max_stretch(&self) -> f32 {
        let strain = |index: &usize| {
            let link = &self.links[*index];
            self.x[link.a as usize].distance(self.x[link.b as usize]) / link.rest - 1.0
        };
        self.structural.iter().map(strain).fold(0.0, f32::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Size = Size { columns: 5, rows: 4, spacing: 0.1, only_corners: false };

    #[test]
    fn both_orders_list_every_link_of_a_grid_once() {
        // Structural across and down, both diagonals, bend across and down.
        let expected = 4 * 4 + 5 * 3 + 2 * 4 * 3 + 3 * 4 + 5 * 2;
        for order in [Order::ByParticle, Order::ByKind] {
            assert_eq!(PlainSheet::hang(SIZE, order).link_count(), expected);
        }
    }

    #[test]
    fn the_sheet_hangs_from_its_pins_and_hardly_stretches() {
        let mut sheet = PlainSheet::hang(SIZE, Order::ByParticle);
        let top = sheet.positions()[0];
        (0..600).for_each(|_| sheet.tick(1.0 / 60.0, 4, 10));
        assert_eq!(sheet.positions()[0], top);
        let stretch = sheet.max_stretch();
        assert!(stretch > 0.0 && stretch < 0.01, "the largest strain is {stretch}");
        assert!(sheet.normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1.0e-3));
    }
}
