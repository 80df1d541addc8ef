//! Kinematic constraints: pins, grabs, attachments, and anchors with a max distance and a backstop.
//!
//! `targets` moves pinned and grabbed particles before the constraints of a substep; `anchors`
//! bounds the distance of particles to animated positions after them. The host sets the targets
//! once per frame; they are reached evenly over the substeps.

pub(crate) mod anchors;
pub(crate) mod targets;
