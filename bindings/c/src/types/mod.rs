//! The structs and numbers of the header, one noun a file, and their way from and to the core.

pub mod changes;
pub mod collider;
pub mod event;
pub mod grid;
pub mod hit;
pub mod material;
pub mod mesh;
pub mod mesh_report;
pub mod settings;
pub mod stats;
pub mod stream;
pub mod value;
pub mod view;
pub mod wind;
