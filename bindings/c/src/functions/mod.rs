//! The functions of the header, one theme a file.

mod anchors;
mod attachments;
mod colliders;
mod create;
mod init;
mod library;
mod parameters;
mod particles;
mod picking;
mod reference_frame;
mod save;
mod time;
mod topology;
mod vertex_buffers;
mod views;

#[cfg(test)]
mod miri_tests;
