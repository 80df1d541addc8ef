//! Reading: what a renderer needs, and numbers.

use crate::ffi::pointers::Out;
use crate::ffi::versioned_struct::OutStruct;
use crate::registry::with_cloth;
use crate::status::MuslinStatus;
use crate::types::changes::MuslinChanges;
use crate::types::mesh_report::MuslinMeshReport;
use crate::types::stats::MuslinStats;
use crate::types::value::MuslinCloth;
use crate::types::view::MuslinView;
use std::sync::LazyLock;
use std::time::Instant;

/// All that a renderer reads, without a copy; see MuslinView for how long it is valid. Normals are
/// computed when first asked for after a change. `out_view` has begun with muslin_view_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_view(
    cloth: MuslinCloth,
    out_view: *mut MuslinView,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out = unsafe { OutStruct::new("out_view", out_view) };
    with_cloth(cloth, |cloth| {
        out?.write(&cloth.view().into());
        Ok(())
    })
}

/// Which vertices and indices are new or not as they were when the view's `topology_revision` was
/// `since_topology_revision`: all that a renderer must upload again of what does not change with every
/// tick. Everything, if that is more than 64 changes ago, or was never (0 is never). `out_changes` has
/// begun with muslin_changes_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_changes(
    cloth: MuslinCloth,
    since_topology_revision: u32,
    out_changes: *mut MuslinChanges,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out = unsafe { OutStruct::new("out_changes", out_changes) };
    with_cloth(cloth, |cloth| {
        out?.write(&cloth.changes(since_topology_revision).into());
        Ok(())
    })
}

/// What had to be repaired of the mesh that the cloth was made of; nothing of a grid. `out_report` has begun with
/// muslin_mesh_report_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_mesh_report(
    cloth: MuslinCloth,
    out_report: *mut MuslinMeshReport,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out = unsafe { OutStruct::new("out_report", out_report) };
    with_cloth(cloth, |cloth| {
        out?.write(&cloth.mesh_report().into());
        Ok(())
    })
}

/// Numbers about the cloth as it is now. `out_stats` has begun with muslin_stats_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_stats(
    cloth: MuslinCloth,
    out_stats: *mut MuslinStats,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out = unsafe { OutStruct::new("out_stats", out_stats) };
    with_cloth(cloth, |cloth| {
        out?.write(&cloth.stats().into());
        cloth.set_clock(Some(seconds));
        Ok(())
    })
}

/// Seconds since the first call, by a clock that only goes forward.
fn seconds() -> f64 {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed().as_secs_f64()
}

/// A hash over all that the next tick depends on: equal on every machine that was told the same.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_state_hash(
    cloth: MuslinCloth,
    out_hash: *mut u64,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out_hash = unsafe { Out::new("out_hash", out_hash) };
    with_cloth(cloth, |cloth| {
        out_hash?.write(cloth.state_hash());
        Ok(())
    })
}
