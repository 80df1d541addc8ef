//! Which particles may touch a shape at all: all particles of a block at once.

use super::Place;
use crate::geom::frame::Frame;
use crate::geom::shape::Bound;
use crate::math::columns::Columns;
use crate::math::max;
use crate::math::simd::{Level, leveled};
use core::ops::Range;

/// Columns of a block of particles.
#[derive(Clone, Copy)]
struct Sight<'a> {
    x: [&'a [f32]; 3],
    predicted: [&'a [f32]; 3],
    way: [&'a [f32]; 3],
}

/// Finds how far each particle of a range is from a shape at least, on all its way through the substep.
pub(super) fn look(
    level: Level,
    place: &Place<'_>,
    bound: Bound,
    range: Range<usize>,
    clear: &mut [f32],
) {
    let sight = Sight {
        x: part(place.x, &range),
        predicted: part(place.predicted, &range),
        way: part(place.way, &range),
    };
    look_over(level, sight, &place.frames, bound, &mut clear[range.clone()]);
}

fn part<'a>(columns: &'a Columns, range: &Range<usize>) -> [&'a [f32]; 3] {
    columns.all().map(|column| &column[range.clone()])
}

leveled! {
    fn look_over(sight: Sight<'_>, frames: &[Frame; 2], bound: Bound, clear: &mut [f32]) = look_lanes
}

#[inline(always)]
fn look_lanes(sight: Sight<'_>, frames: &[Frame; 2], bound: Bound, clear: &mut [f32]) {
    match bound {
        Bound::Below(top) => each(sight, frames, clear, |_, y, _| y - top),
        Bound::Ball(radius) => {
            each(sight, frames, clear, |x, y, z| (x * x + y * y + z * z).sqrt() - radius);
        }
        Bound::Rod(middle, half, radius) => each(sight, frames, clear, |x, y, z| {
            let y = max((y - middle).abs() - half, 0.0);
            (x * x + y * y + z * z).sqrt() - radius
        }),
        Bound::Box(middle, half) => each(sight, frames, clear, |x, y, z| {
            let x = max((x - middle.x).abs() - half.x, 0.0);
            let y = max((y - middle.y).abs() - half.y, 0.0);
            let z = max((z - middle.z).abs() - half.z, 0.0);
            (x * x + y * y + z * z).sqrt()
        }),
    }
}

/// A distance grows no faster than the way; so it was, all along, the one at the end less the way at least.
#[inline(always)]
fn each(
    Sight { x: [x, y, z], predicted: [px, py, pz], way: [wx, wy, wz] }: Sight<'_>,
    frames: &[Frame; 2],
    clear: &mut [f32],
    distance: impl Fn(f32, f32, f32) -> f32,
) {
    let inward = |frame: &Frame, x: f32, y: f32, z: f32| {
        let [u, v, w] = frame.axes;
        let (x, y, z) = (x - frame.origin.x, y - frame.origin.y, z - frame.origin.z);
        (x * u.x + y * u.y + z * u.z, x * v.x + y * v.y + z * v.z, x * w.x + y * w.y + z * w.z)
    };
    let count = clear.len();
    let (x, y, z) = (&x[..count], &y[..count], &z[..count]);
    let (px, py, pz) = (&px[..count], &py[..count], &pz[..count]);
    let (wx, wy, wz) = (&wx[..count], &wy[..count], &wz[..count]);
    for k in 0..count {
        let (x1, y1, z1) = inward(&frames[1], x[k], y[k], z[k]);
        let (x0, y0, z0) = inward(&frames[0], px[k] - wx[k], py[k] - wy[k], pz[k] - wz[k]);
        let (x0, y0, z0) = (x1 - x0, y1 - y0, z1 - z0);
        clear[k] = distance(x1, y1, z1) - (x0 * x0 + y0 * y0 + z0 * z0).sqrt();
    }
}
