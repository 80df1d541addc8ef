//! The cells of a grid, row by row: where two triangles each lie as they were made, eight cells can
//! be summed up at once.

use crate::mesh::Mesh;
use crate::mesh::grid::cell_triangles;

/// The cells of a grid; cell = row · (columns − 1) + column, its triangles are twice that and one on.
#[derive(Clone, Debug)]
pub(crate) struct GridCells {
    /// Particles across.
    pub columns: usize,
    /// Particles down.
    pub rows: usize,
    /// Which of the corners of its two triangles have been split off, in turn a bit each, …
    pub torn: Vec<u8>,
    /// … and whether a cut put a corner elsewhere.
    pub divided: Vec<bool>,
    /// What of a triangle's area at rest falls to a corner that is not its right angle [m²]; a right one
    /// has twice that.
    pub quarter: f32,
    /// The triangles with a corner that was split off, row by row, as of the last time they were gathered, …
    torn_triangles: Vec<u32>,
    /// … and their corners, so that sums need not look for them.
    torn_ends: Vec<[u32; 3]>,
    /// Where among them each row of cells begins, and where the last one ends.
    torn_rows: Vec<u32>,
}

impl GridCells {
    pub fn new(columns: u32, rows: u32, spacing: f32) -> Self {
        let (columns, rows) = (columns as usize, rows as usize);
        let count = (columns - 1) * (rows - 1);
        Self {
            columns,
            rows,
            torn: vec![0; count],
            divided: vec![false; count],
            quarter: 0.125 * spacing * spacing,
            torn_triangles: Vec::new(),
            torn_ends: Vec::new(),
            torn_rows: vec![0; rows],
        }
    }

    /// Makes room for every cell to tear.
    pub fn reserve(&mut self) {
        let more = 2 * self.torn.len() - self.torn_triangles.len();
        self.torn_triangles.reserve_exact(more);
        self.torn_ends.reserve_exact(more);
    }

    /// Gathers the triangles that are torn, after some changed.
    pub fn gather(&mut self, mesh: &Mesh) {
        self.torn_triangles.clear();
        let rows = self.torn.chunks_exact(self.columns - 1).enumerate();
        for (row, torn) in rows {
            self.torn_rows[row] = self.torn_triangles.len() as u32;
            let first = row * torn.len();
            for (cell, torn) in torn.iter().enumerate().filter(|(_, torn)| **torn != 0) {
                let halves = (0..2).filter(|half| torn >> (3 * half) & 0b111 != 0);
                self.torn_triangles.extend(halves.map(|half| (2 * (first + cell) + half) as u32));
            }
        }
        self.torn_rows[self.rows - 1] = self.torn_triangles.len() as u32;
        self.torn_ends.clear();
        self.torn_ends.extend(self.torn_triangles.iter().map(|at| mesh.triangles[*at as usize]));
    }

    /// Whether any triangle has a corner that was split off.
    pub fn is_torn(&self) -> bool {
        !self.torn_triangles.is_empty()
    }

    /// The triangles of a row of cells with a corner that was split off, and their corners.
    pub fn torn_triangles(&self, row: usize) -> (&[u32], &[[u32; 3]]) {
        let own = self.torn_rows[row] as usize..self.torn_rows[row + 1] as usize;
        (&self.torn_triangles[own.clone()], &self.torn_ends[own])
    }

    /// Which corners of a triangle have been split off, a bit each.
    #[inline(always)]
    pub fn torn_corners(&self, triangle: usize) -> u8 {
        self.torn[triangle / 2] >> (3 * (triangle % 2)) & 0b111
    }

    /// The area of a triangle that no cut divided, at rest [m²].
    pub fn rest_area(&self) -> f32 {
        self.quarter + 2.0 * self.quarter + self.quarter
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let triangle = size_of::<u32>() + size_of::<[u32; 3]>();
        2 * self.torn.len()
            + size_of::<u32>() * self.rows
            + triangle * self.torn_triangles.capacity()
    }

    /// Takes note of what a split did around a site.
    pub fn follow(&mut self, mesh: &Mesh, site: u32) {
        let (row, column) = (site as usize / self.columns, site as usize % self.columns);
        for row in row.saturating_sub(1)..(row + 1).min(self.rows - 1) {
            for column in column.saturating_sub(1)..(column + 1).min(self.columns - 1) {
                let cell = row * (self.columns - 1) + column;
                let woven = cell_triangles(self.columns as u32, row as u32, column as u32);
                let triangles = [2 * cell, 2 * cell + 1].map(|at| mesh.triangles[at]);
                let corners = triangles.as_flattened().iter().zip(woven.as_flattened());
                self.torn[cell] =
                    corners.rev().fold(0, |torn, (now, then)| 2 * torn + u8::from(now != then));
                let sites = triangles.map(|three| three.map(|v| mesh.source[v as usize]));
                self.divided[cell] = sites != woven;
            }
        }
    }
}
