//! Pointers to the rows of a grid: each row is checked once, then chunks load and store unchecked.
//!
//! ```text
//! RowPattern::Straight       a: ● ● ● ●  (contiguous)     b: ● ● ● ●  (contiguous)
//! RowPattern::Pairs, Quads   a and b alternate in one contiguous run: [ low half │ high half ]
//! ```
//! So a chunk of L links touches two runs of L particles. In a straight row these begin at a and at
//! b; in other rows they are the low and the high half of 2 L neighbours.
//!
//! Reads `GridSlices` and `LinkRow`; writes nothing.
//! Invariant: a cursor that `GridPointers::cursor` returned has `count` links, and the particles at
//! their ends, within the slices.

// Where there is no SIMD, only the scalar path is used.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::simd::Simd;
use crate::model::grid_rows::{LinkRow, RowPattern};
use crate::solver::stretch::grid_kernel::grid_slices::{GridSlices, QUADS, STRAIGHT};

/// The number of lanes of the smallest vector.
const MIN_LANES: usize = 4;

/// The number of links of a row that go through SIMD chunks: all of them, except an odd last one of
/// a row of quads, and those of a row that is shorter than the smallest chunk.
#[inline(always)]
pub(crate) fn simd_link_count(row: &LinkRow) -> usize {
    round_down(row.count, row.pattern == RowPattern::Quads)
}

/// As [`simd_link_count`], for a row whose pattern is known at compile time.
#[inline(always)]
pub(crate) fn simd_link_count_of<const PATTERN: u8>(row: &LinkRow) -> usize {
    round_down(row.count, PATTERN == QUADS)
}

#[inline(always)]
fn round_down(count: u32, is_paired: bool) -> usize {
    let count = if is_paired { count & !1 } else { count } as usize;
    if count < MIN_LANES { 0 } else { count }
}

/// The addresses of the columns of `GridSlices`.
#[derive(Clone, Copy)]
pub(crate) struct GridPointers {
    first_particle: u32,
    first_link: u32,
    /// The number of particles.
    particles: usize,
    /// The number of links.
    links: usize,
    x: *mut f32,
    y: *mut f32,
    z: *mut f32,
    w: *const f32,
    mask: *const f32,
    rest: *const f32,
    compliance: *const f32,
    ends: [*const f32; 2],
    lambda: *mut f32,
}

impl GridPointers {
    #[inline(always)]
    pub fn new(slices: &mut GridSlices<'_>) -> Self {
        let GridSlices {
            first_particle,
            first_link,
            x,
            y,
            z,
            w,
            mask,
            rest,
            compliance,
            ends,
            lambda,
        } = slices;
        let particles = w.len().min(x.len()).min(y.len()).min(z.len());
        let links = rest.len().min(mask.len()).min(compliance.len()).min(lambda.len());
        Self {
            first_particle: *first_particle,
            first_link: *first_link,
            particles,
            links: links.min(ends[0].len()).min(ends[1].len()),
            x: x.as_mut_ptr(),
            y: y.as_mut_ptr(),
            z: z.as_mut_ptr(),
            w: w.as_ptr(),
            mask: mask.as_ptr(),
            rest: rest.as_ptr(),
            compliance: compliance.as_ptr(),
            ends: ends.map(<[f32]>::as_ptr),
            lambda: lambda.as_mut_ptr(),
        }
    }

    /// The cursor at the first link of a row.
    ///
    /// # Panics
    /// If its first `count` links do not lie within the slices.
    #[inline(always)]
    pub fn cursor<const PATTERN: u8>(&self, row: &LinkRow, count: usize) -> RowCursor {
        // An index before the slices wraps around and fails the check below.
        let particle = |number: u32| number.wrapping_sub(self.first_particle) as usize;
        let b = if PATTERN == STRAIGHT { row.b } else { row.a };
        let link = row.first.wrapping_sub(self.first_link) as usize;
        let cursor = RowCursor { a: particle(row.a), b: particle(b), link };
        let is_within = cursor.a <= cursor.b && self.contains::<PATTERN>(cursor, count);
        assert!(is_within, "every row lies within the slices of its thread");
        cursor
    }

    /// Whether the slices contain `count` links from a cursor on, and the particles at their ends.
    #[inline(always)]
    pub fn contains<const PATTERN: u8>(&self, cursor: RowCursor, links: usize) -> bool {
        let particles = if PATTERN == STRAIGHT { links } else { 2 * links };
        particles <= self.particles
            && cursor.b <= self.particles - particles
            && links <= self.links
            && cursor.link <= self.links - links
    }

    /// The pointers of the chunk at a cursor.
    ///
    /// # Safety
    /// The cursor is within the slices, or at their ends.
    #[inline(always)]
    pub unsafe fn chunk<S: Simd, const PATTERN: u8>(&self, cursor: RowCursor) -> ChunkPointers {
        let b = if PATTERN == STRAIGHT { cursor.b } else { cursor.a + S::LANES };
        // SAFETY: the caller guarantees it; where ends alternate, the high half follows the low
        // half.
        unsafe { self.chunk_of_halves(RowCursor { b, ..cursor }) }
    }

    /// The pointers of a chunk whose high half begins at `b`.
    ///
    /// # Safety
    /// Both halves are within the slices, or at their ends.
    #[inline(always)]
    pub unsafe fn chunk_of_halves(&self, RowCursor { a, b, link }: RowCursor) -> ChunkPointers {
        // SAFETY: the caller guarantees it.
        unsafe {
            ChunkPointers {
                x: [self.x.add(a), self.x.add(b)],
                y: [self.y.add(a), self.y.add(b)],
                z: [self.z.add(a), self.z.add(b)],
                w: [self.w.add(a), self.w.add(b)],
                mask: self.mask.add(link),
                rest: self.rest.add(link),
                compliance: self.compliance.add(link),
                ends: [self.ends[0].add(link), self.ends[1].add(link)],
                lambda: self.lambda.add(link),
            }
        }
    }
}

/// The index of a link of a row and of the particles at its ends. Where ends alternate, `a` and `b`
/// are both the first particle of the run. Also the difference of two such cursors.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct RowCursor {
    pub a: usize,
    pub b: usize,
    pub link: usize,
}

impl RowCursor {
    /// Adds a difference.
    #[inline(always)]
    pub fn offset_by(self, by: Self) -> Self {
        let Self { a, b, link } = self;
        Self { a: a.wrapping_add(by.a), b: b.wrapping_add(by.b), link: link.wrapping_add(by.link) }
    }

    /// Subtracts a difference, wrapping around below 0; `offset_by` wraps back.
    #[inline(always)]
    pub fn minus(self, by: Self) -> Self {
        let Self { a, b, link } = self;
        Self { a: a.wrapping_sub(by.a), b: b.wrapping_sub(by.b), link: link.wrapping_sub(by.link) }
    }

    /// The cursor that many links further on.
    #[inline(always)]
    pub fn advance<const PATTERN: u8>(self, links: usize) -> Self {
        let particles = if PATTERN == STRAIGHT { links } else { 2 * links };
        Self { a: self.a + particles, b: self.b + particles, link: self.link + links }
    }
}

/// Pointers to the links of a chunk, and to the two runs of particles at their ends: lower and
/// upper ends of a straight row, the low and the high half of one run otherwise.
#[derive(Clone, Copy)]
pub(crate) struct ChunkPointers {
    pub x: [*mut f32; 2],
    pub y: [*mut f32; 2],
    pub z: [*mut f32; 2],
    pub w: [*const f32; 2],
    pub mask: *const f32,
    pub rest: *const f32,
    pub compliance: *const f32,
    pub ends: [*const f32; 2],
    pub lambda: *mut f32,
}
