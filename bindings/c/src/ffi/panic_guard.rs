//! X

use crate::log::{self, MUSLIN_LOG_ERROR, MUSLIN_LOG_WARN};
use crate::status::{CallError, MuslinStatus, Result, set_last_error};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs a call, catches its panic, and keeps and logs the sentence of its refusal.
pub fn run_guarded(call: impl FnOnce() -> Result) -> MuslinStatus {
    let mut call = Some(call);
    run_guarded_dyn(&mut || call.take().map_or(Ok(()), |call| call()))
}

/// The same for all calls at once: what is around them would be half of the library if each had its own.
fn run_guarded_dyn(call: &mut dyn FnMut() -> Result) -> MuslinStatus {
    // Whatever the panic left half-changed is behind a lock that it spoilt.
    let outcome = catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let what = text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("no reason given");
        Err(CallError::panicked(what))
    });
    let Err(refusal) = outcome else {
        return MuslinStatus::Ok;
    };
    set_last_error(&refusal.message);
    match refusal.status {
        MuslinStatus::NothingHit | MuslinStatus::NotTorn => {}
        MuslinStatus::Panicked => log::emit(MUSLIN_LOG_ERROR, || refusal.message),
        _ => log::emit(MUSLIN_LOG_WARN, || refusal.message),
    }
    refusal.status
}
