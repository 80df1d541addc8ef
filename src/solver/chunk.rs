//! As many links of a grid's row as there are lanes.

// Where there are no vectors, all goes number by number.
#![cfg_attr(
    not(any(target_arch = "x86_64", target_arch = "aarch64", target_feature = "simd128")),
    allow(dead_code)
)]

use super::links::{BOUND, RIGID, SOFT, correct};
use super::places::Place;
use super::rows::STRAIGHT;
use crate::fabric::rows::Pattern;
use crate::math::simd::{Number, Simd};

const PAIRS: u8 = Pattern::Pairs as u8;

/// The most lanes that there are.
const MOST: usize = 16;

/// Some links: where their ends are, lower and upper, how those are to move, and the links' multipliers; as
/// dealt.
#[derive(Clone, Copy)]
pub(crate) struct Chunk<F> {
    ends: [[F; 3]; 2],
    /// What is added to the lower ends, and taken from the upper ones.
    moves: [[F; 3]; 2],
    lambda: F,
}

impl<F: Number> Chunk<F> {
    /// Solves links.
    ///
    /// # Safety
    /// There are as many at that place, which nobody else writes to; so for all that follow.
    #[inline(always)]
    pub unsafe fn of<const LAW: u8, const PATTERN: u8, const IS_EVEN: bool>(
        s: impl Simd<F = F>,
        place: Place,
        scale: f32,
    ) -> Self {
        let zero = s.splat(0.0);
        // SAFETY: the caller's promise.
        unsafe {
            let rest = in_order::<_, PATTERN>(s, s.load_from(place.rest));
            let (mut compliance, mut lambda) = (zero, zero);
            if LAW == SOFT {
                compliance = in_order::<_, PATTERN>(s, s.load_from(place.compliance));
                lambda = in_order::<_, PATTERN>(s, s.load_from(place.lambda));
            }
            let (xa, xb) = load::<_, PATTERN>(s, fixed(place.x));
            let (ya, yb) = load::<_, PATTERN>(s, fixed(place.y));
            let (za, zb) = load::<_, PATTERN>(s, fixed(place.z));
            let weights = if LAW == BOUND {
                load::<_, PATTERN>(s, place.w).into()
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
            let (dx, dy, dz) = (xb - xa, yb - ya, zb - za);
            let ([to_a, to_b], lambda) =
                correct::<LAW, _>(s, [dx, dy, dz], weights, rest, compliance, lambda, scale);
            Self {
                ends: [[xa, ya, za], [xb, yb, zb]],
                moves: [[dx * to_a, dy * to_a, dz * to_a], [dx * to_b, dy * to_b, dz * to_b]],
                lambda,
            }
        }
    }

    /// Takes back what links did that are not in the row any more, and the first `done`.
    #[inline(always)]
    pub unsafe fn only_in_row<const LAW: u8, const PATTERN: u8>(
        self,
        s: impl Simd<F = F>,
        place: Place,
        done: usize,
    ) -> Self {
        // SAFETY: the caller's promise.
        unsafe {
            let counts = s.load(&COUNTS, MOST - done);
            let keep = s.pick(counts, s.load_from(place.mask), s.splat(0.0));
            self.only::<LAW, PATTERN>(s, place, keep)
        }
    }

    /// Takes back what all but the first `count` links did.
    #[inline(always)]
    pub unsafe fn only_first<const LAW: u8, const PATTERN: u8>(
        self,
        s: impl Simd<F = F>,
        place: Place,
        count: usize,
    ) -> Self {
        // SAFETY: the caller's promise.
        unsafe { self.only::<LAW, PATTERN>(s, place, s.load(&COUNTS, 2 * MOST - count)) }
    }

    /// Takes back what links did that are not to be kept, as they lie in memory.
    #[inline(always)]
    unsafe fn only<const LAW: u8, const PATTERN: u8>(
        self,
        s: impl Simd<F = F>,
        place: Place,
        keep: F,
    ) -> Self {
        let keep = in_order::<_, PATTERN>(s, keep);
        let mut lambda = self.lambda;
        if LAW == SOFT {
            // SAFETY: the caller's promise.
            let old = unsafe { in_order::<_, PATTERN>(s, s.load_from(place.lambda)) };
            lambda = s.pick(keep, lambda, old);
        }
        // What changes no number at all, not even a zero's sign, when it is added, and when it is taken.
        let (nothing, zero) = (s.splat(-0.0), s.splat(0.0));
        let [[ax, ay, az], [bx, by, bz]] = self.moves;
        let added =
            [s.pick(keep, ax, nothing), s.pick(keep, ay, nothing), s.pick(keep, az, nothing)];
        let taken = [s.pick(keep, bx, zero), s.pick(keep, by, zero), s.pick(keep, bz, zero)];
        Self { moves: [added, taken], lambda, ..self }
    }

    #[inline(always)]
    pub unsafe fn store<const LAW: u8, const PATTERN: u8>(self, s: impl Simd<F = F>, place: Place) {
        // SAFETY: the caller's promise.
        unsafe {
            if LAW == SOFT {
                s.store_to(place.lambda, self.lambda_in_memory::<PATTERN>(s));
            }
            let [[xa, ya, za], [xb, yb, zb]] = self.ends;
            let [[ax, ay, az], [bx, by, bz]] = self.moves;
            store::<_, PATTERN>(s, place.x, [xa + ax, xb - bx]);
            store::<_, PATTERN>(s, place.y, [ya + ay, yb - by]);
            store::<_, PATTERN>(s, place.z, [za + az, zb - bz]);
        }
    }

    #[inline(always)]
    fn lambda_in_memory<const PATTERN: u8>(&self, s: impl Simd<F = F>) -> F {
        if PATTERN == STRAIGHT { self.lambda } else { s.undealt(self.lambda) }
    }
}

/// What lies link by link, dealt as the ends are.
#[inline(always)]
fn in_order<S: Simd, const PATTERN: u8>(s: S, v: S::F) -> S::F {
    if PATTERN == STRAIGHT { v } else { s.dealt(v) }
}

/// 0 as often as there may be lanes, then 1 as often, then 0 again.
const COUNTS: [f32; 3 * MOST] = {
    let mut counts = [0.0; 3 * MOST];
    let mut at = MOST;
    while at < 2 * MOST {
        counts[at] = 1.0;
        at += 1;
    }
    counts
};

#[inline(always)]
fn fixed([a, b]: [*mut f32; 2]) -> [*const f32; 2] {
    [a, b]
}

/// One column at both ends of a chunk's links.
///
/// # Safety
/// As for `Chunk::of`.
#[inline(always)]
unsafe fn load<S: Simd, const PATTERN: u8>(s: S, [a, b]: [*const f32; 2]) -> (S::F, S::F) {
    // SAFETY: the caller's promise.
    unsafe {
        if PATTERN == STRAIGHT {
            return (s.load_from(a), s.load_from(b));
        }
        let (low, high) = (s.load_from(a), s.load_from(a.add(S::LANES)));
        if PATTERN == PAIRS { s.deal(low, high) } else { s.deal_twos(low, high) }
    }
}

/// Puts back what `load` read.
///
/// # Safety
/// As for `Chunk::of`.
#[inline(always)]
unsafe fn store<S: Simd, const PATTERN: u8>(s: S, [to_a, to_b]: [*mut f32; 2], [a, b]: [S::F; 2]) {
    // SAFETY: the caller's promise.
    unsafe {
        if PATTERN == STRAIGHT {
            s.store_to(to_a, a);
            s.store_to(to_b, b);
            return;
        }
        let (low, high) = if PATTERN == PAIRS { s.gather_up(a, b) } else { s.deal_twos(a, b) };
        s.store_to(to_a, low);
        s.store_to(to_a.add(S::LANES), high);
    }
}
