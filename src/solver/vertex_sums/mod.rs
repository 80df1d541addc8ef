//! Sums over the triangles around each particle: a vector per triangle, added to its three corners.
//!
//! Aerodynamic forces, normals and texture tangents are such sums (see `contribution`). On a grid
//! the particles gather from their cells (`grid_cells`); elsewhere the triangles scatter to their
//! corners (`triangles`).

pub(crate) mod contribution;
pub(crate) mod grid_cells;
pub(crate) mod triangles;
