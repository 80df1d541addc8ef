//! Rays: intersection with triangles and boxes, and distance to points.
//!
//! Triangles: Möller and Trumbore, "Fast, minimum storage ray-triangle intersection", JGT 1997.
//! Boxes: slabs (Kay and Kajiya, "Ray Tracing Complex Scenes", SIGGRAPH 1986).
//!
//! Reads the ray and the triangle, and writes nothing.
//! Invariant: the direction has length one, so the ray parameter is a distance [m].

use crate::geometry::aabb::Aabb;
use crate::math::{max, min};
use glam::Vec3;

/// A half line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    /// The start [m].
    pub origin: Vec3,
    /// The direction, of length one.
    pub direction: Vec3,
}

/// A hit of a ray on a triangle: the point `(1 - u - v) a + u b + v c`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RayHit {
    /// From the origin of the ray [m].
    pub distance: f32,
    /// Barycentric coordinates of the second and third corner.
    pub u: f32,
    pub v: f32,
}

/// A ray prepared for the intersection with many boxes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BoxRay {
    origin: Vec3,
    /// 1 / direction on each axis, with the sign of the direction and finite.
    inverse: Vec3,
}

/// Smallest component of a direction; its inverse is finite.
const MIN_COMPONENT: f32 = 1.0e-30;

impl BoxRay {
    pub fn new(ray: &Ray) -> Self {
        let inverse =
            |d: f32| 1.0 / if d.abs() < MIN_COMPONENT { MIN_COMPONENT.copysign(d) } else { d };
        Self {
            origin: ray.origin,
            inverse: Vec3::from_array(ray.direction.to_array().map(inverse)),
        }
    }

    /// Returns where the ray enters and leaves a box, as distances from its origin [m]; `None` if it
    /// misses the box.
    ///
    /// Rounding is monotone, so the range in a box lies within that in any box that contains it.
    #[inline(always)]
    pub fn range(&self, bounds: &Aabb) -> Option<[f32; 2]> {
        let (a, b) =
            ((bounds.low - self.origin) * self.inverse, (bounds.high - self.origin) * self.inverse);
        let enter = max(max(min(a.x, b.x), min(a.y, b.y)), max(min(a.z, b.z), 0.0));
        let leave = min(min(max(a.x, b.x), max(a.y, b.y)), max(a.z, b.z));
        (enter <= leave).then_some([enter, leave])
    }
}

impl Ray {
    /// Returns the hit on a triangle, from either side; `None` if the ray misses it or is parallel.
    pub fn intersect_triangle(&self, [a, b, c]: [Vec3; 3]) -> Option<RayHit> {
        let (ab, ac) = (b - a, c - a);
        let p = self.direction.cross(ac);
        let det = ab.dot(p);
        if det == 0.0 {
            return None;
        }
        let from_a = self.origin - a;
        let q = from_a.cross(ab);
        let (u, v) = (from_a.dot(p) / det, self.direction.dot(q) / det);
        let distance = ac.dot(q) / det;
        let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance >= 0.0;
        inside.then_some(RayHit { distance, u, v })
    }

    /// Returns the distance of a point from the ray [m]: from its origin if the point lies behind
    /// it.
    pub fn distance_to_point(&self, point: Vec3) -> f32 {
        let r = point - self.origin;
        let along = r.dot(self.direction);
        if along <= 0.0 { r.length() } else { (r - self.direction * along).length() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

    #[test]
    fn a_ray_hits_a_triangle_from_either_side() {
        for (z, direction) in [(2.0, Vec3::NEG_Z), (-2.0, Vec3::Z)] {
            let ray = Ray { origin: Vec3::new(0.25, 0.5, z), direction };
            let hit = ray.intersect_triangle(TRIANGLE).unwrap();
            assert_eq!((hit.distance, hit.u, hit.v), (2.0, 0.25, 0.5));
        }
    }

    #[test]
    fn a_ray_enters_and_leaves_boxes_and_misses_those_beside_or_behind_it() {
        let bounds = Aabb::from_points([Vec3::ZERO, Vec3::ONE]);
        let range = |origin, direction| BoxRay::new(&Ray { origin, direction }).range(&bounds);
        assert_eq!(range(Vec3::new(0.5, 0.5, 3.0), Vec3::NEG_Z), Some([2.0, 3.0]));
        assert_eq!(range(Vec3::new(0.0, 0.5, 0.25), Vec3::Z), Some([0.0, 0.75]), "along a side");
        assert_eq!(range(Vec3::new(0.5, 0.5, 3.0), Vec3::Z), None);
        assert_eq!(range(Vec3::new(1.5, 0.5, 3.0), Vec3::NEG_Z), None);
        let diagonal = range(Vec3::splat(-1.0), Vec3::ONE.normalize()).unwrap();
        assert!((diagonal[0] - 3.0_f32.sqrt()).abs() < 1e-6, "{diagonal:?}");
    }

    #[test]
    fn a_ray_misses_triangles_beside_behind_and_parallel_to_it() {
        let miss =
            |origin, direction| Ray { origin, direction }.intersect_triangle(TRIANGLE).is_none();
        assert!(miss(Vec3::new(0.8, 0.8, 1.0), Vec3::NEG_Z));
        assert!(miss(Vec3::new(0.2, 0.2, 1.0), Vec3::Z));
        assert!(miss(Vec3::new(-1.0, 0.2, 0.0), Vec3::X));
    }
}
