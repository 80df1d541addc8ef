//! Kinematic constraints: pins, grabs, attachments, and anchors with a max distance and a backstop.
//!
//! `targets` moves pinned and grabbed particles before the constraints of a substep; `anchors`
//! bounds the distance of particles to animated positions after them. The host sets the targets
//! once per frame; `tick_targets` divides their motion over the ticks of an `advance`, and within a
//! tick they move evenly over the substeps.

pub(crate) mod anchors;
pub(crate) mod targets;
pub(crate) mod tick_targets;
