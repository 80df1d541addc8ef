//! Surface collision: self-collision of the cloth by vertex–triangle and edge–edge contacts.
//!
//! ```text
//!                                  file                    once per
//!  particles                       swept_particles         substep   motion bounds
//!      │
//!      ▼
//!  tick bounds                     tick_bounds             tick      where may each particle get to?
//!      │ swept AABBs
//!      ▼
//!  cluster BVH ── cluster pairs    cluster_bvh,            tick      clusters of 8 triangles
//!      │                           cluster_pairs
//!      │ swept AABBs, normal cones                         substep
//!      ▼                           normal_cones
//!  pair cache                      surface_mid_phase,      on demand vertex–triangle, edge–edge
//!      │                           pair_cache, pair_store
//!      │ separation > relative displacement: rejected
//!      ▼
//!  separation test                 separation_test         substep   conservative, continuous
//!      │
//!      ├── near ──▶ narrow phase ──▶ contacts              narrow_phase, contact
//!      └── far, may meet ─────────▶ speculative contacts   speculative
//!                                      │
//!  contact solver   ◀── contacts       │                   contact_solver, warm_start
//!      │                               │
//!      ▼                               ▼
//!  non-crossing pass ◀── all contacts, with escaped        non_crossing, contact_graph
//!      │                 particles tested again
//!      ▼
//!  positions that no surface has crossed                   surface_stages runs all of this
//!
//!  untangle: intersections that exist all the same         untangle, in the contact solver stage
//! ```
//!
//! Method: conservative continuous collision detection with one separating plane per pair, in place
//! of the roots of cubic polynomials. A pair has a normal that separates both sides at the start of
//! a substep; while their separation along it (or along a later normal that also separated them at
//! the start) stays positive, they have not crossed. All stages up to the narrow phase are culling;
//! they only have to be conservative. Two stages act: the contact solver (gap, friction, damping;
//! may fail to converge) and the non-crossing pass (a guarantee, since rolling back to the start
//! always succeeds).
//!
//! Reads the mesh, its rest shape, particles, collider contacts and settings; writes positions,
//! velocities, predicted positions and contact forces.
//!
//! Invariant: the result depends on positions, velocities and contact forces at the start of a tick
//! alone, in the order of the mesh. Caches (tick bounds, pair cache, cluster boxes) make it faster,
//! never different.

mod closest_lanes;
mod cluster;
mod cluster_bvh;
mod cluster_pairs;
mod contact;
mod contact_graph;
mod contact_solver;
mod detection;
mod narrow_phase;
mod non_crossing;
mod normal_cones;
mod pair_cache;
mod pair_store;
mod rest_gap;
mod separation_test;
mod speculative;
mod split_separation;
pub(crate) mod surface_collision;
mod surface_mid_phase;
pub(crate) mod surface_stages;
mod swept_aabb;
mod swept_particles;
mod tick_bounds;
mod untangle;
pub(crate) mod warm_start;
