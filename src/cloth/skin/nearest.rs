//! Nearest point of the cloth: where a vertex of a skin is bound.
//!
//! Method: a walk of a BVH over the triangles finds the smallest distance; of all triangles that
//! are within a tolerance of it, the one nearest to a second point decides. That point lies inside
//! the skin triangles of the vertex, so a vertex on a seam that is open in the cloth is bound to
//! the side that it belongs to.
//!
//! Reads positions and normals of particles; writes nothing.
//! Invariant: a vertex at a particle gets a weight of exactly 1 for it.

use crate::cloth::skin::evaluate::{SurfaceFrame, surface_frame};
use crate::geometry::aabb::Aabb;
use crate::geometry::bvh::Bvh;
use crate::geometry::closest_points::{interpolate, triangle_to_origin};
use crate::math::simd::Scalar;
use crate::math::{max, min};
use glam::Vec3;

/// Triangles whose distances differ by less than this share of an edge are equally near.
const TOLERANCE: f32 = 1.0e-3;

/// Steps towards the point whose normal goes through the vertex.
const STEPS: usize = 6;

/// The cloth that a skin is bound to.
pub(super) struct ClothSurface<'a> {
    pub triangles: &'a [[u32; 3]],
    /// Positions relative to the origin, and unit normals, of the particles.
    pub positions: &'a [[f32; 4]],
    pub normals: &'a [[f32; 4]],
    pub smoothness: f32,
    tree: Bvh,
    tolerance: f32,
    /// Largest distance of a bound vertex [m].
    reach: f32,
    /// The triangle that was found last.
    last: u32,
}

/// The vector in an entry `[x, y, z, 0]`.
pub(super) fn vector([x, y, z, _]: [f32; 4]) -> Vec3 {
    Vec3::new(x, y, z)
}

impl<'a> ClothSurface<'a> {
    pub fn new(
        triangles: &'a [[u32; 3]],
        positions: &'a [[f32; 4]],
        normals: &'a [[f32; 4]],
        mean_edge: f32,
        smoothness: f32,
    ) -> Self {
        let at = |v: u32| vector(positions[v as usize]);
        let bounds: Vec<Aabb> =
            triangles.iter().map(|corners| Aabb::from_points(corners.map(at))).collect();
        let tree = Bvh::build(&bounds);
        let reach = tree.bounds().half_extents().length();
        let tolerance = TOLERANCE * mean_edge;
        Self { triangles, positions, normals, smoothness, tree, tolerance, reach, last: 0 }
    }

    /// Returns the triangle nearest to `point`, and the weights of the nearest point; `None` if it
    /// is farther away than half the diagonal of the cloth's bounding box. Of triangles that are
    /// equally near, takes the one nearest to `inner`.
    pub fn nearest(&mut self, point: Vec3, inner: Vec3) -> Option<(u32, [f32; 3])> {
        let mut nearest = self.distance(self.last, point);
        self.tree.visit_near(point, nearest * nearest, &mut |triangle| {
            nearest = min(self.distance(triangle, point), nearest);
            nearest * nearest
        });
        if nearest > self.reach || nearest.is_nan() {
            return None;
        }
        let limit = nearest + self.tolerance;
        let mut best: Option<(f32, u32)> = None;
        self.tree.visit_near(point, limit * limit, &mut |triangle| {
            if self.distance(triangle, point) <= limit {
                let found = (self.distance(triangle, inner), triangle);
                best = best.filter(|best| *best <= found).or(Some(found));
            }
            limit * limit
        });
        let (_, triangle) = best?;
        self.last = triangle;
        let corners = self.corners(triangle).map(|x| x - point);
        Some((triangle, self.refine(triangle, triangle_to_origin(corners), point)))
    }

    fn corners(&self, triangle: u32) -> [Vec3; 3] {
        self.triangles[triangle as usize].map(|v| vector(self.positions[v as usize]))
    }

    fn distance(&self, triangle: u32, point: Vec3) -> f32 {
        let corners = self.corners(triangle).map(|x| x - point);
        interpolate(corners, triangle_to_origin(corners)).length()
    }

    /// Moves the foot of `point` within its triangle until the normal at the foot goes through the
    /// point (fixed-point iteration), so that offsets are continuous across the edges of the cloth.
    fn refine(&self, triangle: u32, mut weights: [f32; 3], point: Vec3) -> [f32; 3] {
        let [a, b, c] = self.corners(triangle);
        let (p, q) = (b - a, c - a);
        let mut left = f32::INFINITY;
        for _ in 0..STEPS {
            let frame = self.frame(triangle, weights, [1.0, 0.0]);
            let n = Vec3::from_array(frame.axes[2]);
            let miss = point - Vec3::from_array(frame.point);
            let beside = miss - n * miss.dot(n);
            if beside.length() <= 1.0e-6 * p.length() || beside.length() >= left {
                break;
            }
            left = beside.length();
            let volume = p.cross(q).dot(n);
            let (u, v) = (miss.cross(q).dot(n) / volume, p.cross(miss).dot(n) / volume);
            if !(u.is_finite() && v.is_finite()) {
                break;
            }
            let moved = [weights[0] - u - v, weights[1] + u, weights[2] + v].map(|w| max(w, 0.0));
            let sum = moved[0] + moved[1] + moved[2];
            weights = moved.map(|w| w / sum);
        }
        weights
    }

    /// Returns the frame at a point of a triangle.
    pub fn frame(
        &self,
        triangle: u32,
        weights: [f32; 3],
        direction: [f32; 2],
    ) -> SurfaceFrame<f32> {
        let of = |list: &[[f32; 4]]| {
            self.triangles[triangle as usize].map(|v| vector(list[v as usize]).to_array())
        };
        let (x, normals) = (of(self.positions), of(self.normals));
        surface_frame(Scalar, x, normals, weights, direction, self.smoothness)
    }
}
