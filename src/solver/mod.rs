//! The tick: what it works on, its stages, and the order they run in (see `pipeline`).

pub(crate) mod bend;
pub(crate) mod collide;
pub(crate) mod integrate;
pub(crate) mod kinematic;
pub(crate) mod output;
pub(crate) mod particle_stage;
pub(crate) mod pipeline;
pub(crate) mod profile;
pub(crate) mod self_collide;
pub(crate) mod stage;
pub(crate) mod stretch;
pub(crate) mod topology;
pub(crate) mod vertex_sums;
pub(crate) mod world;
