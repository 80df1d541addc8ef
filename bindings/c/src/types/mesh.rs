//! Descriptor of a cloth that is made from any triangle mesh.

use super::grid::MUSLIN_AS_MANY_AGAIN;
use super::material::MuslinMaterial;
use super::settings::MuslinSettings;
use crate::ffi::pointers::{read_u32s, read_vec2s, read_vec3s};
use crate::status::{CallError, Result};
use core::ptr;
use muslin_core::MeshDesc;

/// Any triangle mesh, as modelling tools export them. Initialise it with muslin_mesh_desc_init,
/// then set positions and indices.
///
/// Defects are repaired in this order; muslin_cloth_get_mesh_report counts the repairs:
/// - duplicate vertices are welded (see `weld_distance`);
/// - triangles without an area and repeated triangles are dropped;
/// - where more than two triangles share an edge, the flattest pair stays joined and the others get
///   an edge of their own;
/// - sheets that touch in a single vertex are separated there;
/// - within each piece, triangles are turned to face as most of them do;
/// - if `simplify_below` is above 0, short edges are collapsed.
///
/// Vertices that no triangle uses stay where they are.
///
/// A mesh that is a regular grid, with vertices and triangles in the order of
/// muslin_cloth_create_grid, is simulated as that grid, with identical bits.
///
/// All lists are copied during the call. `material` and `settings` have sizes of their own: replace
/// them only by structs that were initialised with muslin_material_init and muslin_settings_init in
/// the same program.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinMeshDesc {
    /// Set by muslin_mesh_desc_init.
    pub struct_size: u32,
    /// Rest positions of the vertices [m], 3 numbers per vertex. If nothing is welded, split
    /// or collapsed, vertex i is particle i; otherwise see `particles` of MuslinView.
    pub positions: *const f32,
    /// Distance between the starts of consecutive positions [bytes]; 0 means 12. Default 0. A
    /// multiple of 4.
    pub position_stride: u32,
    /// Number of vertices. Default 0. From 3 to 4194304.
    pub vertex_count: u32,
    /// Vertices of the triangles, 3 per triangle, counter-clockwise seen from the front.
    pub indices: *const u32,
    /// Number of indices. Default 0. A multiple of 3, at most 50331648.
    pub index_count: u32,
    /// Texture coordinates, 2 numbers per vertex, or NULL for none.
    pub uvs: *const f32,
    /// Vertices whose particles are pinned from the start, or NULL for none.
    pub pinned: *const u32,
    /// Number of entries of `pinned`. Default 0. At most `vertex_count`.
    pub pinned_count: u32,
    /// Vertices at most this far apart share one particle [m]. Default -1.
    ///
    /// 0 welds vertices at exactly the same position; a negative value welds nothing. Vertices are
    /// processed in order: each joins the nearest earlier vertex that was not welded itself.
    /// Corners of one triangle are never welded together. Choose a value well below the shortest
    /// edge.
    pub weld_distance: f32,
    /// Particles to reserve for tears and cuts. Default MUSLIN_AS_MANY_AGAIN; 0 if the cloth never
    /// tears.
    pub extra_particles: u32,
    /// Material.
    pub material: MuslinMaterial,
    /// Settings.
    pub settings: MuslinSettings,
    /// Not used. Default 0.
    pub reserved: u32,
    /// Edges shorter than this are collapsed [m]. Default 0: none. At most the mean length of the
    /// edges.
    ///
    /// One end of such an edge moves to the other, with its vertices, and the triangles at the edge
    /// are removed. Triangles that are lower than this get another diagonal where that makes them
    /// higher. Borders, seams of texture coordinates and their corners stay, a pinned vertex moves
    /// to pinned ones only, and the topology stays; `short_edges` of MuslinMeshReport counts the
    /// edges that are short nevertheless. A tenth to a third of the mean edge removes the slivers
    /// of most meshes.
    pub simplify_below: f32,
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
            reserved: 0,
            simplify_below: 0.0,
        }
    }
}

/// Larger counts are refused before a list is read; the limit of the core.
const MAX_VERTICES: u32 = 1 << 22;
/// Larger counts are refused before a list is read: twice the number of a closed surface without
/// handles.
const MAX_INDICES: u32 = 12 * MAX_VERTICES;

impl MuslinMeshDesc {
    /// Copies the mesh out of the caller's memory.
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
        // SAFETY: guaranteed by the caller.
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
            simplify_below: self.simplify_below,
        })
    }
}
