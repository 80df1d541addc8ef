//! Tests of versioned structs, unaligned points and panics.

use crate::ffi::panic_guard::run_guarded;
use crate::ffi::pointers::read_vec3s;
use crate::ffi::versioned_struct::{NestedDesc, OutStruct, VersionedStruct, init_desc, read_desc};
use crate::status::{MuslinStatus, Result};
use core::ffi::CStr;
use core::mem::offset_of;
use core::ptr;
use muslin_core::glam::Vec3;

/// A material with `EXTRA` fields more than in its first version.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
struct Material<const EXTRA: usize> {
    struct_size: u32,
    density: f32,
    extra: [f32; EXTRA],
}

impl<const EXTRA: usize> Default for Material<EXTRA> {
    fn default() -> Self {
        Self { struct_size: size_of::<Self>() as u32, density: 0.25, extra: [0.5; EXTRA] }
    }
}

// SAFETY: all fields are 4-byte numbers, so there is no padding.
unsafe impl<const EXTRA: usize> VersionedStruct for Material<EXTRA> {
    const FIRST_SIZE: usize = 8;
    const INIT: &'static str = "material_init";
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq)]
struct Desc<const MATERIAL: usize, const SETTINGS: usize> {
    struct_size: u32,
    columns: u32,
    at: *const u32,
    material: Material<MATERIAL>,
    settings: Material<SETTINGS>,
}

impl<const MATERIAL: usize, const SETTINGS: usize> Default for Desc<MATERIAL, SETTINGS> {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            columns: 40,
            at: ptr::null(),
            material: Material::default(),
            settings: Material::default(),
        }
    }
}

// SAFETY: `repr(C)`, and `HEAD` is the offset of the material in every version.
unsafe impl<const M: usize, const S: usize> NestedDesc for Desc<M, S> {
    type Material = Material<M>;
    type Settings = Material<S>;
    const HEAD: usize = offset_of!(Desc<0, 0>, material);
    const TAIL: usize = 0;
    const INIT: &'static str = "desc_init";
    fn set_parts(&mut self, material: Material<M>, settings: Material<S>) {
        (self.material, self.settings) = (material, settings);
    }
}

/// Initialises a caller's descriptor through the library's version `Ours`, changes it, and reads it
/// back.
fn pass<Ours: NestedDesc, const M: usize, const S: usize>(
    change: impl FnOnce(&mut Desc<M, S>),
) -> Result<Ours> {
    let mut theirs = Desc::<M, S>::default();
    let sizes =
        [size_of_val(&theirs), size_of_val(&theirs.material), size_of_val(&theirs.settings)];
    let [whole, material, settings] = sizes.map(|size| size as u32);
    let at = (&raw mut theirs).cast::<Ours>();
    // SAFETY: `theirs` and its parts have the stated sizes.
    unsafe { init_desc("desc", at, whole, material, settings)? };
    change(&mut theirs);
    // SAFETY: `theirs` and its parts have the stated sizes.
    unsafe { read_desc("desc", (&raw const theirs).cast::<Ours>()) }
}

#[test]
fn fields_that_an_older_caller_lacks_get_their_defaults() {
    let ours: Desc<2, 3> = pass::<_, 0, 1>(|theirs| {
        theirs.columns = 7;
        theirs.material.density = 3.0;
        theirs.settings.density = 4.0;
        theirs.settings.extra = [5.0];
    })
    .unwrap();
    assert_eq!(ours.columns, 7);
    assert_eq!((ours.material.density, ours.material.extra), (3.0, [0.5, 0.5]));
    assert_eq!((ours.settings.density, ours.settings.extra), (4.0, [5.0, 0.5, 0.5]));
}

#[test]
fn a_newer_caller_is_accepted_unless_it_sets_new_fields() {
    let ours: Desc<1, 0> = pass::<_, 4, 3>(|theirs| {
        assert_eq!(theirs.material.extra, [0.5, 0.0, 0.0, 0.0]);
        theirs.material.extra[0] = 6.0;
        theirs.settings.density = 4.0;
    })
    .unwrap();
    assert_eq!((ours.material.extra, ours.settings.density), ([6.0], 4.0));

    let refused = pass::<Desc<1, 0>, 4, 3>(|theirs| theirs.material.extra[2] = 1.0).unwrap_err();
    assert_eq!(refused.status, MuslinStatus::Unsupported);
    assert!(refused.message.starts_with("`material.struct_size`"), "{}", refused.message);
    let refused = pass::<Desc<1, 0>, 4, 3>(|theirs| theirs.settings.extra[0] = 1.0).unwrap_err();
    assert!(refused.message.starts_with("`settings.struct_size`"), "{}", refused.message);
}

#[test]
fn part_sizes_that_exceed_the_descriptor_are_refused() {
    let too_large = pass::<Desc<1, 1>, 1, 1>(|theirs| theirs.settings.struct_size = 400);
    assert_eq!(too_large.unwrap_err().message, "`struct_size` must be set by desc_init");
    let too_small = pass::<Desc<1, 1>, 1, 1>(|theirs| theirs.material.struct_size = 4);
    let rule = "`material.struct_size` must be set by material_init";
    assert_eq!(too_small.unwrap_err().message, rule);
    let uninitialized = pass::<Desc<1, 1>, 1, 1>(|theirs| theirs.struct_size = 0xcdcd_cdcc);
    assert_eq!(uninitialized.unwrap_err().message, "`struct_size` must be set by desc_init");
}

#[test]
fn an_output_struct_is_written_within_the_callers_size() {
    let report = Material::<1> { density: 1.5, extra: [2.5], ..Material::default() };
    let mut older = [Material::<0>::default(), Material { struct_size: 77, ..Material::default() }];
    // SAFETY: `older[0]` has the size that it states.
    unsafe { OutStruct::new("out", (&raw mut older[0]).cast::<Material<1>>()) }
        .unwrap()
        .write(&report);
    assert_eq!((older[0].struct_size, older[0].density), (8, 1.5));
    assert_eq!((older[1].struct_size, older[1].density), (77, 0.25));

    let mut newer = Material::<3>::default();
    // SAFETY: `newer` has the size that it states.
    unsafe { OutStruct::new("out", (&raw mut newer).cast::<Material<1>>()) }
        .unwrap()
        .write(&report);
    assert_eq!((newer.struct_size, newer.density, newer.extra), (20, 1.5, [2.5, 0.0, 0.0]));
}

#[test]
fn points_are_read_from_unaligned_memory() {
    let floats: Vec<u8> = (0..8).flat_map(|i| (i as f32).to_le_bytes()).collect();
    let unaligned = [&[0], &floats[..]].concat();
    // SAFETY: `unaligned` holds two points, 16 bytes apart, from byte 1 on.
    let read = unsafe { read_vec3s("positions", unaligned.as_ptr().add(1).cast(), 16, 2) };
    assert_eq!(read.unwrap(), [Vec3::new(0.0, 1.0, 2.0), Vec3::new(4.0, 5.0, 6.0)]);
    for stride in [4, 8, 13, 14] {
        // SAFETY: with a count of 0 nothing is read.
        let refused = unsafe { read_vec3s("positions", unaligned.as_ptr().cast(), stride, 0) };
        assert_eq!(refused.unwrap_err().status, MuslinStatus::BadValue, "{stride}");
    }
}

#[test]
fn a_panic_becomes_a_status() {
    assert_eq!(run_guarded(|| panic!("on purpose, {}", 7)), MuslinStatus::Panicked);
    // SAFETY: the pointer is valid until this thread's next error.
    let message = unsafe { CStr::from_ptr(crate::status::last_error()) };
    assert_eq!(message, c"a bug in Muslin interrupted the call: on purpose, 7");
}
