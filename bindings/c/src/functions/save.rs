//! Save and restore.

use crate::ffi::pointers::{Out, OutBuffer, borrow_bytes, check_is_asked, write_bytes};
use crate::functions::create::create;
use crate::registry::with_cloth;
use crate::status::MuslinStatus;
use crate::types::value::MuslinCloth;
use core::ffi::c_void;
use muslin_core::Cloth;

/// Writes the complete state of a cloth to `size` bytes at `buffer`. `out_needed` receives the
/// number of bytes of the save.
///
/// If `buffer` is NULL, only that number is returned; otherwise `out_needed` may be NULL. The bytes
/// are the same on every platform. The number is valid until the cloth changes.
///
/// @return MUSLIN_STATUS_BUFFER_TOO_SMALL if the save does not fit: nothing is written, and
/// muslin_last_error() states the required size
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_save(
    cloth: MuslinCloth,
    buffer: *mut c_void,
    size: usize,
    out_needed: *mut usize,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let (buffer, out_needed) =
        unsafe { (OutBuffer::new(buffer, size), Out::new_optional(out_needed)) };
    with_cloth(cloth, |cloth| {
        check_is_asked(&buffer, &out_needed)?;
        write_bytes(&cloth.save(), buffer, out_needed)
    })
}

/// Makes a cloth from `size` bytes at `buffer` that muslin_cloth_save wrote, perhaps on another
/// platform. It continues with the same bits.
///
/// Handles of grabs, attachments and colliders are valid for the new cloth too. Untrusted bytes are
/// safe: they give a valid cloth or an error.
///
/// @return MUSLIN_STATUS_BAD_SAVE if the bytes are not a save, come from another format version, or
/// are damaged
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_restore(
    buffer: *const c_void,
    size: usize,
    out_cloth: *mut MuslinCloth,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out_cloth = unsafe { Out::new("out_cloth", out_cloth) };
    create(out_cloth, || {
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
        let bytes = unsafe { borrow_bytes("buffer", buffer, size)? };
        Ok(Cloth::restore(bytes)?)
    })
}
