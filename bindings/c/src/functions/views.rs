//! Reading: output lists, changes, mesh report, statistics and state hash.

use crate::ffi::pointers::{Out, OutBuffer, check_is_asked, write_bytes};
use crate::ffi::versioned_struct::OutStruct;
use crate::registry::with_cloth;
use crate::status::MuslinStatus;
use crate::types::changes::MuslinChanges;
use crate::types::mesh_report::MuslinMeshReport;
use crate::types::stats::MuslinStats;
use crate::types::value::{MuslinCloth, MuslinVec3};
use crate::types::view::MuslinView;
use core::ffi::c_char;
use std::sync::LazyLock;
use std::time::Instant;

/// Returns all lists that a renderer needs, without a copy; MuslinView says how long they stay
/// valid.
///
/// Normals are computed if positions changed since they were last read. Initialise `out_view` with
/// muslin_view_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_view(
    cloth: MuslinCloth,
    out_view: *mut MuslinView,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out = unsafe { OutStruct::new("out_view", out_view) };
    with_cloth(cloth, |cloth| {
        out?.write(&cloth.view().into());
        Ok(())
    })
}

/// Returns the origin of the cloth [m]: the point that it is simulated relative to, a whole number
/// of metres along each axis.
///
/// It is zero while most of the cloth stays within 16 m of zero along each axis. Beyond, it follows
/// the cloth, so that positions far from zero are as exact as near it. All positions that you pass
/// or read are absolute, except for those that muslin_cloth_write_vertices writes with `relative`.
/// Only ticks and calls that place particles move the origin.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_origin(
    cloth: MuslinCloth,
    out_origin: *mut MuslinVec3,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out_origin = unsafe { Out::new("out_origin", out_origin) };
    with_cloth(cloth, |cloth| {
        out_origin?.write(cloth.origin().into());
        Ok(())
    })
}

/// Returns the vertex and index ranges that changed after the view's `topology_revision` was
/// `since_topology_revision`: what a renderer must upload again, besides positions and normals.
///
/// Returns everything if that revision is more than 64 changes old or never existed; pass 0 for the
/// first upload. Initialise `out_changes` with muslin_changes_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_changes(
    cloth: MuslinCloth,
    since_topology_revision: u32,
    out_changes: *mut MuslinChanges,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out = unsafe { OutStruct::new("out_changes", out_changes) };
    with_cloth(cloth, |cloth| {
        out?.write(&cloth.changes(since_topology_revision).into());
        Ok(())
    })
}

/// Returns what was repaired in the mesh that the cloth was made from. A grid needs no repair.
/// Initialise `out_report` with muslin_mesh_report_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_mesh_report(
    cloth: MuslinCloth,
    out_report: *mut MuslinMeshReport,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out = unsafe { OutStruct::new("out_report", out_report) };
    with_cloth(cloth, |cloth| {
        out?.write(&cloth.mesh_report().into());
        Ok(())
    })
}

/// Writes a sentence for each property of the mesh that its author should know of: what was removed
/// or split, and what makes the cloth slow or uneven. The text has one sentence per line and ends
/// with a zero byte; it is empty for a good mesh. It is written to `size` bytes at `buffer`;
/// `out_needed` receives the number of bytes, with the zero byte.
///
/// If `buffer` is NULL, only that number is returned; otherwise `out_needed` may be NULL.
///
/// @return MUSLIN_STATUS_BUFFER_TOO_SMALL if the text does not fit: nothing is written, and
/// muslin_last_error() states the required size
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_mesh_warnings(
    cloth: MuslinCloth,
    buffer: *mut c_char,
    size: usize,
    out_needed: *mut usize,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let (buffer, out_needed) =
        unsafe { (OutBuffer::new(buffer.cast(), size), Out::new_optional(out_needed)) };
    with_cloth(cloth, |cloth| {
        check_is_asked(&buffer, &out_needed)?;
        let text = cloth.mesh_report().warnings().join("\n") + "\0";
        write_bytes(text.as_bytes(), buffer, out_needed)
    })
}

/// Returns statistics of the current state, computed in time proportional to the size of the cloth.
/// Initialise `out_stats` with muslin_stats_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_stats(
    cloth: MuslinCloth,
    out_stats: *mut MuslinStats,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out = unsafe { OutStruct::new("out_stats", out_stats) };
    with_cloth(cloth, |cloth| {
        out?.write(&cloth.stats().into());
        cloth.set_clock(Some(seconds));
        Ok(())
    })
}

/// Returns the seconds since the first call, from a monotonic clock.
fn seconds() -> f64 {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed().as_secs_f64()
}

/// Returns a hash of all state that the next tick depends on. Equal calls give equal hashes on
/// every platform.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_state_hash(
    cloth: MuslinCloth,
    out_hash: *mut u64,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out_hash = unsafe { Out::new("out_hash", out_hash) };
    with_cloth(cloth, |cloth| {
        out_hash?.write(cloth.state_hash());
        Ok(())
    })
}
