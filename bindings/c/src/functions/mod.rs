//! The functions of the header, one theme per file.
//!
//! Each checks its pointers, looks up the cloth, calls the core and writes results.
//! Invariant: output parameters are written only when the whole call succeeds.

mod anchors;
mod attachments;
mod colliders;
mod create;
mod init;
mod library;
mod parameters;
mod particles;
mod picking;
mod pins;
mod queries;
mod reference_frame;
mod save;
mod sewing;
mod skins;
mod time;
mod topology;
mod vertex_buffers;
mod views;

#[cfg(test)]
mod miri_tests;
