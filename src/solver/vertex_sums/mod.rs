//! Sums over the triangles around each particle, for wind and normals.

pub(crate) mod grid_cells;
pub(crate) mod triangles;
