//! Where vertices are written, which and how.

use crate::status::{CallError, Result};
use core::ffi::c_void;
use core::ptr;
use muslin_core::glam::{Affine3, Mat3, Vec3};
use muslin_core::{ALL_VERTICES, Attribute, MAX_STREAMS, VertexFormat, WriteDesc};

/// Where a vertex is [m]: x y z, and 1 in 16 bits.
pub const MUSLIN_ATTRIBUTE_POSITION: u32 = 0;
/// Its unit normal: x y z, and 0 in 16 bits.
pub const MUSLIN_ATTRIBUTE_NORMAL: u32 = 1;
/// The unit direction square to the normal in which the texture coordinate u grows, x y z, and w, which
/// is 1 or -1: v grows along cross(normal, tangent) times w. It is the sum over the vertex's triangles of
/// (p dv2 - q dv1) sign(du1 dv2 - du2 dv1), p and q being edges and (du1, dv1), (du2, dv2) what they
/// are in the texture, made square to the normal; where a texture says nothing, any such direction.
pub const MUSLIN_ATTRIBUTE_TANGENT: u32 = 2;
/// Its texture coordinates: u v.
pub const MUSLIN_ATTRIBUTE_UV: u32 = 3;
/// 1 at a border that a tear or a cut made, which a renderer may fringe, else 0; and another 0 in 16 bits.
pub const MUSLIN_ATTRIBUTE_FRAYED: u32 = 4;

/// 32-bit floats: 12 bytes of a position or normal, 16 of a tangent, 8 of a uv, 4 of frayed.
pub const MUSLIN_FORMAT_F32: u32 = 0;
/// 16-bit floats: 8 bytes, of a uv or frayed 4. What is beyond 65504 becomes that.
pub const MUSLIN_FORMAT_F16: u32 = 1;
/// 16-bit whole numbers from -32767 to 32767, which stand for -1 to 1: 8 bytes of a normal or tangent, 4
/// of frayed; nothing else.
pub const MUSLIN_FORMAT_SNORM16: u32 = 2;
/// A direction as two of those, x and y where it meets the octahedron |x| + |y| + |z| = 1, its lower
/// half (z < 0) folded outward, to (1 - |y|) sign(x) and (1 - |x|) sign(y): 4 bytes of a normal; 8 of a
/// tangent, those two, w and 0; nothing else.
pub const MUSLIN_FORMAT_OCTAHEDRAL16: u32 = 3;

/// How many streams one call takes.
pub const MUSLIN_MAX_STREAMS: u32 = 16;

/// For `vertex_count`: all from the first one on.
pub const MUSLIN_ALL_VERTICES: u32 = u32::MAX;

/// A place that one attribute of vertices is written to. Streams may share a buffer: interleaved, at
/// equal strides, or one behind the other. Begin with muslin_stream_init, or take muslin_stream.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinStream {
    /// Set by muslin_stream_init; equal for all streams of a call.
    pub struct_size: u32,
    /// What is written: MUSLIN_ATTRIBUTE_...; MUSLIN_ATTRIBUTE_POSITION.
    pub attribute: u32,
    /// How: MUSLIN_FORMAT_...; MUSLIN_FORMAT_F32.
    pub format: u32,
    /// Bytes from one vertex to the next: a multiple of the 4 (MUSLIN_FORMAT_F32) or 2 bytes of a number,
    /// and at least what the attribute takes; 0, which leaves no gaps.
    pub stride: u32,
    /// Where the first vertex goes, aligned to a number; NULL. It is yours, not a view's.
    pub buffer: *mut c_void,
    /// Bytes from there to the end of the buffer; 0.
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
    /// What is written and how; `at` says which of the streams it is.
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

/// Which vertices are written, and how they are placed. Begin with muslin_write_desc_init: all, as they
/// are.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct MuslinWriteDesc {
    /// Set by muslin_write_desc_init.
    pub struct_size: u32,
    /// The first vertex; 0. It goes to the beginning of each stream.
    pub first_vertex: u32,
    /// How many; MUSLIN_ALL_VERTICES.
    pub vertex_count: u32,
    /// How far from the last tick to this one, from 0 to 1; 1. The stats' `blend` is how far the time is
    /// that was asked for. Normals and tangents are those of the surface there.
    pub blend: f32,
    /// What is done to positions, after the offset: three rows of four, so that x becomes
    /// t[0] x + t[1] y + t[2] z + t[3]; nothing. Normals stay square to the surface and on their side of
    /// it, tangents along it.
    pub transform: [f32; 12],
    /// 1 if normals point to the other side, for the back of a cloth; 0.
    pub flip_normals: u32,
    /// How far positions are moved along the normals that are written [m]; 0. Half of the thickness on
    /// either side gives a cloth a body.
    pub offset: f32,
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
        }
    }
}

impl TryFrom<MuslinWriteDesc> for WriteDesc {
    type Error = CallError;

    fn try_from(desc: MuslinWriteDesc) -> Result<Self> {
        if desc.flip_normals > 1 {
            return Err(CallError::bad_value("flip_normals", "be 0 or 1"));
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
