//! Triangle surfaces: open or closed triangle meshes without an inside. Both sides are free space.
//!
//! Two queries over the triangles near a particle: continuous detection (the first triangle that
//! the path of a point crosses) and discrete detection (the closest point on the surface; Ericson,
//! "Real-Time Collision Detection", 2005, sec. 5.1.5). A point stays on the side from which it
//! came.
//!
//! Reads positions and triangles once, at construction. Writes triangle indices to the list of the
//! caller.
//! Invariant: all triangles have an area, so all normals exist.

use crate::geometry::aabb::Aabb;
use crate::geometry::bvh::Bvh;
use crate::geometry::closest_points::{interpolate, triangle_to_origin};
use crate::math::TINY;
use glam::Vec3;

/// Static triangles with a BVH over them.
#[derive(Clone, Debug)]
pub(crate) struct TriangleSurface {
    triangles: Vec<SurfaceTriangle>,
    tree: Bvh,
}

/// A triangle with its normal.
#[derive(Clone, Debug)]
pub(crate) struct SurfaceTriangle {
    /// [m]
    pub corners: [Vec3; 3],
    /// Of length one, by the right-hand rule.
    pub normal: Vec3,
}

/// A path that misses a triangle by no more than this fraction of its size still hits it, so that
/// there is no gap between neighbouring triangles.
const HIT_TOLERANCE: f32 = 1.0e-5;

/// Returns the triangles that have an area.
pub(crate) fn non_degenerate(positions: &[Vec3], triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let has_area = |triangle: &&[u32; 3]| {
        let [a, b, c] = triangle.map(|i| positions[i as usize]);
        (b - a).cross(c - a).length() > 0.0
    };
    triangles.iter().filter(has_area).copied().collect()
}

impl TriangleSurface {
    /// Makes a surface of triangles that have an area; `None` if there are no triangles.
    pub fn new(positions: &[Vec3], triangles: &[[u32; 3]]) -> Option<Self> {
        let mut all = Vec::new();
        for triangle in triangles {
            let corners = triangle.map(|i| positions[i as usize]);
            let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            all.push(SurfaceTriangle { corners, normal: normal * (1.0 / normal.length()) });
        }
        let bounds: Vec<Aabb> =
            all.iter().map(|triangle| Aabb::from_points(triangle.corners)).collect();
        (!all.is_empty()).then(|| Self { tree: Bvh::build(&bounds), triangles: all })
    }

    pub fn bounds(&self) -> Aabb {
        self.tree.bounds()
    }

    /// Returns whether a triangle, or one that is close to it in the BVH, overlaps `bounds`.
    pub fn has_triangle_near(&self, bounds: Aabb) -> bool {
        self.tree.overlapping(bounds).next().is_some()
    }

    /// Pushes the triangles within `radius` [m] of a point. A distance of NaN counts as near.
    pub fn push_triangles_near(&self, point: Vec3, radius: f32, triangles: &mut Vec<u32>) {
        let bounds = Aabb { low: point - Vec3::splat(radius), high: point + Vec3::splat(radius) };
        let is_near = |triangle: &u32| {
            let SurfaceTriangle { corners, normal } = &self.triangles[*triangle as usize];
            let height = (point - corners[0]).dot(*normal);
            // Negated, so that NaN counts as near.
            let is_far = height.abs() > radius || {
                let corners = corners.map(|corner| corner - point);
                interpolate(corners, triangle_to_origin(corners)).length_squared() > radius * radius
            };
            !is_far
        };
        triangles.extend(self.tree.overlapping(bounds).filter(is_near));
    }
}

/// A triangle surface restricted to the candidate triangles of one particle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CandidateTriangles<'a> {
    pub surface: &'a TriangleSurface,
    pub triangles: &'a [u32],
}

impl CandidateTriangles<'_> {
    fn triangles(&self) -> impl Iterator<Item = &SurfaceTriangle> {
        self.triangles.iter().map(|triangle| &self.surface.triangles[*triangle as usize])
    }

    /// Returns the first point where the segment between two points crosses the surface, and the
    /// normal there on the side of `from`; `None` if it crosses no candidate.
    pub fn first_crossing(&self, from: Vec3, to: Vec3) -> Option<(Vec3, Vec3)> {
        let path = to - from;
        let mut first: Option<(f32, Vec3)> = None;
        for triangle in self.triangles() {
            let fall = path.dot(triangle.normal);
            let above = (from - triangle.corners[0]).dot(triangle.normal);
            let still_above = (to - triangle.corners[0]).dot(triangle.normal);
            if above * still_above > 0.0 {
                continue;
            }
            // The path must approach the plane from the side where it starts.
            if fall * above >= 0.0 {
                continue;
            }
            let fraction = -above / fall;
            let is_past = fraction.is_nan() || fraction > 1.0;
            if is_past || first.is_some_and(|(before, _)| before <= fraction) {
                continue;
            }
            let at = triangle.corners.map(|corner| corner - (from + path * fraction));
            let miss = interpolate(at, triangle_to_origin(at)).length_squared();
            let size = (at[1] - at[0]).length_squared() + (at[2] - at[0]).length_squared();
            if miss <= HIT_TOLERANCE * HIT_TOLERANCE * size {
                let outward = if above > 0.0 { triangle.normal } else { -triangle.normal };
                first = Some((fraction, outward));
            }
        }
        first.map(|(fraction, outward)| (from + path * fraction, outward))
    }

    /// Returns the distance of a point from the surface [m] and the direction from the closest
    /// point of the surface to it; `None` if the distance is `max_distance` or more. A point on the
    /// surface gets the normal on the side of `from`.
    pub fn closest(&self, point: Vec3, from: Vec3, max_distance: f32) -> Option<(f32, Vec3)> {
        let mut least = (max_distance * max_distance, None);
        for triangle in self.triangles() {
            // No triangle is nearer than its plane.
            let height = (point - triangle.corners[0]).dot(triangle.normal);
            if height * height >= least.0 {
                continue;
            }
            let corners = triangle.corners.map(|corner| corner - point);
            let weights = triangle_to_origin(corners);
            let at = interpolate(corners, weights);
            let distance2 = at.length_squared();
            if distance2 < least.0 {
                let length = distance2.sqrt();
                let side = if height.abs() > TINY {
                    height
                } else {
                    (from - triangle.corners[0]).dot(triangle.normal)
                };
                let outward = if side > 0.0 { triangle.normal } else { -triangle.normal };
                // Above the interior the normal is exact, but the direction of a short vector is
                // not.
                let is_beside = weights.iter().any(|w| *w <= 0.0) && length > TINY;
                let found = if is_beside {
                    (length, at * (-1.0 / length))
                } else {
                    (height.abs(), outward)
                };
                least = (distance2, Some(found));
            }
        }
        least.1
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A unit square of two triangles in the plane y = 0, and a wall along one of its sides.
    fn corner() -> TriangleSurface {
        let positions =
            [Vec3::ZERO, Vec3::Z, Vec3::X + Vec3::Z, Vec3::X, Vec3::Y, Vec3::Y + Vec3::Z];
        TriangleSurface::new(&positions, &[[0, 1, 2], [0, 2, 3], [0, 4, 1], [1, 4, 5]]).unwrap()
    }

    /// Returns the triangles near two points.
    fn candidates(surface: &TriangleSurface, from: Vec3, to: Vec3) -> Vec<u32> {
        let mut triangles = Vec::new();
        surface.push_triangles_near((from + to) * 0.5, (to - from).length() + 0.2, &mut triangles);
        triangles
    }

    fn first_crossing(surface: &TriangleSurface, from: Vec3, to: Vec3) -> Option<(Vec3, Vec3)> {
        CandidateTriangles { surface, triangles: &candidates(surface, from, to) }
            .first_crossing(from, to)
    }

    #[test]
    fn a_path_through_the_surface_is_stopped_at_its_first_crossing() {
        let surface = corner();
        let (at, out) =
            first_crossing(&surface, Vec3::new(0.5, 0.5, 0.5), Vec3::new(0.5, -0.5, 0.5)).unwrap();
        assert_eq!((at, out), (Vec3::new(0.5, 0.0, 0.5), Vec3::Y));
        let (_, out) =
            first_crossing(&surface, Vec3::new(0.5, -0.5, 0.4), Vec3::new(0.5, 0.5, 0.4)).unwrap();
        assert_eq!(out, Vec3::NEG_Y);
        let (_, out) =
            first_crossing(&surface, Vec3::new(0.2, 0.4, 0.4), Vec3::new(-0.6, -0.6, 0.4)).unwrap();
        assert_eq!(out, Vec3::X);
        assert!(
            first_crossing(&surface, Vec3::new(1.5, 0.5, 0.5), Vec3::new(1.5, -0.5, 0.5)).is_none()
        );
        assert!(
            first_crossing(&surface, Vec3::new(0.5, 0.5, 0.5), Vec3::new(0.5, 0.1, 0.5)).is_none()
        );
    }

    #[test]
    fn no_path_slips_through_between_triangles() {
        let surface = corner();
        for i in 1..1000 {
            let on_diagonal = Vec3::new(i as f32, 0.0, i as f32) * 1.0e-3;
            let offset = Vec3::new(0.1, 1.0, -0.07);
            assert!(
                first_crossing(&surface, on_diagonal + offset, on_diagonal - offset).is_some(),
                "at {i} mm"
            );
        }
    }

    #[test]
    fn the_closest_point_lies_on_the_nearest_triangle() {
        let surface = corner();
        let closest = |x, y| {
            let p = Vec3::new(x, y, 0.5);
            let triangles = candidates(&surface, p, p);
            CandidateTriangles { surface: &surface, triangles: &triangles }.closest(p, Vec3::Y, 0.2)
        };
        let (distance, out) = closest(0.3, 0.1).unwrap();
        assert!((distance - 0.1).abs() < 1.0e-6 && (out - Vec3::Y).length() < 1.0e-6);
        let (distance, out) = closest(1.1, 0.1).unwrap();
        let aslant = Vec3::new(1.0, 1.0, 0.0);
        assert!((out * distance - aslant * 0.1).length() < 1.0e-6, "{distance} m, {out}");
        assert!(closest(0.5, 0.3).is_none());
    }
}
