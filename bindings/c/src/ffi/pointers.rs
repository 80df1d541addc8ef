//! X

use crate::status::{CallError, MuslinStatus, Result};
use core::ffi::c_void;
use core::fmt::Display;
use core::ptr::NonNull;
use core::{ptr, slice};
use muslin_core::glam::{Vec2, Vec3};

pub fn check(ok: bool, field: impl Display, must: &str) -> Result {
    if ok { Ok(()) } else { Err(CallError::bad_value(field, must)) }
}

pub fn check_not_null<T>(name: &str, at: *const T) -> Result {
    check(!at.is_null(), name, "not be NULL")
}

/// Where a result goes.
pub struct Out<T>(NonNull<T>);

impl<T> Out<T> {
    /// # Safety
    /// `at` is NULL or may be written until the call returns.
    pub unsafe fn new(name: &str, at: *mut T) -> Result<Self> {
        check_not_null(name, at)?;
        NonNull::new(at).map(Self).ok_or_else(|| CallError::bad_value(name, "not be NULL"))
    }

    /// For a result that not everybody wants.
    ///
    /// # Safety
    /// `at` is NULL or may be written until the call returns.
    pub unsafe fn new_optional(at: *mut T) -> Option<Self> {
        NonNull::new(at).map(Self)
    }

    pub fn write(self, value: T) {
        // SAFETY: who made this vouched for it.
        unsafe { self.0.as_ptr().write_unaligned(value) };
    }
}

/// A value that need not be given.
///
/// # Safety
/// `at` is NULL or points to a `T`.
pub unsafe fn read_optional<T: Copy>(at: *const T) -> Option<T> {
    // SAFETY: the caller's promise above.
    (!at.is_null()).then(|| unsafe { at.read_unaligned() })
}

/// `count` numbers, copied. None may be at NULL.
///
/// # Safety
/// `at` is NULL or points to `count` numbers.
pub unsafe fn read_u32s(name: &str, at: *const u32, count: u32) -> Result<Vec<u32>> {
    if count == 0 {
        return Ok(Vec::new());
    }
    check_not_null(name, at)?;
    // SAFETY: the caller's promise above.
    Ok((0..count as usize).map(|i| unsafe { at.add(i).read_unaligned() }).collect())
}

/// `count` numbers, copied. None may be at NULL.
///
/// # Safety
/// `at` is NULL or points to `count` numbers.
pub unsafe fn read_f32s(name: &str, at: *const f32, count: u32) -> Result<Vec<f32>> {
    // SAFETY: the caller's promise above; any bits are a number of either kind.
    let bits = unsafe { read_u32s(name, at.cast::<u32>(), count)? };
    Ok(bits.into_iter().map(f32::from_bits).collect())
}

/// `count` pairs of numbers, copied; none at NULL.
///
/// # Safety
/// `at` is NULL or points to `2 * count` numbers.
pub unsafe fn read_vec2s(at: *const f32, count: u32) -> Vec<Vec2> {
    if at.is_null() {
        return Vec::new();
    }
    let at = at.cast::<[f32; 2]>();
    // SAFETY: the caller's promise above.
    (0..count as usize).map(|i| Vec2::from(unsafe { at.add(i).read_unaligned() })).collect()
}

/// `count` points that begin `stride` bytes apart (0 is 12), copied.
///
/// # Safety
/// `at` is NULL or points to as many points, so far apart.
pub unsafe fn read_vec3s(
    name: &str,
    at: *const c_void,
    stride: u32,
    count: u32,
) -> Result<Vec<Vec3>> {
    let stride = if stride == 0 { 12 } else { stride as usize };
    let fits = stride >= 12 && stride.is_multiple_of(4);
    check(fits, "stride", "be 0 or a multiple of 4 that is at least 12")?;
    if count == 0 {
        return Ok(Vec::new());
    }
    check_not_null(name, at)?;
    let point = |i: usize| {
        // SAFETY: the caller's promise above.
        let point = unsafe { at.byte_add(i * stride).cast::<[f32; 3]>().read_unaligned() };
        Vec3::from(point)
    };
    Ok((0..count as usize).map(point).collect())
}

/// The caller's bytes.
///
/// # Safety
/// `at` is NULL or points to `size` bytes that stay as they are until the call returns.
pub unsafe fn borrow_bytes<'a>(name: &str, at: *const c_void, size: usize) -> Result<&'a [u8]> {
    check_not_null(name, at)?;
    check(isize::try_from(size).is_ok(), "size", "be the size of something in memory")?;
    // SAFETY: the caller's promise above; the size fits, and bytes need no alignment.
    Ok(unsafe { slice::from_raw_parts(at.cast(), size) })
}

/// The caller's buffer.
pub struct OutBuffer {
    at: *mut u8,
    size: usize,
}

impl OutBuffer {
    /// None at NULL.
    ///
    /// # Safety
    /// `at` is NULL or points to `size` bytes that may be written until the call returns.
    pub unsafe fn new(at: *mut c_void, size: usize) -> Option<Self> {
        (!at.is_null()).then_some(Self { at: at.cast(), size })
    }

    /// Fills the beginning of the buffer, if all of `bytes` fits.
    pub fn write(self, bytes: &[u8]) -> Result {
        if bytes.len() > self.size {
            let rule = format!("`size` must be at least {}, but is {}", bytes.len(), self.size);
            return Err(CallError::new(MuslinStatus::BufferTooSmall, rule));
        }
        // SAFETY: who made this vouched for `size` bytes, and no more are written; our bytes are new,
        // so they are not the caller's.
        unsafe { ptr::copy_nonoverlapping(bytes.as_ptr(), self.at, bytes.len()) };
        Ok(())
    }
}
