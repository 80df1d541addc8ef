//! The functions of the header, one theme a file.

mod colliders;
mod create;
mod init;
mod library;
mod pins;
mod point;
mod read;
mod save;
mod tear;
mod time;
mod write;
