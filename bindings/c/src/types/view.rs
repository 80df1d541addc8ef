//! Output lists that a renderer reads.

use core::ptr;
use muslin_core::View;
use muslin_core::glam::{Vec2, Vec3};

/// Output lists of a cloth, borrowed from the library's own memory. Read only. Initialise it with
/// muslin_view_init.
///
/// The pointers and the data behind them stay valid until the next call that changes the cloth
/// (advance, step, reset, pin, set_position, tear_edge, cut, destroy and others).
///
/// Vertices are drawn; particles are simulated. See `particles` for their relation.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinView {
    /// Set by muslin_view_init.
    pub struct_size: u32,
    /// Positions [m], 3 numbers per vertex.
    pub positions: *const f32,
    /// Unit normals, weighted by triangle area, 3 numbers per vertex; zeros for a vertex that no
    /// triangle uses. Vertices of the same particle share its normal.
    pub normals: *const f32,
    /// Texture coordinates, 2 numbers per vertex.
    pub uvs: *const f32,
    /// Vertices of the triangles, 3 per triangle, counter-clockwise seen from the front.
    pub indices: *const u32,
    /// Vertex of the descriptor that each vertex came from; for a vertex that a cut added on an
    /// edge, that of the nearer end.
    pub source_vertices: *const u32,
    /// Number of vertices.
    pub vertex_count: u32,
    /// Number of indices, 3 per triangle.
    pub index_count: u32,
    /// Largest number of vertices that the cloth may ever have.
    pub vertex_capacity: u32,
    /// Largest number of indices that the cloth may ever have.
    pub index_capacity: u32,
    /// Changes whenever the indices change.
    pub topology_revision: u32,
    /// Changes whenever positions change.
    pub state_revision: u32,
    /// 1 byte per vertex: 1 on a border that a tear or cut made, e.g. to draw fringes; else 0, also
    /// on borders of the original cloth.
    pub frayed: *const u8,
    /// Particle of each vertex. A mesh that was welded, or whose sheets were separated, has several
    /// vertices per particle; otherwise vertex i is particle i.
    ///
    /// Calls that act on the cloth (pins, grabs, tears, positions and velocities) take particles,
    /// and a ray hit returns one. In an event, `particle_a` and `particle_b` are particles,
    /// `vertex` and `source` are vertices. Triangles have the same numbers in both.
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

// Lists of vectors can be read as lists of numbers: the types have no padding.
const _: () = assert!(size_of::<Vec3>() == 12 && size_of::<Vec2>() == 8 && size_of::<bool>() == 1);
