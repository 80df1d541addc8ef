//! Cheap questions: time, blend, sleep, wind and mass, without the cost of MuslinStats.

use crate::ffi::pointers::Out;
use crate::ffi::versioned_struct::OutStruct;
use crate::registry::with_cloth;
use crate::status::MuslinStatus;
use crate::types::value::{MuslinCloth, MuslinVec3};
use crate::types::wind::MuslinWind;

/// Reads the share of a tick that muslin_cloth_advance has not simulated yet, from 0 to 1: the
/// `blend` of MuslinWriteDesc for smooth motion at any frame rate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_blend(
    cloth: MuslinCloth,
    out_blend: *mut f32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out_blend = unsafe { Out::new("out_blend", out_blend) };
    with_cloth(cloth, |cloth| {
        out_blend?.write(cloth.blend());
        Ok(())
    })
}

/// Reads whether the cloth sleeps, 1 or 0, see `sleep_speed` of MuslinSettings: ticks then move
/// nothing until something wakes it.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_is_asleep(
    cloth: MuslinCloth,
    out_asleep: *mut u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out_asleep = unsafe { Out::new("out_asleep", out_asleep) };
    with_cloth(cloth, |cloth| {
        out_asleep?.write(u32::from(cloth.is_asleep()));
        Ok(())
    })
}

/// Reads the current wind. Initialise `out_wind` with muslin_wind_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_wind(
    cloth: MuslinCloth,
    out_wind: *mut MuslinWind,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out = unsafe { OutStruct::new("out_wind", out_wind) };
    with_cloth(cloth, |cloth| {
        out?.write(&cloth.wind().into());
        Ok(())
    })
}

/// Reads the simulated time since the cloth was made or reset.
///
/// `out_seconds` (may be NULL) receives it in seconds, `out_ticks` (may be NULL) in ticks.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_time(
    cloth: MuslinCloth,
    out_seconds: *mut f64,
    out_ticks: *mut u64,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let (seconds, ticks) =
        unsafe { (Out::new_optional(out_seconds), Out::new_optional(out_ticks)) };
    with_cloth(cloth, |cloth| {
        seconds.into_iter().for_each(|out| out.write(cloth.time()));
        ticks.into_iter().for_each(|out| out.write(u64::from(cloth.ticks())));
        Ok(())
    })
}

/// Reads mass, center of mass and momentum of the whole cloth, pinned particles included. Computed
/// on each call, in one pass over the particles.
///
/// `out_total` (may be NULL) receives the mass [kg], `out_center` (may be NULL) the center of mass
/// [m], `out_momentum` (may be NULL) the sum of mass times velocity [kg m/s].
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_mass(
    cloth: MuslinCloth,
    out_total: *mut f32,
    out_center: *mut MuslinVec3,
    out_momentum: *mut MuslinVec3,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let (total, center, momentum) = unsafe {
        (
            Out::new_optional(out_total),
            Out::new_optional(out_center),
            Out::new_optional(out_momentum),
        )
    };
    with_cloth(cloth, |cloth| {
        let mass = cloth.mass_properties();
        total.into_iter().for_each(|out| out.write(mass.total));
        center.into_iter().for_each(|out| out.write(mass.center.into()));
        momentum.into_iter().for_each(|out| out.write(mass.momentum.into()));
        Ok(())
    })
}
