//! The C face of Muslin: `libmuslin.a`, `libmuslin.so` and `include/muslin.h`.
//!
//! The docs of this crate are written for the readers of the header, which is generated from them.
//! `calls` holds the functions by theme, `types` the structs; pointers are followed in `boundary`
//! only, and cloths live in `registry`.

mod ffi;
mod functions;
mod log;
mod registry;
mod status;
mod types;
