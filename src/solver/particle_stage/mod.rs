//! Particle layouts that gathered kernels work on, and how they are filled and written back.

pub(crate) mod access;
pub(crate) mod interleaved;
