//! What a renderer reads.

use core::ptr;
use muslin_core::View;
use muslin_core::glam::{Vec2, Vec3};

/// A cloth as its renderer sees it: the library's own memory, borrowed. Begin with muslin_view_init.
///
/// The pointers stay valid, and what they point to stays as it is, until the next call that changes
/// the cloth (advance, step, reset, pin, set_position, tear_edge, cut, destroy, ...). Read, do not write.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinView {
    /// Set by muslin_view_init.
    pub struct_size: u32,
    /// Positions [m], 3 numbers a vertex.
    pub positions: *const f32,
    /// Unit normals, area-weighted, 3 numbers a vertex; zeros for a vertex that no triangle uses. Vertices that
    /// share a particle share its normal.
    pub normals: *const f32,
    /// Texture coordinates, 2 numbers a vertex.
    pub uvs: *const f32,
    /// Vertices of the triangles, 3 a triangle.
    pub indices: *const u32,
    /// Which original vertex each vertex came from, 1 a vertex; for one that a cut made on an edge, the
    /// nearer end's.
    pub source_vertices: *const u32,
    /// How many vertices there are.
    pub vertex_count: u32,
    /// How many indices there are: 3 a triangle.
    pub index_count: u32,
    /// How many vertices there may ever be.
    pub vertex_capacity: u32,
    /// How many indices there may ever be.
    pub index_capacity: u32,
    /// Changes when indices do.
    pub topology_revision: u32,
    /// Changes when positions do.
    pub state_revision: u32,
    /// 1 for a vertex at a border that a tear or a cut made, which a renderer may fringe; 0 for others,
    /// those at the borders that the cloth was made with among them. 1 byte a vertex.
    pub frayed: *const u8,
    /// The particle of each vertex, 1 a vertex. A mesh that was welded or had sheets to be parted has several
    /// vertices to a particle; else each vertex is the particle of its number.
    ///
    /// Calls that touch the cloth (pins, grabs, tears by hand, positions and velocities) take particles, and
    /// what a ray hits tells one. Of an event, `particle_a` and `particle_b` are particles, `vertex` and `source`
    /// are vertices. Triangles have the same numbers in both.
    pub particles: *const u32,
}

impl Default for MuslinView {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            positions: ptr::null(),
            normals: ptr::null(),
            uvs: ptr::null(),
            indices: ptr::null(),
            source_vertices: ptr::null(),
            vertex_count: 0,
            index_count: 0,
            vertex_capacity: 0,
            index_capacity: 0,
            topology_revision: 0,
            state_revision: 0,
            frayed: ptr::null(),
            particles: ptr::null(),
        }
    }
}

impl From<View<'_>> for MuslinView {
    fn from(view: View<'_>) -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            positions: view.positions.as_ptr().cast(),
            normals: view.normals.as_ptr().cast(),
            uvs: view.uvs.as_ptr().cast(),
            indices: view.indices.as_ptr(),
            source_vertices: view.source_vertices.as_ptr(),
            vertex_count: view.positions.len() as u32,
            index_count: view.indices.len() as u32,
            vertex_capacity: view.vertex_capacity,
            index_capacity: view.index_capacity,
            topology_revision: view.topology_revision,
            state_revision: view.state_revision,
            frayed: view.frayed.as_ptr().cast(),
            particles: view.particles.as_ptr(),
        }
    }
}

// Lists of vectors are lists of numbers, without gaps.
const _: () = assert!(size_of::<Vec3>() == 12 && size_of::<Vec2>() == 8 && size_of::<bool>() == 1);
