//! Muslin in Godot: a GDExtension with the node [`MuslinCloth3D`](node::MuslinCloth3D).
//!
//! ```text
//! node ── choices          the class and its properties
//! lifecycle ─┬─▶ source       mesh or grid, with its pins ──▶ muslin::MeshDesc
//!            ├─▶ properties ─▶ parameters   ──▶ muslin::{Settings, Material, Wind}
//!            ├─▶ scene ─▶ colliders ─▶ shapes   CollisionShape3D ──▶ muslin::ColliderDesc
//!            ├─▶ surface      the cloth's vertices ──▶ ArrayMesh
//!            └─▶ preview      what the editor shows
//! methods                  what scripts call
//! ```

mod choices;
mod colliders;
mod convert;
mod lifecycle;
mod methods;
mod node;
mod parameters;
mod preview;
mod properties;
mod refusal;
mod scene;
mod shapes;
mod source;
mod surface;

/// The library that Godot loads.
struct Extension;

// SAFETY: Godot loads the library once, through the entry that the macro writes.
#[godot::init::gdextension]
unsafe impl godot::init::ExtensionLibrary for Extension {}
