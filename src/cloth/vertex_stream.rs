//! Descriptions of vertex streams: which attribute is written where, in which format.
//!
//! A stream is what graphics APIs call a vertex attribute binding: base address, stride, format.
//!
//! Reads the caller's descriptions; `write_vertices` writes through `Stream::write`.
//! Invariant: streams that passed `check_all` lie inside their buffers and write no byte twice.

use crate::error::{Error, Result, check};
use crate::math::pack::BLOCK;
use core::cell::Cell;
use core::ops::Range;
use glam::Affine3;
use serde::{Deserialize, Serialize};

/// A vertex attribute that a stream receives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum Attribute {
    /// Position [m].
    #[default]
    Position = 0,
    /// Unit normal.
    Normal = 1,
    /// Unit tangent, perpendicular to the normal, in the direction of growing texture coordinate u;
    /// and the handedness w, 1 or −1: v grows along `cross(normal, tangent)` times w.
    Tangent = 2,
    /// Texture coordinates.
    Uv = 3,
    /// 1 on a border that a tear or cut made, else 0.
    Frayed = 4,
}

impl Attribute {
    /// All attributes, in numerical order.
    pub const ALL: [Self; 5] =
        [Self::Position, Self::Normal, Self::Tangent, Self::Uv, Self::Frayed];
}

/// Number format of a stream. 16-bit numbers have the byte order of the machine.
///
/// A format writes these components; an empty field means that it cannot write the attribute:
///
/// | | `F32` | `F16` | `Snorm16` | `Octahedral16` |
/// | --- | --- | --- | --- | --- |
/// | position | x y z | x y z 1 | | |
/// | normal | x y z | x y z 0 | x y z 0 | u v |
/// | tangent | x y z w | x y z w | x y z w | u v w 0 |
/// | uv | u v | u v | | |
/// | frayed | f | f 0 | f 0 | |
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum VertexFormat {
    /// 32-bit floats.
    #[default]
    F32 = 0,
    /// 16-bit floats. Values beyond ±65504 are clamped.
    F16 = 1,
    /// Signed 16-bit integers; −32767 to 32767 stand for −1 to 1.
    Snorm16 = 2,
    /// A unit vector in octahedral encoding, as two `Snorm16` numbers.
    ///
    /// The vector is projected onto the octahedron |x| + |y| + |z| = 1. The encoding is x and y,
    /// with the lower half (z < 0) folded outward: `u = (1 − |y|) · sign(x)`, `v = (1 − |x|) ·
    /// sign(y)`.
    Octahedral16 = 3,
}

impl VertexFormat {
    /// All formats, in numerical order.
    pub const ALL: [Self; 4] = [Self::F32, Self::F16, Self::Snorm16, Self::Octahedral16];

    /// Returns the size of one component [bytes].
    pub fn size(self) -> usize {
        if self == Self::F32 { 4 } else { 2 }
    }

    /// Returns the size of an attribute of one vertex [bytes]; `None` if the format cannot write
    /// it.
    pub fn width(self, attribute: Attribute) -> Option<usize> {
        use Attribute::{Frayed, Normal, Position, Tangent, Uv};
        match (attribute, self) {
            (Tangent, Self::F32) => Some(16),
            (Position | Normal, Self::F32) => Some(12),
            (Uv, Self::F32) => Some(8),
            (Frayed, Self::F32) => Some(4),
            (Tangent, _) | (Position | Normal, Self::F16) | (Normal, Self::Snorm16) => Some(8),
            (Normal, Self::Octahedral16) | (Uv, Self::F16) => Some(4),
            (Frayed, Self::F16 | Self::Snorm16) => Some(4),
            (Position | Uv, Self::Snorm16) | (Position | Uv | Frayed, Self::Octahedral16) => None,
        }
    }
}

/// A destination for one attribute: the first vertex goes to the start of `bytes`, each further one
/// `stride` bytes after the one before.
///
/// Streams may share a buffer, interleaved or one after the other; that is why the bytes are cells.
///
/// ```
/// use core::cell::Cell;
/// use muslin::{Attribute, Cloth, GridDesc, Stream, VertexFormat, WriteDesc};
///
/// let mut cloth = Cloth::grid(&GridDesc::default())?;
/// // Per vertex: x y z of the position, then the normal in four bytes.
/// let mut buffer = vec![0_u8; 16 * cloth.view().vertex_capacity as usize];
/// let bytes = Cell::from_mut(&mut buffer[..]).as_slice_of_cells();
/// let streams = [
///     Stream { attribute: Attribute::Position, format: VertexFormat::F32, stride: 16, bytes },
///     Stream {
///         attribute: Attribute::Normal,
///         format: VertexFormat::Octahedral16,
///         stride: 16,
///         bytes: &bytes[12..],
///     },
/// ];
/// cloth.write_vertices(&streams, &WriteDesc { blend: cloth.blend(), ..WriteDesc::default() })?;
/// # Ok::<(), muslin::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Stream<'a> {
    /// The attribute to write.
    pub attribute: Attribute,
    /// Its number format.
    pub format: VertexFormat,
    /// Distance between the starts of consecutive vertices [bytes], a multiple of the component
    /// size; 0 means tightly packed.
    pub stride: u32,
    /// The destination, aligned to the component size.
    pub bytes: &'a [Cell<u8>],
}

/// Largest number of streams in one call.
pub const MAX_STREAMS: usize = 16;

/// Value of [`WriteDesc::vertex_count`] that means all vertices from `first_vertex` on.
pub const ALL_VERTICES: u32 = u32::MAX;

/// Selects the vertices to write and how they are transformed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WriteDesc {
    /// First vertex to write; it goes to the start of each stream. Default 0.
    pub first_vertex: u32,
    /// Number of vertices to write. Default [`ALL_VERTICES`].
    pub vertex_count: u32,
    /// Time to draw, from 0 (last tick) to 1 (current tick); default 1. Pass
    /// [`Cloth::blend`](crate::Cloth::blend) for smooth motion. Normals and tangents belong to the
    /// interpolated surface.
    pub blend: f32,
    /// Transform of the positions, applied after the offset; default: identity. A transform that
    /// takes a cloth far from zero to a place near zero, e.g. to the space of a camera, loses no
    /// digits of the positions. Normals stay
    /// perpendicular to the surface and on their side of it; tangents stay in the surface.
    pub transform: Affine3,
    /// Whether normals point to the other side, e.g. for the back of the cloth. Default: no.
    pub flip_normals: bool,
    /// Distance by which positions are moved along the written normals [m]; default 0. Half of the
    /// thickness on either side gives the cloth a visible thickness.
    pub offset: f32,
    /// Whether positions are relative to [`Cloth::origin`](crate::Cloth::origin), also those that
    /// `transform` applies to. Default: no, they are absolute.
    pub relative: bool,
}

impl Default for WriteDesc {
    fn default() -> Self {
        Self {
            first_vertex: 0,
            vertex_count: ALL_VERTICES,
            blend: 1.0,
            transform: Affine3::IDENTITY,
            flip_normals: false,
            offset: 0.0,
            relative: false,
        }
    }
}

impl WriteDesc {
    /// Checks every field, and returns the range of vertices to write out of `vertices`.
    pub(crate) fn check(&self, vertices: usize) -> Result<Range<usize>> {
        let first = self.first_vertex as usize;
        check(first <= vertices, "first_vertex", "be at most the number of vertices")?;
        let count = match self.vertex_count {
            ALL_VERTICES => vertices - first,
            count => count as usize,
        };
        check(count <= vertices - first, "vertex_count", "not reach past the last vertex")?;
        check((0.0..=1.0).contains(&self.blend), "blend", "be from 0 to 1")?;
        check(self.transform.is_finite(), "transform", "be finite")?;
        check(self.offset.is_finite(), "offset", "be finite")?;
        Ok(first..first + count)
    }
}

impl Stream<'_> {
    /// Returns the size of one vertex [bytes]; 0 if the format cannot write the attribute.
    pub(crate) fn width(&self) -> usize {
        self.format.width(self.attribute).unwrap_or(0)
    }

    /// Returns the distance between the starts of consecutive vertices [bytes].
    fn effective_stride(&self) -> usize {
        if self.stride == 0 { self.width() } else { self.stride as usize }
    }

    /// Returns the bytes from the start of the first vertex to the end of the last, for `count`
    /// vertices.
    fn span(&self, count: usize) -> u64 {
        match count as u64 {
            0 => 0,
            count => (count - 1) * self.effective_stride() as u64 + self.width() as u64,
        }
    }

    /// Checks the fields of stream number `at` for `count` vertices.
    fn check(&self, at: usize, count: usize) -> Result<()> {
        let stream = at as u32;
        let check = |ok: bool, field, must| {
            if ok { Ok(()) } else { Err(Error::BadStream { stream, field, must }) }
        };
        let (size, width) = (self.format.size(), self.width());
        check(width > 0, "format", "be one that the attribute can be written in")?;
        let fits = self.effective_stride() >= width && self.effective_stride().is_multiple_of(size);
        check(
            fits,
            "stride",
            "be 0 or a multiple of the component size that holds the whole attribute",
        )?;
        let is_aligned = self.bytes.as_ptr().addr().is_multiple_of(size);
        check(
            is_aligned,
            "buffer",
            "be aligned to the component size: 4 bytes for 32-bit formats, 2 for 16-bit formats",
        )?;
        let (needed, size) = (self.span(count), self.bytes.len() as u64);
        if needed > size {
            return Err(Error::SmallStream { stream, needed, size });
        }
        Ok(())
    }

    /// Returns whether both streams would write the same byte.
    fn overlaps(&self, other: &Self, count: usize) -> bool {
        let (a, b) = (self.bytes.as_ptr().addr() as u64, other.bytes.as_ptr().addr() as u64);
        let are_disjoint = a + self.span(count) <= b || b + other.span(count) <= a;
        let stride = self.effective_stride() as u64;
        // Offset of the other stream's vertices within this stream's stride. It is the same for
        // every vertex if both strides are equal.
        let offset = (b as i64 - a as i64).rem_euclid(stride as i64) as u64;
        let are_interleaved = other.effective_stride() as u64 == stride
            && self.width() as u64 <= offset
            && offset + other.width() as u64 <= stride;
        !are_disjoint && !are_interleaved
    }

    /// Writes the components of at most one block of vertices, starting at vertex `first` of the
    /// stream.
    pub(crate) fn write<T: Copy, const SIZE: usize, const COUNT: usize>(
        &self,
        first: usize,
        count: usize,
        numbers: [&[T; BLOCK]; COUNT],
        bytes_of: impl Fn(T) -> [u8; SIZE],
    ) {
        let stride = self.effective_stride();
        let records = self.bytes[first * stride..].chunks(stride);
        for (k, record) in (0..count.min(BLOCK)).zip(records) {
            let cells = record.as_chunks::<SIZE>().0;
            let cells: &[[Cell<u8>; SIZE]] = &cells[..COUNT];
            for (cells, numbers) in cells.iter().zip(numbers) {
                let bytes = bytes_of(numbers[k]);
                cells.iter().zip(bytes).for_each(|(cell, byte)| cell.set(byte));
            }
        }
    }
}

/// Checks all streams for `count` vertices, and that no two overlap.
pub(crate) fn check_all(streams: &[Stream<'_>], count: usize) -> Result<()> {
    check((1..=MAX_STREAMS).contains(&streams.len()), "streams", "be from 1 to 16")?;
    for (at, stream) in streams.iter().enumerate() {
        stream.check(at, count)?;
        if streams[..at].iter().any(|other| count > 0 && other.overlaps(stream, count)) {
            return Err(Error::BadStream {
                stream: at as u32,
                field: "buffer",
                must: "be apart from the bytes of earlier streams, or interleaved at an equal stride",
            });
        }
    }
    Ok(())
}
