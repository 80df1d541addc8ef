//! Plate elements: bending of a regular grid.
//!
//! A sheet that bends without stretching has the energy ½ D ∫ κₓₓ² + κᵧᵧ² + 2 κₓᵧ². On a grid the
//! curvatures are finite differences of positions, and thus vectors that are linear in them:
//!
//! ```text
//! a ──── m ──── b     weft, warp: a − 2 m + b     a ──── b
//!                                                 │      │    twist: a − b − c + d
//!                                                 c ──── d
//! ```
//! The energy is quadratic, so its matrix is constant (Bergou et al., "A quadratic bending model
//! for inextensible surfaces", SGP 2006). Elements at borders have only their part of the area, and
//! none reaches beyond a border, so a free border carries no moment. Elements that a tear has
//! changed become irregular bends, see `irregular_bend`.
//!
//! Reads `Mesh` and bend links; writes area fractions and the irregular bends.
//!
//! Invariant: the fraction of an element is 0 unless all its particles are the original ones and
//! connected.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::zeros;
use crate::mesh::Mesh;
use crate::mesh::grid::cell_triangles;
use crate::model::irregular_bend::IrregularBends;
use crate::model::link_set::LinkSet;
use crate::model::links::{LinkKind, LinkSupport, Links, ThreadDirection};

/// Elements per particle, by kind: along the weft and along the warp with the particle in the
/// middle, and the twist of the cell whose first corner is the particle.
pub(crate) type PerKind<T> = [T; 3];

/// The plate elements of a grid.
#[derive(Clone, Debug)]
pub(crate) struct PlateElements {
    /// Particles per row.
    pub columns: usize,
    /// Particles per column.
    pub rows: usize,
    /// Distance between neighbours [m].
    pub spacing: f32,
    /// Area of each element relative to one inside the grid; 0 if it does not exist.
    pub area_fraction: PerKind<Vec<f32>>,
    /// Active bends that left their element, as of the last `rebuild_irregular`.
    pub irregular: IrregularBends,
    /// The bend links of these.
    irregular_links: LinkSet,
    /// Counter of changes of `area_fraction`.
    pub revision: u32,
    /// First bend link, and the middle particle of each bend link from there on.
    first: usize,
    middle: Vec<u32>,
    /// `area_fraction` at creation.
    created_fraction: PerKind<Vec<f32>>,
}

heap_bytes!(
    PlateElements {
        area_fraction, irregular, irregular_links, middle, created_fraction,
    } plain { columns, rows, spacing, revision, first }
);

impl PlateElements {
    /// Creates the elements of a grid with these links.
    pub fn new(columns: u32, rows: u32, spacing: f32, mesh: &Mesh, links: &Links) -> Self {
        let (columns, rows) = (columns as usize, rows as usize);
        let count = columns * rows;
        let mut created_fraction = [zeros(count), zeros(count), zeros(count)];
        let border_fraction = |at: usize, lines: usize| {
            let is_border = at == 0 || at == lines - 1;
            if is_border { 0.5 } else { 1.0 }
        };
        for row in 0..rows {
            for column in 0..columns {
                let at = row * columns + column;
                if column > 0 && column < columns - 1 {
                    created_fraction[0][at] = border_fraction(row, rows);
                }
                if row > 0 && row < rows - 1 {
                    created_fraction[1][at] = border_fraction(column, columns);
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

    /// Number of particles at creation.
    pub fn count(&self) -> usize {
        self.columns * self.rows
    }

    /// Updates the element of a bend link after the link changed.
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
        let is_active = links.active[link];
        let area_fraction =
            if is_in_place && is_active { self.created_fraction[kind][middle] } else { 0.0 };
        self.set_fraction(kind, middle, area_fraction);
        self.irregular_links.set(link, is_active && !is_in_place);
    }

    /// Updates the twist of the cells around a site after its vertices changed.
    pub fn update_cells(&mut self, mesh: &Mesh, site: u32) {
        let (row, column) = (site as usize / self.columns, site as usize % self.columns);
        for row in row.saturating_sub(1)..(row + 1).min(self.rows - 1) {
            for column in column.saturating_sub(1)..(column + 1).min(self.columns - 1) {
                let at = row * self.columns + column;
                let first = 2 * (row * (self.columns - 1) + column);
                let original = cell_triangles(self.columns as u32, row as u32, column as u32);
                let is_torn = mesh.triangles[first..first + 2] != original;
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

    /// Rebuilds the irregular bends, after links changed.
    pub fn rebuild_irregular(&mut self, mesh: &Mesh, links: &Links) {
        let Self { irregular, irregular_links, first, middle, created_fraction, .. } = self;
        irregular.rebuild(mesh, links, irregular_links.as_slice(), |link, kind| {
            let middle = middle[link as usize - *first];
            (middle, created_fraction[kind][middle as usize])
        });
    }

    /// Allocates so that every element may become irregular, for `particles` particles.
    pub fn reserve(&mut self, particles: usize) {
        self.irregular_links.reserve(self.middle.len());
        self.irregular.reserve(self.middle.len(), particles);
    }
}
