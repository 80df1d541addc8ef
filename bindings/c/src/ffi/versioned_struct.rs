//! X

use crate::ffi::pointers::{check, check_not_null};
use crate::status::{CallError, MuslinStatus, Result};
use core::fmt::Display;
use core::ptr;
use core::ptr::NonNull;

/// A struct of the header that begins with its size and grows at its end.
///
/// # Safety
/// It is `repr(C)`, begins with a `u32`, has no gap at its end, and holds only numbers and pointers, so
/// that any bytes are a value.
pub unsafe trait VersionedStruct: Copy + Default {
    /// Its size when it was first released [B].
    const FIRST_SIZE: usize;
    /// How to begin one.
    const INIT: &'static str;
}

/// No struct ever grows beyond this [B]: whatever says so was never begun.
const MAX_STRUCT_SIZE: usize = 4096;

/// The size that a struct says it has.
///
/// # Safety
/// `at` points to at least 4 bytes.
unsafe fn read_struct_size(
    field: impl Display,
    at: *const u8,
    least: usize,
    init: &str,
) -> Result<usize> {
    // SAFETY: the caller's promise above.
    let struct_size = unsafe { at.cast::<u32>().read_unaligned() } as usize;
    let fits = (least..=MAX_STRUCT_SIZE).contains(&struct_size) && struct_size.is_multiple_of(4);
    if fits {
        Ok(struct_size)
    } else {
        Err(CallError::bad_value(field, format_args!("be set by {init}")))
    }
}

/// Refuses bytes that this version does not know, unless they are all zero.
///
/// # Safety
/// `at` points to `to` bytes at least.
unsafe fn check_unknown_bytes_are_zero(
    field: impl Display,
    at: *const u8,
    from: usize,
    to: usize,
) -> Result {
    // SAFETY: the caller's promise above.
    if (from..to).all(|i| unsafe { at.add(i).read() } == 0) {
        return Ok(());
    }
    let what = format!("`{field}` tells of a newer struct, with fields that this version lacks");
    Err(CallError::new(MuslinStatus::Unsupported, what))
}

/// A descriptor as far as the caller's compiler knew it; what it did not know gets its default.
///
/// # Safety
/// `at` is NULL or points to a `T` of this or another version, of the size that it says.
pub unsafe fn read_struct<T: VersionedStruct>(name: &str, at: *const T) -> Result<T> {
    check_not_null(name, at)?;
    // SAFETY: the caller's promise above.
    unsafe { read_struct_at("struct_size", at.cast()) }.map(|(value, _)| value)
}

/// # Safety
/// As [`read`], but not NULL.
pub unsafe fn read_struct_at<T: VersionedStruct>(
    field: impl Display + Copy,
    at: *const u8,
) -> Result<(T, usize)> {
    let (mut value, ours) = (T::default(), size_of::<T>());
    // SAFETY: the caller's promise above: `told` bytes are there. `known` is at most that and at most
    // `ours`; a `T` holds only numbers and pointers, so any bytes are a value.
    unsafe {
        let struct_size = read_struct_size(field, at, T::FIRST_SIZE, T::INIT)?;
        check_unknown_bytes_are_zero(field, at, ours, struct_size)?;
        let known = struct_size.min(ours);
        ptr::copy_nonoverlapping(at, (&raw mut value).cast::<u8>(), known);
        Ok((value, struct_size))
    }
}

/// A descriptor that ends in a material and settings, each with a size of its own. What follows the
/// first of them lies where the caller's compiler put it.
///
/// # Safety
/// It is `repr(C)`, begins with a `u32`, its material lies `HEAD` bytes from its beginning and its
/// settings right behind, both aligned to 4, and it holds only numbers and pointers before.
pub unsafe trait NestedDesc: Copy + Default {
    /// Its material.
    type Material: VersionedStruct;
    /// Its settings.
    type Settings: VersionedStruct;
    /// Bytes before the material; they never change.
    const HEAD: usize;
    /// How to begin one.
    const INIT: &'static str;
    /// Puts the two in.
    fn set_parts(&mut self, material: Self::Material, settings: Self::Settings);
}

/// A descriptor with its parts, as far as the caller's compiler knew them.
///
/// # Safety
/// `at` is NULL or points to a `T` of this or another version, of the sizes that it and its parts say.
pub unsafe fn read_desc<T: NestedDesc>(name: &str, at: *const T) -> Result<T> {
    check_not_null(name, at)?;
    let (at, mut desc) = (at.cast::<u8>(), T::default());
    let inside = |end: usize, struct_size: usize| {
        check(end <= struct_size, "struct_size", &format!("be set by {}", T::INIT))
    };
    // SAFETY: the caller's promise above: `told` bytes are there, and no part is read that ends beyond
    // them. The head is all numbers and pointers, so any bytes are a value.
    unsafe {
        let least = T::HEAD + T::Material::FIRST_SIZE + T::Settings::FIRST_SIZE;
        let struct_size = read_struct_size("struct_size", at, least, T::INIT)?;
        let material_at = T::HEAD;
        let size = read_struct_size(
            "material.struct_size",
            at.add(material_at),
            T::Material::FIRST_SIZE,
            T::Material::INIT,
        )?;
        let settings_at = material_at + size;
        inside(settings_at + T::Settings::FIRST_SIZE, struct_size)?;
        let size = read_struct_size(
            "settings.struct_size",
            at.add(settings_at),
            T::Settings::FIRST_SIZE,
            T::Settings::INIT,
        )?;
        let end = settings_at + size;
        inside(end, struct_size)?;
        let (material, _) = read_struct_at("material.struct_size", at.add(material_at))?;
        let (settings, _) = read_struct_at("settings.struct_size", at.add(settings_at))?;
        // What rounds the whole up to its alignment is anything.
        check_unknown_bytes_are_zero(
            "struct_size",
            at,
            end.next_multiple_of(align_of::<T>()),
            struct_size,
        )?;
        ptr::copy_nonoverlapping(at, (&raw mut desc).cast::<u8>(), T::HEAD);
        desc.set_parts(material, settings);
    }
    Ok(desc)
}

/// Begins a struct of the caller's size: zeros, the defaults of what this version knows, and the size.
///
/// # Safety
/// `at` points to `size` bytes that may be written.
unsafe fn write_defaults<T: VersionedStruct>(at: *mut u8, size: usize) {
    let value = T::default();
    // SAFETY: the caller's promise above; `known` is at most `size`.
    unsafe {
        at.write_bytes(0, size);
        let known = size.min(size_of::<T>());
        ptr::copy_nonoverlapping((&raw const value).cast::<u8>(), at, known);
        at.cast::<u32>().write_unaligned(size as u32);
    }
}

/// Refuses a size that no version of a struct has.
fn check_size_argument(name: &str, size: u32, least: usize) -> Result<usize> {
    let size = size as usize;
    let fits = (least..=MAX_STRUCT_SIZE).contains(&size) && size.is_multiple_of(4);
    check(fits, name, "be the sizeof of the struct")?;
    Ok(size)
}

/// Begins a struct of the caller's size.
///
/// # Safety
/// `at` is NULL or points to `size` bytes that may be written.
pub unsafe fn init_struct<T: VersionedStruct>(name: &str, at: *mut T, size: u32) -> Result {
    check_not_null(name, at)?;
    let size = check_size_argument("struct_size", size, T::FIRST_SIZE)?;
    // SAFETY: the caller's promise above.
    unsafe { write_defaults::<T>(at.cast(), size) };
    Ok(())
}

/// Begins a struct of the caller's size, and its parts of theirs.
///
/// # Safety
/// `at` is NULL or points to `size` bytes that may be written.
pub unsafe fn init_desc<T: NestedDesc>(
    name: &str,
    at: *mut T,
    size: u32,
    material_size: u32,
    settings_size: u32,
) -> Result {
    check_not_null(name, at)?;
    let material = check_size_argument("material_size", material_size, T::Material::FIRST_SIZE)?;
    let settings = check_size_argument("settings_size", settings_size, T::Settings::FIRST_SIZE)?;
    let size = check_size_argument("struct_size", size, T::HEAD + material + settings)?;
    let (at, head) = (at.cast::<u8>(), T::default());
    // SAFETY: the caller's promise above; head and parts together are at most `size`.
    unsafe {
        at.write_bytes(0, size);
        ptr::copy_nonoverlapping((&raw const head).cast::<u8>(), at, T::HEAD);
        at.cast::<u32>().write_unaligned(size as u32);
        write_defaults::<T::Material>(at.add(T::HEAD), material);
        write_defaults::<T::Settings>(at.add(T::HEAD + material), settings);
    }
    Ok(())
}

/// Where a struct goes that may be of another version.
pub struct OutStruct<T> {
    at: NonNull<T>,
    size: usize,
}

impl<T: VersionedStruct> OutStruct<T> {
    /// # Safety
    /// `at` is NULL or points to a `T` of this or another version, of the size that it says, that may be
    /// written until the call returns.
    pub unsafe fn new(name: &str, at: *mut T) -> Result<Self> {
        let at = NonNull::new(at).ok_or_else(|| CallError::bad_value(name, "not be NULL"))?;
        let field = format!("{name}->struct_size");
        // SAFETY: the caller's promise above.
        let size = unsafe { read_struct_size(&field, at.as_ptr().cast(), T::FIRST_SIZE, T::INIT)? };
        Ok(Self { at, size })
    }

    /// Writes what the caller's compiler knew; what this version does not know becomes zero.
    pub fn write(self, value: &T) {
        let (at, known) = (self.at.as_ptr().cast::<u8>(), self.size.min(size_of::<T>()));
        // SAFETY: who made this vouched for `size` bytes, and `known` is at most that. The first four
        // bytes, the size, stay as they are.
        unsafe {
            ptr::copy_nonoverlapping((&raw const *value).cast::<u8>().add(4), at.add(4), known - 4);
            at.add(known).write_bytes(0, self.size - known);
        }
    }
}
