//! Geometry without cloth: boxes, trees, rays, shapes, closest points.
//!
//! Nothing here knows of particles, constraints or time. Collision shapes are built from signed
//! distances and features (Ericson, "Real-Time Collision Detection", 2005).
//!
//! Reads positions and writes results of its own types only.
//! Invariant: modules here use `math` and each other, and nothing above.

pub(crate) mod aabb;
pub(crate) mod bends;
pub(crate) mod blade;
pub(crate) mod bvh;
pub(crate) mod closest_points;
pub(crate) mod collision_shape;
pub(crate) mod convex_hull;
pub(crate) mod features;
pub(crate) mod hash_grid;
pub(crate) mod heightfield;
mod moving_features;
pub(crate) mod moving_surface;
pub(crate) mod polyhedron;
pub(crate) mod primitives;
pub(crate) mod ray;
pub(crate) mod relative_motion;
pub(crate) mod signed_distance;
pub(crate) mod solid_mesh;
pub(crate) mod swept_box;
pub(crate) mod transform;
pub(crate) mod triangle;
pub(crate) mod triangle_surface;
