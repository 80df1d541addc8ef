//! The host's log function. Without one, the library is silent.
//!
//! Reads messages of calls; calls the host's function.
//! Invariant: no lock is held while the host's function runs, so it may call the library.

use crate::ffi::callback::{UserPointer, call_log_function};
use core::ffi::{c_char, c_void};
use std::ffi::CString;
use std::sync::{Mutex, PoisonError};

/// A bug in Muslin interrupted a call.
pub const MUSLIN_LOG_ERROR: u32 = 1;
/// A call was refused. The message is that of muslin_last_error.
pub const MUSLIN_LOG_WARN: u32 = 2;
/// A cloth was created or destroyed.
pub const MUSLIN_LOG_INFO: u32 = 3;

/// Function of the host that receives log messages.
///
/// `level` is one of MUSLIN_LOG_...; `message` is valid during the call only; `user` is the pointer
/// that was passed to muslin_set_log.
pub type MuslinLogFn =
    Option<unsafe extern "C" fn(level: u32, message: *const c_char, user: *mut c_void)>;

/// The host's function, the highest level it receives, and its user pointer.
#[derive(Clone, Copy)]
pub struct LogListener {
    pub function: MuslinLogFn,
    pub max_level: u32,
    pub user: UserPointer,
}

static LISTENER: Mutex<LogListener> =
    Mutex::new(LogListener { function: None, max_level: 0, user: UserPointer::NULL });

/// Replaces the listener.
pub fn set_listener(listener: LogListener) {
    *LISTENER.lock().unwrap_or_else(PoisonError::into_inner) = listener;
}

/// Passes a message to the listener if it receives this level. Call this without holding a lock.
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
