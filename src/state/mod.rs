//! State of a cloth: all that a save, a restore and the state hash cover, one noun per file.

pub(crate) mod anchors;
pub(crate) mod attachments;
pub(crate) mod collider_desc;
pub(crate) mod colliders;
pub(crate) mod deformation;
pub(crate) mod events;
pub(crate) mod frame_clock;
pub(crate) mod grabs;
pub(crate) mod mass_scales;
pub(crate) mod origin;
pub(crate) mod particles;
pub(crate) mod pins;
pub(crate) mod pose;
pub(crate) mod settings;
pub(crate) mod sewing;
pub(crate) mod violations;
pub(crate) mod wind;
