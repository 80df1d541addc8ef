//! Geometry that knows nothing of cloth.

pub(crate) mod blade;
pub(crate) mod ray;
pub(crate) mod triangle;
