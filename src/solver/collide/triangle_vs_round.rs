//! Triangles against round shapes that are too small to meet a particle.

use crate::geometry::closest_points::{interpolate, triangle_to_origin};
use crate::geometry::shape::{CollisionShape, PlacedSphere, SignedDistance};
use crate::math::{TINY, max, min};
use crate::solver::collide::broad_phase::{BLOCK, Found};
use crate::solver::collide::push_accumulator::Lifts;
use crate::solver::collide::{Place, Push};
use glam::Vec3;

/// The share of the gap that is kept from what lies between particles. Where a shape is smooth, what a
/// triangle sinks in by is less, so that its corners alone bear it and it lies still.
pub(super) const GAP: f32 = 0.5;

/// Steps towards the ball of a capsule that a triangle is closest to.
const STEPS: u32 = 8;

/// How often the time in which a triangle went through a point is halved to find the moment.
const HALVINGS: u32 = 20;

/// A point of a triangle that touches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spot {
    /// What each corner weighs in it.
    pub weights: [f32; 3],
    pub push: Push,
}

/// A triangle as it was when the substep started and as it is.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub before: [Vec3; 3],
    pub now: [Vec3; 3],
}

/// Pushes the triangles of some blocks out of a shape; says how far the one that was pushed
/// the most, or 0 if there was none.
pub(super) fn solve(
    collision_shape: &CollisionShape,
    place: &mut Place<'_>,
    triangles: &[[u32; 3]],
    found: &Found<'_>,
    gap: f32,
    clear: &[f32],
    lifts: &mut Lifts,
) -> f32 {
    let (gap, mut deepest) = (gap * GAP, 0.0);
    lifts.begin(place.w.len());
    // No point of a triangle is farther from its nearest corner than this share of its longest edge.
    let reach = gap + 0.58 * found.longest;
    for block in found.faces {
        let first = *block as usize * BLOCK;
        for corners in &triangles[first..(first + BLOCK).min(triangles.len())] {
            let each = corners.map(|i| i as usize);
            if each.iter().all(|i| clear[*i] > reach) {
                continue;
            }
            let before = each.map(|i| place.before(i));
            let face = Face { before, now: each.map(|i| place.now(i)) };
            let Some(Spot { weights, push }) = meet(collision_shape, &face, gap) else { continue };
            let (from, to) = (interpolate(before, weights), interpolate(face.now, weights));
            // What was inside comes out little by little.
            let start = outside(collision_shape, from);
            let push = place.rise.push(push.normal, gap, start, gap - push.depth);
            let Some(push) = push else { continue };
            let moved = place.moved(from, to, push);
            deepest = max(push.depth, deepest);
            lifts.add(each, weights, each.map(|i| place.w[i]), moved, push);
        }
    }
    lifts.apply(place);
    deepest
}

/// How far a point is outside of a round shape.
fn outside(collision_shape: &CollisionShape, p: Vec3) -> f32 {
    match collision_shape {
        CollisionShape::Sphere(solid) => solid.nearest(p).0,
        CollisionShape::Capsule(solid) => solid.nearest(p).0,
        _ => f32::INFINITY,
    }
}

/// Where a triangle touches a shape.
fn meet(collision_shape: &CollisionShape, face: &Face, gap: f32) -> Option<Spot> {
    match collision_shape {
        CollisionShape::Sphere(ball) => {
            let knob = PlacedSphere { center: Vec3::ZERO, radius: ball.radius };
            meet_round([knob; 2], |_| knob, face, gap)
        }
        CollisionShape::Capsule(capsule) => {
            meet_round(capsule.ends(), |p| capsule.ball_at(p), face, gap)
        }
        _ => None,
    }
}

/// Two balls and what is between them; `ball_at` is the one that a point is closest to.
fn meet_round(
    ends: [PlacedSphere; 2],
    ball_at: impl Fn(Vec3) -> PlacedSphere,
    face: &Face,
    gap: f32,
) -> Option<Spot> {
    let middle = (face.now[0] + face.now[1] + face.now[2]) * (1.0 / 3.0);
    let mut knob = ball_at(middle);
    let out = middle - knob.center;
    // In front of a plane there is nothing to touch.
    let normal = out * (1.0 / out.length());
    let front = |knob: &PlacedSphere| knob.center.dot(normal) + knob.radius;
    let front = -min(-front(&ends[0]), -front(&ends[1]));
    let is_before = |x: &Vec3, gap: f32| x.dot(normal) >= front + gap;
    if face.now.iter().all(|x| is_before(x, gap)) && face.before.iter().all(|x| is_before(x, 0.0)) {
        return None;
    }
    let through = ends.into_iter().filter_map(|knob| {
        let (weights, out, beyond) = cross(knob.center, face.before, face.now)?;
        Some(Spot { weights, push: Push::new(out, knob.radius + gap + beyond) })
    });
    if let Some(spot) = through.reduce(deeper) {
        return Some(spot);
    }
    let mut weights = [1.0, 0.0, 0.0];
    for _ in 0..STEPS {
        weights = triangle_to_origin(face.now.map(|x| x - knob.center));
        let next = ball_at(interpolate(face.now, weights));
        let is_found = next.center == knob.center;
        knob = next;
        if is_found {
            break;
        }
    }
    let out = interpolate(face.now, weights) - knob.center;
    let length = out.length();
    let depth = knob.radius + gap - length;
    (depth > 0.0 && length > TINY)
        .then(|| Spot { weights, push: Push::new(out * (1.0 / length), depth) })
}

/// The deeper of two spots; the first of equals.
fn deeper(one: Spot, other: Spot) -> Spot {
    if other.push.depth > one.push.depth { other } else { one }
}

/// The normal of a triangle, of length one, and twice its area.
fn normal_of([a, b, c]: [Vec3; 3]) -> Option<(Vec3, f32)> {
    let normal = (b - a).cross(c - a);
    let length = normal.length();
    (length > TINY).then(|| (normal * (1.0 / length), length))
}

/// Whether a triangle went through a point: what its corners weigh there, the way back, and how far it is
/// beyond the point.
pub(super) fn cross(
    point: Vec3,
    before: [Vec3; 3],
    now: [Vec3; 3],
) -> Option<([f32; 3], Vec3, f32)> {
    let (before, now) = (before.map(|x| x - point), now.map(|x| x - point));
    let ((out, _), (normal, area2)) = (normal_of(before)?, normal_of(now)?);
    let (start, end) = (before[0].dot(out), now[0].dot(normal));
    if start * end >= 0.0 {
        return None;
    }
    let at = |share: f32| [0, 1, 2].map(|k| before[k] + (now[k] - before[k]) * share);
    // It turns on its way, so that the moment has to be searched for.
    let (mut from, mut to) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = (from + to) * 0.5;
        let [a, b, c] = at(middle);
        let side = a.dot((b - a).cross(c - a));
        (from, to) = if side * start > 0.0 { (middle, to) } else { (from, middle) };
    }
    let then = at(to);
    let weights = triangle_to_origin(then);
    // A hundredth of an edge beside it is still on it.
    if interpolate(then, weights).length_squared() > 1.0e-4 * area2 {
        return None;
    }
    let back = if start > 0.0 { normal } else { -normal };
    Some((weights, back, end.abs()))
}
