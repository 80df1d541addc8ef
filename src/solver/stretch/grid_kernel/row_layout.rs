//! Where the rows of a grid lie in memory, for kernels that load and store without looking.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::simd::Simd;
use crate::model::grid_rows::{LinkRow, RowPattern};
use crate::solver::stretch::grid_links::{STRAIGHT, Sheet};

/// The fewest lanes that there are.
const FEWEST: usize = 4;

/// How many links of a row go in chunks: all, but for those of a row shorter than any chunk, and an
/// odd one where every two links belong together.
#[inline(always)]
pub(crate) fn in_chunks(row: &LinkRow) -> usize {
    chunked(row.count, row.pattern == RowPattern::Quads)
}

/// As `in_chunks`, of a row whose pattern is known.
#[inline(always)]
pub(crate) fn in_chunks_of<const PATTERN: u8>(row: &LinkRow) -> usize {
    chunked(row.count, PATTERN == RowPattern::Quads as u8)
}

#[inline(always)]
fn chunked(count: u32, is_in_twos: bool) -> usize {
    let count = if is_in_twos { count & !1 } else { count } as usize;
    if count < FEWEST { 0 } else { count }
}

/// Where the lists of a sheet begin.
#[derive(Clone, Copy)]
pub(crate) struct Lists {
    first_particle: u32,
    first_link: u32,
    /// How many particles there are, and links.
    particles: usize,
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

impl Lists {
    #[inline(always)]
    pub fn of(sheet: &mut Sheet<'_>) -> Self {
        let Sheet { first_particle, first_link, x, y, z, w, mask, rest, compliance, ends, lambda } =
            sheet;
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

    /// Where a row begins.
    ///
    /// # Panics
    /// If its first `count` links do not lie within the sheet.
    #[inline(always)]
    pub fn spot<const PATTERN: u8>(&self, row: &LinkRow, count: usize) -> Spot {
        // What lies before the sheet is far behind it then.
        let particle = |number: u32| number.wrapping_sub(self.first_particle) as usize;
        let b = if PATTERN == STRAIGHT { row.b } else { row.a };
        let link = row.first.wrapping_sub(self.first_link) as usize;
        let spot = Spot { a: particle(row.a), b: particle(b), link };
        let is_within = spot.a <= spot.b && self.have_room::<PATTERN>(spot, count);
        assert!(is_within, "rows lie within their sheet");
        spot
    }

    /// Whether there are so many links from a spot on, and particles at their ends.
    #[inline(always)]
    pub fn have_room<const PATTERN: u8>(&self, spot: Spot, links: usize) -> bool {
        let particles = if PATTERN == STRAIGHT { links } else { 2 * links };
        particles <= self.particles
            && spot.b <= self.particles - particles
            && links <= self.links
            && spot.link <= self.links - links
    }

    /// What a chunk from a spot on is about.
    ///
    /// # Safety
    /// It is in the lists, or right behind their ends.
    #[inline(always)]
    pub unsafe fn place<S: Simd, const PATTERN: u8>(&self, spot: Spot) -> Place {
        let b = if PATTERN == STRAIGHT { spot.b } else { spot.a + S::LANES };
        // SAFETY: the caller's promise; where ends alternate there are as many behind as before.
        unsafe { self.place_of(Spot { b, ..spot }) }
    }

    /// The same where the second half of particles is elsewhere.
    ///
    /// # Safety
    /// As for `place`, of both halves.
    #[inline(always)]
    pub unsafe fn place_of(&self, Spot { a, b, link }: Spot) -> Place {
        // SAFETY: the caller's promise.
        unsafe {
            Place {
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

/// A link of a row, and the particles at its ends; both the first of two where they alternate.
#[derive(Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Spot {
    pub a: usize,
    pub b: usize,
    pub link: usize,
}

impl Spot {
    /// As far on as another one is from the very first.
    #[inline(always)]
    pub fn behind(self, by: Self) -> Self {
        let Self { a, b, link } = self;
        Self { a: a.wrapping_add(by.a), b: b.wrapping_add(by.b), link: link.wrapping_add(by.link) }
    }

    /// Takes back what `behind` did; what is before the very first comes out as far behind all.
    #[inline(always)]
    pub fn before(self, by: Self) -> Self {
        let Self { a, b, link } = self;
        Self { a: a.wrapping_sub(by.a), b: b.wrapping_sub(by.b), link: link.wrapping_sub(by.link) }
    }

    /// So many links further on.
    #[inline(always)]
    pub fn after<const PATTERN: u8>(self, links: usize) -> Self {
        let ends = if PATTERN == STRAIGHT { links } else { 2 * links };
        Self { a: self.a + ends, b: self.b + ends, link: self.link + links }
    }
}

/// Where some links of a row lie, and the particles at their lower and upper ends; the first and
/// the second half of all where they alternate.
#[derive(Clone, Copy)]
pub(crate) struct Place {
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
