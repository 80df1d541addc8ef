//! Descriptor of a skin.

use crate::ffi::pointers::{read_u32s, read_vec2s, read_vec3s};
use crate::status::{CallError, Result};
use core::ptr;
use muslin_core::SkinDesc;

/// A render mesh that follows a cloth. Initialise it with muslin_skin_desc_init, then set positions
/// and indices. All lists are copied during the call.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinSkinDesc {
    /// Set by muslin_skin_desc_init.
    pub struct_size: u32,
    /// Positions of the vertices [m], 3 numbers per vertex, where the cloth is now. None may be
    /// farther from the cloth than half the diagonal of the cloth's bounding box.
    pub positions: *const f32,
    /// Distance between the starts of consecutive positions [bytes]; 0 means 12. Default 0. A
    /// multiple of 4.
    pub stride: u32,
    /// Number of vertices. Default 0. From 3 to 4194304.
    pub vertex_count: u32,
    /// Vertices of the triangles, 3 per triangle, counter-clockwise seen from the front.
    pub indices: *const u32,
    /// Number of indices. Default 0. A multiple of 3, at most 50331648.
    pub index_count: u32,
    /// Texture coordinates, 2 numbers per vertex, or NULL for none.
    pub uvs: *const f32,
    /// Curvature over each triangle of the cloth, from 0 (flat triangles) to 1. Default 1.
    ///
    /// Above 0, a fine skin has a smooth outline on a coarse cloth (Phong tessellation). At 1 a
    /// skin lies on a circle between particles that lie on one. Particles are on the surface for
    /// any value.
    pub smoothness: f32,
    /// Not used; 0.
    pub reserved: u32,
}

impl Default for MuslinSkinDesc {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            positions: ptr::null(),
            stride: 0,
            vertex_count: 0,
            indices: ptr::null(),
            index_count: 0,
            uvs: ptr::null(),
            smoothness: SkinDesc::default().smoothness,
            reserved: 0,
        }
    }
}

/// Larger counts are refused before a list is read; the limit of the core.
const MAX_VERTICES: u32 = 1 << 22;
/// Larger counts are refused before a list is read: twice the number of a closed surface without
/// handles.
const MAX_INDICES: u32 = 12 * MAX_VERTICES;

impl MuslinSkinDesc {
    /// Copies the mesh out of the caller's memory.
    ///
    /// # Safety
    /// Every list is NULL or as long as its count says.
    pub unsafe fn read(&self) -> Result<SkinDesc> {
        let counts = [
            (self.vertex_count >= 3, "vertex_count", "be at least 3"),
            (self.vertex_count <= MAX_VERTICES, "vertex_count", "be at most 4194304"),
            (self.index_count > 0, "index_count", "be at least 3"),
            (self.index_count <= MAX_INDICES, "index_count", "be at most 50331648"),
            (self.index_count.is_multiple_of(3), "index_count", "be a multiple of 3"),
        ];
        if let Some((_, field, must)) = counts.into_iter().find(|(fits, ..)| !fits) {
            return Err(CallError::bad_value(field, must));
        }
        // SAFETY: guaranteed by the caller.
        let (positions, indices, uvs) = unsafe {
            (
                read_vec3s("positions", self.positions.cast(), self.stride, self.vertex_count)?,
                read_u32s("indices", self.indices, self.index_count)?,
                read_vec2s(self.uvs, self.vertex_count),
            )
        };
        Ok(SkinDesc { positions, indices, uvs, smoothness: self.smoothness })
    }
}
