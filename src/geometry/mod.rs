//! Geometry that knows nothing of cloth.

pub(crate) mod aabb;
pub(crate) mod blade;
pub(crate) mod bvh;
pub(crate) mod closest_points;
pub(crate) mod convex_hull;
pub(crate) mod features;
pub(crate) mod hash_grid;
pub(crate) mod heightfield;
pub(crate) mod polyhedron;
pub(crate) mod ray;
pub(crate) mod shape;
pub(crate) mod transform;
pub(crate) mod triangle;
pub(crate) mod triangle_surface;
