//! The C library of Muslin: `libmuslin.a`, `libmuslin.so` and `include/muslin.h`.
//!
//! The header is generated from the doc comments of `functions`, `types`, `status` and `log`, so
//! these are written for readers of the header. `ffi` converts between C memory and Rust values and
//! stops panics; `registry` maps handles to cloths.
//! Invariant: raw pointers are dereferenced in `ffi` only.

mod ffi;
mod functions;
mod log;
mod registry;
mod status;
mod types;
