//! The versioned structs of the header, with their sizes in the first release.
//!
//! Reads the struct definitions in `types`; implements the traits of `versioned_struct` for them.
//! Invariant: an assertion per struct shows that its last field ends it, without padding.

use crate::ffi::versioned_struct::{NestedDesc, VersionedStruct};
use crate::types::changes::MuslinChanges;
use crate::types::collider::MuslinColliderDesc;
use crate::types::event::MuslinEvent;
use crate::types::grid::MuslinGridDesc;
use crate::types::hit::MuslinHit;
use crate::types::material::MuslinMaterial;
use crate::types::mesh::MuslinMeshDesc;
use crate::types::mesh_report::MuslinMeshReport;
use crate::types::settings::MuslinSettings;
use crate::types::sewing::MuslinSewDesc;
use crate::types::skin::MuslinSkinDesc;
use crate::types::stats::{MUSLIN_STAGE_SLOTS, MuslinStats};
use crate::types::stream::{MuslinStream, MuslinWriteDesc};
use crate::types::view::MuslinView;
use crate::types::wind::MuslinWind;
use core::mem::offset_of;

/// Implements [`VersionedStruct`] for each struct, from its last field in the first release and its
/// last field now, each with its size [bytes], and the name of its `init` function.
macro_rules! versioned_structs {
    ($($name:ident: $first:ident[$first_size:expr], $last:ident[$last_size:expr], $init:literal;)*) => {$(
        // SAFETY: the definition is `repr(C)`, starts with `struct_size` and holds only numbers and
        // pointers; the assertion below shows that no padding follows the last field.
        unsafe impl VersionedStruct for $name {
            const FIRST_SIZE: usize = offset_of!($name, $first) + $first_size;
            const INIT: &'static str = $init;
        }
        const _: () = assert!(offset_of!($name, $last) + $last_size == size_of::<$name>());
    )*};
}

versioned_structs! {
    // Struct: last field of the first release, last field now, `init` function.
    MuslinSettings: tearing[4], pressure[4], "muslin_settings_init";
    MuslinMaterial: yield_creep[4], yield_weakening[4], "muslin_material_init";
    MuslinWind: seed[4], seed[4], "muslin_wind_init";
    MuslinColliderDesc: restitution[4], reserved[4], "muslin_collider_desc_init";
    MuslinEvent: source[4], count[4], "muslin_event_init";
    MuslinHit: normal[12], normal[12], "muslin_hit_init";
    MuslinView: state_revision[4], particles[size_of::<*const u32>()], "muslin_view_init";
    MuslinMeshReport: is_grid[4], short_edges[4], "muslin_mesh_report_init";
    MuslinChanges: index_count[4], index_count[4], "muslin_changes_init";
    MuslinStream: size[size_of::<usize>()], size[size_of::<usize>()], "muslin_stream_init";
    MuslinSkinDesc: reserved[4], reserved[4], "muslin_skin_desc_init";
    MuslinSewDesc: tear_force[4], tear_force[4], "muslin_sew_desc_init";
    MuslinWriteDesc: offset[4], relative[4], "muslin_write_desc_init";
    MuslinStats: seconds[4 * MUSLIN_STAGE_SLOTS], crossings[4], "muslin_stats_init";
}

/// Implements [`NestedDesc`] for each descriptor that has a material, settings, and bytes behind
/// them.
macro_rules! nested_descs {
    ($($name:ident, $tail:expr, $init:literal;)*) => {$(
        // SAFETY: the definition is `repr(C)`, starts with `struct_size` and holds only numbers and
        // pointers before the material and only numbers behind the settings; the assertions below
        // show where material, settings and tail are and how they are aligned.
        unsafe impl NestedDesc for $name {
            type Material = MuslinMaterial;
            type Settings = MuslinSettings;
            const HEAD: usize = offset_of!($name, material);
            const TAIL: usize = $tail;
            const INIT: &'static str = $init;
            fn set_parts(&mut self, material: MuslinMaterial, settings: MuslinSettings) {
                (self.material, self.settings) = (material, settings);
            }
        }
        const _: () = assert!(
            offset_of!($name, settings) == offset_of!($name, material) + size_of::<MuslinMaterial>()
        );
        const _: () = assert!(
            (offset_of!($name, settings) + size_of::<MuslinSettings>() + $tail)
                .next_multiple_of(align_of::<$name>()) == size_of::<$name>()
        );
    )*};
}

nested_descs! {
    MuslinGridDesc, 0, "muslin_grid_desc_init";
    // `reserved` takes the bytes that may be padding in versions without `simplify_below`.
    MuslinMeshDesc, 8, "muslin_mesh_desc_init";
}

const _: () = assert!(
    offset_of!(MuslinMeshDesc, simplify_below) + 4
        == offset_of!(MuslinMeshDesc, settings) + size_of::<MuslinSettings>() + 8
);
const _: () = assert!(align_of::<MuslinMaterial>() == 4 && align_of::<MuslinSettings>() == 4);
