//! Status codes of the C API, and the message of the last error on each thread.
//!
//! Reads errors of the core; writes a thread-local message.
//! Invariant: every status but `Ok` comes with a message that names the field and the rule.

use core::ffi::{CStr, c_char};
use core::fmt::Display;
use muslin_core::Error;
use std::cell::RefCell;
use std::ffi::CString;

/// Result of a call.
///
/// With any status but MUSLIN_STATUS_OK, the call changed neither the cloth nor the memory behind
/// its `out_...` parameters, and muslin_last_error() returns a message that names the argument and
/// the rule.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MuslinStatus {
    /// The call succeeded.
    Ok = 0,
    /// An argument or field is NULL, out of range, not finite, or inconsistent with another one.
    BadValue = 1,
    /// An index is not below the number of particles, vertices or points.
    BadIndex = 2,
    /// A handle of a cloth, grab, attachment or collider is stale, made up or from another cloth.
    BadHandle = 3,
    /// The mesh cannot be made into cloth, even after repair.
    BadMesh = 4,
    /// The bytes are not a saved cloth, come from another format version, or are damaged.
    BadSave = 5,
    /// A limit on the number of items is reached, or the reserve for tears and cuts
    /// (`extra_particles`) is used up.
    Full = 6,
    /// This version does not support the requested value or struct version.
    Unsupported = 7,
    /// Another thread is using the cloth. The call did nothing; try again.
    Busy = 8,
    /// The caller's buffer is too small.
    BufferTooSmall = 9,
    /// The ray hits nothing. Not an error, so it is not logged.
    NothingHit = 10,
    /// The edge did not tear: both ends are pinned or grabbed, or it is a border edge. Not an
    /// error, so it is not logged.
    NotTorn = 11,
    /// A bug in Muslin interrupted the call; please report it. The cloth is unusable: the only call
    /// that it still accepts is muslin_cloth_destroy.
    Panicked = 12,
}

/// Every status with its general message.
const STATUS_MESSAGES: [(MuslinStatus, &CStr); 13] = [
    (MuslinStatus::Ok, c"done"),
    (MuslinStatus::BadValue, c"a value is missing, out of range or not finite"),
    (MuslinStatus::BadIndex, c"an index is not below the number of items"),
    (MuslinStatus::BadHandle, c"a handle is stale or was never valid"),
    (MuslinStatus::BadMesh, c"the mesh cannot be made into cloth"),
    (MuslinStatus::BadSave, c"the bytes are not a saved cloth of this format version"),
    (MuslinStatus::Full, c"a limit is reached or the reserve is used up"),
    (MuslinStatus::Unsupported, c"this version does not support the request"),
    (MuslinStatus::Busy, c"the cloth is in use on another thread"),
    (MuslinStatus::BufferTooSmall, c"the buffer is too small"),
    (MuslinStatus::NothingHit, c"the ray hits nothing"),
    (MuslinStatus::NotTorn, c"the edge did not tear"),
    (MuslinStatus::Panicked, c"a bug in Muslin interrupted the call"),
];

/// Returns the general message of the status with this number.
pub fn status_message(number: u32) -> &'static CStr {
    let found = STATUS_MESSAGES.iter().find(|(status, _)| *status as u32 == number);
    found.map_or(c"unknown status", |(_, message)| message)
}

/// An error of a call: its status, and a message that names the field and the rule.
#[derive(Clone, Debug, PartialEq)]
pub struct CallError {
    pub status: MuslinStatus,
    pub message: String,
}

/// The result of functions inside this crate.
pub type Result<T = (), E = CallError> = core::result::Result<T, E>;

impl CallError {
    pub fn new(status: MuslinStatus, message: impl Into<String>) -> Self {
        Self { status, message: message.into() }
    }

    /// The error "`field` must …", worded as in the core.
    pub fn bad_value(field: impl Display, must: impl Display) -> Self {
        Self::new(MuslinStatus::BadValue, format!("`{field}` must {must}"))
    }

    /// The error of a stale, made-up or zero handle of a cloth.
    pub fn bad_cloth() -> Self {
        Self::new(MuslinStatus::BadHandle, "`cloth` must be a live cloth")
    }

    /// The error of a stale, made-up or zero handle of a skin.
    pub fn bad_skin() -> Self {
        Self::new(MuslinStatus::BadHandle, "`skin` must be a live skin of a live cloth")
    }

    /// The error of a call that panicked.
    pub fn panicked(what: &str) -> Self {
        Self::new(MuslinStatus::Panicked, format!("a bug in Muslin interrupted the call: {what}"))
    }

    /// The error of a call on a cloth that an earlier panic left in an unknown state.
    pub fn poisoned_cloth() -> Self {
        Self::new(
            MuslinStatus::Panicked,
            "a bug in Muslin interrupted an earlier call on this cloth; it can only be destroyed",
        )
    }
}

impl From<Error> for CallError {
    fn from(error: Error) -> Self {
        let status = match error {
            Error::BadValue { .. }
            | Error::BadEntry { .. }
            | Error::BadCount { .. }
            | Error::BadStream { .. } => MuslinStatus::BadValue,
            Error::SmallStream { .. } => MuslinStatus::BufferTooSmall,
            Error::BadIndex { .. } => MuslinStatus::BadIndex,
            Error::BadHandle { .. } => MuslinStatus::BadHandle,
            Error::BadMesh { .. } => MuslinStatus::BadMesh,
            Error::Full { .. } => MuslinStatus::Full,
            Error::BadSave { .. } => MuslinStatus::BadSave,
            _ => MuslinStatus::Unsupported,
        };
        Self::new(status, error.to_string())
    }
}

thread_local! {
    static LAST_ERROR: RefCell<CString> = RefCell::new(CString::default());
}

/// Stores the message for muslin_last_error on this thread.
pub fn set_last_error(message: &str) {
    // Messages of this library contain no zero byte; one that did would be dropped.
    let message = CString::new(message).unwrap_or_default();
    // While a thread ends, its storage is gone and nobody can read the message.
    let _ = LAST_ERROR.try_with(|last| *last.borrow_mut() = message);
}

/// Returns this thread's last message. The pointer is valid until the next error on this thread.
pub fn last_error() -> *const c_char {
    LAST_ERROR.try_with(|last| last.borrow().as_ptr()).unwrap_or(c"".as_ptr())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_status_has_a_message_of_its_own() {
        for (number, (status, message)) in STATUS_MESSAGES.iter().enumerate() {
            assert_eq!(*status as usize, number);
            assert_eq!(status_message(number as u32), *message);
            assert_eq!(STATUS_MESSAGES.iter().filter(|(_, other)| other == message).count(), 1);
        }
        assert_eq!(status_message(13), c"unknown status");
    }

    #[test]
    fn an_error_of_the_core_keeps_its_message() {
        let error = Error::BadValue { field: "settings.tick", must: "be above 0 and at most 1" };
        let call_error = CallError::from(error);
        assert_eq!(call_error.status, MuslinStatus::BadValue);
        assert_eq!(call_error.message, "`settings.tick` must be above 0 and at most 1");
    }
}
