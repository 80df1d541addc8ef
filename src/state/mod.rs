//! State of a cloth: all that a save, a restore and the state hash cover, one noun per file.

pub(crate) mod anchors;
pub(crate) mod attachments;
pub(crate) mod collider_desc;
pub(crate) mod colliders;
#[cfg(feature = "facet-colliders")]
pub(crate) mod deformation;
pub(crate) mod events;
#[cfg(feature = "facet-colliders")]
mod facet_desc;
pub(crate) mod frame_clock;
pub(crate) mod grabs;
pub(crate) mod mass_scales;
#[cfg(not(feature = "facet-colliders"))]
mod no_facets;
pub(crate) mod origin;
pub(crate) mod particles;
pub(crate) mod pins;
pub(crate) mod pose;
pub(crate) mod settings;
pub(crate) mod sewing;
pub(crate) mod violations;
pub(crate) mod wind;

#[cfg(not(feature = "facet-colliders"))]
pub(crate) use no_facets::deformation;
