//! What changes with time, one noun a file.

pub(crate) mod anchors;
pub(crate) mod attachments;
pub(crate) mod collider_desc;
pub(crate) mod colliders;
pub(crate) mod events;
pub(crate) mod grabs;
pub(crate) mod mass_scales;
pub(crate) mod particles;
pub(crate) mod pins;
pub(crate) mod pose;
pub(crate) mod settings;
pub(crate) mod wind;
