//! Meshes: repair, tearing, cutting, and output for a renderer.

#[path = "../common/mod.rs"]
mod common;

mod change_tracking;
mod cutting;
mod garments;
mod mesh_quality;
mod mesh_repair;
mod simplify;
mod skin_tears;
mod skins;
mod slivers;
mod tear_propagation;
mod tearing;
mod topology_snapshots;
mod write_vertices;
