//! Writing into the caller's own buffers.

use crate::ffi::pointers::OutBuffer;
use crate::ffi::stream_list::read_streams;
use crate::ffi::versioned_struct::read_struct;
use crate::registry::with_cloth;
use crate::status::{CallError, MuslinStatus};
use crate::types::stream::{MuslinStream, MuslinWriteDesc};
use crate::types::value::MuslinCloth;
use core::ffi::c_void;
use muslin_core::IndexFormat;

/// Writes vertices into buffers of yours: each attribute in the format, at the place and at the distances
/// that one of the `stream_count` streams says. Nothing else in the buffers is touched. With room for the
/// view's `vertex_capacity` vertices they fit for ever. `desc` may be NULL: all vertices, as they are.
///
/// @return MUSLIN_STATUS_BUFFER_TOO_SMALL if the vertices do not fit the `size` of a stream;
/// MUSLIN_STATUS_BAD_VALUE for a field of a stream or of `desc` that cannot be, a format that an attribute
/// is not written in, bytes that two streams write or that a view is of, unless `stream_count` is from 1 to
/// MUSLIN_MAX_STREAMS, or if a stream takes normals or tangents and the transform cannot be inverted; the
/// buffers are untouched then
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_write_vertices(
    cloth: MuslinCloth,
    streams: *const MuslinStream,
    stream_count: u32,
    desc: *const MuslinWriteDesc,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        // SAFETY: the caller's promise above; none of the buffers is the cloth's.
        let (streams, desc) = unsafe {
            let streams = read_streams(streams, stream_count, |bytes| cloth.lends(&bytes))?;
            let desc = if desc.is_null() { None } else { Some(read_struct("desc", desc)?) };
            (streams, MuslinWriteDesc::try_into(desc.unwrap_or_default())?)
        };
        Ok(cloth.write_vertices(streams.as_slice(), &desc)?)
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
    let buffer = unsafe { OutBuffer::new(buffer, size) };
    with_cloth(cloth, |cloth| {
        let buffer = buffer.ok_or_else(|| CallError::bad_value("buffer", "not be NULL"))?;
        let format = match index_format {
            16 => IndexFormat::U16,
            32 => IndexFormat::U32,
            _ => return Err(CallError::bad_value("index_format", "be 16 or 32")),
        };
        if flip > 1 {
            return Err(CallError::bad_value("flip", "be 0 or 1"));
        }
        let mut bytes = vec![0; cloth.indices().len() * format.size()];
        cloth.write_indices(&mut bytes, format, flip == 1, base_vertex)?;
        buffer.write(&bytes)
    })
}
