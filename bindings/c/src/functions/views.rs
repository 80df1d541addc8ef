//! Reading: output lists, changes, mesh report, statistics and state hash.

use crate::ffi::pointers::Out;
use crate::ffi::versioned_struct::OutStruct;
use crate::registry::with_cloth;
use crate::status::MuslinStatus;
use crate::types::changes::MuslinChanges;
use crate::types::mesh_report::MuslinMeshReport;
use crate::types::stats::MuslinStats;
use crate::types::value::{MuslinCloth, MuslinVec3};
use crate::types::view::MuslinView;
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
