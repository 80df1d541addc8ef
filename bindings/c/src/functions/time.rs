//! Time runs.

use crate::ffi::pointers::Out;
use crate::registry::with_cloth;
use crate::status::MuslinStatus;
use crate::types::value::MuslinCloth;

/// Runs the ticks that a frame of `seconds` [s] owes; `out_ticks` (may be NULL) gets their number.
///
/// What is left over waits for the next frame, see `blend` of MuslinStats. A late frame owes at most
/// `max_ticks_per_advance`; the rest is dropped. Zero changes nothing.
///
/// @return MUSLIN_STATUS_BAD_VALUE if `seconds` is negative or not finite
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_advance(
    cloth: MuslinCloth,
    seconds: f32,
    out_ticks: *mut u32,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out_ticks = unsafe { Out::new_optional(out_ticks) };
    with_cloth(cloth, |cloth| {
        let ticks = cloth.advance(seconds)?;
        if let Some(out_ticks) = out_ticks {
            out_ticks.write(ticks);
        }
        Ok(())
    })
}

/// Runs exactly `ticks` ticks.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_step(cloth: MuslinCloth, ticks: u32) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        cloth.step(ticks);
        Ok(())
    })
}
