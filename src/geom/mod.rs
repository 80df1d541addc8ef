//! Geometry that knows nothing of cloth.

pub(crate) mod aabb;
pub(crate) mod blade;
pub(crate) mod bvh;
pub(crate) mod closest;
pub(crate) mod frame;
pub(crate) mod hash_grid;
pub(crate) mod hull;
pub(crate) mod polyhedron;
pub(crate) mod ray;
pub(crate) mod relief;
pub(crate) mod shape;
pub(crate) mod surface;
pub(crate) mod terrain;
pub(crate) mod triangle;
