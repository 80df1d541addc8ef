//! Which particles may touch a shape at all: all particles of a block at once.

use crate::geometry::shape::DistanceBound;
use crate::geometry::transform::Transform;
use crate::math::columns::Columns;
use crate::math::max;
use crate::math::simd::{Level, leveled};
use crate::solver::collide::Place;
use core::ops::Range;

/// Columns of a block of particles.
#[derive(Clone, Copy)]
struct Sight<'a> {
    x: [&'a [f32]; 3],
    predicted: [&'a [f32]; 3],
    way: [&'a [f32]; 3],
}

/// Finds how far each particle of a range is from a shape at least, on all its way through the substep, and
/// says whether one may touch it.
pub(super) fn look(
    level: Level,
    place: &Place<'_>,
    bound: DistanceBound,
    range: Range<usize>,
    clear: &mut [f32],
) -> bool {
    let sight = Sight {
        x: part(place.x, &range),
        predicted: part(place.predicted, &range),
        way: part(place.way, &range),
    };
    let clear = &mut clear[range];
    look_over(level, sight, &place.frames, bound, clear);
    let mut is_any = false;
    find_any(level, clear, place.gap, &mut is_any);
    is_any
}

fn part<'a>(columns: &'a Columns, range: &Range<usize>) -> [&'a [f32]; 3] {
    columns.all().map(|column| &column[range.clone()])
}

leveled! {
    fn look_over(sight: Sight<'_>, frames: &[Transform; 2], bound: DistanceBound, clear: &mut [f32]) = look_lanes
}

#[inline(always)]
fn look_lanes(sight: Sight<'_>, frames: &[Transform; 2], bound: DistanceBound, clear: &mut [f32]) {
    match bound {
        DistanceBound::Plane => above(sight.x, &frames[1], clear),
        DistanceBound::Below(top) => each(sight, frames, clear, |_, y, _| y - top),
        DistanceBound::Sphere(radius) => {
            each(sight, frames, clear, |x, y, z| (x * x + y * y + z * z).sqrt() - radius);
        }
        DistanceBound::Rod(middle, half, radius) => each(sight, frames, clear, |x, y, z| {
            let y = max((y - middle).abs() - half, 0.0);
            (x * x + y * y + z * z).sqrt() - radius
        }),
        DistanceBound::Box(middle, half) => each(sight, frames, clear, |x, y, z| {
            let x = max((x - middle.x).abs() - half.x, 0.0);
            let y = max((y - middle.y).abs() - half.y, 0.0);
            let z = max((z - middle.z).abs() - half.z, 0.0);
            (x * x + y * y + z * z).sqrt()
        }),
    }
}

leveled! {
    /// Whether something is no farther than `gap`, or is no number.
    fn find_any(clear: &[f32], gap: f32, is_any: &mut bool) = find_any_lanes
}

#[inline(always)]
fn find_any_lanes(clear: &[f32], gap: f32, is_any: &mut bool) {
    let mut found = 0;
    for clear in clear {
        found |= u32::from(clear.is_nan() | (*clear <= gap));
    }
    *is_any = found != 0;
}

/// How high above a plane particles end, to the bit as `Transform::inward` says.
#[inline(always)]
fn above([x, y, z]: [&[f32]; 3], frame: &Transform, clear: &mut [f32]) {
    let (o, up) = (frame.origin, frame.axes[1]);
    for (((clear, x), y), z) in clear.iter_mut().zip(x).zip(y).zip(z) {
        *clear = (x - o.x) * up.x + (y - o.y) * up.y + (z - o.z) * up.z;
    }
}

/// A distance grows no faster than the way; so it was, all along, the one at the end less the way at least.
#[inline(always)]
fn each(
    Sight { x: [x, y, z], predicted: [px, py, pz], way: [wx, wy, wz] }: Sight<'_>,
    frames: &[Transform; 2],
    clear: &mut [f32],
    distance: impl Fn(f32, f32, f32) -> f32,
) {
    let inward = |frame: &Transform, x: f32, y: f32, z: f32| {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::columns::Columns;
    use glam::Vec3;

    #[test]
    fn heights_over_a_plane_are_those_that_its_frame_sees() {
        let mut x = Columns::with_capacity(37);
        (0..37).for_each(|i| x.push(Vec3::new(0.31 * i as f32, 1.0 - 0.07 * i as f32, 0.2)));
        let turned = Transform {
            origin: Vec3::new(0.1, -0.4, 0.3),
            axes: [Vec3::new(0.6, -0.8, 0.0), Vec3::new(0.8, 0.6, 0.0), Vec3::Z],
        };
        for level in Level::all() {
            let mut clear = [0.0; 37];
            let columns = x.all();
            let sight = Sight { x: columns, predicted: columns, way: columns };
            look_over(level, sight, &[turned; 2], DistanceBound::Plane, &mut clear);
            for (i, clear) in clear.iter().enumerate() {
                let height = turned.point_to_local(x.at(i)).y;
                assert_eq!(clear.to_bits(), height.to_bits(), "{i} at {level:?}");
            }
        }
    }

    #[test]
    fn a_block_is_passed_over_only_if_all_of_it_is_far() {
        for level in Level::all() {
            for (one, may_touch) in [(0.02, false), (0.01, true), (-3.0, true), (f32::NAN, true)] {
                let mut clear = [5.0; 37];
                clear[23] = one;
                let mut is_any = !may_touch;
                find_any(level, &clear, 0.01, &mut is_any);
                assert_eq!(is_any, may_touch, "{one} at {level:?}");
            }
        }
    }
}
