//! Kernels for the distance constraints of a regular grid, whose rows lie side by side in memory.

pub(crate) mod row_chunk;
pub(crate) mod row_layout;
pub(crate) mod uniform_rows;
