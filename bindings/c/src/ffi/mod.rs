//! X

pub mod callback;
pub mod panic_guard;
pub mod pointers;
pub mod stream_list;
pub mod struct_versions;
pub mod versioned_struct;

#[cfg(test)]
mod tests;
