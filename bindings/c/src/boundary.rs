//! The boundary: the caller's pointers are read and written here, and panics end here.
//!
//! Pointers may be NULL where that is said, and never need to be aligned.

use crate::log::{self, Listener, MUSLIN_LOG_ERROR, MUSLIN_LOG_WARN};
use crate::status::{MuslinStatus, Refusal, Result, remember};
use crate::types::changes::MuslinChanges;
use crate::types::collider::MuslinColliderDesc;
use crate::types::event::MuslinEvent;
use crate::types::grid::MuslinGridDesc;
use crate::types::hit::MuslinHit;
use crate::types::material::MuslinMaterial;
use crate::types::mesh::MuslinMeshDesc;
use crate::types::mesh_report::MuslinMeshReport;
use crate::types::settings::MuslinSettings;
use crate::types::stats::{MUSLIN_STAGE_SLOTS, MuslinStats};
use crate::types::stream::{MuslinStream, MuslinWriteDesc};
use crate::types::view::MuslinView;
use crate::types::wind::MuslinWind;
use core::ffi::{CStr, c_void};
use core::fmt::Display;
use core::mem::offset_of;
use core::ptr::NonNull;
use core::{ptr, slice};
use muslin_core::glam::{Vec2, Vec3};
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs a call, catches its panic, and keeps and logs the sentence of its refusal.
pub fn guard(call: impl FnOnce() -> Result) -> MuslinStatus {
    let mut call = Some(call);
    guard_shared(&mut || call.take().map_or(Ok(()), |call| call()))
}

/// The same for all calls at once: what is around them would be half of the library if each had its own.
fn guard_shared(call: &mut dyn FnMut() -> Result) -> MuslinStatus {
    // Whatever the panic left half-changed is behind a lock that it spoilt.
    let outcome = catch_unwind(AssertUnwindSafe(call)).unwrap_or_else(|panic| {
        let text = panic.downcast_ref::<String>().map(String::as_str);
        let what = text.or(panic.downcast_ref::<&str>().copied()).unwrap_or("no reason given");
        Err(Refusal::panicked(what))
    });
    let Err(refusal) = outcome else {
        return MuslinStatus::Ok;
    };
    remember(&refusal.sentence);
    match refusal.status {
        MuslinStatus::NothingHit | MuslinStatus::NotTorn => {}
        MuslinStatus::Panicked => log::tell(MUSLIN_LOG_ERROR, || refusal.sentence),
        _ => log::tell(MUSLIN_LOG_WARN, || refusal.sentence),
    }
    refusal.status
}

fn check(ok: bool, field: impl Display, must: &str) -> Result {
    if ok { Ok(()) } else { Err(Refusal::bad_value(field, must)) }
}

fn not_null<T>(name: &str, at: *const T) -> Result {
    check(!at.is_null(), name, "not be NULL")
}

/// Where a result goes.
pub struct Out<T>(NonNull<T>);

impl<T> Out<T> {
    /// # Safety
    /// `at` is NULL or may be written until the call returns.
    pub unsafe fn new(name: &str, at: *mut T) -> Result<Self> {
        not_null(name, at)?;
        NonNull::new(at).map(Self).ok_or_else(|| Refusal::bad_value(name, "not be NULL"))
    }

    /// For a result that not everybody wants.
    ///
    /// # Safety
    /// `at` is NULL or may be written until the call returns.
    pub unsafe fn optional(at: *mut T) -> Option<Self> {
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
pub unsafe fn optional<T: Copy>(at: *const T) -> Option<T> {
    // SAFETY: the caller's promise above.
    (!at.is_null()).then(|| unsafe { at.read_unaligned() })
}

/// `count` numbers, copied. None may be at NULL.
///
/// # Safety
/// `at` is NULL or points to `count` numbers.
pub unsafe fn list(name: &str, at: *const u32, count: u32) -> Result<Vec<u32>> {
    if count == 0 {
        return Ok(Vec::new());
    }
    not_null(name, at)?;
    // SAFETY: the caller's promise above.
    Ok((0..count as usize).map(|i| unsafe { at.add(i).read_unaligned() }).collect())
}

/// `count` numbers, copied. None may be at NULL.
///
/// # Safety
/// `at` is NULL or points to `count` numbers.
pub unsafe fn numbers(name: &str, at: *const f32, count: u32) -> Result<Vec<f32>> {
    // SAFETY: the caller's promise above; any bits are a number of either kind.
    let bits = unsafe { list(name, at.cast::<u32>(), count)? };
    Ok(bits.into_iter().map(f32::from_bits).collect())
}

/// `count` pairs of numbers, copied; none at NULL.
///
/// # Safety
/// `at` is NULL or points to `2 * count` numbers.
pub unsafe fn pairs(at: *const f32, count: u32) -> Vec<Vec2> {
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
pub unsafe fn points(name: &str, at: *const c_void, stride: u32, count: u32) -> Result<Vec<Vec3>> {
    let stride = if stride == 0 { 12 } else { stride as usize };
    let fits = stride >= 12 && stride.is_multiple_of(4);
    check(fits, "stride", "be 0 or a multiple of 4 that is at least 12")?;
    if count == 0 {
        return Ok(Vec::new());
    }
    not_null(name, at)?;
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
pub unsafe fn bytes<'a>(name: &str, at: *const c_void, size: usize) -> Result<&'a [u8]> {
    not_null(name, at)?;
    check(isize::try_from(size).is_ok(), "size", "be the size of something in memory")?;
    // SAFETY: the caller's promise above; the size fits, and bytes need no alignment.
    Ok(unsafe { slice::from_raw_parts(at.cast(), size) })
}

/// The caller's buffer.
pub struct Buffer {
    at: *mut u8,
    size: usize,
}

impl Buffer {
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
            return Err(Refusal::new(MuslinStatus::BufferTooSmall, rule));
        }
        // SAFETY: who made this vouched for `size` bytes, and no more are written; our bytes are new,
        // so they are not the caller's.
        unsafe { ptr::copy_nonoverlapping(bytes.as_ptr(), self.at, bytes.len()) };
        Ok(())
    }
}

/// The pointer that a listener gets back.
#[derive(Clone, Copy)]
pub struct User(pub *mut c_void);

impl User {
    pub const NONE: Self = Self(ptr::null_mut());
}

// SAFETY: the library never follows the pointer; the host was told that its listener is called on any
// thread.
unsafe impl Send for User {}

/// Hands a message to the host.
pub fn call_listener(listener: &Listener, level: u32, message: &CStr) {
    if let Some(function) = listener.function {
        // SAFETY: who set the listener vouched for the function and its pointer; the message ends in a
        // zero and lives until the function returns.
        unsafe { function(level, message.as_ptr(), listener.user.0) };
    }
}

/// A struct of the header that begins with its size and grows at its end.
///
/// # Safety
/// It is `repr(C)`, begins with a `u32`, has no gap at its end, and holds only numbers and pointers, so
/// that any bytes are a value.
pub unsafe trait Growing: Copy + Default {
    /// Its size when it was first released [B].
    const FIRST_SIZE: usize;
    /// How to begin one.
    const INIT: &'static str;
}

/// Each struct that grows: its field that was last when it was first released, the one that is last
/// now, each with its size, and how to begin one.
macro_rules! growing {
    ($($name:ident from $last:ident[$size:expr] to $end:ident[$end_size:expr], $init:literal;)*) => {$(
        // SAFETY: its file shows it.
        unsafe impl Growing for $name {
            const FIRST_SIZE: usize = offset_of!($name, $last) + $size;
            const INIT: &'static str = $init;
        }
        const _: () = assert!(offset_of!($name, $end) + $end_size == size_of::<$name>());
    )*};
}

growing! {
    MuslinSettings from tearing[4] to sleep_speed[4], "muslin_settings_init";
    MuslinMaterial from yield_creep[4] to yield_weakening[4], "muslin_material_init";
    MuslinWind from seed[4] to seed[4], "muslin_wind_init";
    MuslinColliderDesc from restitution[4] to heights[size_of::<*const f32>()],
        "muslin_collider_desc_init";
    MuslinEvent from source[4] to count[4], "muslin_event_init";
    MuslinHit from normal[12] to normal[12], "muslin_hit_init";
    MuslinView from state_revision[4] to particles[size_of::<*const u32>()], "muslin_view_init";
    MuslinMeshReport from is_grid[4] to is_grid[4], "muslin_mesh_report_init";
    MuslinChanges from index_count[4] to index_count[4], "muslin_changes_init";
    MuslinStream from size[size_of::<usize>()] to size[size_of::<usize>()], "muslin_stream_init";
    MuslinWriteDesc from offset[4] to offset[4], "muslin_write_desc_init";
    MuslinStats from seconds[4 * MUSLIN_STAGE_SLOTS] to max_speed[4], "muslin_stats_init";
}

/// No struct ever grows beyond this [B]: whatever says so was never begun.
const MAX_STRUCT_SIZE: usize = 4096;

/// The size that a struct says it has.
///
/// # Safety
/// `at` points to at least 4 bytes.
unsafe fn told_size(field: impl Display, at: *const u8, least: usize, init: &str) -> Result<usize> {
    // SAFETY: the caller's promise above.
    let told = unsafe { at.cast::<u32>().read_unaligned() } as usize;
    let fits = (least..=MAX_STRUCT_SIZE).contains(&told) && told.is_multiple_of(4);
    if fits { Ok(told) } else { Err(Refusal::bad_value(field, format_args!("be set by {init}"))) }
}

/// Refuses bytes that this version does not know, unless they are all zero.
///
/// # Safety
/// `at` points to `to` bytes at least.
unsafe fn refuse_unknown(field: impl Display, at: *const u8, from: usize, to: usize) -> Result {
    // SAFETY: the caller's promise above.
    if (from..to).all(|i| unsafe { at.add(i).read() } == 0) {
        return Ok(());
    }
    let what = format!("`{field}` tells of a newer struct, with fields that this version lacks");
    Err(Refusal::new(MuslinStatus::Unsupported, what))
}

/// A descriptor as far as the caller's compiler knew it; what it did not know gets its default.
///
/// # Safety
/// `at` is NULL or points to a `T` of this or another version, of the size that it says.
pub unsafe fn read<T: Growing>(name: &str, at: *const T) -> Result<T> {
    not_null(name, at)?;
    // SAFETY: the caller's promise above.
    unsafe { read_sized("struct_size", at.cast()) }.map(|(value, _)| value)
}

/// # Safety
/// As [`read`], but not NULL.
unsafe fn read_sized<T: Growing>(field: impl Display + Copy, at: *const u8) -> Result<(T, usize)> {
    let (mut value, ours) = (T::default(), size_of::<T>());
    // SAFETY: the caller's promise above: `told` bytes are there. `known` is at most that and at most
    // `ours`; a `T` holds only numbers and pointers, so any bytes are a value.
    unsafe {
        let told = told_size(field, at, T::FIRST_SIZE, T::INIT)?;
        refuse_unknown(field, at, ours, told)?;
        let known = told.min(ours);
        ptr::copy_nonoverlapping(at, (&raw mut value).cast::<u8>(), known);
        Ok((value, told))
    }
}

/// A descriptor that ends in a material and settings, each with a size of its own. What follows the
/// first of them lies where the caller's compiler put it.
///
/// # Safety
/// It is `repr(C)`, begins with a `u32`, its material lies `HEAD` bytes from its beginning and its
/// settings right behind, both aligned to 4, and it holds only numbers and pointers before.
pub unsafe trait Nesting: Copy + Default {
    /// Its material.
    type Material: Growing;
    /// Its settings.
    type Settings: Growing;
    /// Bytes before the material; they never change.
    const HEAD: usize;
    /// How to begin one.
    const INIT: &'static str;
    /// Puts the two in.
    fn set_parts(&mut self, material: Self::Material, settings: Self::Settings);
}

macro_rules! nesting {
    ($($name:ident, $init:literal;)*) => {$(
        // SAFETY: its file shows it, and the lines below check it.
        unsafe impl Nesting for $name {
            type Material = MuslinMaterial;
            type Settings = MuslinSettings;
            const HEAD: usize = offset_of!($name, material);
            const INIT: &'static str = $init;
            fn set_parts(&mut self, material: MuslinMaterial, settings: MuslinSettings) {
                (self.material, self.settings) = (material, settings);
            }
        }
        const _: () = assert!(
            offset_of!($name, settings) == offset_of!($name, material) + size_of::<MuslinMaterial>()
        );
    )*};
}

nesting! {
    MuslinGridDesc, "muslin_grid_desc_init";
    MuslinMeshDesc, "muslin_mesh_desc_init";
}

const _: () = assert!(align_of::<MuslinMaterial>() == 4 && align_of::<MuslinSettings>() == 4);

/// A descriptor with its parts, as far as the caller's compiler knew them.
///
/// # Safety
/// `at` is NULL or points to a `T` of this or another version, of the sizes that it and its parts say.
pub unsafe fn read_nested<T: Nesting>(name: &str, at: *const T) -> Result<T> {
    not_null(name, at)?;
    let (at, mut desc) = (at.cast::<u8>(), T::default());
    let inside = |end: usize, told: usize| {
        check(end <= told, "struct_size", &format!("be set by {}", T::INIT))
    };
    // SAFETY: the caller's promise above: `told` bytes are there, and no part is read that ends beyond
    // them. The head is all numbers and pointers, so any bytes are a value.
    unsafe {
        let least = T::HEAD + T::Material::FIRST_SIZE + T::Settings::FIRST_SIZE;
        let told = told_size("struct_size", at, least, T::INIT)?;
        let material_at = T::HEAD;
        let size = told_size(
            "material.struct_size",
            at.add(material_at),
            T::Material::FIRST_SIZE,
            T::Material::INIT,
        )?;
        let settings_at = material_at + size;
        inside(settings_at + T::Settings::FIRST_SIZE, told)?;
        let size = told_size(
            "settings.struct_size",
            at.add(settings_at),
            T::Settings::FIRST_SIZE,
            T::Settings::INIT,
        )?;
        let end = settings_at + size;
        inside(end, told)?;
        let (material, _) = read_sized("material.struct_size", at.add(material_at))?;
        let (settings, _) = read_sized("settings.struct_size", at.add(settings_at))?;
        // What rounds the whole up to its alignment is anything.
        refuse_unknown("struct_size", at, end.next_multiple_of(align_of::<T>()), told)?;
        ptr::copy_nonoverlapping(at, (&raw mut desc).cast::<u8>(), T::HEAD);
        desc.set_parts(material, settings);
    }
    Ok(desc)
}

/// Begins a struct of the caller's size: zeros, the defaults of what this version knows, and the size.
///
/// # Safety
/// `at` points to `size` bytes that may be written.
unsafe fn begin<T: Growing>(at: *mut u8, size: usize) {
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
fn check_own_size(name: &str, size: u32, least: usize) -> Result<usize> {
    let size = size as usize;
    let fits = (least..=MAX_STRUCT_SIZE).contains(&size) && size.is_multiple_of(4);
    check(fits, name, "be the sizeof of the struct")?;
    Ok(size)
}

/// Begins a struct of the caller's size.
///
/// # Safety
/// `at` is NULL or points to `size` bytes that may be written.
pub unsafe fn init<T: Growing>(name: &str, at: *mut T, size: u32) -> Result {
    not_null(name, at)?;
    let size = check_own_size("struct_size", size, T::FIRST_SIZE)?;
    // SAFETY: the caller's promise above.
    unsafe { begin::<T>(at.cast(), size) };
    Ok(())
}

/// Begins a struct of the caller's size, and its parts of theirs.
///
/// # Safety
/// `at` is NULL or points to `size` bytes that may be written.
pub unsafe fn init_nested<T: Nesting>(
    name: &str,
    at: *mut T,
    size: u32,
    material_size: u32,
    settings_size: u32,
) -> Result {
    not_null(name, at)?;
    let material = check_own_size("material_size", material_size, T::Material::FIRST_SIZE)?;
    let settings = check_own_size("settings_size", settings_size, T::Settings::FIRST_SIZE)?;
    let size = check_own_size("struct_size", size, T::HEAD + material + settings)?;
    let (at, head) = (at.cast::<u8>(), T::default());
    // SAFETY: the caller's promise above; head and parts together are at most `size`.
    unsafe {
        at.write_bytes(0, size);
        ptr::copy_nonoverlapping((&raw const head).cast::<u8>(), at, T::HEAD);
        at.cast::<u32>().write_unaligned(size as u32);
        begin::<T::Material>(at.add(T::HEAD), material);
        begin::<T::Settings>(at.add(T::HEAD + material), settings);
    }
    Ok(())
}

/// Where a struct goes that may be of another version.
pub struct Report<T> {
    at: NonNull<T>,
    size: usize,
}

impl<T: Growing> Report<T> {
    /// # Safety
    /// `at` is NULL or points to a `T` of this or another version, of the size that it says, that may be
    /// written until the call returns.
    pub unsafe fn new(name: &str, at: *mut T) -> Result<Self> {
        let at = NonNull::new(at).ok_or_else(|| Refusal::bad_value(name, "not be NULL"))?;
        let field = format!("{name}->struct_size");
        // SAFETY: the caller's promise above.
        let size = unsafe { told_size(&field, at.as_ptr().cast(), T::FIRST_SIZE, T::INIT)? };
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

mod streams;
#[cfg(test)]
mod tests;

pub use streams::streams;
