//! The triangle mesh of a cloth: its topology, its repair at creation, and the surgery of tears and cuts.

pub(crate) mod grid;
pub(crate) mod grid_detection;
pub(crate) mod intake;
pub(crate) mod report;
pub(crate) mod seams;
pub(crate) mod split_edge;
pub(crate) mod split_vertex;
pub(crate) mod topology;
pub(crate) mod validate;

pub(crate) use topology::{Corner, Fan, Mesh, NONE, next_corner, prev_corner, triangle_of};
