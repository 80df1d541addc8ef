//! Contact with colliders and self-collision.

#[path = "../common/mod.rs"]
mod common;

mod added_substeps;
mod colliders;
mod fast_impacts;
mod friction_and_contact;
mod hard_constraints;
mod particle_collision;
mod rest_with_intersections;
mod split_separation;
mod surface_collision;
mod untangling;
