//! What the library tells the host's log. Nothing, unless the host asks.

use crate::ffi::callback::{UserPointer, call_log_function};
use core::ffi::{c_char, c_void};
use std::ffi::CString;
use std::sync::{Mutex, PoisonError};

/// A defect of Muslin stopped a call.
pub const MUSLIN_LOG_ERROR: u32 = 1;
/// A call was refused; the message is what muslin_last_error says.
pub const MUSLIN_LOG_WARN: u32 = 2;
/// A cloth was made or destroyed.
pub const MUSLIN_LOG_INFO: u32 = 3;

/// Gets a message of the library: its level (MUSLIN_LOG_...), a sentence that is valid for the time of
/// the call, and the `user` pointer of muslin_set_log.
pub type MuslinLogFn =
    Option<unsafe extern "C" fn(level: u32, message: *const c_char, user: *mut c_void)>;

/// Whom to tell, and how much.
#[derive(Clone, Copy)]
pub struct LogListener {
    pub function: MuslinLogFn,
    pub max_level: u32,
    pub user: UserPointer,
}

static LISTENER: Mutex<LogListener> =
    Mutex::new(LogListener { function: None, max_level: 0, user: UserPointer::NULL });

/// Replaces whoever listened before.
pub fn set_listener(listener: LogListener) {
    *LISTENER.lock().unwrap_or_else(PoisonError::into_inner) = listener;
}

/// Tells the listener, if it wants to hear this level. The listener may call the library: nothing is
/// locked meanwhile, so call this with nothing locked.
pub fn emit(level: u32, message: impl FnOnce() -> String) {
    let listener = *LISTENER.lock().unwrap_or_else(PoisonError::into_inner);
    let Some(function) = listener.function else { return };
    if level > listener.max_level {
        return;
    }
    if let Ok(message) = CString::new(message()) {
        call_log_function(function, level, &message, listener.user);
    }
}
