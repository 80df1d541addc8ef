//! The library itself: version, status messages, last error, stage names, log.

use crate::ffi::callback::UserPointer;
use crate::log::{LogListener, MuslinLogFn, set_listener};
use crate::status::{MuslinStatus, last_error, status_message};
use core::ffi::{CStr, c_char, c_void};
use core::ptr;
use muslin_core::Stage;

/// Major, minor and patch version of the package.
const VERSION: [&str; 3] = [
    env!("CARGO_PKG_VERSION_MAJOR"),
    env!("CARGO_PKG_VERSION_MINOR"),
    env!("CARGO_PKG_VERSION_PATCH"),
];

/// Returns the version of the running library as 0x00MMmmpp: major, minor, patch.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_version() -> u32 {
    VERSION.iter().fold(0, |version, part| (version << 8) | part.parse::<u32>().unwrap_or(0))
}

/// Returns the version of the running library as "major.minor.patch". The pointer is always valid.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_version_string() -> *const c_char {
    concat!(env!("CARGO_PKG_VERSION"), "\0").as_ptr().cast()
}

/// Returns the general meaning of a MuslinStatus. Accepts any number; the pointer is always valid.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_status_string(status: u32) -> *const c_char {
    status_message(status).as_ptr()
}

/// Returns the message of this thread's last call that was refused; it names the argument and the
/// rule. "" if no call was refused yet. Successful calls do not change it.
///
/// The pointer is never NULL, and valid until the next call of this thread that is refused.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_last_error() -> *const c_char {
    last_error()
}

/// Returns the name of a stage of the tick, for `seconds` of MuslinStats. Stages are numbered from
/// 0; NULL beyond the last one. The pointer is always valid.
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

/// Sends log messages up to `max_level` (MUSLIN_LOG_ERROR, MUSLIN_LOG_WARN or MUSLIN_LOG_INFO) to
/// `log`. NULL, the initial value, switches the log off.
///
/// `log` is called on the thread of the call that it reports, perhaps on several threads at once,
/// and may call the library. `user` is passed to it unchanged. Both must stay valid until they are
/// replaced and calls that are running on other threads have returned.
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
    fn stage_names_are_those_of_the_core() {
        for (at, stage) in Stage::ALL.iter().enumerate() {
            let name = muslin_stage_name(at as u32);
            // SAFETY: a name that is not NULL is one of the literals above.
            let name = (!name.is_null()).then(|| unsafe { CStr::from_ptr(name) });
            assert_eq!(name.and_then(|name| name.to_str().ok()), Some(stage.name()));
        }
        assert!(muslin_stage_name(Stage::COUNT as u32).is_null());
    }
}
