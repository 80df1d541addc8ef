//! Muslin in Godot: a GDExtension with the node [`MuslinCloth3D`](node::MuslinCloth3D).
//!
//! ```text
//! node         the class and its properties
//! lifecycle ─┬─▶ source       mesh or grid, with its pins ──▶ muslin::MeshDesc
//!            ├─▶ parameters   properties ──▶ muslin::{Settings, Material, Wind}
//!            ├─▶ colliders ─▶ shapes   CollisionShape3D ──▶ muslin::ColliderDesc
//!            └─▶ surface      the cloth's vertices ──▶ ArrayMesh
//! methods      what scripts call
//! ```

mod colliders;
mod convert;
mod lifecycle;
mod methods;
mod node;
mod parameters;
mod refusal;
mod shapes;
mod source;
mod surface;

/// The library that Godot loads.
struct Extension;

// SAFETY: Godot loads the library once, through the entry that the macro writes.
#[godot::init::gdextension]
unsafe impl godot::init::ExtensionLibrary for Extension {}
