//! Turns the result of a call into a status, and stops panics at the C boundary.
//!
//! Reads the call's result; writes the thread's last error and the log.
//! Invariant: no panic unwinds into C code.

use crate::log::{self, MUSLIN_LOG_ERROR, MUSLIN_LOG_WARN};
use crate::status::{CallError, MuslinStatus, Result, set_last_error};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs a call and returns its status. Catches a panic; stores and logs the message of an error.
pub fn run_guarded(call: impl FnOnce() -> Result) -> MuslinStatus {
    let mut call = Some(call);
    run_guarded_dyn(&mut || call.take().map_or(Ok(()), |call| call()))
}

/// The part of `run_guarded` that is compiled once; one copy per caller would be half of the
/// library.
fn run_guarded_dyn(call: &mut dyn FnMut() -> Result) -> MuslinStatus {
    // Unwind safety: state that a panic left half-changed is behind a lock that it poisoned.
    let outcome = catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let what = text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("no reason given");
        Err(CallError::panicked(what))
    });
    let Err(error) = outcome else {
        return MuslinStatus::Ok;
    };
    set_last_error(&error.message);
    match error.status {
        MuslinStatus::NothingHit | MuslinStatus::NotTorn => {}
        MuslinStatus::Panicked => log::emit(MUSLIN_LOG_ERROR, || error.message),
        _ => log::emit(MUSLIN_LOG_WARN, || error.message),
    }
    error.status
}
