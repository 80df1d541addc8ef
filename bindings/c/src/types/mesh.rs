//! A cloth from any triangle mesh.

use super::grid::MUSLIN_AS_MANY_AGAIN;
use super::material::MuslinMaterial;
use super::settings::MuslinSettings;
use crate::ffi::pointers::{read_u32s, read_vec2s, read_vec3s};
use crate::status::{CallError, Result};
use core::ptr;
use muslin_core::MeshDesc;

/// Any triangle mesh, as artists export them. Begin with muslin_mesh_desc_init, then give it positions and
/// indices.
///
/// What cannot be cloth in it is repaired, and muslin_cloth_get_mesh_report tells what was: doubled vertices are
/// welded, triangles without an area and repeated ones dropped; where more than two triangles share an edge the
/// flattest two stay joined and the others get an edge of their own; sheets that meet at a mere point are parted;
/// the triangles of a piece are turned to face as most of them do. Vertices that no triangle uses stay where they
/// are.
///
/// A mesh that is a regular grid, its vertices and triangles in the order that muslin_cloth_create_grid has them,
/// is woven as that grid is: it moves in the same bits.
///
/// All lists are copied while the cloth is made. `material` and `settings` carry sizes of their own:
/// replace them by structs that began with muslin_material_init and muslin_settings_init in the same
/// program.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinMeshDesc {
    /// Set by muslin_mesh_desc_init.
    pub struct_size: u32,
    /// Where the vertices are at rest [m], 3 numbers a vertex. Each is the particle of its number if nothing is
    /// welded or split, see MuslinView's `particles`.
    pub positions: *const f32,
    /// Bytes from one position to the next; 0, which is 12. A multiple of 4.
    pub position_stride: u32,
    /// How many vertices there are; 0. From 3 to 4194304.
    pub vertex_count: u32,
    /// Vertices of the triangles, 3 a triangle, counter-clockwise seen from its front.
    pub indices: *const u32,
    /// How many indices there are; 0. A multiple of 3, at most 50331648.
    pub index_count: u32,
    /// Texture coordinates, 2 numbers a vertex; or NULL: none.
    pub uvs: *const f32,
    /// Vertices whose particles are pinned from the start; or NULL: none.
    pub pinned: *const u32,
    /// How many `pinned` there are; 0. At most `vertex_count`.
    pub pinned_count: u32,
    /// Vertices at most this far apart share a particle [m]; 0 joins those at the very same place, -1 (or
    /// anything below 0) leaves all apart. Vertices are taken in order, and each joins the nearest one before
    /// it that stayed apart; but the corners of a triangle stay apart, however small it is. Keep it well below
    /// the shortest edge.
    pub weld_distance: f32,
    /// Particles that tears may add; MUSLIN_AS_MANY_AGAIN.
    pub extra_particles: u32,
    /// What it is made of.
    pub material: MuslinMaterial,
    /// How its time runs.
    pub settings: MuslinSettings,
}

impl Default for MuslinMeshDesc {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            positions: ptr::null(),
            position_stride: 0,
            vertex_count: 0,
            indices: ptr::null(),
            index_count: 0,
            uvs: ptr::null(),
            pinned: ptr::null(),
            pinned_count: 0,
            weld_distance: -1.0,
            extra_particles: MUSLIN_AS_MANY_AGAIN,
            material: MuslinMaterial::default(),
            settings: MuslinSettings::default(),
        }
    }
}

/// More vertices than this are refused unread; the core's own bound.
const MAX_VERTICES: u32 = 1 << 22;
/// More indices than this are refused unread: twice what a closed surface without handles has.
const MAX_INDICES: u32 = 12 * MAX_VERTICES;

impl MuslinMeshDesc {
    /// The mesh, copied out of the caller's memory.
    ///
    /// # Safety
    /// Every list is NULL or as long as its count says.
    pub unsafe fn read(&self) -> Result<MeshDesc> {
        let counts = [
            (self.vertex_count >= 3, "vertex_count", "be at least 3"),
            (self.vertex_count <= MAX_VERTICES, "vertex_count", "be at most 4194304"),
            (self.index_count > 0, "index_count", "be at least 3"),
            (self.index_count <= MAX_INDICES, "index_count", "be at most 50331648"),
            (self.index_count.is_multiple_of(3), "index_count", "be a multiple of 3"),
            (self.pinned_count <= self.vertex_count, "pinned_count", "be at most `vertex_count`"),
        ];
        if let Some((_, field, must)) = counts.into_iter().find(|(fits, ..)| !fits) {
            return Err(CallError::bad_value(field, must));
        }
        let (stride, count) = (self.position_stride, self.vertex_count);
        // SAFETY: the caller's promise above.
        let (positions, indices, uvs, pinned) = unsafe {
            (
                read_vec3s("positions", self.positions.cast(), stride, count)?,
                read_u32s("indices", self.indices, self.index_count)?,
                read_vec2s(self.uvs, count),
                read_u32s("pinned", self.pinned, self.pinned_count)?,
            )
        };
        Ok(MeshDesc {
            positions,
            indices,
            uvs,
            pinned,
            weld_distance: self.weld_distance,
            extra_particles: self.extra_particles,
            material: self.material.into(),
            settings: self.settings.try_into()?,
        })
    }
}
