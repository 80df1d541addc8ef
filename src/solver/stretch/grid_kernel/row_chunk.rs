//! As many links of a grid's row as there are lanes.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use crate::math::simd::{Float, MAX_LANES, Simd};
use crate::model::grid_rows::RowPattern;
use crate::solver::stretch::grid_kernel::row_layout::Place;
use crate::solver::stretch::grid_links::STRAIGHT;
use crate::solver::stretch::link_projection::{BOUND, RIGID, SOFT, compute_correction};

const PAIRS: u8 = RowPattern::Pairs as u8;

/// What all links of a row have in common.
#[derive(Clone, Copy)]
pub(crate) struct Terms {
    /// As `links::correct` has it.
    pub scale: f32,
    /// The length at rest of those that do not give way; others have what their substep gives them.
    pub rest: f32,
}

/// Links that are about to be solved: where their ends are, what leads from the lower to the upper
/// ones, the shares of it that these are to move by, and the links' multipliers then; as dealt but
/// for the ends.
///
/// Chunks have nothing to do with each other, so processors go on with the next while they wait for
/// a division. Engines run out of registers if code says so too.
#[derive(Clone, Copy)]
pub(crate) struct Chunk<F> {
    /// The positions of both halves of all ends, as they lie in memory.
    ends: [[F; 2]; 3],
    span: [F; 3],
    /// Lower ends move along the span, upper ones against it.
    shares: [F; 2],
    lambda: F,
}

impl<F: Float> Chunk<F> {
    /// Looks at links.
    ///
    /// # Safety
    /// There are as many at that place, which nobody else writes to; so for all that follow.
    #[inline(always)]
    pub unsafe fn of<const LAW: u8, const PATTERN: u8, const IS_EVEN: bool>(
        s: impl Simd<F = F>,
        place: Place,
        Terms { scale, rest }: Terms,
    ) -> Self {
        let zero = s.splat(0.0);
        // SAFETY: the caller's promise.
        unsafe {
            let rest = if LAW == RIGID {
                s.splat(rest)
            } else {
                in_order::<_, PATTERN>(s, s.load_from(place.rest))
            };
            let (mut compliance, mut lambda) = (zero, zero);
            if LAW == SOFT {
                compliance = in_order::<_, PATTERN>(s, s.load_from(place.compliance));
                lambda = in_order::<_, PATTERN>(s, s.load_from(place.lambda));
            }
            let x = halves(s, fixed(place.x));
            let y = halves(s, fixed(place.y));
            let z = halves(s, fixed(place.z));
            let ((xa, xb), (ya, yb)) = (dealt::<_, PATTERN>(s, x), dealt::<_, PATTERN>(s, y));
            let (za, zb) = dealt::<_, PATTERN>(s, z);
            let weights = if LAW == BOUND {
                dealt::<_, PATTERN>(s, halves(s, place.w)).into()
            } else if IS_EVEN {
                // Those of rigid links are 1 then.
                let one = s.splat(1.0);
                [if LAW == RIGID {
                    one
                } else {
                    in_order::<_, PATTERN>(s, s.load_from(place.ends[0]))
                }; 2]
            } else {
                [
                    in_order::<_, PATTERN>(s, s.load_from(place.ends[0])),
                    in_order::<_, PATTERN>(s, s.load_from(place.ends[1])),
                ]
            };
            let span = [xb - xa, yb - ya, zb - za];
            let (shares, lambda) =
                compute_correction::<LAW, _>(s, span, weights, rest, compliance, lambda, scale);
            Self { ends: [x, y, z], span, shares, lambda }
        }
    }

    /// Which links are still in the row, but for the first `done`.
    #[inline(always)]
    pub unsafe fn in_row(s: impl Simd<F = F>, place: Place, done: usize) -> F {
        // SAFETY: the caller's promise.
        unsafe { s.select_or_zero(s.load(&COUNTS, MAX_LANES - done), s.load_from(place.mask)) }
    }

    /// The first `count` links.
    #[inline(always)]
    pub fn first(s: impl Simd<F = F>, count: usize) -> F {
        s.load(&COUNTS, 2 * MAX_LANES - count)
    }

    /// Moves the ends of all links.
    #[inline(always)]
    pub unsafe fn finish<const LAW: u8, const PATTERN: u8>(
        self,
        s: impl Simd<F = F>,
        place: Place,
    ) {
        // SAFETY: the caller's promise.
        unsafe { self.store::<LAW, PATTERN, false>(s, place, self.lambda) }
    }

    /// The same of those links alone that are to be kept, as they lie in memory; what is beyond is
    /// written anew as it was.
    #[inline(always)]
    pub unsafe fn finish_only<const LAW: u8, const PATTERN: u8>(
        self,
        s: impl Simd<F = F>,
        place: Place,
        keep: F,
    ) {
        let keep = in_order::<_, PATTERN>(s, keep);
        // SAFETY: the caller's promise.
        unsafe { self.store::<LAW, PATTERN, true>(s, place, keep) }
    }

    #[inline(always)]
    unsafe fn store<const LAW: u8, const PATTERN: u8, const MASKED: bool>(
        self,
        s: impl Simd<F = F>,
        place: Place,
        keep: F,
    ) {
        let Self { ends: [x, y, z], span: [dx, dy, dz], shares, lambda } = self;
        // SAFETY: the caller's promise.
        unsafe {
            if LAW == SOFT {
                let lambda = if MASKED {
                    let old = in_order::<_, PATTERN>(s, s.load_from(place.lambda));
                    s.select(keep, lambda, old)
                } else {
                    lambda
                };
                let lambda =
                    if PATTERN == STRAIGHT { lambda } else { s.from_shuffled_order(lambda) };
                s.store_to(place.lambda, lambda);
            }
            let x = pushed::<_, PATTERN, MASKED>(s, x, dx, shares, keep);
            let y = pushed::<_, PATTERN, MASKED>(s, y, dy, shares, keep);
            let z = pushed::<_, PATTERN, MASKED>(s, z, dz, shares, keep);
            for (to, [low, high]) in [(place.x, x), (place.y, y), (place.z, z)] {
                s.store_to(to[0], low);
                s.store_to(to[1], high);
            }
        }
    }
}

/// What lies link by link, dealt as the ends are.
#[inline(always)]
fn in_order<S: Simd, const PATTERN: u8>(s: S, v: S::F) -> S::F {
    if PATTERN == STRAIGHT { v } else { s.to_shuffled_order(v) }
}

/// 0 as often as there may be lanes, then 1 as often, then 0 again.
const COUNTS: [f32; 3 * MAX_LANES] = {
    let mut counts = [0.0; 3 * MAX_LANES];
    let mut at = MAX_LANES;
    while at < 2 * MAX_LANES {
        counts[at] = 1.0;
        at += 1;
    }
    counts
};

#[inline(always)]
fn fixed([a, b]: [*mut f32; 2]) -> [*const f32; 2] {
    [a, b]
}

/// Both halves of one column at the ends of a chunk's links.
///
/// # Safety
/// As for `Chunk::of`.
#[inline(always)]
unsafe fn halves<S: Simd>(s: S, [a, b]: [*const f32; 2]) -> [S::F; 2] {
    // SAFETY: the caller's promise.
    unsafe { [s.load_from(a), s.load_from(b)] }
}

/// The same dealt out to lower and upper ends.
#[inline(always)]
fn dealt<S: Simd, const PATTERN: u8>(s: S, [low, high]: [S::F; 2]) -> (S::F, S::F) {
    match PATTERN {
        STRAIGHT => (low, high),
        PAIRS => s.deinterleave(low, high),
        _ => s.deinterleave_pairs(low, high),
    }
}

/// Both halves of one column, moved: lower ends along a span by their share, upper ones against it.
#[inline(always)]
fn pushed<S: Simd, const PATTERN: u8, const MASKED: bool>(
    s: S,
    [low, high]: [S::F; 2],
    span: S::F,
    [to_a, to_b]: [S::F; 2],
    keep: S::F,
) -> [S::F; 2] {
    // What changes no number at all, not even a zero's sign, when it is added, and when it is
    // taken.
    let (nothing, zero) = (s.splat(-0.0), s.splat(0.0));
    let chosen = |v: S::F, nothing: S::F| if MASKED { s.select(keep, v, nothing) } else { v };
    if PATTERN == STRAIGHT {
        let (added, taken) = (chosen(span * to_a, nothing), chosen(span * to_b, zero));
        return [low + added, high - taken];
    }
    let against = to_b * s.splat(-1.0);
    let (to_a, to_b) = (chosen(span * to_a, nothing), chosen(span * against, nothing));
    let (to_low, to_high) =
        if PATTERN == PAIRS { s.interleave(to_a, to_b) } else { s.deinterleave_pairs(to_a, to_b) };
    [low + to_low, high + to_high]
}
