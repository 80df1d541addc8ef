//! Tearing by hand, and what happened.

use crate::boundary::{Out, Report};
use crate::registry::with_cloth;
use crate::status::{MuslinStatus, Refusal};
use crate::types::event::MuslinEvent;
use crate::types::value::MuslinCloth;

/// Tears the cloth between two neighbouring particles, as over-stretching would: the more loaded of the
/// two is split by the plane across the way between them. Where neither has anything on its other
/// side, the edge itself opens, if it starts at a border.
///
/// @return MUSLIN_STATUS_NOT_TORN if it did not give way: both ends are pinned or grabbed, or the edge is
/// a border already; MUSLIN_STATUS_BAD_INDEX for a particle that is not; MUSLIN_STATUS_BAD_VALUE unless
/// the two are the ends of an edge; MUSLIN_STATUS_FULL if the reserve for tears is used up
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_tear_edge(
    cloth: MuslinCloth,
    particle_a: u32,
    particle_b: u32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        if cloth.tear_edge(particle_a, particle_b)? {
            return Ok(());
        }
        let sentence = "the edge did not give way: its ends are held, or it is a border";
        Err(Refusal::new(MuslinStatus::NotTorn, sentence))
    })
}

/// Takes the oldest event that was not read yet; the 1024 newest are kept. `out_some` becomes 1, or 0 if
/// there is none, which leaves `out_event` as it is. `out_event` has begun with muslin_event_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_next_event(
    cloth: MuslinCloth,
    out_event: *mut MuslinEvent,
    out_some: *mut u32,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let (out_event, out_some) =
        unsafe { (Report::new("out_event", out_event), Out::new("out_some", out_some)) };
    with_cloth(cloth, |cloth| {
        let (out_event, out_some) = (out_event?, out_some?);
        let event = cloth.next_event();
        out_some.write(event.is_some().into());
        if let Some(event) = event {
            out_event.write(&event.into());
        }
        Ok(())
    })
}
