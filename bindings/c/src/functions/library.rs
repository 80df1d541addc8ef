//! About the library itself: version, words for statuses, log.

use crate::ffi::callback::UserPointer;
use crate::log::{LogListener, MuslinLogFn, set_listener};
use crate::status::{MuslinStatus, last_error, status_message};
use core::ffi::{CStr, c_char, c_void};
use core::ptr;
use muslin_core::Stage;

/// The parts of the version, as the package says them.
const VERSION: [&str; 3] = [
    env!("CARGO_PKG_VERSION_MAJOR"),
    env!("CARGO_PKG_VERSION_MINOR"),
    env!("CARGO_PKG_VERSION_PATCH"),
];

/// The version of the library that runs: 0x00MMmmpp, major, minor, patch.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_version() -> u32 {
    VERSION.iter().fold(0, |version, part| (version << 8) | part.parse::<u32>().unwrap_or(0))
}

/// The version of the library that runs: "major.minor.patch". Always valid.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_version_string() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// What a MuslinStatus says in general, any number: never NULL, always valid.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_status_string(status: u32) -> *const c_char {
    status_message(status).as_ptr()
}

/// Why the last call of this thread that was refused was refused: a sentence that names the field and
/// the rule. "" if none was yet. Calls that are not refused leave it as it is.
///
/// Never NULL; valid until the next call of this thread that is refused.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_last_error() -> *const c_char {
    last_error()
}

/// The name of a stage of a tick, 0 and up, for `seconds` of MuslinStats: always valid; NULL for a stage
/// that is not.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_stage_name(stage: u32) -> *const c_char {
    let names: [&CStr; Stage::COUNT] = [
        c"colliders",
        c"forces",
        c"predict",
        c"hold",
        c"tethers",
        c"stretch",
        c"shear",
        c"bend",
        c"pairs",
        c"self-contacts",
        c"contacts",
        c"velocities",
        c"tear",
        c"limit",
        c"guard",
        c"outputs",
    ];
    names.get(stage as usize).map_or(ptr::null(), |name| name.as_ptr())
}

/// Sends what the library has to say, up to `max_level` (MUSLIN_LOG_ERROR, MUSLIN_LOG_WARN,
/// MUSLIN_LOG_INFO), to `log`. At first, and with NULL, it is silent.
///
/// `log` is called on whichever thread made the library speak, maybe on several at once, and may call
/// the library. `user` is handed to it and nothing else. Both must be good until they are replaced and
/// until calls that are under way on other threads have returned.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_set_log(
    log: MuslinLogFn,
    max_level: u32,
    user: *mut c_void,
) -> MuslinStatus {
    set_listener(LogListener { function: log, max_level, user: UserPointer(user) });
    MuslinStatus::Ok
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_are_named_as_the_core_names_them() {
        for (at, stage) in Stage::ALL.iter().enumerate() {
            let name = muslin_stage_name(at as u32);
            // SAFETY: not NULL, and then it is one of the words above.
            let name = (!name.is_null()).then(|| unsafe { CStr::from_ptr(name) });
            assert_eq!(name.and_then(|name| name.to_str().ok()), Some(stage.name()));
        }
        assert!(muslin_stage_name(Stage::COUNT as u32).is_null());
    }
}
