//! Narrow phase: cloth triangles against spheres and capsules that are small enough to slip between
//! particles.
//!
//! ```text
//!        c            The contact is at the point of the triangle closest to the sphere, with its
//!       ╱ ╲           barycentric weights. If the center of an end sphere passed through the
//!      ╱ ● ╲          triangle in this substep, the contact is where it passed.
//!     a─────b
//! ```
//! A capsule is a family of spheres; alternating between the closest point of the triangle and the
//! closest sphere finds the nearest pair. Where that is slow, the ends and the spheres nearest to the
//! edges of the triangle are compared. Continuous detection of a point and a triangle searches
//! for the root of the signed volume by bisection.
//!
//! Reads local particles, blocks of triangles and clearances; writes positions through
//! [`PushAccumulator`].
//! Invariant: only triangles with a corner near the shape are tested, so no others move.

use crate::geometry::closest_points::{interpolate, segment_to_segment, triangle_to_origin};
use crate::geometry::collision_shape::CollisionShape;
use crate::geometry::primitives::PlacedSphere;
use crate::geometry::signed_distance::SignedDistance;
use crate::math::{TINY, max, min};
use crate::solver::collide::contact_distance::TRIANGLE_GAP;
use crate::solver::collide::local_particles::{LocalParticles, Penetration};
use crate::solver::collide::long_triangles::{LongTriangles, longest_edge_squared};
use crate::solver::collide::nearby_blocks::{BLOCK, Neighbours};
use crate::solver::collide::push_accumulator::PushAccumulator;
use glam::Vec3;

/// Largest number of alternations between the closest point of a triangle and the closest sphere of
/// a capsule.
const MAX_STEPS: u32 = 8;

/// No point of a triangle is farther from its nearest corner than this fraction of its longest
/// edge.
const REACH: f32 = 0.58;

/// Bisections of the substep that find when a triangle passed a point.
const BISECTIONS: u32 = 20;

/// A point up to this part of an edge beside a triangle counts as on it.
pub(super) const BESIDE: f32 = 1.0e-2;

/// A contact at a point of a triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct TriangleContact {
    /// The barycentric weights of the point.
    pub weights: [f32; 3],
    pub penetration: Penetration,
}

/// The local positions of a triangle at the start of the substep and now [m].
#[derive(Clone, Copy, Debug)]
struct TriangleMotion {
    start: [Vec3; 3],
    end: [Vec3; 3],
}

/// Pushes the nearby triangles, and all long ones, out of a shape once, with contact distance `gap`
/// [m] of particles at scale 1. Returns the depth of the deepest penetration [m], 0 if there was none.
pub(super) fn solve(
    shape: &CollisionShape,
    particles: &mut LocalParticles<'_>,
    (triangles, long): (&[[u32; 3]], &LongTriangles),
    neighbours: &Neighbours<'_>,
    gap: f32,
    clearance: &mut [f32],
    pushes: &mut PushAccumulator,
) -> f32 {
    let (gap, mut deepest) = (gap * TRIANGLE_GAP, 0.0);
    pushes.reset(particles.w.len());
    let mut push = |corners: [usize; 3], motion: TriangleMotion| {
        let gap = gap * particles.contact_scales.thickness(&corners);
        let Some(contact) = find_contact(shape, &motion, gap) else { return };
        let TriangleContact { weights, penetration } = contact;
        let from = interpolate(motion.start, weights);
        let to = interpolate(motion.end, weights);
        // A point that started inside comes out step by step.
        let start_distance = round_distance(shape, from);
        let end_distance = gap - penetration.depth;
        let normal = penetration.normal;
        let penetration =
            particles.depenetration.penetration(normal, gap, start_distance, end_distance);
        let Some(penetration) = penetration else { return };
        let correction = particles.correction((corners, weights), [from, to], penetration);
        deepest = max(penetration.depth, deepest);
        pushes.add(particles, (corners, weights), correction, penetration, [Vec3::ZERO; 3]);
    };
    let is_far = |corners: [usize; 3], limit: f32| corners.iter().all(|i| clearance[*i] > limit);
    let motion = |corners: [usize; 3]| TriangleMotion {
        start: corners.map(|i| particles.start_position(i)),
        end: corners.map(|i| particles.end_position(i)),
    };
    let largest_gap = gap * particles.contact_scales.thickness_range[1];
    let limit = largest_gap + REACH * neighbours.longest_edge;
    for block in neighbours.triangle_blocks {
        let first = *block as usize * BLOCK;
        for corners in &triangles[first..(first + BLOCK).min(triangles.len())] {
            let corners = corners.map(|i| i as usize);
            if !is_far(corners, limit) {
                push(corners, motion(corners));
            }
        }
    }
    // The limit covers the triangles of the blocks up to `longest_edge`.
    let longest_tested =
        if neighbours.triangle_blocks.is_empty() { 0.0 } else { neighbours.longest_edge };
    let free = max(neighbours.longest_free_edge, longest_tested);
    for (triangle, bound) in long.with_longest_edges(particles.x) {
        let corners = triangles[triangle as usize].map(|i| i as usize);
        if is_far(corners, largest_gap + REACH * bound) {
            continue;
        }
        // Lengths are the same in world space.
        let edge2 = longest_edge_squared(corners.map(|i| particles.x.get(i)));
        if edge2 <= free * free && particles.contact_scales.room(&corners) == 1.0 {
            continue;
        }
        let start2 = longest_edge_squared(corners.map(|i| particles.start_in_world(i)));
        let longest = max(edge2, start2).sqrt();
        if !is_far(corners, largest_gap + REACH * longest) {
            push(corners, motion(corners));
        }
    }
    pushes.apply(particles);
    // The clearances of these hold no longer, so their triangles count as near.
    pushes.pushed().iter().for_each(|i| clearance[*i as usize] = 0.0);
    deepest
}

/// Returns the signed distance of a point from a round shape [m]; infinity for other shapes.
fn round_distance(shape: &CollisionShape, p: Vec3) -> f32 {
    match shape {
        CollisionShape::Sphere(solid) => solid.signed_distance(p).0,
        CollisionShape::Capsule(solid) => solid.signed_distance(p).0,
        _ => f32::INFINITY,
    }
}

/// Returns the contact of a triangle with a round shape, if they are nearer than `gap` [m].
fn find_contact(
    shape: &CollisionShape,
    motion: &TriangleMotion,
    gap: f32,
) -> Option<TriangleContact> {
    match shape {
        CollisionShape::Sphere(sphere) => {
            let sphere = PlacedSphere { center: Vec3::ZERO, radius: sphere.radius };
            round_contact([sphere; 2], |_| sphere, motion, gap)
        }
        CollisionShape::Capsule(capsule) => {
            round_contact(capsule.ends(), |p| capsule.closest_sphere(p), motion, gap)
        }
        _ => None,
    }
}

/// Returns the contact of a triangle with the convex hull of two spheres; `closest_sphere` gives
/// the sphere of the family that is closest to a point.
fn round_contact(
    ends: [PlacedSphere; 2],
    closest_sphere: impl Fn(Vec3) -> PlacedSphere,
    motion: &TriangleMotion,
    gap: f32,
) -> Option<TriangleContact> {
    let centroid = (motion.end[0] + motion.end[1] + motion.end[2]) * (1.0 / 3.0);
    let mut sphere = closest_sphere(centroid);
    let out = centroid - sphere.center;
    // A plane in front of the shape separates them.
    let normal = out * (1.0 / out.length());
    let front = |sphere: &PlacedSphere| sphere.center.dot(normal) + sphere.radius;
    let front = -min(-front(&ends[0]), -front(&ends[1]));
    let is_in_front = |x: &Vec3, gap: f32| x.dot(normal) >= front + gap;
    if motion.end.iter().all(|x| is_in_front(x, gap))
        && motion.start.iter().all(|x| is_in_front(x, 0.0))
    {
        return None;
    }
    let crossings = ends.into_iter().filter_map(|sphere| {
        let (weights, out, beyond) =
            point_crossing(sphere.center, motion.start, motion.end, BESIDE)?;
        let penetration = Penetration::new(out, sphere.radius + gap + beyond);
        Some(TriangleContact { weights, penetration })
    });
    if let Some(contact) = crossings.reduce(deeper) {
        return Some(contact);
    }
    for _ in 0..MAX_STEPS {
        let weights = triangle_to_origin(motion.end.map(|x| x - sphere.center));
        let next = closest_sphere(interpolate(motion.end, weights));
        let has_converged = next.center == sphere.center;
        sphere = next;
        if has_converged {
            return sphere_contact(sphere, motion.end, gap);
        }
    }
    // An edge that is nearly parallel to the axis converges slowly. The nearest points are then near
    // the axis, on an edge of the triangle or at an end of the capsule.
    let [a, b, c] = motion.end;
    let axis = ends.map(|end| end.center);
    let beside_edges = [[a, b], [b, c], [c, a]].map(|edge| {
        let (_, t) = segment_to_segment(axis, edge);
        closest_sphere(edge[0] + (edge[1] - edge[0]) * t)
    });
    let candidates = [sphere, ends[0], ends[1]].into_iter().chain(beside_edges);
    candidates.filter_map(|sphere| sphere_contact(sphere, motion.end, gap)).reduce(deeper)
}

/// Returns the contact of a triangle at rest with a sphere, if they are nearer than `gap` [m].
fn sphere_contact(sphere: PlacedSphere, corners: [Vec3; 3], gap: f32) -> Option<TriangleContact> {
    let weights = triangle_to_origin(corners.map(|x| x - sphere.center));
    let out = interpolate(corners, weights) - sphere.center;
    let length = out.length();
    let depth = sphere.radius + gap - length;
    (depth > 0.0 && length > TINY).then(|| {
        let penetration = Penetration::new(out * (1.0 / length), depth);
        TriangleContact { weights, penetration }
    })
}

/// Returns the deeper of two contacts; the first if they are equal.
fn deeper(one: TriangleContact, other: TriangleContact) -> TriangleContact {
    if other.penetration.depth > one.penetration.depth { other } else { one }
}

/// Returns the unit normal of a triangle and twice its area [m²]; `None` without an area.
fn normal_and_area2([a, b, c]: [Vec3; 3]) -> Option<(Vec3, f32)> {
    let normal = (b - a).cross(c - a);
    let length = normal.length();
    (length > TINY).then(|| (normal * (1.0 / length), length))
}

/// Returns whether a moving triangle passed a point in this substep: the barycentric weights of the
/// point, the normal back to the side of the start, and how far the triangle is beyond the point
/// now [m]. A point up to the part `beside` of an edge beside the triangle counts as on it.
pub(super) fn point_crossing(
    point: Vec3,
    start: [Vec3; 3],
    end: [Vec3; 3],
    beside: f32,
) -> Option<([f32; 3], Vec3, f32)> {
    let (start, end) = (start.map(|x| x - point), end.map(|x| x - point));
    let (start_normal, _) = normal_and_area2(start)?;
    let (end_normal, area2) = normal_and_area2(end)?;
    let (start_side, end_side) = (start[0].dot(start_normal), end[0].dot(end_normal));
    if start_side * end_side >= 0.0 {
        return None;
    }
    let at = |time: f32| [0, 1, 2].map(|k| start[k] + (end[k] - start[k]) * time);
    // The triangle rotates on its path, so the time is the root of a cubic.
    let (mut from, mut to) = (0.0, 1.0);
    for _ in 0..BISECTIONS {
        let middle = (from + to) * 0.5;
        let [a, b, c] = at(middle);
        let side = a.dot((b - a).cross(c - a));
        (from, to) = if side * start_side > 0.0 { (middle, to) } else { (from, middle) };
    }
    let crossing = at(to);
    let weights = triangle_to_origin(crossing);
    if interpolate(crossing, weights).length_squared() > beside * beside * area2 {
        return None;
    }
    let back = if start_side > 0.0 { end_normal } else { -end_normal };
    Some((weights, back, end_side.abs()))
}
