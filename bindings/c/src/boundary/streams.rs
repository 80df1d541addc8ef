//! Streams: descriptors one behind the other, each with a buffer of the caller's.

use super::{Growing, check, not_null, read_sized};
use crate::status::Result;
use crate::types::stream::{MUSLIN_MAX_STREAMS, MuslinStream};
use core::cell::Cell;
use core::ops::Range;
use core::slice;
use muslin_core::{Attribute, Stream, VertexFormat};

const MOST: usize = MUSLIN_MAX_STREAMS as usize;

/// The streams of one call, without a copy of what they lead to.
pub struct Streams<'a> {
    all: [Stream<'a>; MOST],
    count: usize,
}

impl<'a> Streams<'a> {
    pub fn all(&self) -> &[Stream<'a>] {
        &self.all[..self.count]
    }
}

/// `count` streams. None of their buffers `is_ours`.
///
/// # Safety
/// `at` is NULL or points to as many streams of this or another version, of the size that they say; each
/// buffer is NULL or points to `size` bytes that may be written as long as the streams live.
pub unsafe fn streams<'a>(
    at: *const MuslinStream,
    count: u32,
    is_ours: impl Fn(Range<usize>) -> bool,
) -> Result<Streams<'a>> {
    let count = count as usize;
    check((1..=MOST).contains(&count), "stream_count", "be from 1 to 16")?;
    not_null("streams", at)?;
    let nowhere =
        Stream { attribute: Attribute::Position, format: VertexFormat::F32, stride: 0, bytes: &[] };
    // SAFETY: the caller's promise above.
    let size = unsafe { at.cast::<u32>().read_unaligned() };
    let mut all = [nowhere; MOST];
    for (i, stream) in all[..count].iter_mut().enumerate() {
        let field = format_args!("streams[{i}].struct_size");
        // SAFETY: the caller's promise above: those before are of the size of the first.
        let given = unsafe {
            let at = at.byte_add(i * size as usize);
            let told = at.cast::<u32>().read_unaligned();
            check(told == size, field, "be that of the first stream")?;
            read_sized::<MuslinStream>(field, at.cast())?.0
        };
        let (attribute, format) = given.choices(i)?;
        // SAFETY: the caller's promise above.
        let bytes = unsafe { cells(i, &given, &is_ours)? };
        *stream = Stream { attribute, format, stride: given.stride, bytes };
    }
    Ok(Streams { all, count })
}

/// The bytes of a stream's buffer. Others may share them, so they are cells.
///
/// # Safety
/// As for [`streams`].
unsafe fn cells<'a>(
    i: usize,
    stream: &MuslinStream,
    is_ours: &impl Fn(Range<usize>) -> bool,
) -> Result<&'a [Cell<u8>]> {
    let (at, size) = (stream.buffer, stream.size);
    check(!at.is_null(), format_args!("streams[{i}].buffer"), "not be NULL")?;
    let fits = isize::try_from(size).is_ok() && at.addr().checked_add(size).is_some();
    check(fits, format_args!("streams[{i}].size"), "be the size of something in memory")?;
    let is_theirs = !is_ours(at.addr()..at.addr() + size);
    check(is_theirs, format_args!("streams[{i}].buffer"), "not be what a view is of")?;
    // SAFETY: the caller's promise above; the size fits, and bytes need no alignment.
    Ok(unsafe { slice::from_raw_parts(at.cast(), size) })
}

const _: () = assert!(size_of::<MuslinStream>() == MuslinStream::FIRST_SIZE);
