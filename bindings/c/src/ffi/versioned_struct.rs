//! Structs that carry their own size, so that programs and library may be of different versions.
//!
//! ```text
//! caller older:  [ size | known fields ]            missing fields get their defaults
//! caller newer:  [ size | known fields | more ]     accepted if the bytes of `more` are zero
//! ```
//!
//! Reads descriptors and writes reports in caller memory, within the size that the struct states.
//! Invariant: fields are only ever added at the end of a struct, so a prefix of any version is
//! valid.

use crate::ffi::pointers::{check, check_not_null};
use crate::status::{CallError, MuslinStatus, Result};
use core::fmt::Display;
use core::ptr::{self, NonNull};

/// A struct of the header that starts with its size and grows only at its end.
///
/// # Safety
/// The struct is `repr(C)`, starts with a `u32`, has no padding at its end, and holds only numbers
/// and pointers, so that every bit pattern is a valid value.
pub unsafe trait VersionedStruct: Copy + Default {
    /// Size in the first release [bytes].
    const FIRST_SIZE: usize;
    /// Name of the header's `init` function.
    const INIT: &'static str;
}

/// Larger than any version of a struct [bytes]; a larger value means that the struct was not
/// initialised.
const MAX_STRUCT_SIZE: usize = 4096;

/// Reads the size that a struct states, and checks it.
///
/// # Safety
/// `at` points to at least 4 bytes.
unsafe fn read_struct_size(
    field: impl Display,
    at: *const u8,
    min_size: usize,
    init: &str,
) -> Result<usize> {
    // SAFETY: guaranteed by the caller.
    let struct_size = unsafe { at.cast::<u32>().read_unaligned() } as usize;
    let is_valid =
        (min_size..=MAX_STRUCT_SIZE).contains(&struct_size) && struct_size.is_multiple_of(4);
    if is_valid {
        Ok(struct_size)
    } else {
        Err(CallError::bad_value(field, format_args!("be set by {init}")))
    }
}

/// Refuses bytes that this version does not know, unless all of them are zero.
///
/// # Safety
/// `at` points to at least `to` bytes.
unsafe fn check_unknown_bytes_are_zero(
    field: impl Display,
    at: *const u8,
    from: usize,
    to: usize,
) -> Result {
    // SAFETY: guaranteed by the caller.
    if (from..to).all(|i| unsafe { at.add(i).read() } == 0) {
        return Ok(());
    }
    let message = format!(
        "`{field}` must not be that of a newer struct whose added fields are used: this version lacks \
         them"
    );
    Err(CallError::new(MuslinStatus::Unsupported, message))
}

/// Reads a descriptor. Fields that the caller's version does not have get their defaults.
///
/// # Safety
/// `at` is NULL or points to a `T` of this or another version, of the size that it states.
pub unsafe fn read_struct<T: VersionedStruct>(name: &str, at: *const T) -> Result<T> {
    check_not_null(name, at)?;
    // SAFETY: guaranteed by the caller.
    unsafe { read_struct_at("struct_size", at.cast()) }.map(|(value, _)| value)
}

/// Reads a descriptor at a pointer that is not NULL; also returns the size that it states.
///
/// # Safety
/// `at` points to a `T` of this or another version, of the size that it states.
pub unsafe fn read_struct_at<T: VersionedStruct>(
    field: impl Display + Copy,
    at: *const u8,
) -> Result<(T, usize)> {
    let (mut value, ours) = (T::default(), size_of::<T>());
    // SAFETY: the caller guarantees `struct_size` readable bytes. `known` is at most that and at most
    // `ours`. A `T` holds only numbers and pointers, so every bit pattern is valid.
    unsafe {
        let struct_size = read_struct_size(field, at, T::FIRST_SIZE, T::INIT)?;
        check_unknown_bytes_are_zero(field, at, ours, struct_size)?;
        let known = struct_size.min(ours);
        ptr::copy_nonoverlapping(at, (&raw mut value).cast::<u8>(), known);
        Ok((value, struct_size))
    }
}

/// A descriptor with a material and settings, each with a size of its own. The caller's version of
/// the material decides where its settings start, and that of the settings where the tail starts.
///
/// # Safety
/// The struct is `repr(C)` and starts with a `u32`; its material is `HEAD` bytes from its start,
/// its settings follow directly, then `TAIL` bytes, all aligned to 4; before the material it holds
/// only numbers and pointers, and behind the settings only numbers.
pub unsafe trait NestedDesc: Copy + Default {
    /// The material.
    type Material: VersionedStruct;
    /// The settings.
    type Settings: VersionedStruct;
    /// Bytes before the material. They are the same in all versions.
    const HEAD: usize;
    /// Bytes of the fields behind the settings: 0, or at least the alignment, so that padding at the
    /// end of a struct without them is not taken for them.
    const TAIL: usize;
    /// Name of the header's `init` function.
    const INIT: &'static str;
    /// Sets material and settings.
    fn set_parts(&mut self, material: Self::Material, settings: Self::Settings);
}

/// Reads a descriptor with its material and settings, each of its own version.
///
/// # Safety
/// `at` is NULL or points to a `T` of this or another version, of the sizes that it and its parts
/// state.
pub unsafe fn read_desc<T: NestedDesc>(name: &str, at: *const T) -> Result<T> {
    check_not_null(name, at)?;
    let (at, mut desc) = (at.cast::<u8>(), T::default());
    let check_is_inside = |end: usize, struct_size: usize| {
        check(end <= struct_size, "struct_size", &format!("be set by {}", T::INIT))
    };
    // SAFETY: the caller guarantees `struct_size` readable bytes, and no part is read that ends beyond
    // them. The head holds only numbers and pointers, so every bit pattern is valid.
    unsafe {
        let min_size = T::HEAD + T::Material::FIRST_SIZE + T::Settings::FIRST_SIZE;
        let struct_size = read_struct_size("struct_size", at, min_size, T::INIT)?;
        let material_at = T::HEAD;
        let size = read_struct_size(
            "material.struct_size",
            at.add(material_at),
            T::Material::FIRST_SIZE,
            T::Material::INIT,
        )?;
        let settings_at = material_at + size;
        check_is_inside(settings_at + T::Settings::FIRST_SIZE, struct_size)?;
        let size = read_struct_size(
            "settings.struct_size",
            at.add(settings_at),
            T::Settings::FIRST_SIZE,
            T::Settings::INIT,
        )?;
        let end = settings_at + size;
        check_is_inside(end, struct_size)?;
        let (material, _) = read_struct_at("material.struct_size", at.add(material_at))?;
        let (settings, _) = read_struct_at("settings.struct_size", at.add(settings_at))?;
        let tail = if struct_size - end >= T::TAIL { T::TAIL } else { 0 };
        // Padding that rounds the size up to the alignment may have any value.
        let known = (end + tail).next_multiple_of(align_of::<T>());
        check_unknown_bytes_are_zero("struct_size", at, known, struct_size)?;
        let ours = (&raw mut desc).cast::<u8>();
        ptr::copy_nonoverlapping(at, ours, T::HEAD);
        let our_tail = T::HEAD + size_of::<T::Material>() + size_of::<T::Settings>();
        ptr::copy_nonoverlapping(at.add(end), ours.add(our_tail), tail);
        desc.set_parts(material, settings);
    }
    Ok(desc)
}

/// Initialises a struct of the caller's size: defaults of the known fields, zeros behind them.
///
/// # Safety
/// `at` points to `size` writable bytes.
unsafe fn write_defaults<T: VersionedStruct>(at: *mut u8, size: usize) {
    let value = T::default();
    // SAFETY: guaranteed by the caller; `known` is at most `size`.
    unsafe {
        at.write_bytes(0, size);
        let known = size.min(size_of::<T>());
        ptr::copy_nonoverlapping((&raw const value).cast::<u8>(), at, known);
        at.cast::<u32>().write_unaligned(size as u32);
    }
}

/// Refuses a size that no version of a struct has.
fn check_size_argument(name: &str, size: u32, min_size: usize) -> Result<usize> {
    let size = size as usize;
    let is_valid = (min_size..=MAX_STRUCT_SIZE).contains(&size) && size.is_multiple_of(4);
    check(is_valid, name, "be the sizeof of the struct")?;
    Ok(size)
}

/// Initialises a struct of the caller's size.
///
/// # Safety
/// `at` is NULL or points to `size` writable bytes.
pub unsafe fn init_struct<T: VersionedStruct>(name: &str, at: *mut T, size: u32) -> Result {
    check_not_null(name, at)?;
    let size = check_size_argument("struct_size", size, T::FIRST_SIZE)?;
    // SAFETY: guaranteed by the caller.
    unsafe { write_defaults::<T>(at.cast(), size) };
    Ok(())
}

/// Initialises a descriptor and its parts, each of the caller's size.
///
/// # Safety
/// `at` is NULL or points to `size` writable bytes.
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
    // SAFETY: guaranteed by the caller; head and parts together are at most `size`.
    unsafe {
        at.write_bytes(0, size);
        ptr::copy_nonoverlapping((&raw const head).cast::<u8>(), at, T::HEAD);
        at.cast::<u32>().write_unaligned(size as u32);
        write_defaults::<T::Material>(at.add(T::HEAD), material);
        write_defaults::<T::Settings>(at.add(T::HEAD + material), settings);
    }
    Ok(())
}

/// An output struct that may be of another version.
pub struct OutStruct<T> {
    at: NonNull<T>,
    size: usize,
}

impl<T: VersionedStruct> OutStruct<T> {
    /// Checks an output struct and the size that it states.
    ///
    /// # Safety
    /// `at` is NULL or points to a `T` of this or another version, of the size that it states, that
    /// is writable until the call returns.
    pub unsafe fn new(name: &str, at: *mut T) -> Result<Self> {
        let at = NonNull::new(at).ok_or_else(|| CallError::bad_value(name, "not be NULL"))?;
        let field = format!("{name}->struct_size");
        // SAFETY: guaranteed by the caller.
        let size = unsafe { read_struct_size(&field, at.as_ptr().cast(), T::FIRST_SIZE, T::INIT)? };
        Ok(Self { at, size })
    }

    /// Writes the fields that the caller's version has. Bytes that this version does not know
    /// become zero.
    pub fn write(self, value: &T) {
        let (at, known) = (self.at.as_ptr().cast::<u8>(), self.size.min(size_of::<T>()));
        // SAFETY: the creator of `self` guaranteed `size` writable bytes, and `known` is at most that.
        // The first four bytes, the size, stay as they are.
        unsafe {
            ptr::copy_nonoverlapping((&raw const *value).cast::<u8>().add(4), at.add(4), known - 4);
            at.add(known).write_bytes(0, self.size - known);
        }
    }
}
