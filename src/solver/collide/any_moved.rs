//! A test whether particles have moved since their positions were stored.
//!
//! Reads both positions and writes one flag.
//! Invariant: NaN counts as moved.

use crate::math::simd::leveled;

leveled! {
    /// Sets `has_moved` if the squared distance of two positions is above `limit2` [m²] or NaN.
    pub(super) fn any_moved(x: [&[f32]; 3], from: [&[f32]; 3], limit2: f32, has_moved: &mut bool)
        = any_moved_lanes
}

#[inline(always)]
fn any_moved_lanes(
    [x, y, z]: [&[f32]; 3],
    [u, v, w]: [&[f32]; 3],
    limit2: f32,
    has_moved: &mut bool,
) {
    let mut found = 0_u32;
    let now = x.iter().zip(y).zip(z);
    let then = u.iter().zip(v).zip(w);
    for (((x, y), z), ((u, v), w)) in now.zip(then) {
        let (x, y, z) = (x - u, y - v, z - w);
        // NaN counts as moved.
        let moved2 = x * x + y * y + z * z;
        found |= u32::from(moved2.is_nan() | (moved2 > limit2));
    }
    *has_moved |= found != 0;
}
