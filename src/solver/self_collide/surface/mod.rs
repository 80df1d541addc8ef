//! Surface collision: self-collision of the cloth by vertex–triangle and edge–edge contacts.
//!
//! ```text
//!                                                      runs per   files
//! tick bounds: where each particle may move to         tick       tick_bounds
//!     │
//!     ▼
//! cluster BVH: swept AABBs of 8 triangles each         tick       cluster, cluster_bvh
//!     │
//!     ▼
//! cluster pairs ◀── normal cones, swept AABBs          substep    cluster_pairs, normal_cones,
//!     │             of the motion bounds                          swept_particles, swept_aabb
//!     ▼
//! pair cache: vertex–triangle and edge–edge pairs      on demand  surface_mid_phase, pair_cache,
//!     │       kept until the clusters have moved                  pair_store, rest_gap
//!     │       too far relative to each other
//!     ▼ candidate pairs
//! separation test: AABBs, then one direction           substep    separation_test
//!     │
//!     ├─ near ─▶ narrow phase ─▶ contacts              substep    narrow_phase, contact
//!     │                             │
//!     └─ far, may meet ─▶ speculative contacts         substep    speculative
//!                                   │
//!                                   ▼
//! contact solver: impulses, friction, warm start       substep    contact_solver, warm_start
//!     │   └─ untangle: intersections that exist        substep    untangle
//!     ▼
//! non-crossing pass ◀── pairs of escaped particles,    substep    non_crossing, contact_graph
//!     │    ▲            promoted speculative contacts
//!     ▼    └─ tangent planes of colliders              substep    support_planes
//! projection out of colliders, until both hold;        substep    sewn_sides
//! the same with sewn pairs
//!     │
//!     ▼
//! positions at the end of the substep
//! ```
//! `detection` runs the steps from cluster pairs to contacts, `surface_stages` runs everything, and
//! `surface_collision` holds the data. `contact_damping` corrects velocities at the end of a substep;
//! `split_separation` prepares fresh tears.
//!
//! Method: conservative continuous collision detection with one separating plane per pair, in place
//! of the roots of cubic polynomials (Provot 1997; Bridson, Fedkiw, Anderson 2002). Each pair has a
//! normal that separates both sides at the start of a substep. While the separation along it (or
//! along a later normal that also separates them at the start) stays positive, they have not
//! crossed. All steps down to the separation test are culling; they only have to be conservative.
//! Two steps act on particles: the contact solver keeps the gap, adds friction and damps, and may
//! fail to converge; the non-crossing pass gives the guarantee, because the start positions satisfy
//! all contacts at once.
//!
//! Terms: *start* is the position at the start of the substep and *now* the current one. The
//! *motion bound* of a particle is a box that its displacement stays in; a particle that leaves it
//! has *escaped*. *Separation* is measured along a direction, *distance* between closest points,
//! and the *gap* is the distance that the contact solver keeps.
//!
//! Reads the mesh, its rest shape, particles, collider contacts and settings; writes positions,
//! velocities, predicted positions and contact forces.
//!
//! Invariant: the result depends only on the state at the start of a tick and on the order of the
//! mesh. Caches (tick bounds, pair cache, cluster boxes) save time and change no bit.

mod closest_lanes;
mod cluster;
mod cluster_bvh;
mod cluster_pairs;
mod contact;
pub(crate) mod contact_damping;
mod contact_graph;
mod contact_solver;
pub(crate) mod crossing_report;
mod detection;
mod narrow_phase;
mod non_crossing;
mod normal_cones;
mod pair_cache;
mod pair_store;
mod rest_gap;
mod separation_test;
mod sewn_sides;
mod speculative;
mod split_separation;
pub(crate) mod support_planes;
pub(crate) mod surface_collision;
mod surface_mid_phase;
pub(crate) mod surface_stages;
mod swept_aabb;
pub(crate) mod swept_particles;
mod tick_bounds;
mod untangle;
pub(crate) mod warm_start;
