//! Triangle surfaces: open or closed triangle meshes without an inside. Both sides are free space.
//!
//! Two queries over the triangles near a particle: continuous detection (the first triangle that
//! the path of a point crosses) and discrete detection (the closest point on the surface; Ericson,
//! "Real-Time Collision Detection", 2005, sec. 5.1.5). A point stays on the side from which it
//! came.
//!
//! The surface of a moving mesh (`geometry::moving_surface`) also knows where its triangles were at
//! the start of the substep. Then the path of a point is measured relative to each triangle: its
//! start is carried along, at the same height and beside the same place of the triangle.
//!
//! Reads positions and triangles at construction, and those of a moving mesh when it is posed.
//! Writes triangle indices to the list of the caller.
//! Invariant: all triangles have an area when made, so all normals exist; one that loses its area
//! has a normal of zero, and stops nothing.

use crate::geometry::aabb::Aabb;
use crate::geometry::bvh::Bvh;
use crate::geometry::closest_points::{interpolate, triangle_to_origin};
use crate::geometry::relative_motion::{PartMotion, PointMotion};
use crate::geometry::solid_mesh::ClosestPointQuery;
use crate::geometry::swept_box::{MovingBox, SweptBox};
use crate::math::{TINY, max};
use glam::Vec3;

/// Triangles with a BVH over them.
#[derive(Clone, Debug)]
pub(crate) struct TriangleSurface {
    triangles: Vec<SurfaceTriangle>,
    /// The triangles at the start of the substep; empty if they do not move.
    before: Vec<SurfaceTriangle>,
    /// The motion of each triangle in the tick; empty likewise.
    motions: Vec<PartMotion>,
    tree: Bvh,
    /// The moving boxes of the nodes of the tree; empty likewise.
    nodes: Vec<MovingBox>,
}

/// A place of a surface that a point touches or passes through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct SurfacePoint {
    /// Where a path crosses the surface [m].
    pub at: Vec3,
    /// Distance of the point from the surface [m]; 0 where a path crosses it.
    pub distance: f32,
    /// The normal on the side of the point, of length one.
    pub outward: Vec3,
    /// How far the surface moved there in the substep, in its frame [m].
    pub carry: Vec3,
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
            all.push(SurfaceTriangle::new(triangle.map(|i| positions[i as usize])));
        }
        let bounds: Vec<Aabb> =
            all.iter().map(|triangle| Aabb::from_points(triangle.corners)).collect();
        let (before, motions) = (Vec::new(), Vec::new());
        (!all.is_empty()).then(|| Self {
            tree: Bvh::build(&bounds),
            triangles: all,
            before,
            motions,
            nodes: Vec::new(),
        })
    }

    /// Prepares for triangles that move.
    pub fn make_movable(&mut self) {
        self.before.clone_from(&self.triangles);
        self.motions = vec![PartMotion::default(); self.triangles.len()];
    }

    /// Sets the corners of a triangle now and at the start of the substep [m].
    pub fn pose(&mut self, triangle: u32, now: [Vec3; 3], before: [Vec3; 3]) {
        let at = triangle as usize;
        self.triangles[at] = SurfaceTriangle::new(now);
        self.before[at] =
            if before == now { self.triangles[at].clone() } else { SurfaceTriangle::new(before) };
    }

    /// Returns whether the vertices move.
    pub fn deforms(&self) -> bool {
        !self.before.is_empty()
    }

    /// Sets the motion of a triangle in the tick.
    pub fn set_motion(&mut self, triangle: u32, motion: PartMotion) {
        self.motions[triangle as usize] = motion;
    }

    /// Recomputes the tree from the boxes of the triangles at both ends of a tick.
    pub fn refit(&mut self, boxes: &dyn Fn(u32) -> MovingBox) {
        self.tree.refit_moving(boxes, &mut self.nodes);
    }

    /// Returns the triangles whose boxes may overlap `bounds`.
    pub fn overlapping(&self, bounds: Aabb) -> impl Iterator<Item = u32> + '_ {
        self.tree.overlapping(bounds)
    }

    /// Visits the triangles near the point of a query: as they are posed, or with `corners` as given.
    pub fn visit_near(
        &self,
        query: &mut ClosestPointQuery,
        corners: Option<&dyn Fn(u32) -> [Vec3; 3]>,
    ) {
        let (point, squared) = query.start();
        self.tree.visit_near(point, squared, &mut |triangle| {
            let posed = || self.triangles[triangle as usize].corners;
            query.visit(corners.map_or_else(posed, |corners| corners(triangle)))
        });
    }

    /// Returns how far a triangle moved near a point that was at `from` at the start of the substep
    /// [m]: the displacement of the closest place of the triangle, and along the normal what keeps
    /// the height of the point.
    #[inline(never)]
    fn carry(&self, triangle: u32, from: Vec3) -> Vec3 {
        let Some(before) = self.before.get(triangle as usize) else { return Vec3::ZERO };
        let now = &self.triangles[triangle as usize];
        let weights = triangle_to_origin(before.corners.map(|corner| corner - from));
        let moved = [0, 1, 2].map(|k| now.corners[k] - before.corners[k]);
        let carry = interpolate(moved, weights);
        let height = (from - before.corners[0]).dot(before.normal);
        carry + now.normal * (height - (from + carry - now.corners[0]).dot(now.normal))
    }

    pub fn bounds(&self) -> Aabb {
        self.tree.bounds()
    }

    /// Returns whether a triangle, or one that is close to it in the BVH, overlaps `bounds`.
    pub fn has_triangle_near(&self, bounds: Aabb) -> bool {
        self.tree.overlapping(bounds).next().is_some()
    }

    /// Pushes the triangles within `radius` [m] of a point, and of those that overlap `bounds` the
    /// ones that come as near if both move on. A distance of NaN counts as near. A moving surface is
    /// posed at `moment` of the tick.
    pub fn push_triangles_near(
        &self,
        (point, motion): (Vec3, &PointMotion),
        radius: f32,
        (bounds, moment): (Aabb, f32),
        triangles: &mut Vec<u32>,
    ) {
        let is_near = |triangle: &u32| {
            let SurfaceTriangle { corners, normal } = &self.triangles[*triangle as usize];
            let own = self.motions.get(*triangle as usize);
            let most = radius + own.map_or(0.0, |own| motion.reach(own));
            let height = (point - corners[0]).dot(*normal);
            // Negated, so that NaN counts as near.
            if height.abs() > most {
                return false;
            }
            let corners = corners.map(|corner| corner - point);
            let [a, b, c] = corners;
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            let (mut above, mut below) =
                (low.cmpgt(Vec3::splat(radius)), high.cmplt(Vec3::splat(-radius)));
            for k in 0..if own.is_some() { 2 } else { 0 } {
                let (path, spread) = motion.relative_path(k, own);
                above &= (low + path).cmpgt(Vec3::splat(radius + spread));
                below &= (high + path).cmplt(Vec3::splat(-radius - spread));
            }
            let is_far = above.any() || below.any() || {
                interpolate(corners, triangle_to_origin(corners)).length_squared() > most * most
            };
            !is_far
        };
        if self.nodes.is_empty() {
            triangles.extend(self.tree.overlapping(bounds).filter(is_near));
            return;
        }
        let now = Aabb::from_points([point]).expanded(radius);
        let query = SweptBox::new(now, motion.displacements, [0.0; 2]);
        let times = [moment - motion.shares[1], moment, moment + motion.shares[0]];
        let near = self.tree.items_of_nodes(|node| self.nodes[node].may_meet(&query, times));
        triangles.extend(near.filter(is_near));
    }
}

impl SurfaceTriangle {
    fn new(corners: [Vec3; 3]) -> Self {
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let length = normal.length();
        Self { corners, normal: normal * if length > 0.0 { 1.0 / length } else { 0.0 } }
    }
}

/// Returns when a point that moves along a straight line passes through a triangle whose corners do,
/// from 0 to 1, and that place of the triangle at the end; `None` if it passes beside it.
///
/// The volume between point and triangle is a cubic polynomial of time (Provot, "Collision and
/// self-collision handling in cloth model dedicated to design garments", 1997); here it changes its
/// sign, and the root is bracketed. Triangles with a common edge agree on which one is hit. The box of
/// the whole motion relative to the point rules out most.
#[inline(never)]
fn moving_crossing(
    [from, to]: [Vec3; 2],
    [before, now]: [&SurfaceTriangle; 2],
) -> Option<(f32, Vec3)> {
    let relative = |time: f32| {
        let at = from + (to - from) * time;
        [0, 1, 2].map(|k| before.corners[k] + (now.corners[k] - before.corners[k]) * time - at)
    };
    let size = |[a, b, c]: [Vec3; 3]| (b - a).length_squared() + (c - a).length_squared();
    let [first, last] = [relative(0.0), relative(1.0)];
    let mut box_low = Vec3::INFINITY;
    let mut box_high = Vec3::NEG_INFINITY;
    for corner in first.iter().chain(&last) {
        (box_low, box_high) = (box_low.min(*corner), box_high.max(*corner));
    }
    let beside = box_low.max(-box_high).max(Vec3::ZERO);
    if beside.length_squared() > MISS_TOLERANCE * max(size(first), size(last)) {
        return None;
    }
    let volume = |[a, b, c]: [Vec3; 3]| a.dot(b.cross(c));
    let (mut low, mut high) = (0.0, 1.0);
    let is_negative = volume(first) < 0.0;
    for _ in 0..ROOT_STEPS {
        let middle = (low + high) * 0.5;
        if (volume(relative(middle)) < 0.0) == is_negative {
            low = middle;
        } else {
            high = middle;
        }
    }
    let corners = relative(high);
    let weights = triangle_to_origin(corners);
    let is_hit = interpolate(corners, weights).length_squared() <= MISS_TOLERANCE * size(corners);
    is_hit.then(|| (high, interpolate(now.corners, weights)))
}

/// Halvings of the time in which a point passes through a moving triangle.
const ROOT_STEPS: u32 = 20;

/// A path that misses a moving triangle by no more than this fraction of the square of its size still
/// hits it: rounding, and what is left of the time.
const MISS_TOLERANCE: f32 = 1.0e-8;

/// A triangle surface restricted to the candidate triangles of one particle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CandidateTriangles<'a> {
    pub surface: &'a TriangleSurface,
    pub triangles: &'a [u32],
}

impl CandidateTriangles<'_> {
    /// Returns the candidates with their numbers, now and at the start of the substep.
    fn triangles(&self) -> impl Iterator<Item = (u32, [&SurfaceTriangle; 2])> {
        let TriangleSurface { triangles, before, .. } = self.surface;
        self.triangles.iter().map(|triangle| {
            let now = &triangles[*triangle as usize];
            (*triangle, [now, before.get(*triangle as usize).unwrap_or(now)])
        })
    }

    /// Returns the first point where the path of a point between two positions crosses the surface;
    /// `None` if it crosses no candidate. Its normal is that on the side of `from`.
    #[inline(never)]
    pub fn first_crossing(&self, from: Vec3, to: Vec3) -> Option<SurfacePoint> {
        let is_moving = self.surface.deforms();
        let mut first: Option<(f32, SurfacePoint)> = None;
        for (number, [triangle, before]) in self.triangles() {
            let above = (from - before.corners[0]).dot(before.normal);
            let still_above = (to - triangle.corners[0]).dot(triangle.normal);
            if above * still_above > 0.0 {
                continue;
            }
            if is_moving {
                let is_later = |time: f32| first.is_some_and(|(earlier, _)| earlier <= time);
                let hit = moving_crossing([from, to], [before, triangle]);
                let Some((time, at)) = hit.filter(|(time, _)| !is_later(*time)) else { continue };
                let outward = if above > 0.0 { triangle.normal } else { -triangle.normal };
                let carry = self.surface.carry(number, from);
                first = Some((time, SurfacePoint { at, distance: 0.0, outward, carry }));
                continue;
            }
            let path = to - from;
            let fall = path.dot(triangle.normal);
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
                let at = from + path * fraction;
                let carry = Vec3::ZERO;
                first = Some((fraction, SurfacePoint { at, distance: 0.0, outward, carry }));
            }
        }
        first.map(|(_, point)| point)
    }

    /// Returns the closest place of the surface to a point and the direction from there to it;
    /// `None` if it is `max_distance` [m] away or more. A point on the surface gets the normal on
    /// the side of `from`, where it was at the start of the substep.
    #[inline(never)]
    pub fn closest(&self, point: Vec3, from: Vec3, max_distance: f32) -> Option<SurfacePoint> {
        let mut least = (max_distance * max_distance, None);
        for (number, [triangle, before]) in self.triangles() {
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
                    (from - before.corners[0]).dot(before.normal)
                };
                let outward = if side > 0.0 { triangle.normal } else { -triangle.normal };
                // Above the interior the normal is exact, but the direction of a short vector is
                // not.
                let is_beside = weights.iter().any(|w| *w <= 0.0) && length > TINY;
                let (distance, outward) = if is_beside {
                    (length, at * (-1.0 / length))
                } else {
                    (height.abs(), outward)
                };
                least = (distance2, Some((number, distance, outward)));
            }
        }
        least.1.map(|(number, distance, outward)| {
            let carry = self.surface.carry(number, from);
            SurfacePoint { at: point - outward * distance, distance, outward, carry }
        })
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
        let (middle, radius) = ((from + to) * 0.5, (to - from).length() + 0.2);
        let bounds = Aabb::from_points([middle]).expanded(radius);
        let point = (middle, &PointMotion::default());
        surface.push_triangles_near(point, radius, (bounds, 1.0), &mut triangles);
        triangles
    }

    fn first_crossing(surface: &TriangleSurface, from: Vec3, to: Vec3) -> Option<(Vec3, Vec3)> {
        CandidateTriangles { surface, triangles: &candidates(surface, from, to) }
            .first_crossing(from, to)
            .map(|point| (point.at, point.outward))
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
            CandidateTriangles { surface: &surface, triangles: &triangles }
                .closest(p, Vec3::Y, 0.2)
                .map(|point| (point.distance, point.outward))
        };
        let (distance, out) = closest(0.3, 0.1).unwrap();
        assert!((distance - 0.1).abs() < 1.0e-6 && (out - Vec3::Y).length() < 1.0e-6);
        let (distance, out) = closest(1.1, 0.1).unwrap();
        let aslant = Vec3::new(1.0, 1.0, 0.0);
        assert!((out * distance - aslant * 0.1).length() < 1.0e-6, "{distance} m, {out}");
        assert!(closest(0.5, 0.3).is_none());
    }
}
