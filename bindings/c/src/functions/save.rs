//! A cloth as bytes, and back.

use crate::ffi::pointers::{Out, OutBuffer, borrow_bytes};
use crate::functions::create::create;
use crate::registry::with_cloth;
use crate::status::{CallError, MuslinStatus};
use crate::types::value::MuslinCloth;
use core::ffi::c_void;
use muslin_core::Cloth;

/// Writes all of a cloth into `size` bytes at `buffer`; `out_needed` gets the number of bytes that it
/// takes. With `buffer` NULL it gets only that number. With a buffer `out_needed` may be NULL.
///
/// The bytes are the same on every machine, and hold until the cloth changes.
///
/// @return MUSLIN_STATUS_BUFFER_TOO_SMALL if it does not fit: nothing is written, muslin_last_error names
/// the size that it takes
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_save(
    cloth: MuslinCloth,
    buffer: *mut c_void,
    size: usize,
    out_needed: *mut usize,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let (buffer, out_needed) =
        unsafe { (OutBuffer::new(buffer, size), Out::new_optional(out_needed)) };
    with_cloth(cloth, |cloth| {
        if buffer.is_none() && out_needed.is_none() {
            return Err(CallError::bad_value("out_needed", "not be NULL where `buffer` is"));
        }
        let bytes = cloth.save();
        if let Some(buffer) = buffer {
            buffer.write(&bytes)?;
        }
        if let Some(out_needed) = out_needed {
            out_needed.write(bytes.len());
        }
        Ok(())
    })
}

/// Makes the cloth that muslin_cloth_save turned into the `size` bytes at `buffer`, on this machine or
/// any other: it goes on in the same bits. Handles of grabs, attachments and colliders hold for it too.
///
/// @return MUSLIN_STATUS_BAD_SAVE if the bytes are not that, or not whole
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_restore(
    buffer: *const c_void,
    size: usize,
    out_cloth: *mut MuslinCloth,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out_cloth = unsafe { Out::new("out_cloth", out_cloth) };
    create(out_cloth, || {
        // SAFETY: the caller's promise above.
        let bytes = unsafe { borrow_bytes("buffer", buffer, size)? };
        Ok(Cloth::restore(bytes)?)
    })
}
