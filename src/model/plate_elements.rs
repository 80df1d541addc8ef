//! PlateElements: what resists bending where a grid is as it was woven.
//!
//! A sheet that is bent without stretching has the energy ½ D ∫ κₓₓ² + κᵧᵧ² + 2 κₓᵧ². On a grid the
//! curvatures are differences of positions, and so vectors that are linear in them:
//!
//! ```text
//! a ──── m ──── b     weft, warp: a − 2 m + b     a ──── b
//!                                                 │      │    twist: a − b − c + d
//!                                                 c ──── d
//! ```
//! Their energy is quadratic, so that its matrix is always the same (Bergou et al., "A quadratic bending
//! model for inextensible surfaces", SGP 2006). Borders have the part of an element's area that is theirs,
//! and no element reaches over them: a free border bears no moment. What has left its place after a tear
//! is an elbow, see `elbows`.

use crate::mesh::Mesh;
use crate::mesh::grid::cell_triangles;
use crate::model::irregular_bend::IrregularBends;
use crate::model::links::{LinkKind, Links, Support, Thread};
use crate::model::stray_links::StrayLinks;

/// The three elements that belong to a particle: the one along the weft and the one along the warp that have
/// it in their middle, and the twist of the cell whose first corner it is.
pub(crate) type Each<T> = [T; 3];

/// The elements of a grid.
#[derive(Clone, Debug)]
pub(crate) struct PlateElements {
    /// Particles across.
    pub columns: usize,
    /// Particles down.
    pub rows: usize,
    /// Distance between neighbours [m].
    pub spacing: f32,
    /// What there is of each element, over one that lies inside; 0 where there is none any more.
    pub share: Each<Vec<f32>>,
    /// What left its element and still holds, as of the last time it was gathered.
    pub elbows: IrregularBends,
    /// The bend links of these.
    strays: StrayLinks,
    /// How often elements came or went.
    pub revision: u32,
    /// The first bend link, and the element of each from there on: the particle in its middle.
    first: usize,
    middle: Vec<u32>,
    /// What there was of each element when it was woven.
    woven: Each<Vec<f32>>,
}

impl PlateElements {
    /// The elements of a grid with these links.
    pub fn new(columns: u32, rows: u32, spacing: f32, mesh: &Mesh, links: &Links) -> Self {
        let (columns, rows) = (columns as usize, rows as usize);
        let count = columns * rows;
        let mut woven = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        let of_lines = |at: usize, lines: usize| {
            let is_border = at == 0 || at == lines - 1;
            if is_border { 0.5 } else { 1.0 }
        };
        for row in 0..rows {
            for column in 0..columns {
                let at = row * columns + column;
                if column > 0 && column < columns - 1 {
                    woven[0][at] = of_lines(row, rows);
                }
                if row > 0 && row < rows - 1 {
                    woven[1][at] = of_lines(column, columns);
                }
                if row < rows - 1 && column < columns - 1 {
                    woven[2][at] = 2.0;
                }
            }
        }
        let is_bend = |link: &usize| links.kind(*link) == LinkKind::Bend;
        let bends: Vec<usize> = (0..links.len()).filter(is_bend).collect();
        let middle = bends.iter().map(|link| match links.spec[*link].support {
            Support::Pair([left, _]) => mesh.vertex(left),
            _ => 0,
        });
        Self {
            columns,
            rows,
            spacing,
            share: woven.clone(),
            elbows: IrregularBends::default(),
            strays: StrayLinks::default(),
            revision: 0,
            first: bends.first().copied().unwrap_or(links.len()),
            middle: middle.collect(),
            woven,
        }
    }

    /// Particles that it was woven with.
    pub fn count(&self) -> usize {
        self.columns * self.rows
    }

    /// Takes note of what became of a bend link.
    pub fn follow_link(&mut self, mesh: &Mesh, links: &Links, link: usize) {
        let Some(middle) = link.checked_sub(self.first).and_then(|at| self.middle.get(at)) else {
            return;
        };
        let middle = *middle as usize;
        let (kind, step) = match links.spec[link].thread {
            Thread::Weft => (0, 1),
            Thread::Warp => (1, self.columns),
        };
        let ends = (links.a[link] as usize, links.b[link] as usize);
        let is_in_place = match links.spec[link].support {
            Support::Pair([left, _]) => {
                let vertex = mesh.vertex(left) as usize;
                vertex == middle && ends == (middle - step, middle + step)
            }
            _ => false,
        };
        let holds = links.active[link];
        let share = if is_in_place && holds { self.woven[kind][middle] } else { 0.0 };
        self.change(kind, middle, share);
        self.strays.follow(link, holds && !is_in_place);
    }

    /// Takes note of which cells around a site are torn.
    pub fn follow_cells(&mut self, mesh: &Mesh, site: u32) {
        let (row, column) = (site as usize / self.columns, site as usize % self.columns);
        for row in row.saturating_sub(1)..(row + 1).min(self.rows - 1) {
            for column in column.saturating_sub(1)..(column + 1).min(self.columns - 1) {
                let at = row * self.columns + column;
                let first = 2 * (row * (self.columns - 1) + column);
                let woven = cell_triangles(self.columns as u32, row as u32, column as u32);
                let is_torn = mesh.triangles[first..first + 2] != woven;
                self.change(2, at, if is_torn { 0.0 } else { self.woven[2][at] });
            }
        }
    }

    fn change(&mut self, kind: usize, at: usize, share: f32) {
        if self.share[kind][at] != share {
            self.share[kind][at] = share;
            self.revision = self.revision.wrapping_add(1);
        }
    }

    /// Gathers what left its element, after links changed.
    pub fn gather(&mut self, mesh: &Mesh, links: &Links) {
        let Self { elbows, strays, first, middle, woven, .. } = self;
        elbows.gather(mesh, links, strays.all(), |link, kind| {
            let middle = middle[link as usize - *first];
            (middle, woven[kind][middle as usize])
        });
    }

    /// Makes room for every element to stray, and for so many particles.
    pub fn reserve(&mut self, particles: usize) {
        self.strays.reserve(self.middle.len());
        self.elbows.reserve(self.middle.len(), particles);
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of::<f32>() * (6 * self.count() + 2 * self.middle.len()) + self.elbows.bytes()
    }
}
