//! Structs and constants of the header, one noun per file, with their conversions from and to the
//! core.
//!
//! Invariant: layouts and numbers never change; structs with a `struct_size` grow only at their
//! end.

pub mod changes;
pub mod collider;
pub mod event;
pub mod grid;
pub mod hit;
pub mod material;
pub mod mesh;
pub mod mesh_report;
pub mod settings;
pub mod sewing;
pub mod skin;
pub mod stats;
pub mod stream;
pub mod value;
pub mod view;
pub mod wind;
