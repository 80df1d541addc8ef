//! Streams: places in the caller's buffers that vertices are written to, and what is written there.

use crate::error::{Error, Result, check};
use crate::math::pack::BLOCK;
use core::cell::Cell;
use core::ops::Range;
use glam::Affine3;
use serde::{Deserialize, Serialize};

/// What of a vertex a stream takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum Attribute {
    /// Where it is [m].
    #[default]
    Position = 0,
    /// Its unit normal.
    Normal = 1,
    /// The unit direction square to the normal in which the texture coordinate u grows, and 1 or -1: v
    /// grows along `cross(normal, tangent)` times that.
    Tangent = 2,
    /// Its texture coordinates.
    Uv = 3,
    /// 1 at a border that a tear or a cut made, which a renderer may fringe; else 0.
    Frayed = 4,
}

impl Attribute {
    /// Every attribute, in the order of their numbers.
    pub const ALL: [Self; 5] =
        [Self::Position, Self::Normal, Self::Tangent, Self::Uv, Self::Frayed];
}

/// How a stream writes numbers; 16 bits as the machine keeps numbers of that width.
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
    /// 16-bit floats; what is beyond 65504 becomes that.
    F16 = 1,
    /// 16-bit whole numbers from -32767 to 32767, which stand for -1 to 1.
    Snorm16 = 2,
    /// A direction as two of those: x and y where it meets the octahedron |x| + |y| + |z| = 1, the lower
    /// half (z < 0) folded outward: `u = (1 - |y|) · sign x`, `v = (1 - |x|) · sign y`.
    Octahedral16 = 3,
}

impl VertexFormat {
    /// Every format, in the order of their numbers.
    pub const ALL: [Self; 4] = [Self::F32, Self::F16, Self::Snorm16, Self::Octahedral16];

    /// Bytes of one number.
    pub fn size(self) -> usize {
        if self == Self::F32 { 4 } else { 2 }
    }

    /// Bytes that an attribute of one vertex takes; `None` if it is not written so.
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

/// A place that one attribute of vertices is written to: the first vertex at the beginning of `bytes`,
/// each other one `stride` bytes behind the one before.
///
/// Streams may share a buffer, interleaved or one behind the other; so bytes are cells.
///
/// ```
/// use core::cell::Cell;
/// use muslin::{Attribute, Cloth, GridDesc, Stream, VertexFormat, WriteDesc};
///
/// let mut cloth = Cloth::grid(&GridDesc::default())?;
/// // x y z of the position, then the normal in four bytes.
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
    /// What is written.
    pub attribute: Attribute,
    /// How.
    pub format: VertexFormat,
    /// Bytes from one vertex to the next, a multiple of what a number takes; 0 leaves no gaps.
    pub stride: u32,
    /// Where, aligned to what a number takes.
    pub bytes: &'a [Cell<u8>],
}

/// How many streams are written at once, at most.
pub const MAX_STREAMS: usize = 16;

/// For `vertex_count`: all from the first one on.
pub const ALL_VERTICES: u32 = u32::MAX;

/// Which vertices are written, and how they are placed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct WriteDesc {
    /// The first vertex; 0. It goes to the beginning of each stream.
    pub first_vertex: u32,
    /// How many; [`ALL_VERTICES`].
    pub vertex_count: u32,
    /// How far from the last tick to this one, from 0 to 1; 1. [`Cloth::blend`](crate::Cloth::blend) tells
    /// how far the time is that was asked for. Normals and tangents are those of the surface there.
    pub blend: f32,
    /// What is done to positions, after the offset; nothing. Normals stay square to the surface and on
    /// their side of it, tangents along it.
    pub transform: Affine3,
    /// Whether normals point to the other side, for the back of a cloth; no.
    pub flip_normals: bool,
    /// How far positions are moved along the normals that are written [m]; 0. Half of the thickness on
    /// either side gives a cloth a body.
    pub offset: f32,
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
        }
    }
}

impl WriteDesc {
    /// The vertices that it asks for, of so many.
    pub(crate) fn check(&self, vertices: usize) -> Result<Range<usize>> {
        let first = self.first_vertex as usize;
        check(first <= vertices, "first_vertex", "be at most the number of vertices")?;
        let count = match self.vertex_count {
            ALL_VERTICES => vertices - first,
            count => count as usize,
        };
        check(count <= vertices - first, "vertex_count", "end at the last vertex, or before")?;
        check((0.0..=1.0).contains(&self.blend), "blend", "be from 0 to 1")?;
        check(self.transform.is_finite(), "transform", "be finite")?;
        check(self.offset.is_finite(), "offset", "be finite")?;
        Ok(first..first + count)
    }
}

impl Stream<'_> {
    /// Bytes that a vertex takes; 0 of what is not written so.
    pub(crate) fn width(&self) -> usize {
        self.format.width(self.attribute).unwrap_or(0)
    }

    fn step(&self) -> usize {
        if self.stride == 0 { self.width() } else { self.stride as usize }
    }

    /// Bytes from the beginning of the first of so many vertices to the end of the last.
    fn span(&self, count: usize) -> u64 {
        match count as u64 {
            0 => 0,
            count => (count - 1) * self.step() as u64 + self.width() as u64,
        }
    }

    fn check(&self, at: usize, count: usize) -> Result<()> {
        let stream = at as u32;
        let check = |ok: bool, field, must| {
            if ok { Ok(()) } else { Err(Error::BadStream { stream, field, must }) }
        };
        let (size, width) = (self.format.size(), self.width());
        check(width > 0, "format", "be one that its attribute is written in")?;
        let fits = self.step() >= width && self.step().is_multiple_of(size);
        check(fits, "stride", "be 0 or a multiple of a number's size that holds the attribute")?;
        let is_aligned = self.bytes.as_ptr().addr().is_multiple_of(size);
        check(
            is_aligned,
            "buffer",
            "be aligned to the size of a number: 4 bytes, or 2 of 16 bits",
        )?;
        let (needed, size) = (self.span(count), self.bytes.len() as u64);
        if needed > size {
            return Err(Error::SmallStream { stream, needed, size });
        }
        Ok(())
    }

    /// Whether a byte that this one writes is also written by another.
    fn meets(&self, other: &Self, count: usize) -> bool {
        let (a, b) = (self.bytes.as_ptr().addr() as u64, other.bytes.as_ptr().addr() as u64);
        let apart = a + self.span(count) <= b || b + other.span(count) <= a;
        let step = self.step() as u64;
        // How far behind one of its vertices the other's begin: where both take equal steps, they are
        // always as far.
        let behind = (b as i64 - a as i64).rem_euclid(step as i64) as u64;
        let interleaved = other.step() as u64 == step
            && self.width() as u64 <= behind
            && behind + other.width() as u64 <= step;
        !apart && !interleaved
    }

    /// Writes numbers of at most a block of vertices, the first of them vertex `first` of the stream.
    pub(crate) fn put<T: Copy, const SIZE: usize, const COUNT: usize>(
        &self,
        first: usize,
        count: usize,
        numbers: [&[T; BLOCK]; COUNT],
        bytes_of: impl Fn(T) -> [u8; SIZE],
    ) {
        let step = self.step();
        let places = self.bytes[first * step..].chunks(step);
        for (k, place) in (0..count.min(BLOCK)).zip(places) {
            let cells = place.as_chunks::<SIZE>().0;
            let cells: &[[Cell<u8>; SIZE]] = &cells[..COUNT];
            for (cells, numbers) in cells.iter().zip(numbers) {
                let bytes = bytes_of(numbers[k]);
                cells.iter().zip(bytes).for_each(|(cell, byte)| cell.set(byte));
            }
        }
    }
}

/// Refuses streams that cannot all be written.
pub(crate) fn check_all(streams: &[Stream<'_>], count: usize) -> Result<()> {
    check((1..=MAX_STREAMS).contains(&streams.len()), "streams", "be from 1 to 16")?;
    for (at, stream) in streams.iter().enumerate() {
        stream.check(at, count)?;
        if streams[..at].iter().any(|other| count > 0 && other.meets(stream, count)) {
            return Err(Error::BadStream {
                stream: at as u32,
                field: "buffer",
                must: "be apart from those of the streams before, or interleaved at equal strides",
            });
        }
    }
    Ok(())
}
