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

#[cfg(all(test, feature = "docs"))]
mod tests {
    #[test]
    fn whatever_the_class_registers_has_a_description() {
        let sources = concat!(include_str!("node.rs"), include_str!("methods.rs"));
        let documents: Vec<_> = godot::docs::__gather_xml_docs().collect();
        let [xml] = &documents[..] else { panic!("{} documents", documents.len()) };
        for (attributes, element) in [
            (["#[export]", "#[export("], "<member "),
            (["#[func]", "#[func("], "<method "),
            (["#[signal]", "#[signal("], "<signal "),
            (["#[constant]", "#[constant("], "<constant "),
        ] {
            let counts = attributes.map(|attribute| sources.matches(attribute).count());
            let registered: usize = counts.iter().sum();
            assert!(registered > 1, "{element}");
            assert_eq!(xml.matches(element).count(), registered, "{element}");
        }
        let words: String = xml.split_whitespace().collect();
        assert!(!words.contains("<description></description>"));
    }
}
