//! Vertex streams: where and how vertices are written.

use crate::status::{CallError, Result};
use core::ffi::c_void;
use core::ptr;
use muslin_core::glam::{Affine3, Mat3, Vec3};
use muslin_core::{ALL_VERTICES, Attribute, MAX_STREAMS, VertexFormat, WriteDesc};

/// Position [m]: x y z; in 16-bit formats x y z 1.
pub const MUSLIN_ATTRIBUTE_POSITION: u32 = 0;
/// Unit normal: x y z; in 16-bit formats x y z 0.
pub const MUSLIN_ATTRIBUTE_NORMAL: u32 = 1;
/// Tangent: x y z w. The unit vector perpendicular to the normal in which texture coordinate u
/// grows; w is 1 or -1, and v grows along cross(normal, tangent) times w.
///
/// It is the sum over the vertex's triangles of (p dv2 - q dv1) sign(du1 dv2 - du2 dv1), made
/// perpendicular to the normal. p and q are edges of the triangle; (du1, dv1) and (du2, dv2) are
/// the same edges in texture space. Where texture coordinates are degenerate, it is any
/// perpendicular direction.
pub const MUSLIN_ATTRIBUTE_TANGENT: u32 = 2;
/// Texture coordinates: u v.
pub const MUSLIN_ATTRIBUTE_UV: u32 = 3;
/// 1 on a border that a tear or cut made, e.g. to draw fringes, else 0; in 16-bit formats followed
/// by 0.
pub const MUSLIN_ATTRIBUTE_FRAYED: u32 = 4;

/// 32-bit floats. Bytes: position and normal 12, tangent 16, uv 8, frayed 4.
pub const MUSLIN_FORMAT_F32: u32 = 0;
/// 16-bit floats. Values beyond 65504 are clamped. Bytes: position, normal and tangent 8, uv and
/// frayed 4.
pub const MUSLIN_FORMAT_F16: u32 = 1;
/// Signed 16-bit integers; -32767 to 32767 stand for -1 to 1. Bytes: normal and tangent 8, frayed
/// 4. Not for other attributes.
pub const MUSLIN_FORMAT_SNORM16: u32 = 2;
/// Unit vectors in octahedral encoding, as two 16-bit integers like MUSLIN_FORMAT_SNORM16. Bytes:
/// normal 4, tangent 8 (u, v, w and 0). Not for other attributes.
///
/// The vector is projected onto the octahedron |x| + |y| + |z| = 1. The encoding is x and y, with
/// the lower half (z < 0) folded outward to (1 - |y|) sign(x) and (1 - |x|) sign(y).
pub const MUSLIN_FORMAT_OCTAHEDRAL16: u32 = 3;

/// Largest number of streams in one call.
pub const MUSLIN_MAX_STREAMS: u32 = 16;

/// Value of `vertex_count` that means all vertices from `first_vertex` on.
pub const MUSLIN_ALL_VERTICES: u32 = u32::MAX;

/// A destination for one vertex attribute. Initialise it with muslin_stream_init, or make it with
/// muslin_stream.
///
/// Streams may share a buffer: interleaved at equal strides, or one after the other.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinStream {
    /// Set by muslin_stream_init. Equal for all streams of a call.
    pub struct_size: u32,
    /// Attribute: one of MUSLIN_ATTRIBUTE_.... Default MUSLIN_ATTRIBUTE_POSITION.
    pub attribute: u32,
    /// Number format: one of MUSLIN_FORMAT_.... Default MUSLIN_FORMAT_F32.
    pub format: u32,
    /// Distance between the starts of consecutive vertices [bytes]. Default 0: tightly packed.
    /// Otherwise a multiple of the component size (4 for MUSLIN_FORMAT_F32, else 2), at least the
    /// size of the attribute.
    pub stride: u32,
    /// Address of the first vertex, aligned to the component size. Default NULL. Your own memory,
    /// not that of a view.
    pub buffer: *mut c_void,
    /// Bytes from `buffer` to the end of the memory. Default 0.
    pub size: usize,
}

impl Default for MuslinStream {
    fn default() -> Self {
        Self {
            struct_size: size_of::<Self>() as u32,
            attribute: MUSLIN_ATTRIBUTE_POSITION,
            format: MUSLIN_FORMAT_F32,
            stride: 0,
            buffer: ptr::null_mut(),
            size: 0,
        }
    }
}

impl MuslinStream {
    /// Returns attribute and format; `at` is the index of the stream.
    pub fn choices(&self, at: usize) -> Result<(Attribute, VertexFormat)> {
        let bad = |field: &str, kind: &str| {
            CallError::bad_value(
                format_args!("streams[{at}].{field}"),
                format_args!("be a MUSLIN_{kind}_..."),
            )
        };
        let attribute = Attribute::ALL.get(self.attribute as usize).copied();
        let format = VertexFormat::ALL.get(self.format as usize).copied();
        Ok((
            attribute.ok_or_else(|| bad("attribute", "ATTRIBUTE"))?,
            format.ok_or_else(|| bad("format", "FORMAT"))?,
        ))
    }
}

/// Selects the vertices to write and how they are transformed. Initialise it with
/// muslin_write_desc_init, which selects all vertices, untransformed.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinWriteDesc {
    /// Set by muslin_write_desc_init.
    pub struct_size: u32,
    /// First vertex to write; it goes to the start of each stream. Default 0.
    pub first_vertex: u32,
    /// Number of vertices to write. Default MUSLIN_ALL_VERTICES.
    pub vertex_count: u32,
    /// Time to draw, from 0 (last tick) to 1 (current tick). Default 1. Pass `blend` of MuslinStats
    /// for smooth motion. Normals and tangents belong to the interpolated surface.
    pub blend: f32,
    /// Transform of the positions, applied after the offset: three rows of four numbers, so that x
    /// becomes t[0] x + t[1] y + t[2] z + t[3]. Default: identity. A transform that takes a cloth
    /// far from zero to a place near zero loses no digits. Normals stay perpendicular to the
    /// surface and on their side of it; tangents stay in the surface.
    pub transform: [f32; 12],
    /// 1 if normals point to the other side, e.g. for the back of the cloth. Default 0.
    pub flip_normals: u32,
    /// Distance by which positions are moved along the written normals [m]. Default 0. Half of the
    /// thickness on either side gives the cloth a visible thickness.
    pub offset: f32,
    /// 1 if positions are relative to the origin of muslin_cloth_get_origin, also those that
    /// `transform` applies to. Default 0: they are absolute.
    pub relative: u32,
}

impl Default for MuslinWriteDesc {
    fn default() -> Self {
        let desc = WriteDesc::default();
        Self {
            struct_size: size_of::<Self>() as u32,
            first_vertex: desc.first_vertex,
            vertex_count: desc.vertex_count,
            blend: desc.blend,
            transform: [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0],
            flip_normals: desc.flip_normals.into(),
            offset: desc.offset,
            relative: desc.relative.into(),
        }
    }
}

impl TryFrom<MuslinWriteDesc> for WriteDesc {
    type Error = CallError;

    fn try_from(desc: MuslinWriteDesc) -> Result<Self> {
        for (field, flag) in [("flip_normals", desc.flip_normals), ("relative", desc.relative)] {
            if flag > 1 {
                return Err(CallError::bad_value(field, "be 0 or 1"));
            }
        }
        let t = desc.transform;
        let column = |at: usize| Vec3::new(t[at], t[at + 4], t[at + 8]);
        Ok(Self {
            first_vertex: desc.first_vertex,
            vertex_count: desc.vertex_count,
            blend: desc.blend,
            transform: Affine3 {
                matrix3: Mat3::from_cols(column(0), column(1), column(2)),
                translation: column(3),
            },
            flip_normals: desc.flip_normals == 1,
            offset: desc.offset,
            relative: desc.relative == 1,
        })
    }
}

const _: () = {
    assert!(MUSLIN_ALL_VERTICES == ALL_VERTICES && MUSLIN_MAX_STREAMS as usize == MAX_STREAMS);
    assert!(MUSLIN_ATTRIBUTE_NORMAL == Attribute::Normal as u32);
    assert!(MUSLIN_ATTRIBUTE_TANGENT == Attribute::Tangent as u32);
    assert!(MUSLIN_ATTRIBUTE_UV == Attribute::Uv as u32);
    assert!(MUSLIN_ATTRIBUTE_FRAYED == Attribute::Frayed as u32);
    assert!(MUSLIN_FORMAT_F16 == VertexFormat::F16 as u32);
    assert!(MUSLIN_FORMAT_SNORM16 == VertexFormat::Snorm16 as u32);
    assert!(MUSLIN_FORMAT_OCTAHEDRAL16 == VertexFormat::Octahedral16 as u32);
};
