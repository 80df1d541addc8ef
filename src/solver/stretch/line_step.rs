//! One step of a block of chains: eight links side by side (one per lane) and the particles that
//! they run to.
//!
//! A step carries a link through the line solver (see `line_solver` for the two systems):
//!
//! ```text
//! gather        to, target, inv_target        by line_gather or line_strided
//! elimination   n, coupling, inv_pivot, rhs   by tridiagonal, forward over the steps
//! substitution  n ← offset, rhs ← share       by tridiagonal, backward over the steps
//! scatter       u = share u₋ + offset         by line_gather or line_strided, forward
//! ```
//! Fields are reused for a second quantity once the first is no longer needed, so that a whole
//! block fits into the L1 cache.
//!
//! Reads and writes its own fields only.
//! Invariant: the lanes do not interact, so a lane has the bits of a chain that is solved alone.

use crate::math::simd::{Float, LANES, LaneArray, Simd};

/// Three columns of eight lanes.
pub(crate) type Lanes3 = [LaneArray; 3];

/// The state of eight links side by side.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct LineStep {
    /// The position [m] and inverse mass [1/kg] of the particle that each link runs to.
    pub to: [LaneArray; 4],
    /// Target length [m]; after elimination, the predicted length over it.
    pub target: LaneArray,
    /// One over the target length [1/m].
    pub inv_target: LaneArray,
    /// α̃ of a compliant link over its rest length: its strain per λ.
    pub relative_compliance: LaneArray,
    /// Unit direction of the link; after substitution, the offset of u = share u₋ + offset [m].
    pub n: Lanes3,
    /// Coupling to the link before, w₋ (n₋·n): the negated off-diagonal entry of the first system.
    pub coupling: LaneArray,
    /// One over the pivot of the first system; 0 where there is no link to solve.
    pub inv_pivot: LaneArray,
    /// Right side of the first system; after substitution, the share of u = share u₋ + offset.
    pub rhs: LaneArray,
}

impl LineStep {
    /// Sets the target lengths of compliant links: their rest lengths.
    #[inline(always)]
    pub fn set_rest_target<S: Simd>(&mut self, s: S, first: usize, rest: &LaneArray) {
        let target = s.load(rest, first);
        s.store(&mut self.target, first, target);
        s.store(&mut self.inv_target, first, s.splat(1.0) / target);
    }

    /// Sets the target lengths of rigid links: `1 - MAX_ERROR_REDUCTION` of the error at the start
    /// of the substep, where they had the length `start_length`, remains.
    #[inline(always)]
    pub fn set_relaxed_target<S: Simd>(
        &mut self,
        s: S,
        first: usize,
        start_length: S::F,
        rest: &LaneArray,
    ) {
        let rest = s.load(rest, first);
        let target = rest + (start_length - rest) * s.splat(1.0 - MAX_ERROR_REDUCTION);
        s.store(&mut self.target, first, target);
        s.store(&mut self.inv_target, first, s.splat(1.0) / target);
    }

    /// The displacement u of the particles [m], from the displacement u₋ of the particles before.
    ///
    /// It is not limited; see [`clamp_length`].
    #[inline(always)]
    pub fn displacement<S: Simd>(&self, s: S, first: usize, [x, y, z]: [S::F; 3]) -> [S::F; 3] {
        [
            self.displacement_along(s, 0, first, x),
            self.displacement_along(s, 1, first, y),
            self.displacement_along(s, 2, first, z),
        ]
    }

    /// One component of the displacement u.
    #[inline(always)]
    pub fn displacement_along<S: Simd>(
        &self,
        s: S,
        axis: usize,
        first: usize,
        before: S::F,
    ) -> S::F {
        s.load(&self.rhs, first) * before + s.load(&self.n[axis], first)
    }

    /// The positions of the particles after a displacement.
    #[inline(always)]
    pub fn displaced<S: Simd>(&self, s: S, first: usize, [x, y, z]: [S::F; 3]) -> [S::F; 3] {
        let [to_x, to_y, to_z, _] = &self.to;
        [x + s.load(to_x, first), y + s.load(to_y, first), z + s.load(to_z, first)]
    }
}

/// The share of a rigid link's length error that one substep corrects at most.
const MAX_ERROR_REDUCTION: f32 = 0.3;

/// The absolute value.
#[inline(always)]
pub(crate) fn abs<S: Simd>(s: S, v: S::F) -> S::F {
    v.max(s.splat(0.0) - v)
}

/// The largest absolute component of a vector.
#[inline(always)]
pub(crate) fn max_component<S: Simd>(s: S, [x, y, z]: [S::F; 3]) -> S::F {
    abs(s, x).max(abs(s, y)).max(abs(s, z))
}

/// Positive if a displacement whose largest component is `component` may be longer than `limit`.
///
/// A vector that is longer than `limit` has a component above limit / √3 = 0.577 limit. Comparing
/// the squared length would be exact, but the squares of a cloth at rest are denormal numbers,
/// which processors handle slowly.
#[inline(always)]
pub(crate) fn limit_excess<S: Simd>(
    s: S,
    component: S::F,
    limit: &LaneArray,
    first: usize,
) -> S::F {
    component - abs(s, s.load(limit, first)) * s.splat(0.577)
}

/// The length of a vector.
#[inline(always)]
pub(crate) fn length<S: Simd>(_: S, [x, y, z]: [S::F; 3]) -> S::F {
    (x * x + y * y + z * z).sqrt()
}

/// Shortens a displacement to `limit` [m]: a chain whose system is ill-conditioned would fling its
/// particles otherwise.
#[inline(always)]
pub(crate) fn clamp_length([x, y, z]: [f32; 3], limit: f32) -> [f32; 3] {
    let length2 = x * x + y * y + z * z;
    let share = if length2 > limit * limit { limit / length2.sqrt() } else { 1.0 };
    [x * share, y * share, z * share]
}

const _: () = assert!(LANES == 8);
