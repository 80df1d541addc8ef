//! The cells of a grid, row by row: where two triangles each lie as they were made, eight cells can
//! be summed up at once.

use crate::mesh::Mesh;
use crate::mesh::grid::cell_triangles;

/// The cells of a grid; cell = row · (columns − 1) + column, its triangles are twice that and one on.
#[derive(Clone, Debug)]
pub(crate) struct Cells {
    /// Particles across.
    pub columns: usize,
    /// Particles down.
    pub rows: usize,
    /// Whether a corner of the cell has been split off, …
    pub torn: Vec<bool>,
    /// … and whether a cut put a corner elsewhere.
    pub divided: Vec<bool>,
}

impl Cells {
    pub fn new(columns: u32, rows: u32) -> Self {
        let (columns, rows) = (columns as usize, rows as usize);
        let whole = vec![false; (columns - 1) * (rows - 1)];
        Self { columns, rows, torn: whole.clone(), divided: whole }
    }

    /// Takes note of what a split did around a site.
    pub fn follow(&mut self, mesh: &Mesh, site: u32) {
        let (row, column) = (site as usize / self.columns, site as usize % self.columns);
        for row in row.saturating_sub(1)..(row + 1).min(self.rows - 1) {
            for column in column.saturating_sub(1)..(column + 1).min(self.columns - 1) {
                let cell = row * (self.columns - 1) + column;
                let woven = cell_triangles(self.columns as u32, row as u32, column as u32);
                let triangles = [2 * cell, 2 * cell + 1].map(|at| mesh.triangles[at]);
                self.torn[cell] = triangles != woven;
                let sites = triangles.map(|three| three.map(|v| mesh.source[v as usize]));
                self.divided[cell] = sites != woven;
            }
        }
    }
}
