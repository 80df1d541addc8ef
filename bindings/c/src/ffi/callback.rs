//! X

use core::ffi::{CStr, c_char, c_void};
use core::ptr;

/// X
#[derive(Clone, Copy)]
pub struct UserPointer(pub *mut c_void);

impl UserPointer {
    pub const NULL: Self = Self(ptr::null_mut());
}

// SAFETY: the library never dereferences the pointer. `muslin_set_log` requires that the host's
// function may be called with it on any thread.
unsafe impl Send for UserPointer {}

/// X
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
