//! What a call returns, and the sentence that goes with it.

use core::ffi::{CStr, c_char};
use core::fmt::Display;
use muslin_core::Error;
use std::cell::RefCell;
use std::ffi::CString;

/// What became of a call. Whatever is not MUSLIN_STATUS_OK left the cloth and all `out_...` parameters
/// as they were, and muslin_last_error() says why in a sentence.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MuslinStatus {
    /// Done.
    Ok = 0,
    /// An argument or a field is NULL, out of its range or not finite, or does not fit another one.
    BadValue = 1,
    /// An index points past the last particle or vertex.
    BadIndex = 2,
    /// A handle of a cloth, grab, attachment or collider that is not there (any more).
    BadHandle = 3,
    /// The triangles cannot be cloth.
    BadMesh = 4,
    /// The bytes are not a saved cloth of this version, or were damaged.
    BadSave = 5,
    /// The room that was reserved is used up.
    Full = 6,
    /// A wish that this version does not know or does not fulfil yet.
    Unsupported = 7,
    /// The cloth is in use on another thread at this moment.
    Busy = 8,
    /// The caller's buffer is too small.
    BufferTooSmall = 9,
    /// The ray meets nothing. Not a mistake, so it is not logged.
    NothingHit = 10,
    /// The edge did not give way: its ends are held, or it is a border. Not a mistake, so it is not
    /// logged.
    NotTorn = 11,
    /// A defect of Muslin stopped the call half-way; please report it. The cloth is of no use any more:
    /// all that it still takes is muslin_cloth_destroy.
    Panicked = 12,
}

/// Every status with what it says in general.
const STATUS_MESSAGES: [(MuslinStatus, &CStr); 13] = [
    (MuslinStatus::Ok, c"done"),
    (MuslinStatus::BadValue, c"a value is missing, out of its range or not finite"),
    (MuslinStatus::BadIndex, c"an index points past the last particle or vertex"),
    (MuslinStatus::BadHandle, c"a handle names nothing that is there"),
    (MuslinStatus::BadMesh, c"the triangles cannot be cloth"),
    (MuslinStatus::BadSave, c"the bytes are not a saved cloth of this version"),
    (MuslinStatus::Full, c"the room that was reserved is used up"),
    (MuslinStatus::Unsupported, c"this version does not support it"),
    (MuslinStatus::Busy, c"the cloth is in use on another thread"),
    (MuslinStatus::BufferTooSmall, c"the buffer is too small"),
    (MuslinStatus::NothingHit, c"the ray meets nothing"),
    (MuslinStatus::NotTorn, c"the edge did not give way"),
    (MuslinStatus::Panicked, c"a defect of Muslin stopped the call"),
];

/// What the status of this number says in general.
pub fn status_message(number: u32) -> &'static CStr {
    let found = STATUS_MESSAGES.iter().find(|(status, _)| *status as u32 == number);
    found.map_or(c"no status of this version", |(_, message)| message)
}

/// A call that was refused: its status and a sentence that names the field and the rule.
#[derive(Clone, Debug, PartialEq)]
pub struct CallError {
    pub status: MuslinStatus,
    pub message: String,
}

/// What calls give inside of this crate.
pub type Result<T = (), E = CallError> = core::result::Result<T, E>;

impl CallError {
    pub fn new(status: MuslinStatus, message: impl Into<String>) -> Self {
        Self { status, message: message.into() }
    }

    /// "`field` must …", as the core says it.
    pub fn bad_value(field: impl Display, must: impl Display) -> Self {
        Self::new(MuslinStatus::BadValue, format!("`{field}` must {must}"))
    }

    /// A handle of a cloth that is not there.
    pub fn bad_cloth() -> Self {
        Self::new(
            MuslinStatus::BadHandle,
            "`cloth` must be a cloth that was made and not destroyed",
        )
    }

    /// A defect of ours, caught.
    pub fn panicked(what: &str) -> Self {
        Self::new(MuslinStatus::Panicked, format!("a defect of Muslin stopped the call: {what}"))
    }

    /// A cloth that a defect of ours left half-changed.
    pub fn poisoned_cloth() -> Self {
        Self::new(
            MuslinStatus::Panicked,
            "a defect of Muslin stopped an earlier call on this cloth; it can only be destroyed",
        )
    }
}

impl From<Error> for CallError {
    fn from(error: Error) -> Self {
        let status = match error {
            Error::BadValue { .. } | Error::BadStream { .. } => MuslinStatus::BadValue,
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

/// Keeps a sentence for muslin_last_error on this thread.
pub fn set_last_error(message: &str) {
    // No sentence of ours holds a zero byte; one that did would be left out.
    let message = CString::new(message).unwrap_or_default();
    // On a thread that is just ending, nobody can ask any more.
    let _ = LAST_ERROR.try_with(|last| *last.borrow_mut() = message);
}

/// This thread's last sentence; stays where it is until the next refusal.
pub fn last_error() -> *const c_char {
    LAST_ERROR.try_with(|last| last.borrow().as_ptr()).unwrap_or(c"".as_ptr())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_status_says_something_of_its_own() {
        for (number, (status, said)) in STATUS_MESSAGES.iter().enumerate() {
            assert_eq!(*status as usize, number);
            assert_eq!(status_message(number as u32), *said);
            assert_eq!(STATUS_MESSAGES.iter().filter(|(_, other)| other == said).count(), 1);
        }
        assert_eq!(status_message(13), c"no status of this version");
    }

    #[test]
    fn a_refusal_of_the_core_keeps_its_words() {
        let error = Error::BadValue { field: "settings.tick", must: "be above 0 and at most 1" };
        let refusal = CallError::from(error);
        assert_eq!(refusal.status, MuslinStatus::BadValue);
        assert_eq!(refusal.message, "`settings.tick` must be above 0 and at most 1");
    }
}
