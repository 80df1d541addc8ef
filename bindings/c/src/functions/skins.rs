//! Skins: render meshes that follow a cloth.

use crate::ffi::panic_guard::run_guarded;
use crate::ffi::pointers::Out;
use crate::ffi::stream_list::read_streams;
use crate::ffi::versioned_struct::{OutStruct, read_struct};
use crate::functions::vertex_buffers::read_write_desc;
use crate::registry::{self, with_skin};
use crate::status::MuslinStatus;
use crate::types::skin::MuslinSkinDesc;
use crate::types::stream::{MuslinStream, MuslinWriteDesc};
use crate::types::value::{MuslinCloth, MuslinSkin};
use crate::types::view::MuslinView;
use core::ptr;
use muslin_core::Skin;

/// Binds a render mesh, usually finer than the cloth, to the cloth as it is now; its lists are
/// copied. Destroy it with muslin_skin_destroy; it also ends with its cloth.
///
/// Each vertex is bound to the nearest point of the cloth, at its distance from it, and moves along
/// with the cloth on a surface that is curved over each triangle (`smoothness`). Make the skin while
/// the cloth has the shape that the mesh was modelled in, usually before the first tick: on a folded
/// cloth the nearest layer may be another one.
///
/// A triangle of the skin that a tear or cut would stretch goes with one side, that of its center.
/// Its corners on the other side are copied, so the number of vertices may grow; the number of
/// indices never changes. muslin_cloth_reset restores the given mesh. muslin_cloth_save contains no
/// skins.
///
/// @return MUSLIN_STATUS_BAD_VALUE or MUSLIN_STATUS_BAD_INDEX for an invalid field of `desc`, also
/// if a vertex is too far from the cloth; MUSLIN_STATUS_UNSUPPORTED if `desc` is of a newer version
/// and uses fields that this library does not have
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_skin_create(
    cloth: MuslinCloth,
    desc: *const MuslinSkinDesc,
    out_skin: *mut MuslinSkin,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out_skin = unsafe { Out::new("out_skin", out_skin) };
    run_guarded(|| {
        let out_skin = out_skin?;
        // SAFETY: by the header's rules, the lists of `desc` are as long as its counts say.
        let desc = unsafe { read_struct("desc", desc)?.read()? };
        out_skin.write(registry::insert_skin(cloth, |cloth| Ok(Skin::new(cloth, &desc)?))?);
        Ok(())
    })
}

/// Writes vertices of a skin into your own buffers, as muslin_cloth_write_vertices does.
///
/// Follows tears and cuts first, so call muslin_skin_view for the number of vertices and
/// `topology_revision` before. Buffers for the view's `vertex_capacity` vertices are always large
/// enough. With `desc` NULL all vertices are written, untransformed.
///
/// @return the statuses of muslin_cloth_write_vertices; the buffers are untouched then
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_skin_write_vertices(
    skin: MuslinSkin,
    streams: *const MuslinStream,
    stream_count: u32,
    desc: *const MuslinWriteDesc,
) -> MuslinStatus {
    with_skin(skin, |skin, cloth| {
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call; `read_streams`
        // refuses buffers that overlap the lists of the skin and of its cloth.
        let (streams, desc) = unsafe {
            let is_lent = |bytes| skin.lends(&bytes) || cloth.lends(&bytes);
            (read_streams(streams, stream_count, is_lent)?, read_write_desc(desc)?)
        };
        Ok(skin.write_vertices(cloth, streams.as_slice(), &desc)?)
    })
}

/// Returns the lists of a skin where its cloth is now, without a copy.
///
/// The pointers and the data behind them stay valid until the next call that takes the skin or that
/// changes or destroys its cloth. `source_vertices` are those of the descriptor: its vertices keep
/// their numbers, copies that tears and cuts need follow. `frayed` is 1 on edges of the skin that a
/// tear or cut opened. `topology_revision` is that of the skin: it changes whenever its indices or
/// the number of its vertices do. `particles` is NULL. Initialise `out_view` with muslin_view_init.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_skin_view(
    skin: MuslinSkin,
    out_view: *mut MuslinView,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
    let out = unsafe { OutStruct::new("out_view", out_view) };
    with_skin(skin, |skin, cloth| {
        let out = out?;
        skin.refresh(cloth)?;
        out.write(&MuslinView {
            positions: skin.positions().as_ptr().cast(),
            normals: skin.normals().as_ptr().cast(),
            uvs: skin.uvs().as_ptr().cast(),
            indices: skin.indices().as_ptr(),
            source_vertices: skin.source_vertices().as_ptr(),
            vertex_count: skin.positions().len() as u32,
            index_count: skin.indices().len() as u32,
            vertex_capacity: skin.vertex_capacity(),
            index_capacity: skin.indices().len() as u32,
            topology_revision: skin.topology_revision(),
            state_revision: skin.state_revision(),
            frayed: skin.frayed().as_ptr().cast(),
            particles: ptr::null(),
            ..MuslinView::default()
        });
        Ok(())
    })
}

/// Destroys a skin. Its handle becomes stale; memory borrowed from it must no longer be read.
#[unsafe(no_mangle)]
pub extern "C" fn muslin_skin_destroy(skin: MuslinSkin) -> MuslinStatus {
    registry::destroy_skin(skin)
}
