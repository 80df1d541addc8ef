//! Changes of topology: tears by overstretch and cuts by a blade.
//!
//! Both split vertices or edges of the triangle mesh and then update everything that is derived
//! from the mesh: masses, pins, anchors, links, tethers, crack tips and piece labels.

#[cfg(feature = "cut")]
pub(crate) mod cut;
pub(crate) mod piece_labels;
pub(crate) mod piece_members;
pub(crate) mod tear;
pub(crate) mod tear_scratch;
