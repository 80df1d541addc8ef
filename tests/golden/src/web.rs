//! The report as a plain C function, for wasm in Node without bindings.

use std::ffi::{CString, c_char};

/// Returns [`crate::report`] as a zero-terminated string, which is never freed.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_golden_report(every_tick: u32) -> *mut c_char {
    let report = crate::report(every_tick != 0);
    // Names and numbers contain no zero byte. With one, the report would be empty and match no
    // table.
    CString::new(report).unwrap_or_default().into_raw()
}
