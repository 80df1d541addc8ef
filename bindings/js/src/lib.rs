//! The JavaScript face of Muslin.
