//! SIMD kernels for the distance constraints of a regular grid, row by row.
//!
//! ```text
//! grid_slices    the columns of particles and links that a kernel works on
//! row_layout     the same as raw pointers, checked once per row; index arithmetic
//! row_chunk      one chunk: as many links of a row as there are lanes
//! uniform_rows   many rows that differ only in their position
//! ```
//! `grid_links`, the stage above, chooses the kernel for each run of rows.

pub(crate) mod grid_slices;
pub(crate) mod row_chunk;
pub(crate) mod row_layout;
pub(crate) mod uniform_rows;
