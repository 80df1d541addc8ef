//! Changes of topology: tears and cuts.

pub(crate) mod cut;
pub(crate) mod tear;
