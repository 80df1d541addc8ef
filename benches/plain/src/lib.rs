//! The cloth that most people write: one list of links in natural order, one scalar loop over it.
//!
//! Nothing here is slowed down on purpose: plain arrays, indices of 32 bits, rest lengths computed
//! once, one root and one division a link, and the same compiler. It is a crate of its own so that it
//! can be compiled for wasm by itself, without the vector instructions that Muslin asks for.

#[cfg(target_arch = "wasm32")]
mod wasm;

use glam::Vec3;

/// In what order the links are listed; people write both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Order {
    /// Row by row, all links of a particle after one another.
    ByParticle,
    /// All structural links row by row, then all for shear, then all for bending.
    ByKind,
}

/// A grid, hung in the plane z = 0 with its top left particle in the origin.
#[derive(Clone, Copy, Debug)]
pub struct Size {
    /// Particles across.
    pub columns: usize,
    /// Particles down.
    pub rows: usize,
    /// Distance between neighbours [m].
    pub spacing: f32,
    /// Whether only the corners of the top row are pinned, and not all of it.
    pub by_corners: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Structural,
    Shear,
    Bend,
}

/// A distance constraint.
struct Link {
    a: u32,
    b: u32,
    rest: f32,
}

/// A grid of particles with structural, shear and bend links.
pub struct PlainSheet {
    x: Vec<Vec3>,
    x_last: Vec<Vec3>,
    /// Inverse masses; 0 is pinned.
    w: Vec<f32>,
    links: Vec<Link>,
    /// Which of the links join neighbours along the threads.
    structural: Vec<usize>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<Vec3>,
}

impl PlainSheet {
    /// A sheet at rest.
    pub fn hang(size: Size, order: Order) -> Self {
        let Size { columns, rows, spacing, by_corners } = size;
        let cells = || (0..rows).flat_map(|row| (0..columns).map(move |column| (row, column)));
        let x: Vec<Vec3> = cells()
            .map(|(row, column)| spacing * Vec3::new(column as f32, -(row as f32), 0.0))
            .collect();
        let is_pinned = |(row, column): (usize, usize)| {
            row == 0 && (!by_corners || column == 0 || column + 1 == columns)
        };
        let w = cells().map(|cell| if is_pinned(cell) { 0.0 } else { 1.0 }).collect();
        let mut links = Vec::new();
        let mut triangles = Vec::new();
        for (row, column) in cells() {
            let at = |down: usize, across: usize| ((row + down) * columns + across) as u32;
            let mut join = |kind, from: usize, down: usize, to: usize| {
                if row + down < rows && from < columns && to < columns {
                    let (a, b) = (at(0, from), at(down, to));
                    let rest = x[a as usize].distance(x[b as usize]);
                    links.push((kind, Link { a, b, rest }));
                }
            };
            join(Kind::Structural, column, 0, column + 1);
            join(Kind::Structural, column, 1, column);
            join(Kind::Shear, column, 1, column + 1);
            join(Kind::Shear, column + 1, 1, column);
            join(Kind::Bend, column, 0, column + 2);
            join(Kind::Bend, column, 2, column);
            if row + 1 < rows && column + 1 < columns {
                triangles.push([at(0, column), at(1, column), at(0, column + 1)]);
                triangles.push([at(0, column + 1), at(1, column), at(1, column + 1)]);
            }
        }
        if order == Order::ByKind {
            links.sort_by_key(|(kind, _)| *kind); // a stable sort: rows stay in order
        }
        let structural = (0..links.len()).filter(|at| links[*at].0 == Kind::Structural).collect();
        let links = links.into_iter().map(|(_, link)| link).collect();
        let normals = vec![Vec3::ZERO; x.len()];
        Self { x_last: x.clone(), x, w, links, structural, triangles, normals }
    }

    /// How many links there are.
    pub fn link_count(&self) -> usize {
        self.links.len()
    }

    /// Where the particles are.
    pub fn positions(&self) -> &[Vec3] {
        &self.x
    }

    /// A tick of `tick` [s]: Verlet, then sweeps, in each substep; normals at the end.
    pub fn tick(&mut self, tick: f32, substeps: u32, iterations: u32) {
        for _ in 0..substeps {
            self.predict(tick / substeps as f32);
            for _ in 0..iterations {
                self.sweep();
            }
        }
        self.shade();
    }

    /// Moves all that is not pinned for `h` [s], with the damping of Muslin's default settings.
    pub fn predict(&mut self, h: f32) {
        let fall = Vec3::new(0.0, -9.81, 0.0) * (h * h);
        let keep = 1.0 - 0.5 * h;
        for ((x, x_last), w) in self.x.iter_mut().zip(&mut self.x_last).zip(&self.w) {
            if *w > 0.0 {
                let moved = *x - *x_last;
                *x_last = *x;
                *x += moved * keep + fall;
            }
        }
    }

    /// One sweep over all links.
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

    fn shade(&mut self) {
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

    /// The greatest stretch of a structural link: 0.01 is 1 % over its rest length.
    pub fn max_stretch(&self) -> f32 {
        let stretch = |at: &usize| {
            let link = &self.links[*at];
            self.x[link.a as usize].distance(self.x[link.b as usize]) / link.rest - 1.0
        };
        self.structural.iter().map(stretch).fold(0.0, f32::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Size = Size { columns: 5, rows: 4, spacing: 0.1, by_corners: false };

    #[test]
    fn every_link_of_a_grid_is_listed_once_in_either_order() {
        // Across, down, both diagonals, and bending both ways.
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
        assert!(stretch > 0.0 && stretch < 0.01, "stretched by {stretch}");
        assert!(sheet.normals.iter().all(|normal| (normal.length() - 1.0).abs() < 1.0e-3));
    }
}
