//! The C face of Muslin.
