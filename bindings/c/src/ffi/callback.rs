//! Calls from the library into the host.
//!
//! Reads the host's function and user pointer.
//! Invariant: the user pointer is passed on and never dereferenced.

use core::ffi::{CStr, c_char, c_void};
use core::ptr;

/// The pointer that the host gets back with each message.
#[derive(Clone, Copy)]
pub struct UserPointer(pub *mut c_void);

impl UserPointer {
    pub const NULL: Self = Self(ptr::null_mut());
}

// SAFETY: the library never dereferences the pointer. `muslin_set_log` requires that the host's
// function may be called with it on any thread.
unsafe impl Send for UserPointer {}

/// Passes a message to the host's log function.
pub fn call_log_function(
    function: unsafe extern "C" fn(level: u32, message: *const c_char, user: *mut c_void),
    level: u32,
    message: &CStr,
    user: UserPointer,
) {
    // SAFETY: the caller of `muslin_set_log` guarantees that the function may be called with this
    // `user`. The message ends in a zero byte and lives until the function returns.
    unsafe { function(level, message.as_ptr(), user.0) };
}
