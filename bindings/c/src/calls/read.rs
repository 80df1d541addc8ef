//! Reading: what a renderer needs, and numbers.

use crate::boundary::{Buffer, Out, Report};
use crate::registry::with_cloth;
use crate::status::{MuslinStatus, Refusal};
use crate::types::changes::MuslinChanges;
use crate::types::stats::MuslinStats;
use crate::types::value::MuslinCloth;
use crate::types::view::MuslinView;
use core::ffi::c_void;
use muslin_core::IndexFormat;
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
    let out = unsafe { Report::new("out_view", out_view) };
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
    let out = unsafe { Report::new("out_changes", out_changes) };
    with_cloth(cloth, |cloth| {
        out?.write(&cloth.changes(since_topology_revision).into());
        Ok(())
    })
}

/// Writes the indices of all triangles to the beginning of `buffer`, which has room for `size` bytes:
/// `index_format` is how many bits each takes, 16 or 32; each has `base_vertex` added, and every triangle
/// is turned round if `flip` is 1. With room for the view's `index_capacity` it fits for ever.
///
/// @return MUSLIN_STATUS_BUFFER_TOO_SMALL if `size` is less than the view's `index_count` takes;
/// MUSLIN_STATUS_BAD_VALUE unless `index_format` and `flip` are one of these, or for 16 bits if an index is
/// above 65534; `buffer` is untouched then
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_write_indices(
    cloth: MuslinCloth,
    buffer: *mut c_void,
    size: usize,
    index_format: u32,
    flip: u32,
    base_vertex: u32,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let buffer = unsafe { Buffer::new(buffer, size) };
    with_cloth(cloth, |cloth| {
        let buffer = buffer.ok_or_else(|| Refusal::bad_value("buffer", "not be NULL"))?;
        let format = match index_format {
            16 => IndexFormat::U16,
            32 => IndexFormat::U32,
            _ => return Err(Refusal::bad_value("index_format", "be 16 or 32")),
        };
        if flip > 1 {
            return Err(Refusal::bad_value("flip", "be 0 or 1"));
        }
        let mut bytes = vec![0; cloth.indices().len() * format.size()];
        cloth.write_indices(&mut bytes, format, flip == 1, base_vertex)?;
        buffer.write(&bytes)
    })
}

/// Numbers about the cloth as it is now. `out_stats` has begun with muslin_stats_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_get_stats(
    cloth: MuslinCloth,
    out_stats: *mut MuslinStats,
) -> MuslinStatus {
    // SAFETY: the caller's promise above.
    let out = unsafe { Report::new("out_stats", out_stats) };
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
