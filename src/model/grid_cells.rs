//! Cells of a regular grid, two triangles each. Where both triangles have their original particles,
//! kernels process eight cells at once.
//!
//! Reads `Mesh`; writes flags per cell and a packed list of the other triangles.
//!
//! Invariant: a triangle is in the packed list exactly if one of its bits in `moved_corners` is
//! set; current after `rebuild_torn`.

use crate::math::heap_bytes::heap_bytes;
use crate::mesh::Mesh;
use crate::mesh::grid::cell_triangles;

/// The cells of a grid. Cell = row · (columns − 1) + column; its triangles are 2 · cell and 2 ·
/// cell + 1.
#[derive(Clone, Debug)]
pub(crate) struct GridCells {
    /// Particles per row.
    pub columns: usize,
    /// Particles per column.
    pub rows: usize,
    /// Corners of the two triangles that have another particle than at creation: bits 0 to 2 and 3
    /// to 5.
    pub moved_corners: Vec<u8>,
    /// Whether a cut moved a corner of the cell to another site.
    pub is_cut: Vec<bool>,
    /// Rest area per acute corner of a triangle [m²]; the right-angled corner has twice as much.
    pub corner_area: f32,
    /// Triangles with a moved corner, row by row, as of the last `rebuild_torn`.
    torn_triangles: Vec<u32>,
    /// Their particles.
    torn_particles: Vec<[u32; 3]>,
    /// First entry of each row of cells in `torn_triangles`, and the end of the last one.
    torn_row_starts: Vec<u32>,
}

heap_bytes!(
    GridCells {
        moved_corners, is_cut, torn_triangles, torn_particles, torn_row_starts,
    } plain { columns, rows, corner_area }
);

impl GridCells {
    /// The cells of a grid with `columns` × `rows` particles at `spacing` [m].
    pub fn new(columns: u32, rows: u32, spacing: f32) -> Self {
        let (columns, rows) = (columns as usize, rows as usize);
        let count = (columns - 1) * (rows - 1);
        Self {
            columns,
            rows,
            moved_corners: vec![0; count],
            is_cut: vec![false; count],
            corner_area: 0.125 * spacing * spacing,
            torn_triangles: Vec::new(),
            torn_particles: Vec::new(),
            torn_row_starts: vec![0; rows],
        }
    }

    /// Allocates so that every cell may tear.
    pub fn reserve(&mut self) {
        let more = 2 * self.moved_corners.len() - self.torn_triangles.len();
        self.torn_triangles.reserve_exact(more);
        self.torn_particles.reserve_exact(more);
    }

    /// Rebuilds the list of torn triangles, after some changed.
    pub fn rebuild_torn(&mut self, mesh: &Mesh) {
        self.torn_triangles.clear();
        let rows = self.moved_corners.chunks_exact(self.columns - 1).enumerate();
        for (row, moved_corners) in rows {
            self.torn_row_starts[row] = self.torn_triangles.len() as u32;
            let first = row * moved_corners.len();
            for (cell, moved_corners) in
                moved_corners.iter().enumerate().filter(|(_, moved_corners)| **moved_corners != 0)
            {
                let halves = (0..2).filter(|half| moved_corners >> (3 * half) & 0b111 != 0);
                self.torn_triangles.extend(halves.map(|half| (2 * (first + cell) + half) as u32));
            }
        }
        self.torn_row_starts[self.rows - 1] = self.torn_triangles.len() as u32;
        self.torn_particles.clear();
        self.torn_particles
            .extend(self.torn_triangles.iter().map(|at| mesh.triangles[*at as usize]));
    }

    /// Returns whether any triangle has a moved corner.
    pub fn is_torn(&self) -> bool {
        !self.torn_triangles.is_empty()
    }

    /// The torn triangles of a row of cells, and their particles.
    pub fn torn_triangles(&self, row: usize) -> (&[u32], &[[u32; 3]]) {
        let own = self.torn_row_starts[row] as usize..self.torn_row_starts[row + 1] as usize;
        (&self.torn_triangles[own.clone()], &self.torn_particles[own])
    }

    /// Corners of a triangle that have moved, one bit each.
    #[inline(always)]
    pub fn moved_corners_of(&self, triangle: usize) -> u8 {
        self.moved_corners[triangle / 2] >> (3 * (triangle % 2)) & 0b111
    }

    /// Rest area of a triangle that no cut divided [m²].
    pub fn rest_area(&self) -> f32 {
        self.corner_area + 2.0 * self.corner_area + self.corner_area
    }

    /// Updates the flags of the cells around a site, after its vertices changed.
    pub fn update_site(&mut self, mesh: &Mesh, site: u32) {
        let (row, column) = (site as usize / self.columns, site as usize % self.columns);
        for row in row.saturating_sub(1)..(row + 1).min(self.rows - 1) {
            for column in column.saturating_sub(1)..(column + 1).min(self.columns - 1) {
                let cell = row * (self.columns - 1) + column;
                let original = cell_triangles(self.columns as u32, row as u32, column as u32);
                let triangles = [2 * cell, 2 * cell + 1].map(|at| mesh.triangles[at]);
                let corners = triangles.as_flattened().iter().zip(original.as_flattened());
                self.moved_corners[cell] =
                    corners.rev().fold(0, |bits, (now, then)| 2 * bits + u8::from(now != then));
                let sites = triangles.map(|three| three.map(|v| mesh.source[v as usize]));
                self.is_cut[cell] = sites != original;
            }
        }
    }
}
