//! Geometry without cloth: boxes, trees, rays, shapes, closest points.
//!
//! Nothing here knows of particles, constraints or time. Collision shapes are built from signed
//! distances and features (Ericson, "Real-Time Collision Detection", 2005).
//!
//! Reads positions and writes results of its own types only.
//! Invariant: modules here use `math` and each other, and nothing above.

pub(crate) mod aabb;
pub(crate) mod bends;
#[cfg(feature = "cut")]
pub(crate) mod blade;
pub(crate) mod bvh;
pub(crate) mod closest_points;
pub(crate) mod collision_shape;
#[cfg(feature = "facet-colliders")]
pub(crate) mod convex_hull;
pub(crate) mod features;
pub(crate) mod hash_grid;
#[cfg(feature = "facet-colliders")]
pub(crate) mod heightfield;
#[cfg(feature = "facet-colliders")]
mod moving_features;
#[cfg(feature = "facet-colliders")]
pub(crate) mod moving_surface;
#[cfg(not(feature = "facet-colliders"))]
mod no_facets;
#[cfg(feature = "facet-colliders")]
pub(crate) mod polyhedron;
pub(crate) mod primitives;
pub(crate) mod ray;
pub(crate) mod relative_motion;
pub(crate) mod signed_distance;
#[cfg(feature = "facet-colliders")]
pub(crate) mod solid_mesh;
pub(crate) mod swept_box;
pub(crate) mod transform;
pub(crate) mod triangle;
#[cfg(feature = "facet-colliders")]
pub(crate) mod triangle_surface;

#[cfg(not(feature = "facet-colliders"))]
pub(crate) use no_facets::{heightfield, polyhedron, solid_mesh, triangle_surface};
