//! The checks after each tick. They share no code with the solver.

pub mod bodies;
pub mod bvh;
pub mod crossings;
pub mod distance;
mod exact;
pub mod momentum;
pub mod stretch;
pub mod surface;
