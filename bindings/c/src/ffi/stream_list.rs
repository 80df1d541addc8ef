//! Reads the array of vertex streams of a call, each with a buffer of the caller.
//!
//! Reads the descriptors; borrows the buffers as cells, since streams may share one.
//! Invariant: no buffer overlaps memory that the cloth lends to its host.

use crate::ffi::pointers::{check, check_not_null};
use crate::ffi::versioned_struct::{VersionedStruct, read_struct_at};
use crate::status::Result;
use crate::types::stream::{MUSLIN_MAX_STREAMS, MuslinStream};
use core::cell::Cell;
use core::ops::Range;
use core::slice;
use muslin_core::{Attribute, Stream, VertexFormat};

/// Largest number of streams in one call.
const MAX: usize = MUSLIN_MAX_STREAMS as usize;

/// The streams of one call; their buffers are borrowed.
pub struct StreamList<'a> {
    streams: [Stream<'a>; MAX],
    count: usize,
}

impl<'a> StreamList<'a> {
    /// The streams that the caller gave.
    pub fn as_slice(&self) -> &[Stream<'a>] {
        &self.streams[..self.count]
    }
}

/// Reads `count` streams. Refuses a buffer for which `is_lent` returns true: memory of the cloth
/// itself.
///
/// # Safety
/// `at` is NULL or points to `count` streams of this or another version, of the size that they
/// state; each buffer is NULL or points to `size` bytes that are writable as long as the streams
/// live.
pub unsafe fn read_streams<'a>(
    at: *const MuslinStream,
    count: u32,
    is_lent: impl Fn(Range<usize>) -> bool,
) -> Result<StreamList<'a>> {
    let count = count as usize;
    check((1..=MAX).contains(&count), "stream_count", "be from 1 to 16")?;
    check_not_null("streams", at)?;
    let empty =
        Stream { attribute: Attribute::Position, format: VertexFormat::F32, stride: 0, bytes: &[] };
    // SAFETY: guaranteed by the caller.
    let size = unsafe { at.cast::<u32>().read_unaligned() };
    let mut streams = [empty; MAX];
    for (i, stream) in streams[..count].iter_mut().enumerate() {
        let field = format_args!("streams[{i}].struct_size");
        // SAFETY: guaranteed by the caller; the earlier streams have the size of the first one.
        let given = unsafe {
            let at = at.byte_add(i * size as usize);
            let struct_size = at.cast::<u32>().read_unaligned();
            check(struct_size == size, field, "be that of the first stream")?;
            read_struct_at::<MuslinStream>(field, at.cast())?.0
        };
        let (attribute, format) = given.choices(i)?;
        // SAFETY: guaranteed by the caller.
        let bytes = unsafe { borrow_buffer(i, &given, &is_lent)? };
        *stream = Stream { attribute, format, stride: given.stride, bytes };
    }
    Ok(StreamList { streams, count })
}

/// Borrows the buffer of stream number `i`, as cells, since streams may share it.
///
/// # Safety
/// As for [`read_streams`].
unsafe fn borrow_buffer<'a>(
    i: usize,
    stream: &MuslinStream,
    is_lent: &impl Fn(Range<usize>) -> bool,
) -> Result<&'a [Cell<u8>]> {
    let (at, size) = (stream.buffer, stream.size);
    check(!at.is_null(), format_args!("streams[{i}].buffer"), "not be NULL")?;
    let fits = isize::try_from(size).is_ok() && at.addr().checked_add(size).is_some();
    check(fits, format_args!("streams[{i}].size"), "fit in the address space")?;
    let is_callers_own = !is_lent(at.addr()..at.addr() + size);
    check(
        is_callers_own,
        format_args!("streams[{i}].buffer"),
        "not be memory of a view of this cloth",
    )?;
    // SAFETY: guaranteed by the caller; the size was checked, and bytes need no alignment.
    Ok(unsafe { slice::from_raw_parts(at.cast(), size) })
}

const _: () = assert!(size_of::<MuslinStream>() == MuslinStream::FIRST_SIZE);
