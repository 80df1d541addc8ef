//! The boundary between C memory and Rust values.
//!
//! - `pointers`: copies lists out of the caller's memory, writes results into it;
//! - `versioned_struct`: structs that start with `struct_size` and may be of another version;
//! - `struct_versions`: which structs these are;
//! - `stream_list`: the array of vertex streams;
//! - `panic_guard`: turns errors and panics into a status;
//! - `callback`: calls the host's log function.
//!
//! Invariant: caller memory need not be aligned, and may be NULL only where a function says so.

pub mod callback;
pub mod panic_guard;
pub mod pointers;
pub mod stream_list;
pub mod struct_versions;
pub mod versioned_struct;

#[cfg(test)]
mod tests;
