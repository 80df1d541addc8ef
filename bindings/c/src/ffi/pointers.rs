//! Reads lists from the caller's memory and writes results into it.
//!
//! Reads and writes caller memory of the length that the caller states.
//! Invariant: no pointer is kept after the call, and none is assumed to be aligned.

use crate::status::{CallError, MuslinStatus, Result};
use core::ffi::c_void;
use core::fmt::Display;
use core::ptr::NonNull;
use core::{ptr, slice};
use muslin_core::glam::{Vec2, Vec3};

/// Returns an error for `field` unless `ok`.
pub fn check(ok: bool, field: impl Display, must: &str) -> Result {
    if ok { Ok(()) } else { Err(CallError::bad_value(field, must)) }
}

/// Returns an error for `name` if the pointer is NULL.
pub fn check_not_null<T>(name: &str, at: *const T) -> Result {
    check(!at.is_null(), name, "not be NULL")
}

/// An output parameter that is not NULL.
pub struct Out<T>(NonNull<T>);

impl<T> Out<T> {
    /// Checks an output parameter.
    ///
    /// # Safety
    /// `at` is NULL or writable until the call returns.
    pub unsafe fn new(name: &str, at: *mut T) -> Result<Self> {
        check_not_null(name, at)?;
        NonNull::new(at).map(Self).ok_or_else(|| CallError::bad_value(name, "not be NULL"))
    }

    /// An output parameter that may be NULL.
    ///
    /// # Safety
    /// `at` is NULL or writable until the call returns.
    pub unsafe fn new_optional(at: *mut T) -> Option<Self> {
        NonNull::new(at).map(Self)
    }

    pub fn write(self, value: T) {
        // SAFETY: the creator of `self` guaranteed that the pointer is writable.
        unsafe { self.0.as_ptr().write_unaligned(value) };
    }
}

/// Reads a value; `None` at NULL.
///
/// # Safety
/// `at` is NULL or points to a `T`.
pub unsafe fn read_optional<T: Copy>(at: *const T) -> Option<T> {
    // SAFETY: guaranteed by the caller.
    (!at.is_null()).then(|| unsafe { at.read_unaligned() })
}

/// Copies `count` values. The pointer may be NULL if `count` is 0.
///
/// # Safety
/// `at` is NULL or points to `count` values.
pub unsafe fn read_list<T: Copy>(name: &str, at: *const T, count: u32) -> Result<Vec<T>> {
    if count == 0 {
        return Ok(Vec::new());
    }
    check_not_null(name, at)?;
    // SAFETY: guaranteed by the caller.
    Ok((0..count as usize).map(|i| unsafe { at.add(i).read_unaligned() }).collect())
}

/// Copies `count` numbers. The pointer may be NULL if `count` is 0.
///
/// # Safety
/// `at` is NULL or points to `count` numbers.
pub unsafe fn read_u32s(name: &str, at: *const u32, count: u32) -> Result<Vec<u32>> {
    // SAFETY: guaranteed by the caller.
    unsafe { read_list(name, at, count) }
}

/// Copies `count` numbers. The pointer may be NULL if `count` is 0.
///
/// # Safety
/// `at` is NULL or points to `count` numbers.
pub unsafe fn read_f32s(name: &str, at: *const f32, count: u32) -> Result<Vec<f32>> {
    // SAFETY: guaranteed by the caller; u32 and f32 have the same size, and any bits are valid.
    let bits = unsafe { read_u32s(name, at.cast::<u32>(), count)? };
    Ok(bits.into_iter().map(f32::from_bits).collect())
}

/// Copies `count` pairs of numbers; returns an empty list at NULL.
///
/// # Safety
/// `at` is NULL or points to `2 * count` numbers.
pub unsafe fn read_vec2s(at: *const f32, count: u32) -> Vec<Vec2> {
    if at.is_null() {
        return Vec::new();
    }
    let at = at.cast::<[f32; 2]>();
    // SAFETY: guaranteed by the caller.
    (0..count as usize).map(|i| Vec2::from(unsafe { at.add(i).read_unaligned() })).collect()
}

/// Copies `count` points whose starts are `stride` bytes apart; 0 means 12.
///
/// # Safety
/// `at` is NULL or points to `count` points with that stride.
pub unsafe fn read_vec3s(
    name: &str,
    at: *const c_void,
    stride: u32,
    count: u32,
) -> Result<Vec<Vec3>> {
    let stride = stride_of_points(stride)?;
    if count == 0 {
        return Ok(Vec::new());
    }
    check_not_null(name, at)?;
    let point = |i: usize| {
        // SAFETY: guaranteed by the caller.
        let point = unsafe { at.byte_add(i * stride).cast::<[f32; 3]>().read_unaligned() };
        Vec3::from(point)
    };
    Ok((0..count as usize).map(point).collect())
}

/// Returns the distance between the starts of consecutive points [bytes]; 0 means 12.
fn stride_of_points(stride: u32) -> Result<usize> {
    let stride = if stride == 0 { 12 } else { stride as usize };
    let fits = stride >= 12 && stride.is_multiple_of(4);
    check(fits, "stride", "be 0 or a multiple of 4 that is at least 12")?;
    Ok(stride)
}

/// A list of the caller that receives points.
pub struct OutVec3s {
    at: *mut f32,
    stride: usize,
    count: usize,
}

impl OutVec3s {
    /// A list of `count` points whose starts are `stride` bytes apart; 0 means 12. The pointer may
    /// be NULL if `count` is 0.
    ///
    /// # Safety
    /// `at` is NULL or points to `count` points with that stride that are writable until the call
    /// returns.
    pub unsafe fn new(name: &str, at: *mut f32, stride: u32, count: u32) -> Result<Self> {
        let stride = stride_of_points(stride)?;
        if count > 0 {
            check_not_null(name, at)?;
        }
        Ok(Self { at, stride, count: count as usize })
    }

    /// Writes as many points as the list holds.
    pub fn write(self, points: impl Iterator<Item = Vec3>) {
        for (i, point) in points.take(self.count).enumerate() {
            // SAFETY: the creator of `self` guaranteed `count` writable points, and `i` is below it.
            unsafe { self.at.byte_add(i * self.stride).cast::<Vec3>().write_unaligned(point) };
        }
    }
}

/// A list of the caller that receives numbers; none at NULL.
pub struct OutU32s {
    at: *mut u32,
    count: usize,
}

impl OutU32s {
    /// A list of `count` numbers; none at NULL.
    ///
    /// # Safety
    /// `at` is NULL or points to `count` numbers that are writable until the call returns.
    pub unsafe fn new(at: *mut u32, count: u32) -> Self {
        Self { at, count: if at.is_null() { 0 } else { count as usize } }
    }

    /// Writes as many numbers as the list holds.
    pub fn write(self, numbers: &[u32]) {
        for (i, number) in numbers.iter().take(self.count).enumerate() {
            // SAFETY: the creator of `self` guaranteed `count` writable numbers, and `i` is below it.
            unsafe { self.at.add(i).write_unaligned(*number) };
        }
    }
}

/// Borrows `size` bytes of the caller.
///
/// # Safety
/// `at` is NULL or points to `size` bytes that do not change until the call returns.
pub unsafe fn borrow_bytes<'a>(name: &str, at: *const c_void, size: usize) -> Result<&'a [u8]> {
    check_not_null(name, at)?;
    check(isize::try_from(size).is_ok(), "size", "fit in the address space")?;
    // SAFETY: guaranteed by the caller; the size was checked, and bytes need no alignment.
    Ok(unsafe { slice::from_raw_parts(at.cast(), size) })
}

/// A buffer of the caller for bytes of variable length.
pub struct OutBuffer {
    at: *mut u8,
    size: usize,
}

impl OutBuffer {
    /// A buffer of `size` bytes; `None` at NULL.
    ///
    /// # Safety
    /// `at` is NULL or points to `size` bytes that are writable until the call returns.
    pub unsafe fn new(at: *mut c_void, size: usize) -> Option<Self> {
        (!at.is_null()).then_some(Self { at: at.cast(), size })
    }

    /// Writes `bytes` to the start of the buffer; refuses if they do not fit.
    pub fn write(self, bytes: &[u8]) -> Result {
        if bytes.len() > self.size {
            let rule = format!("`size` must be at least {}, but is {}", bytes.len(), self.size);
            return Err(CallError::new(MuslinStatus::BufferTooSmall, rule));
        }
        // SAFETY: the creator of `self` guaranteed `size` writable bytes, and no more are written.
        // `bytes` is memory of the library, so it does not overlap the caller's buffer.
        unsafe { ptr::copy_nonoverlapping(bytes.as_ptr(), self.at, bytes.len()) };
        Ok(())
    }
}

/// Returns an error if a call is asked neither for bytes nor for their number.
pub fn check_is_asked(buffer: &Option<OutBuffer>, out_needed: &Option<Out<usize>>) -> Result {
    let is_asked = buffer.is_some() || out_needed.is_some();
    check(is_asked, "out_needed", "not be NULL when `buffer` is NULL")
}

/// Writes `bytes` and their number to what the caller gave; refuses if they do not fit.
pub fn write_bytes(
    bytes: &[u8],
    buffer: Option<OutBuffer>,
    out_needed: Option<Out<usize>>,
) -> Result {
    if let Some(buffer) = buffer {
        buffer.write(bytes)?;
    }
    if let Some(out_needed) = out_needed {
        out_needed.write(bytes.len());
    }
    Ok(())
}
