//! Where the rows of a grid lie in memory, for kernels that load and store without looking.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use super::rows::{STRAIGHT, Sheet};
use crate::fabric::rows::{Pattern, Row};

/// The fewest lanes that there are.
const FEWEST: usize = 4;

/// How many links of a row go in chunks: all, but for those of a row shorter than any chunk, and an
/// odd one where every two links belong together.
#[inline(always)]
pub(crate) fn in_chunks(row: &Row) -> usize {
    let count = row.count as usize;
    let even = if row.pattern == Pattern::Quads { count & !1 } else { count };
    if even < FEWEST { 0 } else { even }
}

/// Where the lists of a sheet begin.
#[derive(Clone, Copy)]
pub(crate) struct Lists {
    first_particle: u32,
    first_link: u32,
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
    /// # Panics
    /// If a row's chunks do not lie within the sheet.
    #[inline(always)]
    pub fn of(rows: &[Row], sheet: &mut Sheet<'_>) -> Self {
        let Sheet { first_particle, first_link, x, y, z, w, mask, rest, compliance, ends, lambda } =
            sheet;
        let particles = w.len().min(x.len()).min(y.len()).min(z.len());
        let links = rest.len().min(mask.len()).min(compliance.len()).min(lambda.len());
        let links = links.min(ends[0].len()).min(ends[1].len());
        let (particles, links) = (particles as u64, links as u64);
        for row in rows {
            let count = in_chunks(row) as u64;
            let end = if row.pattern == Pattern::Straight { row.b } else { row.a };
            let wide = if row.pattern == Pattern::Straight { count } else { 2 * count };
            let is_within = row.a >= *first_particle
                && row.a <= row.b
                && row.first >= *first_link
                && u64::from(end - *first_particle) + wide <= particles
                && u64::from(row.first - *first_link) + count <= links;
            assert!(is_within, "rows lie within their sheet");
        }
        Self {
            first_particle: *first_particle,
            first_link: *first_link,
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
    #[inline(always)]
    pub fn place<const PATTERN: u8>(&self, row: &Row) -> Place {
        let first = (row.first - self.first_link) as usize;
        let a = (row.a - self.first_particle) as usize;
        let b = if PATTERN == STRAIGHT { (row.b - self.first_particle) as usize } else { a };
        Place {
            x: [self.x.wrapping_add(a), self.x.wrapping_add(b)],
            y: [self.y.wrapping_add(a), self.y.wrapping_add(b)],
            z: [self.z.wrapping_add(a), self.z.wrapping_add(b)],
            w: [self.w.wrapping_add(a), self.w.wrapping_add(b)],
            mask: self.mask.wrapping_add(first),
            rest: self.rest.wrapping_add(first),
            compliance: self.compliance.wrapping_add(first),
            ends: [self.ends[0].wrapping_add(first), self.ends[1].wrapping_add(first)],
            lambda: self.lambda.wrapping_add(first),
        }
    }
}

/// Where some links of a row lie, and the particles at their lower and upper ends; both in the first
/// of two where they alternate.
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

impl Place {
    /// So many links further on.
    ///
    /// # Safety
    /// The row has as many from here.
    #[inline(always)]
    pub unsafe fn after<const PATTERN: u8>(self, links: usize) -> Self {
        let ends = if PATTERN == STRAIGHT { links } else { 2 * links };
        let Self { x: [xa, xb], y: [ya, yb], z: [za, zb], w: [wa, wb], .. } = self;
        // SAFETY: the caller's promise, and that of `Lists::of`.
        unsafe {
            Self {
                x: [xa.add(ends), xb.add(ends)],
                y: [ya.add(ends), yb.add(ends)],
                z: [za.add(ends), zb.add(ends)],
                w: [wa.add(ends), wb.add(ends)],
                mask: self.mask.add(links),
                rest: self.rest.add(links),
                compliance: self.compliance.add(links),
                ends: [self.ends[0].add(links), self.ends[1].add(links)],
                lambda: self.lambda.add(links),
            }
        }
    }
}
