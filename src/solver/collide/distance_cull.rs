//! Distance culling: a lower bound of the distance of each particle from a shape, a block at a
//! time.
//!
//! ```text
//! clearance = d(end) − |end − start|     d: distance from the simple bound of the shape
//! ```
//! A distance changes by no more than the length of the path, so this bounds the distance over the
//! whole substep. For a half space the height at the end is enough.
//!
//! Reads positions, predicted positions and displacements of a block; writes its clearances.
//! Invariant: a particle with a clearance above the gap cannot touch the shape; NaN counts as
//! touching.

use crate::geometry::collision_shape::DistanceBound;
use crate::geometry::transform::Transform;
use crate::math::columns::Columns;
use crate::math::max;
use crate::math::simd::{Level, leveled};
use crate::solver::collide::local_particles::LocalParticles;
use crate::solver::collide::nearby_blocks::BLOCK;
use core::ops::Range;
use glam::Vec3;

/// The columns of a block of particles.
#[derive(Clone, Copy)]
pub(super) struct BlockColumns<'a> {
    pub x: [&'a [f32]; 3],
    pub predicted: [&'a [f32]; 3],
    pub displacement: [&'a [f32]; 3],
}

impl<'a> BlockColumns<'a> {
    pub fn of(particles: &'a LocalParticles<'_>, range: &Range<usize>) -> Self {
        Self {
            x: slices(particles.x, range),
            predicted: slices(particles.predicted, range),
            displacement: slices(particles.displacement, range),
        }
    }
}

/// Writes the clearances of a range of particles, and returns whether one of them may touch the
/// shape.
pub(super) fn update_clearance(
    level: Level,
    particles: &LocalParticles<'_>,
    bound: DistanceBound,
    range: Range<usize>,
    clearance: &mut [f32],
) -> bool {
    let block = BlockColumns::of(particles, &range);
    let clearance = &mut clearance[range];
    compute_clearance(level, block, &particles.frames, bound, clearance);
    let mut is_within = false;
    any_within(level, clearance, particles.largest_gap(), &mut is_within);
    is_within
}

/// Returns whether a position of a range may be lower than `height` [m] above a shape at rest in
/// `frame`; a negative height is a depth.
pub(super) fn is_any_below(
    level: Level,
    x: &Columns,
    frame: &Transform,
    bound: DistanceBound,
    range: Range<usize>,
    height: f32,
) -> bool {
    let still = [&[0.0; BLOCK][..range.len()]; 3];
    let (x, mut distances) = (slices(x, &range), [0.0; BLOCK]);
    let block = BlockColumns { x, predicted: x, displacement: still };
    let distances = &mut distances[..range.len()];
    compute_clearance(level, block, &[*frame; 2], bound, distances);
    // The distance from a box is zero anywhere inside.
    let height = if let DistanceBound::Box(..) = bound { max(height, 0.0) } else { height };
    let mut is_below = false;
    any_within(level, distances, height, &mut is_below);
    is_below
}

fn slices<'a>(columns: &'a Columns, range: &Range<usize>) -> [&'a [f32]; 3] {
    columns.slices().map(|column| &column[range.clone()])
}

leveled! {
    fn compute_clearance(
        block: BlockColumns<'_>,
        frames: &[Transform; 2],
        bound: DistanceBound,
        clearance: &mut [f32],
    ) = compute_clearance_lanes
}

#[inline(always)]
fn compute_clearance_lanes(
    block: BlockColumns<'_>,
    frames: &[Transform; 2],
    bound: DistanceBound,
    clearance: &mut [f32],
) {
    // A capsule is a box without width, less its radius.
    let (middle, half, radius) = match bound {
        DistanceBound::HalfSpace => return heights_above_plane(block.x, &frames[1], clearance),
        DistanceBound::Below(top) => {
            return path_clearances(block, frames, clearance, |_, y, _| y - top);
        }
        DistanceBound::Capsule(middle, half, radius) => (Vec3::Y * middle, Vec3::Y * half, radius),
        DistanceBound::Box(middle, half) => (middle, half, 0.0),
    };
    path_clearances(block, frames, clearance, |x, y, z| {
        let x = max((x - middle.x).abs() - half.x, 0.0);
        let y = max((y - middle.y).abs() - half.y, 0.0);
        let z = max((z - middle.z).abs() - half.z, 0.0);
        (x * x + y * y + z * z).sqrt() - radius
    });
}

leveled! {
    /// Sets `is_within` to whether a clearance is at most `gap` [m] or NaN.
    fn any_within(clearance: &[f32], gap: f32, is_within: &mut bool) = any_within_lanes
}

#[inline(always)]
fn any_within_lanes(clearance: &[f32], gap: f32, is_within: &mut bool) {
    let mut found = 0;
    for clearance in clearance {
        found |= u32::from(clearance.is_nan() | (*clearance <= gap));
    }
    *is_within = found != 0;
}

/// Writes the heights above the plane y = 0 of a frame: the same bits as
/// [`Transform::point_to_local`].
#[inline(always)]
fn heights_above_plane([x, y, z]: [&[f32]; 3], frame: &Transform, clearance: &mut [f32]) {
    let (o, up) = (frame.origin, frame.axes[1]);
    for (((clearance, x), y), z) in clearance.iter_mut().zip(x).zip(y).zip(z) {
        *clearance = (x - o.x) * up.x + (y - o.y) * up.y + (z - o.z) * up.z;
    }
}

/// Writes the distance at the end minus the length of the path, for any distance function.
#[inline(always)]
fn path_clearances(
    block: BlockColumns<'_>,
    frames: &[Transform; 2],
    clearance: &mut [f32],
    distance: impl Fn(f32, f32, f32) -> f32,
) {
    let to_local = |frame: &Transform, x: f32, y: f32, z: f32| {
        let [u, v, w] = frame.axes;
        let (x, y, z) = (x - frame.origin.x, y - frame.origin.y, z - frame.origin.z);
        (x * u.x + y * u.y + z * u.z, x * v.x + y * v.y + z * v.z, x * w.x + y * w.y + z * w.z)
    };
    let BlockColumns { x: [x, y, z], predicted, displacement } = block;
    let ([px, py, pz], [dx, dy, dz]) = (predicted, displacement);
    let count = clearance.len();
    let (x, y, z) = (&x[..count], &y[..count], &z[..count]);
    let (px, py, pz) = (&px[..count], &py[..count], &pz[..count]);
    let (dx, dy, dz) = (&dx[..count], &dy[..count], &dz[..count]);
    for k in 0..count {
        let (x1, y1, z1) = to_local(&frames[1], x[k], y[k], z[k]);
        let (x0, y0, z0) = to_local(&frames[0], px[k] - dx[k], py[k] - dy[k], pz[k] - dz[k]);
        let (x0, y0, z0) = (x1 - x0, y1 - y0, z1 - z0);
        clearance[k] = distance(x1, y1, z1) - (x0 * x0 + y0 * y0 + z0 * z0).sqrt();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::columns::Columns;

    #[test]
    fn heights_above_a_plane_are_the_local_heights_to_the_bit() {
        let mut x = Columns::with_capacity(37);
        (0..37).for_each(|i| x.push(Vec3::new(0.31 * i as f32, 1.0 - 0.07 * i as f32, 0.2)));
        let turned = Transform {
            origin: Vec3::new(0.1, -0.4, 0.3),
            axes: [Vec3::new(0.6, -0.8, 0.0), Vec3::new(0.8, 0.6, 0.0), Vec3::Z],
        };
        for level in Level::available() {
            let mut clearance = [0.0; 37];
            let columns = x.slices();
            let block = BlockColumns { x: columns, predicted: columns, displacement: columns };
            compute_clearance(level, block, &[turned; 2], DistanceBound::HalfSpace, &mut clearance);
            for (i, clearance) in clearance.iter().enumerate() {
                let height = turned.point_to_local(x.get(i)).y;
                assert_eq!(clearance.to_bits(), height.to_bits(), "{i} at {level:?}");
            }
        }
    }

    #[test]
    fn a_block_is_culled_only_if_all_of_its_particles_are_far() {
        for level in Level::available() {
            for (one, may_touch) in [(0.02, false), (0.01, true), (-3.0, true), (f32::NAN, true)] {
                let mut clearance = [5.0; 37];
                clearance[23] = one;
                let mut is_within = !may_touch;
                any_within(level, &clearance, 0.01, &mut is_within);
                assert_eq!(is_within, may_touch, "{one} at {level:?}");
            }
        }
    }
}
