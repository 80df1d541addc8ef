//! The report for a host that can only call a plain function: wasm in node, without any bindings.

use std::ffi::{CString, c_char};

/// [`crate::report`] as text that ends in a zero; it is never freed.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_golden_report(every_tick: u32) -> *mut c_char {
    let report = crate::report(every_tick != 0);
    // Names and numbers hold no zero; a text that did would come out empty and fit no table.
    CString::new(report).unwrap_or_default().into_raw()
}
