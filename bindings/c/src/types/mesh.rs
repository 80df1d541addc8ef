//! A cloth from any triangle mesh.

use super::grid::MUSLIN_AS_MANY_AGAIN;
use super::material::MuslinMaterial;
use super::settings::MuslinSettings;
use crate::boundary;
use crate::status::{Refusal, Result};
use core::ptr;
use muslin_core::MeshDesc;

/// Any triangle mesh: every edge with one or two triangles, no two parts joined by a mere point.
/// Begin with muslin_mesh_desc_init, then give it positions and indices.
///
/// All lists are copied while the cloth is made. `material` and `settings` carry sizes of their own:
/// replace them by structs that began with muslin_material_init and muslin_settings_init in the same
/// program.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinMeshDesc {
    /// Set by muslin_mesh_desc_init.
    pub struct_size: u32,
    /// Where the vertices are at rest [m], 3 numbers a vertex; particle = vertex.
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
    /// Vertices that are pinned from the start; or NULL: none.
    pub pinned: *const u32,
    /// How many `pinned` there are; 0. At most `vertex_count`.
    pub pinned_count: u32,
    /// Vertices nearer to each other than this are one [m]; -1 leaves all apart. Nothing from 0 on is
    /// supported yet.
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
            return Err(Refusal::bad_value(field, must));
        }
        let (stride, count) = (self.position_stride, self.vertex_count);
        // SAFETY: the caller's promise above.
        let (positions, indices, uvs, pinned) = unsafe {
            (
                boundary::points("positions", self.positions.cast(), stride, count)?,
                boundary::list("indices", self.indices, self.index_count)?,
                boundary::pairs(self.uvs, count),
                boundary::list("pinned", self.pinned, self.pinned_count)?,
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
