//! Rays: where they hit triangles, how near they pass points.

use glam::Vec3;

/// A ray with a direction of length one.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ray {
    pub origin: Vec3,
    pub direction: Vec3,
}

/// Where a ray meets a triangle: `u` and `v` weigh the second and third corner.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Meeting {
    pub distance: f32,
    pub u: f32,
    pub v: f32,
}

impl Ray {
    /// Meets a triangle from either side.
    ///
    /// Möller and Trumbore, "Fast, minimum storage ray-triangle intersection", JGT 1997.
    pub fn meet(&self, [a, b, c]: [Vec3; 3]) -> Option<Meeting> {
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
        inside.then_some(Meeting { distance, u, v })
    }

    /// How far a point is from the ray [m]; from its origin, if it lies behind.
    pub fn distance_to(&self, point: Vec3) -> f32 {
        let way = point - self.origin;
        let along = way.dot(self.direction);
        if along <= 0.0 { way.length() } else { (way - self.direction * along).length() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [Vec3; 3] = [Vec3::ZERO, Vec3::X, Vec3::Y];

    #[test]
    fn a_ray_meets_a_triangle_from_either_side() {
        for (z, direction) in [(2.0, Vec3::NEG_Z), (-2.0, Vec3::Z)] {
            let ray = Ray { origin: Vec3::new(0.25, 0.5, z), direction };
            let meeting = ray.meet(TRIANGLE).unwrap();
            assert_eq!((meeting.distance, meeting.u, meeting.v), (2.0, 0.25, 0.5));
        }
    }

    #[test]
    fn a_ray_misses_beside_behind_and_along() {
        let miss = |origin, direction| Ray { origin, direction }.meet(TRIANGLE).is_none();
        assert!(miss(Vec3::new(0.8, 0.8, 1.0), Vec3::NEG_Z));
        assert!(miss(Vec3::new(0.2, 0.2, 1.0), Vec3::Z));
        assert!(miss(Vec3::new(-1.0, 0.2, 0.0), Vec3::X));
    }
}
