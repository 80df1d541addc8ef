//! The functions of the header, one theme a file.

mod attachments;
mod colliders;
mod create;
mod init;
mod leashes;
mod library;
mod pins;
mod point;
mod read;
mod save;
mod tear;
mod teleport;
mod time;
#[cfg(test)]
mod walk;
mod write;
