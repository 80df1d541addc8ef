//! Kinematic constraints: pins, grabs, attachments, and anchors with a max distance and a backstop.

pub(crate) mod anchors;
pub(crate) mod targets;
