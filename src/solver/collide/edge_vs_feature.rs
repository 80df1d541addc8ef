//! Edges and triangles of the cloth against what sticks out of shapes of flat facets.
//!
//! An edge touches a ridge, and a triangle a corner, where the plane that parts them has all of the shape
//! below it. Anywhere else something else touches first: a particle a facet, or the next ridge. So
//! ways out never turn by more than the shape does.

use crate::geometry::closest_points::interpolate;
use crate::geometry::features::{Corner, EdgeFeature, Features, Sides};
use crate::geometry::shape::CollisionShape;
use crate::math::{TINY, max, min};
use crate::solver::collide::mid_phase::{EdgePair, Sharp, TipPair};
use crate::solver::collide::push_accumulator::Lifts;
use crate::solver::collide::triangle_vs_round::{Spot, cross};
use crate::solver::collide::{Place, Push};
use glam::Vec3;

/// A plane may cut off this much of a ridge (a sine), which rounding may have it do. More would have what touches
/// begin and end at once.
const LEAN: f32 = 1.0e-3;

/// Edges that are more along a ridge than this (the square of a sine) have no way out of it.
const ALONG: f32 = 1.0e-4;

/// What is farther than so many gaps in the first round is not looked at in the others.
const NEARBY: f32 = 4.0;

/// What stays the same for all pairs of a collider in a substep.
#[derive(Clone, Copy)]
pub(super) struct Task<'a> {
    pub collision_shape: &'a CollisionShape,
    pub found: Sharp<'a>,
    /// The gap that is kept [m].
    pub gap: f32,
    /// What is deeper than this did not get there by little and little [m].
    pub deepest: f32,
}

/// Finds the pairs that are near enough to touch in this substep; `now` is room for where particles are.
pub(super) fn look(task: &Task<'_>, place: &Place<'_>, now: &mut Vec<Vec3>, near: &mut Vec<u32>) {
    let Sharp { edges, tips, .. } = task.found;
    let features = task.found.features(task.collision_shape);
    near.clear();
    if edges.is_empty() && tips.is_empty() {
        return;
    }
    now.clear();
    now.extend((0..place.w.len()).map(|i| place.now(i)));
    let reach = task.gap * NEARBY;
    // Both are as long as the normal; what is not a number is near.
    let is_near = |height: f32, normal: Vec3| {
        !(height > 0.0 && height * height > reach * reach * normal.length_squared())
    };
    for (at, pair) in edges.iter().enumerate() {
        let ridge = &features.ridges[pair.ridge as usize];
        let [a, b] = pair.ends.map(|i| now[i as usize] - ridge.ends[0]);
        let normal = (ridge.ends[1] - ridge.ends[0]).cross(b - a);
        let height = normal.dot(a) * 1.0_f32.copysign(normal.dot(ridge.out));
        // A border has no side of its own.
        if ridge.sides == Sides::Border || is_near(height, normal) {
            near.push(at as u32);
        }
    }
    for (at, pair) in tips.iter().enumerate() {
        let corner = &features.corners[pair.corner as usize];
        let [a, b, c] = pair.corners.map(|i| now[i as usize] - corner.at);
        let normal = (b - a).cross(c - a);
        let height = normal.dot(a) * 1.0_f32.copysign(normal.dot(corner.out));
        if corner.sides == Sides::Border || is_near(height, normal) {
            near.push((edges.len() + at) as u32);
        }
    }
}

/// Pushes what is near out of the shape once; says how far the one that was pushed the most, or 0 if there
/// was none.
pub(super) fn solve(
    task: &Task<'_>,
    place: &mut Place<'_>,
    near: &[u32],
    lifts: &mut Lifts,
) -> f32 {
    let features = task.found.features(task.collision_shape);
    let mut deepest = 0.0;
    lifts.begin(place.w.len());
    for at in near {
        let at = *at as usize;
        let met = match task.found.edges.get(at) {
            Some(pair) => meet_edge(task, features, place, pair),
            None => meet_tip(task, features, place, &task.found.tips[at - task.found.edges.len()]),
        };
        let Some((corners, Spot { weights, push })) = met else { continue };
        let from = interpolate(corners.map(|i| place.before(i)), weights);
        let to = interpolate(corners.map(|i| place.now(i)), weights);
        let moved = place.moved(from, to, push);
        deepest = max(push.depth, deepest);
        lifts.add(corners, weights, corners.map(|i| place.w[i]), moved, push);
    }
    lifts.apply(place);
    deepest
}

fn meet_edge(
    task: &Task<'_>,
    features: &Features,
    place: &Place<'_>,
    pair: &EdgePair,
) -> Option<([usize; 3], Spot)> {
    let ridge = &features.ridges[pair.ridge as usize];
    let [i, j] = pair.ends.map(|i| i as usize);
    let (now, before) = ([place.now(i), place.now(j)], [place.before(i), place.before(j)]);
    let (normal, height) = over(ridge, now)?;
    if height >= task.gap {
        return None;
    }
    let most = min(task.collision_shape.depth(ridge.ends[0], normal), task.deepest);
    let (share, push) = if height > -most {
        if ridge.sides == Sides::Fold && !before.iter().all(|x| ridge.is_outside(*x)) {
            return None;
        }
        let share = crossing(ridge, now, normal)?;
        let from = before[0] + (before[1] - before[0]) * share;
        let start = (from - ridge.ends[0]).dot(normal);
        if ridge.sides == Sides::Border && start <= 0.0 {
            return None;
        }
        (share, place.rise.push(normal, task.gap, start, height)?)
    } else {
        // It is beyond the middle, where it can only have come through the ridge.
        let (then, start) = over(ridge, before)?;
        if start <= 0.0 || then.dot(normal) <= 0.0 {
            return None;
        }
        let moment = start / (start - height);
        let then = [0, 1].map(|k| before[k] + (now[k] - before[k]) * moment);
        (crossing(ridge, then, normal)?, Push::new(normal, task.gap - height))
    };
    // The third corner weighs nothing.
    Some(([i, j, i], Spot { weights: [1.0 - share, share, 0.0], push }))
}

/// The way out that is square to a ridge and an edge, and how far out the edge is; nothing where
/// something else of the shape is farther out.
fn over(ridge: &EdgeFeature, [a, b]: [Vec3; 2]) -> Option<(Vec3, f32)> {
    let (along, span) = (ridge.ends[1] - ridge.ends[0], b - a);
    let normal = along.cross(span);
    let length2 = normal.length_squared();
    if length2 <= ALONG * along.length_squared() * span.length_squared() {
        return None;
    }
    let normal = normal * (1.0 / length2.sqrt());
    let normal = if normal.dot(ridge.out) < 0.0 { -normal } else { normal };
    let is_above = ridge.into.iter().all(|into| normal.dot(*into) <= LEAN);
    is_above.then(|| (normal, (a - ridge.ends[0]).dot(normal)))
}

/// Where an edge passes over a ridge, as a share of the edge.
fn crossing(ridge: &EdgeFeature, [a, b]: [Vec3; 2], normal: Vec3) -> Option<f32> {
    let (along, span, between) = (ridge.ends[1] - ridge.ends[0], b - a, a - ridge.ends[0]);
    // Seen along the way out both are lines in a plane.
    let turn = normal.dot(along.cross(span));
    let s = normal.dot(between.cross(span)) / turn;
    let t = normal.dot(between.cross(along)) / turn;
    let is_on = |share: f32| (0.0..=1.0).contains(&share);
    (is_on(s) && is_on(t)).then_some(t)
}

fn meet_tip(
    task: &Task<'_>,
    features: &Features,
    place: &Place<'_>,
    pair: &TipPair,
) -> Option<([usize; 3], Spot)> {
    let corner = &features.corners[pair.corner as usize];
    let corners = pair.corners.map(|i| i as usize);
    let (now, before) = (corners.map(|i| place.now(i)), corners.map(|i| place.before(i)));
    let (normal, height) = over_tip(features, corner, now, before)?;
    if height >= task.gap {
        return None;
    }
    let most = min(task.collision_shape.depth(corner.at, normal), task.deepest);
    let spot = if height > -most {
        if corner.sides == Sides::Fold && !before.iter().all(|x| features.is_outside(corner, *x)) {
            return None;
        }
        let weights = within(now, corner.at, normal)?;
        let start = (interpolate(before, weights) - corner.at).dot(normal);
        Spot { weights, push: place.rise.push(normal, task.gap, start, height)? }
    } else {
        let (weights, back, _) = cross(corner.at, before, now)?;
        if back.dot(normal) <= 0.0 {
            return None;
        }
        Spot { weights, push: Push::new(normal, task.gap - height) }
    };
    Some((corners, spot))
}

/// The normal of a triangle, and how far it is out of a corner along it; nothing where something else of the
/// shape is farther out.
fn over_tip(
    features: &Features,
    corner: &Corner,
    [a, b, c]: [Vec3; 3],
    before: [Vec3; 3],
) -> Option<(Vec3, f32)> {
    let normal = (b - a).cross(c - a);
    let length = normal.length();
    if length <= TINY {
        return None;
    }
    let normal = normal * (1.0 / length);
    let out = if corner.sides == Sides::Border {
        let [p, q, r] = before;
        // On the side where it was.
        let then = (q - p).cross(r - p);
        normal * then.dot(p - corner.at)
    } else {
        corner.out
    };
    let normal = if normal.dot(out) < 0.0 { -normal } else { normal };
    features.is_tip(corner, normal, LEAN).then(|| (normal, (a - corner.at).dot(normal)))
}

/// What the corners of a triangle weigh in the point of it that is over a place.
fn within([a, b, c]: [Vec3; 3], at: Vec3, normal: Vec3) -> Option<[f32; 3]> {
    let part = |p: Vec3, q: Vec3| normal.dot((p - at).cross(q - at));
    let (u, v, w) = (part(b, c), part(c, a), part(a, b));
    let whole = u + v + w;
    let weights = [u / whole, v / whole, w / whole];
    weights.iter().all(|weight| *weight >= 0.0).then_some(weights)
}
