//! Output for renderers and hosts: normals, tangents, vertex transforms and statistics.
//!
//! These modules read the state and never change it; `cloth` calls them after the ticks.

pub(crate) mod normals;
pub(crate) mod stats;
pub(crate) mod tangents;
pub(crate) mod vertex_transform;
