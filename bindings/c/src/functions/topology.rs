//! Tearing, creasing and cutting by hand, and the event queue.

use crate::ffi::pointers::Out;
use crate::ffi::versioned_struct::OutStruct;
use crate::registry::with_cloth;
use crate::status::{CallError, MuslinStatus};
use crate::types::event::MuslinEvent;
use crate::types::value::{MuslinCloth, MuslinVec3};

/// Tears the cloth between two neighbouring particles, as over-stretching does.
///
/// The particle under the higher load is split by the plane that is perpendicular to the edge. If
/// neither particle has triangles on its other side, the edge itself opens, provided that it starts
/// at a border.
///
/// @return MUSLIN_STATUS_NOT_TORN if both ends are pinned or grabbed, or the edge is already a
/// border; MUSLIN_STATUS_BAD_INDEX if a particle does not exist; MUSLIN_STATUS_BAD_VALUE unless the
/// two are the ends of an edge; MUSLIN_STATUS_FULL if the reserve for tears is used up
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
        let message =
            "the edge did not tear: both ends are pinned or grabbed, or it is a border edge";
        Err(CallError::new(MuslinStatus::NotTorn, message))
    })
}

/// Adds a fold of `angle` [rad] to the rest shape, along the line from `from` to `to` [m]. Both
/// points are given on the cloth as it was made.
///
/// - A positive angle folds towards the front of the cloth (the side from which triangles are
///   counter-clockwise), a negative one away from it.
/// - The line need not follow the mesh: the fold is distributed over the cells beside it. A line
///   that misses the cloth has no effect.
/// - The cloth bends only as far as `bend_stiffness` can turn it.
/// - The fold lasts until muslin_cloth_reset; a second crease of -`angle` along the same line
///   removes it.
///
/// @return MUSLIN_STATUS_BAD_VALUE if a number is not finite, `to` equals `from`, or `angle` is not
/// from -3 to 3; the cloth is unchanged then
#[unsafe(no_mangle)]
pub extern "C" fn muslin_cloth_crease(
    cloth: MuslinCloth,
    from: MuslinVec3,
    to: MuslinVec3,
    angle: f32,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| Ok(cloth.crease(from.into(), to.into(), angle)?))
}

/// Cuts the cloth with a blade: the segment from `from` to `to` [m], swept along `sweep` [m].
///
/// `out_edges` (may be NULL) receives the number of opened edges; 0 means that the blade missed and
/// nothing changed.
///
/// - Triangles that the blade crosses are divided along it: new vertices lie on the crossed edges,
///   with attributes interpolated between the edge's ends, and the mesh opens along them.
/// - The cut goes through an existing vertex instead if it would pass closer than an eighth of an
///   edge, or would leave a triangle with an angle below 5 degrees or with less than 1/200 of the
///   area of a square of the mean edge. It does not snap to a pinned vertex; it passes it at an
///   eighth of the edge.
/// - Where the blade ends inside a triangle, the cut ends at the edge before it.
/// - New vertices are free; a pinned vertex that the cut goes through is pinned on both sides.
/// - Mass and rest area are conserved.
/// - Each crossed edge uses one particle of the reserve (`extra_particles`), and one more if it
///   opens.
///
/// @return MUSLIN_STATUS_BAD_VALUE if a number is not finite, `to` equals `from`, or `sweep` is
/// zero or parallel to the segment; MUSLIN_STATUS_FULL if the reserve cannot hold the whole cut;
/// the cloth is unchanged then
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_cut(
    cloth: MuslinCloth,
    from: MuslinVec3,
    to: MuslinVec3,
    sweep: MuslinVec3,
    out_edges: *mut u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out_edges = unsafe { Out::new_optional(out_edges) };
    with_cloth(cloth, |cloth| {
        let edges = cloth.cut(from.into(), to.into(), sweep.into())?;
        if let Some(out_edges) = out_edges {
            out_edges.write(edges);
        }
        Ok(())
    })
}

/// Removes the oldest unread event and writes it to `out_event`. The newest 1024 are kept.
///
/// `out_some` becomes 1, or 0 if there is no event; then `out_event` is not written. Initialise
/// `out_event` with muslin_event_init.
///
/// Events are ordered by tick, and within a tick:
/// - recoveries;
/// - tears, the most stretched edge first: for each, its split vertices, then the torn edge;
/// - the exhausted reserve, if it cannot hold another tear;
/// - detached pieces, ordered by their first triangle;
/// - links that pins or grabs hold past `max_stretch`.
///
/// A cut adds the edges that it divided, in its order, then the edges that it opened, the vertices
/// that it split, and the detached pieces.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_next_event(
    cloth: MuslinCloth,
    out_event: *mut MuslinEvent,
    out_some: *mut u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
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
