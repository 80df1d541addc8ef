//! Time stepping.

use crate::ffi::panic_guard::run_guarded;
use crate::ffi::pointers::{Out, OutU32s, read_list};
use crate::registry::{with_cloth, with_cloths};
use crate::status::MuslinStatus;
use crate::types::value::MuslinCloth;
use muslin_core::Cloth;

/// Runs the ticks that are due after `seconds` [s] of frame time. `out_ticks` (may be NULL)
/// receives how many ran.
///
/// The remainder, less than one tick, is kept for the next call; `blend` of MuslinStats returns it
/// as a share of a tick. At most `max_ticks_per_advance` ticks run; the rest of the backlog is
/// dropped, so a slow machine shows slow motion instead of falling further behind. Zero seconds
/// change nothing.
///
/// Poses that were given since the last tick (targets of pins and grabs, attachments, anchors,
/// colliders, the frame of muslin_cloth_move_frame) are reached evenly over the ticks of this call,
/// and exactly at the end of the last one. If no tick runs, they wait for the next call.
///
/// @return MUSLIN_STATUS_BAD_VALUE if `seconds` is negative or not finite
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_advance(
    cloth: MuslinCloth,
    seconds: f32,
    out_ticks: *mut u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out_ticks = unsafe { Out::new_optional(out_ticks) };
    with_cloth(cloth, |cloth| {
        let ticks = cloth.advance(seconds)?;
        if let Some(out_ticks) = out_ticks {
            out_ticks.write(ticks);
        }
        Ok(())
    })
}

/// Advances `count` cloths by `seconds` [s] of frame time, each as muslin_cloth_advance does, with
/// the same bits. `out_ticks` (may be NULL) receives how many ticks each of them ran.
///
/// A cloth that sleeps costs next to nothing. `cloths` may be NULL if `count` is 0.
///
/// If one of the cloths is refused, none of them advances; the message names its index.
///
/// @return MUSLIN_STATUS_BAD_VALUE if `seconds` is negative or not finite, or if a cloth occurs
/// twice
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloths_advance(
    cloths: *const MuslinCloth,
    count: u32,
    seconds: f32,
    out_ticks: *mut u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, the pointer is NULL or valid for the call.
    let out_ticks = unsafe { OutU32s::new(out_ticks, count) };
    run_guarded(|| {
        // SAFETY: by the header's rules, the pointer is NULL or valid for the call.
        let handles = unsafe { read_list("cloths", cloths, count)? };
        with_cloths(&handles, |cloths| {
            out_ticks.write(&Cloth::advance_many(cloths, seconds)?);
            Ok(())
        })
    })
}

/// Runs exactly `ticks` ticks. The time that muslin_cloth_advance keeps for the next frame does not
/// change. Poses that were given before the call are reached in the first of these ticks.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_step(cloth: MuslinCloth, ticks: u32) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        cloth.step(ticks);
        Ok(())
    })
}
