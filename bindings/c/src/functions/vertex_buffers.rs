//! Writing vertices and indices into the caller's own buffers.

use crate::ffi::pointers::OutBuffer;
use crate::ffi::stream_list::read_streams;
use crate::ffi::versioned_struct::read_struct;
use crate::registry::with_cloth;
use crate::status::{CallError, MuslinStatus, Result};
use crate::types::stream::{MuslinStream, MuslinWriteDesc};
use crate::types::value::MuslinCloth;
use core::ffi::c_void;
use muslin_core::{IndexFormat, WriteDesc};

/// Reads the description of what to write; the default for NULL.
///
/// # Safety
/// `desc` is NULL or points to a `MuslinWriteDesc` of the size that it states.
pub unsafe fn read_write_desc(desc: *const MuslinWriteDesc) -> Result<WriteDesc> {
    // SAFETY: guaranteed by the caller.
    let given = if desc.is_null() { None } else { Some(unsafe { read_struct("desc", desc)? }) };
    given.unwrap_or_default().try_into()
}

/// Writes vertices into your own buffers, each attribute with the format, address and stride of its
/// stream: separate, interleaved or one after the other. Other bytes are untouched.
///
/// Buffers for the view's `vertex_capacity` vertices are always large enough. With `desc` NULL all
/// vertices are written, untransformed.
///
/// @return MUSLIN_STATUS_BUFFER_TOO_SMALL if the vertices do not fit the `size` of a stream;
/// MUSLIN_STATUS_BAD_VALUE if `stream_count` is not from 1 to MUSLIN_MAX_STREAMS, a field of a
/// stream or of `desc` is invalid, a format cannot write its attribute, two streams overlap, a
/// buffer is memory of a view, or normals or tangents are written with a transform that cannot be
/// inverted; the buffers are untouched then
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_write_vertices(
    cloth: MuslinCloth,
    streams: *const MuslinStream,
    stream_count: u32,
    desc: *const MuslinWriteDesc,
) -> MuslinStatus {
    with_cloth(cloth, |cloth| {
        // SAFETY: by the header's rules, each pointer is NULL or valid for the call; `read_streams`
        // refuses buffers that overlap the cloth's own lists.
        let (streams, desc) = unsafe {
            let streams = read_streams(streams, stream_count, |bytes| cloth.lends(&bytes))?;
            (streams, read_write_desc(desc)?)
        };
        Ok(cloth.write_vertices(streams.as_slice(), &desc)?)
    })
}

/// Writes the indices of all triangles to the start of `buffer`, which has `size` bytes.
///
/// `index_format` is the width of an index in bits, 16 or 32. `base_vertex` is added to each index.
/// With `flip` 1 the winding of every triangle is reversed. A buffer for the view's
/// `index_capacity` indices is always large enough.
///
/// @return MUSLIN_STATUS_BUFFER_TOO_SMALL if `size` is less than the view's `index_count` indices
/// need; MUSLIN_STATUS_BAD_VALUE if `index_format` or `flip` has another value, or an index would
/// be above 65534 in 16 bits or 4294967294 in 32 bits; `buffer` is untouched then
#[unsafe(no_mangle)]
pub unsafe extern "C" fn muslin_cloth_write_indices(
    cloth: MuslinCloth,
    buffer: *mut c_void,
    size: usize,
    index_format: u32,
    flip: u32,
    base_vertex: u32,
) -> MuslinStatus {
    // SAFETY: by the header's rules, each pointer is NULL or valid for the call.
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
