//! The distances of a block of particles from a solid at both ends of their paths, several particles
//! at a time.
//!
//! ```text
//! start, end                 local positions at the start of the substep and now
//! d(start), n(start)         signed distance [m] and outward normal
//! d(end),   n(end)
//! ```
//! For spheres and capsules, whose distance takes roots and divisions but no branches; a sphere is a
//! capsule of length zero. Other shapes are measured one particle at a time.
//!
//! Reads positions, predicted positions and displacements of a block; writes only its own fields.
//! Invariant: the same bits as `SignedDistance::signed_distance` of single points.

use crate::geometry::collision_shape::CollisionShape;
use crate::geometry::primitives::{Capsule, Sphere};
use crate::geometry::signed_distance::SignedDistance;
use crate::geometry::transform::Transform;
use crate::math::simd::{Level, leveled};
use crate::solver::collide::distance_cull::BlockColumns;
use crate::solver::collide::nearby_blocks::BLOCK;
use glam::Vec3;

/// A position of a particle in the local frame, with its distance from a solid.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeasuredPoint {
    pub at: Vec3,
    /// The signed distance, negative inside [m].
    pub distance: f32,
    /// The outward normal, of length one.
    pub normal: Vec3,
}

impl MeasuredPoint {
    #[inline(always)]
    pub fn new(solid: &(impl SignedDistance + ?Sized), at: Vec3) -> Self {
        let (distance, normal) = solid.signed_distance(at);
        Self { at, distance, normal }
    }
}

/// The components of [`MeasuredPoint`]: position, distance, normal.
const COMPONENTS: usize = 7;

/// Measured points of the particles of a block, one column for each component.
type MeasuredColumns = [[f32; BLOCK]; COMPONENTS];

/// The paths of a block of particles: measured points at the start of the substep and now.
pub(super) struct SolidDistances([MeasuredColumns; 2]);

impl Default for SolidDistances {
    fn default() -> Self {
        Self([[[0.0; BLOCK]; COMPONENTS]; 2])
    }
}

impl SolidDistances {
    /// Measures a block of particles; `frames` are those of the collider at the start and at the end.
    /// Returns whether it can: false for shapes that are measured one particle at a time.
    pub fn measure(
        &mut self,
        level: Level,
        shape: &CollisionShape,
        block: BlockColumns<'_>,
        frames: &[Transform; 2],
    ) -> bool {
        // With four lanes less is gained, and in WebAssembly it would cost 2 kB of gzip.
        if !level.is_wide() {
            return false;
        }
        let Self(paths) = self;
        match shape {
            CollisionShape::Sphere(Sphere { radius }) => {
                measure_capsule(level, block, frames, &Capsule::new(0.0, *radius, *radius), paths);
            }
            CollisionShape::Capsule(solid) => measure_capsule(level, block, frames, solid, paths),
            _ => return false,
        }
        true
    }

    /// Returns the points at the start and now of the particle with this index in the block.
    #[inline(always)]
    pub fn path(&self, k: usize) -> [MeasuredPoint; 2] {
        let Self([start, end]) = self;
        let point = |[x, y, z, distance, nx, ny, nz]: &MeasuredColumns| MeasuredPoint {
            at: Vec3::new(x[k], y[k], z[k]),
            distance: distance[k],
            normal: Vec3::new(nx[k], ny[k], nz[k]),
        };
        [point(start), point(end)]
    }
}

leveled! {
    fn measure_capsule(
        block: BlockColumns<'_>,
        frames: &[Transform; 2],
        solid: &Capsule,
        paths: &mut [MeasuredColumns; 2],
    ) = measure_lanes
}

#[inline(always)]
fn measure_lanes(
    block: BlockColumns<'_>,
    frames: &[Transform; 2],
    solid: &impl SignedDistance,
    [start, end]: &mut [MeasuredColumns; 2],
) {
    let BlockColumns { x, predicted, displacement } = block;
    for axis in 0..3 {
        let count = x[axis].len().min(BLOCK);
        end[axis][..count].copy_from_slice(&x[axis][..count]);
        let moved = predicted[axis].iter().zip(displacement[axis]);
        for (start, (predicted, displacement)) in start[axis].iter_mut().zip(moved) {
            *start = predicted - displacement;
        }
    }
    measure_points(&frames[0], solid, start);
    measure_points(&frames[1], solid, end);
}

/// Measures points, which are in world space before and in the local frame afterwards. In a block with
/// fewer particles the last ones are of no use, and are not read.
#[inline(always)]
fn measure_points(
    frame: &Transform,
    solid: &impl SignedDistance,
    [x, y, z, distance, nx, ny, nz]: &mut MeasuredColumns,
) {
    for k in 0..BLOCK {
        let at = frame.point_to_local(Vec3::new(x[k], y[k], z[k]));
        let (d, normal) = solid.signed_distance(at);
        (x[k], y[k], z[k], distance[k]) = (at.x, at.y, at.z, d);
        (nx[k], ny[k], nz[k]) = (normal.x, normal.y, normal.z);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::columns::Columns;

    #[test]
    fn blocks_have_the_bits_of_single_points() {
        let count = 51;
        let wave = |i: usize, k: f32| (i as f32 * k).sin();
        let mut columns = [(); 3].map(|()| Columns::default());
        for (column, scale) in columns.iter_mut().zip([1.0, 1.0, 0.05]) {
            (0..count).for_each(|i| {
                column.push(Vec3::new(wave(i, 1.13), wave(i, 2.31), wave(i, 0.77)) * scale);
            });
        }
        // The center of the sphere and of the capsule.
        columns[0].set(7, Vec3::new(0.1, -0.4, 0.3));
        let [x, predicted, displacement] = &columns;
        let block = BlockColumns {
            x: x.slices(),
            predicted: predicted.slices(),
            displacement: displacement.slices(),
        };
        let turned = Transform {
            origin: Vec3::new(0.1, -0.4, 0.3),
            axes: [Vec3::new(0.6, -0.8, 0.0), Vec3::new(0.8, 0.6, 0.0), Vec3::Z],
        };
        let frames = [Transform { origin: Vec3::new(0.0, -0.3, 0.3), ..turned }, turned];
        let sphere = Sphere { radius: 0.4 };
        let capsule = Capsule::new(0.3, 0.2, 0.1);
        let solids: [(&dyn SignedDistance, Capsule); 2] =
            [(&sphere, Capsule::new(0.0, 0.4, 0.4)), (&capsule, capsule)];
        for (solid, as_capsule) in solids {
            for level in Level::available() {
                let mut distances = SolidDistances::default();
                measure_capsule(level, block, &frames, &as_capsule, &mut distances.0);
                for i in 0..count {
                    let world = [predicted.get(i) - displacement.get(i), x.get(i)];
                    for (k, measured) in distances.path(i).into_iter().enumerate() {
                        let at = frames[k].point_to_local(world[k]);
                        let one = MeasuredPoint::new(solid, at);
                        assert_eq!(format!("{measured:?}"), format!("{one:?}"), "{i} {level:?}");
                    }
                }
            }
        }
    }
}
