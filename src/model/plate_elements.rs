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
//! is an elbow, see `irregular`.

use crate::mesh::Mesh;
use crate::mesh::grid::cell_triangles;
use crate::model::irregular_bend::IrregularBends;
use crate::model::link_set::LinkSet;
use crate::model::links::{LinkKind, LinkSupport, Links, ThreadDirection};

/// The three elements that belong to a particle: the one along the weft and the one along the warp that have
/// it in their middle, and the twist of the cell whose first corner it is.
pub(crate) type PerKind<T> = [T; 3];

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
    pub area_fraction: PerKind<Vec<f32>>,
    /// What left its element and still holds, as of the last time it was gathered.
    pub irregular: IrregularBends,
    /// The bend links of these.
    irregular_links: LinkSet,
    /// How often elements came or went.
    pub revision: u32,
    /// The first bend link, and the element of each from there on: the particle in its middle.
    first: usize,
    middle: Vec<u32>,
    /// What there was of each element when it was woven.
    created_fraction: PerKind<Vec<f32>>,
}

impl PlateElements {
    /// The elements of a grid with these links.
    pub fn new(columns: u32, rows: u32, spacing: f32, mesh: &Mesh, links: &Links) -> Self {
        let (columns, rows) = (columns as usize, rows as usize);
        let count = columns * rows;
        let mut created_fraction = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        let of_lines = |at: usize, lines: usize| {
            let is_border = at == 0 || at == lines - 1;
            if is_border { 0.5 } else { 1.0 }
        };
        for row in 0..rows {
            for column in 0..columns {
                let at = row * columns + column;
                if column > 0 && column < columns - 1 {
                    created_fraction[0][at] = of_lines(row, rows);
                }
                if row > 0 && row < rows - 1 {
                    created_fraction[1][at] = of_lines(column, columns);
                }
                if row < rows - 1 && column < columns - 1 {
                    created_fraction[2][at] = 2.0;
                }
            }
        }
        let is_bend = |link: &usize| links.kind(*link) == LinkKind::Bend;
        let bends: Vec<usize> = (0..links.len()).filter(is_bend).collect();
        let middle = bends.iter().map(|link| match links.spec[*link].support {
            LinkSupport::TwoEdges([left, _]) => mesh.vertex(left),
            _ => 0,
        });
        Self {
            columns,
            rows,
            spacing,
            area_fraction: created_fraction.clone(),
            irregular: IrregularBends::default(),
            irregular_links: LinkSet::default(),
            revision: 0,
            first: bends.first().copied().unwrap_or(links.len()),
            middle: middle.collect(),
            created_fraction,
        }
    }

    /// Particles that it was woven with.
    pub fn count(&self) -> usize {
        self.columns * self.rows
    }

    /// Takes note of what became of a bend link.
    pub fn update_link(&mut self, mesh: &Mesh, links: &Links, link: usize) {
        let Some(middle) = link.checked_sub(self.first).and_then(|at| self.middle.get(at)) else {
            return;
        };
        let middle = *middle as usize;
        let (kind, step) = match links.spec[link].direction {
            ThreadDirection::Weft => (0, 1),
            ThreadDirection::Warp => (1, self.columns),
        };
        let ends = (links.a[link] as usize, links.b[link] as usize);
        let is_in_place = match links.spec[link].support {
            LinkSupport::TwoEdges([left, _]) => {
                let vertex = mesh.vertex(left) as usize;
                vertex == middle && ends == (middle - step, middle + step)
            }
            _ => false,
        };
        let holds = links.active[link];
        let area_fraction =
            if is_in_place && holds { self.created_fraction[kind][middle] } else { 0.0 };
        self.set_fraction(kind, middle, area_fraction);
        self.irregular_links.set(link, holds && !is_in_place);
    }

    /// Takes note of which cells around a site are torn.
    pub fn update_cells(&mut self, mesh: &Mesh, site: u32) {
        let (row, column) = (site as usize / self.columns, site as usize % self.columns);
        for row in row.saturating_sub(1)..(row + 1).min(self.rows - 1) {
            for column in column.saturating_sub(1)..(column + 1).min(self.columns - 1) {
                let at = row * self.columns + column;
                let first = 2 * (row * (self.columns - 1) + column);
                let created_fraction =
                    cell_triangles(self.columns as u32, row as u32, column as u32);
                let is_torn = mesh.triangles[first..first + 2] != created_fraction;
                self.set_fraction(2, at, if is_torn { 0.0 } else { self.created_fraction[2][at] });
            }
        }
    }

    fn set_fraction(&mut self, kind: usize, at: usize, area_fraction: f32) {
        if self.area_fraction[kind][at] != area_fraction {
            self.area_fraction[kind][at] = area_fraction;
            self.revision = self.revision.wrapping_add(1);
        }
    }

    /// Gathers what left its element, after links changed.
    pub fn rebuild_irregular(&mut self, mesh: &Mesh, links: &Links) {
        let Self { irregular, irregular_links, first, middle, created_fraction, .. } = self;
        irregular.rebuild(mesh, links, irregular_links.as_slice(), |link, kind| {
            let middle = middle[link as usize - *first];
            (middle, created_fraction[kind][middle as usize])
        });
    }

    /// Makes room for every element to stray, and for so many particles.
    pub fn reserve(&mut self, particles: usize) {
        self.irregular_links.reserve(self.middle.len());
        self.irregular.reserve(self.middle.len(), particles);
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of::<f32>() * (6 * self.count() + 2 * self.middle.len()) + self.irregular.bytes()
    }
}
