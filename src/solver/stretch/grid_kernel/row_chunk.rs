//! One chunk: as many links of a grid's row as there are lanes.
//!
//! ```text
//! load                two runs of particles, weights, rest lengths, compliances, λ
//! deinterleave        to lower and upper ends (not straight rows); links are permuted likewise
//! compute_correction  see link_projection
//! interleave          back to the order in memory
//! store               both runs, λ
//! ```
//! A chunk has two phases, `compute` and `apply`. Chunks are independent, so the processor can
//! start the next chunk while it waits for the division of the current one. (Two chunks in one loop
//! body would make WebAssembly engines run out of registers.)
//!
//! Reads and writes through `ChunkPointers`.
//! Invariant: lanes outside `mask` are stored with the bits that they had.

// Where there is no SIMD, only the scalar path is used.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::simd::{Baseline, Float, MAX_LANES, Simd};
use crate::solver::stretch::grid_kernel::grid_slices::{PAIRS, STRAIGHT};
use crate::solver::stretch::grid_kernel::row_layout::{ChunkPointers, GridPointers, RowCursor};
use crate::solver::stretch::link_projection::{BOUND, RIGID, SOFT, compute_correction};

/// The parameters that all links of a row share.
#[derive(Clone, Copy)]
pub(crate) struct RowParameters {
    /// As in `link_projection::compute_correction`.
    pub scale: f32,
    /// The rest length of rigid links [m]. Under the other laws each link has its own: damping
    /// changes it.
    pub rest: f32,
}

/// The computed correction of the links of a chunk, in the order of the deinterleaved ends.
#[derive(Clone, Copy)]
pub(crate) struct LinkChunk<F> {
    /// The two runs of positions, in the order in memory.
    ends: [[F; 2]; 3],
    /// From the lower to the upper end of each link.
    span: [F; 3],
    /// The shares of the span that lower ends move along it, and upper ends against it.
    shares: [F; 2],
    /// The new multipliers.
    lambda: F,
}

impl<F: Float> LinkChunk<F> {
    /// Computes the corrections of a chunk of links.
    ///
    /// # Safety
    /// The pointers are valid for `S::LANES` links and particles each, and no other thread writes
    /// there.
    #[inline(always)]
    pub unsafe fn compute<const LAW: u8, const PATTERN: u8, const IS_EVEN: bool>(
        s: impl Simd<F = F>,
        at: ChunkPointers,
        RowParameters { scale, rest }: RowParameters,
    ) -> Self {
        let zero = s.splat(0.0);
        // SAFETY: the caller guarantees it.
        unsafe {
            let rest = if LAW == RIGID {
                s.splat(rest)
            } else {
                to_end_order::<_, PATTERN>(s, s.load_from(at.rest))
            };
            let (mut compliance, mut lambda) = (zero, zero);
            if LAW == SOFT {
                compliance = to_end_order::<_, PATTERN>(s, s.load_from(at.compliance));
                lambda = to_end_order::<_, PATTERN>(s, s.load_from(at.lambda));
            }
            let x = load_halves(s, read_only(at.x));
            let y = load_halves(s, read_only(at.y));
            let z = load_halves(s, read_only(at.z));
            let ((xa, xb), (ya, yb)) =
                (split_ends::<_, PATTERN>(s, x), split_ends::<_, PATTERN>(s, y));
            let (za, zb) = split_ends::<_, PATTERN>(s, z);
            let weights = if LAW == BOUND {
                split_ends::<_, PATTERN>(s, load_halves(s, at.w)).into()
            } else if IS_EVEN {
                // Equal weights of rigid links are 1.
                let one = s.splat(1.0);
                [if LAW == RIGID {
                    one
                } else {
                    to_end_order::<_, PATTERN>(s, s.load_from(at.ends[0]))
                }; 2]
            } else {
                [
                    to_end_order::<_, PATTERN>(s, s.load_from(at.ends[0])),
                    to_end_order::<_, PATTERN>(s, s.load_from(at.ends[1])),
                ]
            };
            let span = [xb - xa, yb - ya, zb - za];
            let (shares, lambda) =
                compute_correction::<LAW, _>(s, span, weights, rest, compliance, lambda, scale);
            Self { ends: [x, y, z], span, shares, lambda }
        }
    }

    /// The mask of the links that are still in the row, without the first `done` links.
    ///
    /// # Safety
    /// As for [`LinkChunk::compute`].
    #[inline(always)]
    pub unsafe fn row_mask(s: impl Simd<F = F>, at: ChunkPointers, done: usize) -> F {
        // SAFETY: the caller guarantees it.
        unsafe { s.select_or_zero(s.load(&MASKS, MAX_LANES - done), s.load_from(at.mask)) }
    }

    /// The mask of the first `count` links.
    #[inline(always)]
    pub fn first_mask(s: impl Simd<F = F>, count: usize) -> F {
        s.load(&MASKS, 2 * MAX_LANES - count)
    }

    /// Applies the corrections of all links.
    ///
    /// # Safety
    /// As for [`LinkChunk::compute`].
    #[inline(always)]
    pub unsafe fn apply<const LAW: u8, const PATTERN: u8>(
        self,
        s: impl Simd<F = F>,
        at: ChunkPointers,
    ) {
        // SAFETY: the caller guarantees it.
        unsafe { self.store::<LAW, PATTERN, false>(s, at, self.lambda) }
    }

    /// Applies the corrections of the links in `mask`, which is in the order in memory; all other
    /// numbers are stored unchanged.
    ///
    /// # Safety
    /// As for [`LinkChunk::compute`].
    #[inline(always)]
    pub unsafe fn apply_masked<const LAW: u8, const PATTERN: u8>(
        self,
        s: impl Simd<F = F>,
        at: ChunkPointers,
        mask: F,
    ) {
        let mask = to_end_order::<_, PATTERN>(s, mask);
        // SAFETY: the caller guarantees it.
        unsafe { self.store::<LAW, PATTERN, true>(s, at, mask) }
    }

    #[inline(always)]
    unsafe fn store<const LAW: u8, const PATTERN: u8, const MASKED: bool>(
        self,
        s: impl Simd<F = F>,
        at: ChunkPointers,
        mask: F,
    ) {
        let Self { ends: [x, y, z], span: [dx, dy, dz], shares, lambda } = self;
        // SAFETY: the caller guarantees it.
        unsafe {
            if LAW == SOFT {
                let lambda = if MASKED {
                    let old = to_end_order::<_, PATTERN>(s, s.load_from(at.lambda));
                    s.select(mask, lambda, old)
                } else {
                    lambda
                };
                let lambda = if PATTERN == STRAIGHT { lambda } else { s.unshuffle(lambda) };
                s.store_to(at.lambda, lambda);
            }
            let x = corrected::<_, PATTERN, MASKED>(s, x, dx, shares, mask);
            let y = corrected::<_, PATTERN, MASKED>(s, y, dy, shares, mask);
            let z = corrected::<_, PATTERN, MASKED>(s, z, dz, shares, mask);
            for (to, [low, high]) in [(at.x, x), (at.y, y), (at.z, z)] {
                s.store_to(to[0], low);
                s.store_to(to[1], high);
            }
        }
    }
}

/// Permutes one number per link to the order that the ends have after they are deinterleaved.
#[inline(always)]
fn to_end_order<S: Simd, const PATTERN: u8>(s: S, v: S::F) -> S::F {
    if PATTERN == STRAIGHT { v } else { s.shuffle(v) }
}

/// As many zeros as a vector has lanes at most, as many ones, as many zeros: a vector that is
/// loaded across a border is the mask of a number of first or last lanes.
const MASKS: [f32; 3 * MAX_LANES] = {
    let mut masks = [0.0; 3 * MAX_LANES];
    let mut at = MAX_LANES;
    while at < 2 * MAX_LANES {
        masks[at] = 1.0;
        at += 1;
    }
    masks
};

#[inline(always)]
fn read_only([a, b]: [*mut f32; 2]) -> [*const f32; 2] {
    [a, b]
}

/// Loads the two runs of one column.
///
/// # Safety
/// As for [`LinkChunk::compute`].
#[inline(always)]
unsafe fn load_halves<S: Simd>(s: S, [a, b]: [*const f32; 2]) -> [S::F; 2] {
    // SAFETY: the caller guarantees it.
    unsafe { [s.load_from(a), s.load_from(b)] }
}

/// Splits the two runs of one column into lower and upper ends.
#[inline(always)]
fn split_ends<S: Simd, const PATTERN: u8>(s: S, [low, high]: [S::F; 2]) -> (S::F, S::F) {
    match PATTERN {
        STRAIGHT => (low, high),
        PAIRS => s.deinterleave(low, high),
        _ => s.deinterleave_pairs(low, high),
    }
}

/// The two runs of one column after the correction: lower ends move along the span by their share,
/// upper ends against it.
#[inline(always)]
fn corrected<S: Simd, const PATTERN: u8, const MASKED: bool>(
    s: S,
    [low, high]: [S::F; 2],
    span: S::F,
    [to_a, to_b]: [S::F; 2],
    mask: S::F,
) -> [S::F; 2] {
    // Adding −0 or subtracting +0 changes no number, not even the sign of a zero.
    let (nothing, zero) = (s.splat(-0.0), s.splat(0.0));
    let masked = |v: S::F, unchanged: S::F| if MASKED { s.select(mask, v, unchanged) } else { v };
    if PATTERN == STRAIGHT {
        let (added, subtracted) = (masked(span * to_a, nothing), masked(span * to_b, zero));
        return [low + added, high - subtracted];
    }
    let against = to_b * s.splat(-1.0);
    let (to_a, to_b) = (masked(span * to_a, nothing), masked(span * against, nothing));
    let (to_low, to_high) =
        if PATTERN == PAIRS { s.interleave(to_a, to_b) } else { s.deinterleave_pairs(to_a, to_b) };
    [low + to_low, high + to_high]
}

/// Solves links `done` to `count` of a row, if there are any, with the smallest vectors.
///
/// The last chunk overlaps with links that are done and masks them, because nothing may lie behind
/// the row. Few rows need it, so that one version serves all instruction sets.
///
/// # Safety
/// The row lies within the slices, and has none or at least `Baseline::LANES` links.
#[inline(never)]
pub(crate) unsafe fn solve_row_tail<const LAW: u8, const PATTERN: u8>(
    pointers: &GridPointers,
    row: RowCursor,
    mut done: usize,
    count: usize,
    parameters: RowParameters,
) {
    let s = Baseline::new();
    while done < count {
        let from = done.min(count - Baseline::LANES);
        // SAFETY: the caller guarantees it.
        unsafe {
            let at = pointers.chunk::<Baseline, PATTERN>(row.advance::<PATTERN>(from));
            let chunk = LinkChunk::compute::<LAW, PATTERN, false>(s, at, parameters);
            let mask = LinkChunk::row_mask(s, at, done - from);
            chunk.apply_masked::<LAW, PATTERN>(s, at, mask);
        }
        done = from + Baseline::LANES;
    }
}
