//! The regular grid: positions, texture coordinates and triangles. Vertex = row · columns + column.
//!
//! ```text
//! (0,0) ──▶ right
//!   ●───●───●
//!   │ ╲ │ ╱ │     diagonals alternate like a chessboard
//!   ●───●───●
//!   ▼ down
//! ```

use glam::{Vec2, Vec3};

/// Placement of a grid in space.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GridFrame {
    /// Position of vertex (0, 0), the top left [m].
    pub origin: Vec3,
    /// Unit direction along a row.
    pub right: Vec3,
    /// Unit direction along a column.
    pub down: Vec3,
    /// Distance between neighbours [m].
    pub spacing: f32,
}

/// Vertex positions, row by row [m].
pub(crate) fn positions(columns: u32, rows: u32, frame: &GridFrame) -> Vec<Vec3> {
    let at = |row: u32, column: u32| {
        let (across, along) = (column as f32 * frame.spacing, row as f32 * frame.spacing);
        frame.origin + frame.right * across + frame.down * along
    };
    (0..rows).flat_map(|row| (0..columns).map(move |column| at(row, column))).collect()
}

/// Texture coordinates, row by row: (0, 1) at the top left, (1, 0) at the bottom right.
pub(crate) fn uvs(columns: u32, rows: u32) -> Vec<Vec2> {
    let at = |row: u32, column: u32| {
        let (u, v) = (column as f32 / (columns - 1) as f32, row as f32 / (rows - 1) as f32);
        Vec2::new(u, 1.0 - v)
    };
    (0..rows).flat_map(|row| (0..columns).map(move |column| at(row, column))).collect()
}

/// Two triangles per cell, row by row. Their normals point along `down` × `right`.
///
/// Diagonals alternate from cell to cell, so that no direction is preferred.
pub(crate) fn triangles(columns: u32, rows: u32) -> Vec<[u32; 3]> {
    let cells = (0..rows - 1).flat_map(|row| (0..columns - 1).map(move |column| (row, column)));
    cells.flat_map(|(row, column)| cell_triangles(columns, row, column)).collect()
}

/// The two triangles of one cell. The first starts with top left, bottom left; the second ends with
/// top right.
pub(crate) fn cell_triangles(columns: u32, row: u32, column: u32) -> [[u32; 3]; 2] {
    let top_left = row * columns + column;
    let (top_right, bottom_left) = (top_left + 1, top_left + columns);
    let bottom_right = bottom_left + 1;
    if has_falling_diagonal(row, column) {
        [[top_left, bottom_left, bottom_right], [top_left, bottom_right, top_right]]
    } else {
        [[top_left, bottom_left, top_right], [bottom_left, bottom_right, top_right]]
    }
}

/// Whether the diagonal of a cell runs from top left to bottom right.
pub(crate) fn has_falling_diagonal(row: u32, column: u32) -> bool {
    (row + column).is_multiple_of(2)
}

/// Rest area per corner of each triangle [m²]: half of the triangle's area at the right angle, a
/// quarter at each of the others. Equals `geometry::triangle::corner_areas` up to rounding.
pub(crate) fn corner_areas(columns: u32, rows: u32, spacing: f32) -> Vec<[f32; 3]> {
    let (half, quarter) = (0.25 * spacing * spacing, 0.125 * spacing * spacing);
    let cells = (0..rows - 1).flat_map(|row| (0..columns - 1).map(move |column| (row, column)));
    let areas = |(row, column)| {
        if has_falling_diagonal(row, column) {
            [[quarter, half, quarter], [quarter, quarter, half]]
        } else {
            [[half, quarter, quarter], [quarter, half, quarter]]
        }
    };
    cells.flat_map(areas).collect()
}
