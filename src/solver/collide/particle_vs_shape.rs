//! Particles against shapes.

use crate::geometry::heightfield::Heightfield;
use crate::geometry::polyhedron::Foremost;
use crate::geometry::shape::{CollisionShape, SignedDistance};
use crate::geometry::triangle_surface::Patch;
use crate::math::simd::Level;
use crate::math::{max, min};
use crate::solver::collide::broad_phase::BLOCK;
use crate::solver::collide::mid_phase::Sharp;
use crate::solver::collide::{Place, Push, Rise, distance_cull};
use glam::Vec3;

/// Steps towards a surface; by then one is there, or passes it by.
const STEPS: u32 = 24;

/// Ways out that point apart no more than this (its cosine) belong to one side of a shape.
const SAME_SIDE: f32 = 0.7;

/// Pushes the particles of some blocks out of a shape; `clear` then holds how far each of them is from it at
/// least, and is as it was where nobody looked.
pub(super) fn solve(
    level: Level,
    collision_shape: &CollisionShape,
    place: &mut Place<'_>,
    blocks: &[u32],
    sharp: &Sharp<'_>,
    clear: &mut [f32],
) {
    let count = place.w.len();
    let bound = collision_shape.bound();
    for block in blocks {
        let first = *block as usize * BLOCK;
        let range = first..(first + BLOCK).min(count);
        if !distance_cull::look(level, place, bound, range.clone(), clear) {
            continue;
        }
        for i in range {
            // Negated, so that what is not a number is looked at.
            if place.w[i] <= 0.0 || clear[i] > place.gap {
                continue;
            }
            push(collision_shape, place, sharp, i);
        }
    }
}

/// Pushes a particle out of a shape.
#[inline(never)]
pub(super) fn push(
    collision_shape: &CollisionShape,
    place: &mut Place<'_>,
    sharp: &Sharp<'_>,
    i: usize,
) {
    let (before, now, gap) = (place.before(i), place.now(i), place.gap);
    let rise = place.rise;
    let patch = |surface| Patch { surface, facets: sharp.facets(i) };
    let found = match collision_shape {
        CollisionShape::HalfSpace(solid) => meet_solid(solid, before, now, gap, rise),
        CollisionShape::Sphere(solid) => meet_solid(solid, before, now, gap, rise),
        CollisionShape::Capsule(solid) => meet_solid(solid, before, now, gap, rise),
        CollisionShape::Cuboid(solid, _) => meet_solid(solid, before, now, gap, rise),
        CollisionShape::ConvexHull(body, _) => {
            let solid = Foremost { body, faces: sharp.facets(i) };
            if solid.faces.is_empty() { None } else { meet_solid(&solid, before, now, gap, rise) }
        }
        CollisionShape::TriangleSurface(surface, _) => {
            meet_surface(&patch(surface), before, now, max(gap, SKIN))
        }
        CollisionShape::Heightfield(terrain) => meet_terrain(terrain, before, now, gap),
    };
    let Some(found) = found else { return };
    let moved = place.moved(before, now, found);
    // Friction moves along a plane, which a bent surface is not.
    let moved = match collision_shape {
        CollisionShape::TriangleSurface(surface, _)
            if patch(surface).strike(before, now + moved).is_some() =>
        {
            before - now
        }
        _ => moved,
    };
    place.push_point(i, now, found.normal, moved);
}

/// Gap that surfaces without an inside keep at least [m]: what came to lie on one could not say any more on
/// which side it was.
const SKIN: f32 = 1.0e-4;

/// Planes of a bent shape that a particle may be pushed out of, one after the other.
const PLANES: u32 = 4;

/// Of a gap that was just opened, rounding may have left so much.
const OPEN: f32 = 0.95;

/// A surface: where the way goes through first, or what is closest. What finds no way out stays where it
/// was.
fn meet_surface(surface: &Patch<'_>, before: Vec3, now: Vec3, gap: f32) -> Option<Push> {
    let mut at = now;
    for number in 0..PLANES {
        if let Some((point, out)) = surface.strike(before, at) {
            at += out * (gap - (at - point).dot(out));
            continue;
        }
        let reach = if number == 0 { gap } else { gap * OPEN };
        let Some((distance, out)) = surface.closest(at, before, reach) else {
            return push_from(now, at);
        };
        at += out * (gap - distance);
    }
    let is_through = surface.strike(before, at).is_some();
    push_from(now, if is_through { before } else { at })
}

fn push_from(now: Vec3, to: Vec3) -> Option<Push> {
    let out = to - now;
    let depth = out.length();
    (depth > 0.0).then(|| Push::new(out * (1.0 / depth), depth))
}

/// Ground: what is below it now comes up, what went through a hill comes back.
fn meet_terrain(terrain: &Heightfield, before: Vec3, now: Vec3, gap: f32) -> Option<Push> {
    let way = now - before;
    let across = (way.x * way.x + way.z * way.z).sqrt();
    let count = max(min((across / (0.5 * terrain.spacing())).ceil(), 1000.0), 1.0) as u32;
    let places = (1..=count).map(|k| before + way * (k as f32 / count as f32));
    let first = places.map(|at| Some((at, terrain.above(at)?)));
    let (struck, (height, out)) = first.flatten().find(|(_, (height, _))| *height < gap)?;
    let depth = gap - height - (now - struck).dot(out);
    if depth <= 0.0 {
        return None;
    }
    let mut at = now + out * depth;
    for _ in 1..PLANES {
        match terrain.above(at) {
            Some((height, out)) if height < gap * OPEN => {
                at += out * (gap - height);
            }
            _ => break,
        }
    }
    push_from(now, at)
}

/// What keeps a particle on its way from `before` to `now` a `gap` out of a convex body; one that was inside
/// comes out little by little.
fn meet_solid(
    solid: &impl SignedDistance,
    before: Vec3,
    now: Vec3,
    gap: f32,
    rise: Rise,
) -> Option<Push> {
    let (start, out) = solid.nearest(before);
    let way = now - before;
    // What is beyond the plane between them does not touch.
    if start + way.dot(out) >= min(gap, start + rise.by) {
        return None;
    }
    let (height, normal) = solid.nearest(now);
    if normal.dot(out) >= SAME_SIDE {
        return rise.push(normal, gap, start, height);
    }
    if start < -rise.deep {
        return Some(Push { normal: out, depth: rise.by, is_slick: true });
    }
    scatter_transpose(solid, before, now, start, min(gap, start + rise.by))
}

/// What takes back a particle that went around a body or through it, which its way tells.
#[inline(never)]
fn scatter_transpose(
    solid: &dyn SignedDistance,
    before: Vec3,
    now: Vec3,
    start: f32,
    gap: f32,
) -> Option<Push> {
    let (at, normal) = strike(solid, before, now - before, start, gap)?;
    let (distance, _) = solid.nearest(at);
    let depth = gap - distance - (now - at).dot(normal);
    (depth > 0.0).then_some(Push::new(normal, depth))
}

/// Where a way meets a body, and which way is out there.
///
/// Up to the plane in front of a convex body one may go on: all of the body is behind it. One that sets out
/// from the surface is let slide along it.
fn strike(
    solid: &dyn SignedDistance,
    before: Vec3,
    way: Vec3,
    start: f32,
    gap: f32,
) -> Option<(Vec3, Vec3)> {
    let surface = max(min(start, gap), 0.0) * 0.5;
    let hair = surface * 0.1 + way.length() * 1.0e-4;
    let mut share = 0.0;
    for _ in 0..STEPS {
        let at = before + way * share;
        let (distance, normal) = solid.nearest(at);
        if distance <= surface + hair {
            return Some((at, normal));
        }
        let fall = -way.dot(normal);
        share += (distance - surface) / fall;
        if fall <= 0.0 || share >= 1.0 {
            return None;
        }
    }
    let (distance, normal) = solid.nearest(before + way);
    (distance < gap).then_some((before + way, normal))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::shape::{Cuboid, HalfSpace, Sphere};

    const GAP: f32 = 1.0e-3;

    /// Where a particle ends that goes from one place to another.
    fn end(solid: &impl SignedDistance, before: Vec3, now: Vec3) -> Vec3 {
        meet_solid(solid, before, now, GAP, Rise { by: 9.0, deep: 9.0 })
            .map_or(now, |push| now + push.normal * push.depth)
    }

    #[test]
    fn what_flies_through_a_thin_plate_ends_where_it_came_from() {
        for half in [0.00005, 0.0025, 0.1] {
            let plate = Cuboid { half: Vec3::new(1.0, half, 1.0) };
            for fall in [0.01, 0.1, 1.0, 10.0] {
                let from = Vec3::new(0.2, half + 0.5 * fall, 0.1);
                let end = end(&plate, from, from + Vec3::new(0.03, -fall, 0.0));
                assert!((end.y - half - GAP).abs() < 3.0e-4 + fall * 1.0e-3, "{fall} m: {end}");
            }
        }
    }

    #[test]
    fn what_flies_through_a_ball_ends_where_it_came_from() {
        let ball = Sphere { radius: 0.05 };
        let end = end(&ball, Vec3::Y * 0.5, Vec3::new(0.01, -0.5, 0.0));
        assert!(ball.nearest(end).0 > 0.9 * GAP && end.y > 0.0, "{end}");
    }

    #[test]
    fn what_flies_almost_along_a_plate_does_not_get_through() {
        let plate = Cuboid { half: Vec3::new(9.0, 0.001, 9.0) };
        for slope in [0.01, 0.03, 0.1] {
            let before = Vec3::Y * (0.001 + GAP);
            let end = end(&plate, before, before + Vec3::new(1.0, -slope, 0.3));
            assert!(end.y > 0.001, "at a slope of {slope} to {end}");
        }
    }

    #[test]
    fn what_passes_by_goes_on() {
        let ball = Sphere { radius: 0.05 };
        let now = Vec3::new(0.06, -0.5, 0.0);
        assert_eq!(end(&ball, Vec3::new(0.06, 0.5, 0.0), now), now);
        let plate = Cuboid { half: Vec3::new(1.0, 0.01, 1.0) };
        let now = Vec3::new(1.03, -0.02, 0.0);
        assert_eq!(end(&plate, Vec3::new(1.01, 0.02, 0.0), now), now);
    }

    #[test]
    fn what_slides_over_a_rim_falls() {
        let plate = Cuboid { half: Vec3::new(1.0, 0.01, 1.0) };
        let now = Vec3::new(1.0 + GAP, 0.009, 0.0);
        let before = Vec3::new(1.0 - GAP, 0.01 + GAP, 0.0);
        let end = end(&plate, before, now);
        assert!((end - now).length() < 2.1 * GAP, "{now} to {end}");
    }

    #[test]
    fn what_falls_on_ground_or_flies_into_a_hill_stays_above() {
        let heights = (0..25).map(|i| if i % 5 == 2 { 1.0 } else { 0.0 }).collect();
        let ground = Heightfield::new(5, 5, 0.5, heights);
        let end = |before: Vec3, now: Vec3| {
            let push = meet_terrain(&ground, before, now, GAP);
            push.map_or(now, |push| now + push.normal * push.depth)
        };
        let valley = Vec3::new(0.1, 0.5, 1.1);
        for fall in [0.01, 0.1, 1.0, 3.0] {
            let end = end(valley, valley - Vec3::Y * fall);
            let height = ground.above(end).map_or(9.0, |(height, _)| height);
            assert!(height > 0.9 * GAP, "fell {fall} m to {end}");
        }
        let through = end(valley, Vec3::new(1.9, 0.5, 1.1));
        assert!(through.x < 1.0, "flew through a hill to {through}");
        assert_eq!(end(valley, valley + Vec3::X * 0.2), valley + Vec3::X * 0.2);
    }

    #[test]
    fn what_starts_inside_comes_out_little_by_little() {
        let ball = Sphere { radius: 0.5 };
        let inside = Vec3::new(0.1, 0.2, 0.0);
        assert!((ball.nearest(end(&ball, inside, inside)).0 - GAP).abs() < 1.0e-6);
        let end = end(&HalfSpace, Vec3::Y * -3.0, Vec3::Y * -3.0);
        assert!((end - Vec3::Y * GAP).length() < 1.0e-6, "{end}");
        let depth = |deep| {
            let rise = Rise { by: 0.25, deep };
            meet_solid(&HalfSpace, Vec3::Y * -3.0, Vec3::Y * -3.5, GAP, rise).unwrap().depth
        };
        assert_eq!((depth(9.0), depth(1.0)), (0.75, 0.25));
    }
}
