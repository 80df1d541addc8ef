//! Tearing and cutting by hand, and what happened.

use crate::ffi::pointers::Out;
use crate::ffi::versioned_struct::OutStruct;
use crate::registry::with_cloth;
use crate::status::{CallError, MuslinStatus};
use crate::types::event::MuslinEvent;
use crate::types::value::{MuslinCloth, MuslinVec3};

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
        let message = "the edge did not give way: its ends are held, or it is a border";
        Err(CallError::new(MuslinStatus::NotTorn, message))
    })
}

/// Gives the cloth a fold of `angle` [rad] along a line, from `from` to `to` [m], both where they are in the
/// cloth as it was made. From then on the cloth rests folded by so much more along it: towards its front,
/// where the triangles are counter-clockwise, if `angle` is above 0, and else away from it.
///
/// The line need not follow the mesh: the fold is shared out over the cells beside it. It bends no more than
/// `bend_stiffness` can make it, and stays until muslin_cloth_reset; folding by -`angle` along the same line
/// takes it away. Where the line is not on the cloth nothing is folded.
///
/// @return MUSLIN_STATUS_BAD_VALUE for a number that is not finite, for `to` equal to `from`, and unless
/// `angle` is from -3 to 3; the cloth is untouched then
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_crease(
    cloth: MuslinCloth,
    from: MuslinVec3,
    to: MuslinVec3,
    angle: f32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.crease(from.into(), to.into(), angle)?))
}

/// Cuts the cloth with a blade: the segment from `from` to `to` [m], swept along `sweep` [m]. `out_edges`
/// (may be NULL) gets how many edges opened; 0 leaves the cloth as it was.
///
/// Triangles that the blade goes through are divided along it: vertices come to be on the edges that it
/// crosses, between their ends in all that they have, and the mesh opens along them. Where it would come
/// nearer to a vertex than an eighth of an edge, or leave a triangle with an angle below 5 degrees or
/// less area than one in 200 of a square of the mean edge, the cut goes through the nearer vertex
/// instead; past a pinned one it goes at an eighth of the edge. Where the blade ends inside a triangle,
/// the cut ends at the edge before. Vertices that a cut makes are free; a pinned one that it goes through
/// is pinned on both sides. Mass and area at rest stay. Each edge that is crossed takes one particle of
/// the reserve (`extra_particles`), and one more where it opens.
///
/// @return MUSLIN_STATUS_BAD_VALUE for a number that is not finite, or unless `to` is apart from `from` and
/// `sweep` leads away from the line through both; MUSLIN_STATUS_FULL if the reserve cannot take the whole
/// cut; the cloth is untouched then
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_cut(
    cloth: MuslinCloth,
    from: MuslinVec3,
    to: MuslinVec3,
    sweep: MuslinVec3,
    out_edges: *mut u32,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out_edges = unsafe { Out::new_optional(out_edges) };
    with_cloth(cloth, |cloth| {
        let edges = cloth.cut(from.into(), to.into(), sweep.into())?;
        if let Some(out_edges) = out_edges {
            out_edges.write(edges);
        }
        Ok(())
    })
}

/// Takes the oldest event that was not read yet; the 1024 newest are kept. `out_some` becomes 1, or 0 if
/// there is none, which leaves `out_event` as it is. `out_event` has begun with muslin_event_init.
///
/// They come by tick; in a tick recoveries first, then tears, the worst first, and of each the vertices that
/// it split before the torn edge; then, if there was no room for another, that; then the pieces that
/// came off, in the order of their first triangles; then what is held apart. A cut tells the edges that it
/// divided, in its order; those that it opened; the vertices that it split; and the pieces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_next_event(
    cloth: MuslinCloth,
    out_event: *mut MuslinEvent,
    out_some: *mut u32,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let (out_event, out_some) =
        unsafe { (OutStruct::new("out_event", out_event), Out::new("out_some", out_some)) };
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
