//! Contact with colliders and self-collision.

#[path = "../common/mod.rs"]
mod common;

/// The checks of `cargo xtask verify`, which share no code with the solver.
#[allow(dead_code)]
#[path = "../verify/src/checks"]
mod checks {
    pub mod bodies;
    mod bvh;
    mod crossings;
    mod distance;
    mod exact;
    pub mod stretch;
    pub mod surface;
}
/// The bodies and sheets of its scenes.
#[allow(dead_code)]
#[path = "../verify/src/shapes.rs"]
mod shapes;

mod added_substeps;
mod colliders;
mod corner_in_a_gap;
mod deforming_colliders;
mod fast_impacts;
mod friction_and_contact;
mod hard_constraints;
mod impact_momentum;
mod layers;
mod maps;
mod narrow_gaps;
mod particle_collision;
mod rest_with_intersections;
mod small_and_fast_bodies;
mod solid_meshes;
mod split_separation;
mod stretch_bound;
mod surface_collision;
mod untangling;
mod upright_drops;
mod violations;
