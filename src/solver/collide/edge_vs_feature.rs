//! Narrow phase: cloth edges and triangles against the edge and vertex features of shapes with flat
//! faces.
//!
//! ```text
//! edge – edge feature         n = (q₁ − q₀) × (b − a), normalised        height = (a − q₀) · n
//! triangle – vertex feature   n = normal of the triangle                 height = (a − q) · n
//! ```
//! A contact counts only if n lies in the normal cone of the feature: then the whole shape lies
//! below the contact plane near the feature. Outside the cone another feature or a face is nearer.
//! So every contact normal lies between the normals of the adjacent faces. If the cloth is deeper
//! than the center of the shape, a contact counts only if the cloth passed through the feature in
//! this substep. Cloth that passed through a two-sided feature goes back to its side, whatever the
//! normal: at a saddle or a sharp fold the normal may lie in no cone.
//!
//! Reads local particles and candidate pairs; writes positions through [`PushAccumulator`].
//! Invariant: a pair with a positive height at or above the gap is not moved.

use crate::geometry::closest_points::interpolate;
use crate::geometry::collision_shape::CollisionShape;
use crate::geometry::features::{EdgeFeature, Features, VertexFeature};
use crate::geometry::relative_motion::RigidStep;
use crate::math::{TINY, max, min};
use crate::solver::collide::local_particles::{LocalParticles, Penetration};
use crate::solver::collide::mid_phase::{EdgeEdgePair, VertexTrianglePair};
use crate::solver::collide::push_accumulator::PushAccumulator;
use crate::solver::collide::pushed_corners::PushedCorners;
use crate::solver::collide::triangle_vs_round::{BESIDE, TriangleContact, point_crossing};
use glam::Vec3;

/// How far a normal may lie outside a normal cone (a sine): tolerates rounding. With a larger value
/// contacts would begin and end abruptly.
const CONE_TOLERANCE: f32 = 1.0e-3;

/// Edges at a smaller angle than this to an edge feature (its sine squared) have no contact normal.
const MIN_SINE2: f32 = 1.0e-4;

/// Cloth is fast if it moves farther than this many gaps in a substep.
const FAST_GAPS: f32 = 4.0;

/// Cloth that started behind a two-sided feature, with all corners in front of its faces, counts as
/// pierced by the feature up to this depth, in gaps. Deeper cloth lies on the inner side of the bend.
const SHALLOW: f32 = 0.3;

/// At a sharp fold a contact normal is almost perpendicular to `outward`. Below this cosine between
/// both, the sign of the normal is arbitrary.
const FOLD_COSINE: f32 = 0.2;

/// Cloth that passed through a feature returns to this fraction of the gap on its own side. With the
/// whole gap it would not come to rest.
const PASSED_GAP: f32 = 0.5;

/// A vertex of a rigid shape up to this part of an edge beside a triangle counts as on it. A larger part
/// would also push the triangle beside the one on whose other side the vertex is.
const BESIDE_RIGID: f32 = 3.0e-4;

/// The data that all pairs of one collider share in a substep.
#[derive(Clone, Copy)]
pub(super) struct FeatureQuery<'a> {
    pub shape: &'a CollisionShape,
    pub features: &'a Features,
    pub edges: &'a [EdgeEdgePair],
    pub vertices: &'a [VertexTrianglePair],
    /// The distance to keep from features at scale 1 [m], and the largest scale.
    pub gap: f32,
    pub largest_scale: f32,
    /// A penetration deeper than this [m] cannot result from motion in small steps.
    pub max_depth: f32,
}

impl FeatureQuery<'_> {
    /// Returns whether corners of the cloth moved far in this substep. Cloth that hardly moves would
    /// not come to rest by the rules for cloth that turns or slides.
    fn is_fast<const COUNT: usize>(&self, start: [Vec3; COUNT], end: [Vec3; COUNT]) -> bool {
        let far = self.gap * FAST_GAPS;
        start.iter().zip(end).any(|(start, end)| start.distance_squared(end) > far * far)
    }

    /// Returns whether there are no pairs.
    pub fn is_empty(&self) -> bool {
        self.edges.is_empty() && self.vertices.is_empty()
    }
}

/// Accumulates the pushes of the pairs whose corners have been pushed as far as their slacks. Returns the
/// depth of the deepest penetration [m], 0 if there was none.
pub(super) fn push(
    query: &FeatureQuery<'_>,
    particles: &LocalParticles<'_>,
    (slacks, pushed): (&[f32], &PushedCorners<'_>),
    pushes: &mut PushAccumulator,
) -> f32 {
    let FeatureQuery { features, edges, vertices, .. } = *query;
    let mut deepest = 0.0;
    for (at, slack) in slacks.iter().enumerate() {
        let (contact, step) = match edges.get(at) {
            Some(pair) => {
                if pushed.are_within(&pair.particles, *slack) {
                    continue;
                }
                let step = features.edge_step(pair.edge);
                (edge_contact(query, features, particles, (pair, step)), step)
            }
            None => {
                let pair = &vertices[at - edges.len()];
                if pushed.are_within(&pair.particles, *slack) {
                    continue;
                }
                let step = features.vertex_step(pair.vertex);
                (vertex_contact(query, features, particles, (pair, step)), step)
            }
        };
        let Some((corners, TriangleContact { weights, penetration })) = contact else { continue };
        let mut penetration = penetration;
        let start = corners.map(|i| particles.start_position(i));
        let (mut from, mut carries) = (interpolate(start, weights), [Vec3::ZERO; 3]);
        if let Some(step) = step {
            carries = start.map(|x| step.carry(x) - x);
            penetration.carry = step.carry(from) - from;
            from += penetration.carry;
        }
        let to = interpolate(corners.map(|i| particles.end_position(i)), weights);
        let correction = particles.correction((corners, weights), [from, to], penetration);
        deepest = max(penetration.depth, deepest);
        pushes.add(particles, (corners, weights), correction, penetration, carries);
    }
    deepest
}

/// Returns the position of a particle at the start of the substep, as a feature that moved since
/// carries it along [m].
#[inline(never)]
pub(super) fn start_position(
    particles: &LocalParticles<'_>,
    i: usize,
    step: Option<&RigidStep>,
) -> Vec3 {
    let start = particles.start_position(i);
    step.map_or(start, |step| step.carry(start))
}

/// Returns the contact of a cloth edge with an edge feature, as a triangle whose third corner has
/// no weight.
fn edge_contact(
    query: &FeatureQuery<'_>,
    features: &Features,
    particles: &LocalParticles<'_>,
    (pair, step): (&EdgeEdgePair, Option<&RigidStep>),
) -> Option<([usize; 3], TriangleContact)> {
    let edge = &features.edges[pair.edge as usize];
    let [i, j] = pair.particles.map(|i| i as usize);
    let end = [particles.end_position(i), particles.end_position(j)];
    let start = [i, j].map(|i| start_position(particles, i, step));
    let gap = query.gap * particles.contact_scales.thickness(&[i, j]);
    let passed = || edge_passage(edge, ([i, j], start, end), gap);
    let Some((normal, height)) = edge_normal(edge, end) else { return passed() };
    if height >= gap {
        return if normal.dot(edge.outward) < FOLD_COSINE { passed() } else { None };
    }
    let center_depth = query.shape.depth_of_center(edge.ends[0], normal);
    let most = min(center_depth, query.max_depth);
    let (fraction, penetration) = if height > -most {
        let fraction = edge_crossing(edge, end, normal)?;
        let from = start[0] + (start[1] - start[0]) * fraction;
        let start_height = (from - edge.ends[0]).dot(normal);
        let is_fast = query.is_fast(start, end);
        let own = outward_normal(edge, start).map(|own| StartPlane {
            height: (start[0] - edge.ends[0]).dot(own),
            is_beside: is_fast && edge_crossing(edge, start, own).is_none(),
        });
        let are_outside = start.iter().map(|x| edge.is_outside(*x));
        if edge.sides.is_two_sided() && !was_outside(own, step.is_none(), gap, are_outside) {
            return passed();
        }
        let start_height = corrected_start_height(start_height, gap, is_fast, own);
        if edge.sides.is_boundary() && start_height <= 0.0 {
            return None;
        }
        let depenetration = particles.depenetration;
        (fraction, depenetration.penetration(normal, gap, start_height, height)?)
    } else {
        // The edge is beyond the center, so it counts only if it came through the edge feature.
        let (start_normal, start_height) = edge_normal(edge, start)?;
        if start_height <= 0.0 || start_normal.dot(normal) <= 0.0 {
            return None;
        }
        let time = start_height / (start_height - height);
        let crossing = [0, 1].map(|k| start[k] + (end[k] - start[k]) * time);
        let penetration = Penetration::new(normal, gap - height);
        (edge_crossing(edge, crossing, normal)?, penetration)
    };
    let weights = [1.0 - fraction, fraction, 0.0];
    Some(([i, j, i], TriangleContact { weights, penetration }))
}

/// A cloth edge or triangle at the start of the substep, as a feature of the collider sees it along
/// the normal that it had then.
#[derive(Clone, Copy)]
struct StartPlane {
    /// Of the cloth above the feature [m].
    height: f32,
    /// Whether it moves fast and lay beside the feature.
    is_beside: bool,
}

/// Returns whether cloth started on the outer side of a two-sided feature. Its height decides; just
/// behind the feature, each corner must also have been in front of a face. Corners alone do not decide:
/// those of a long triangle may lie behind both faces where the surface bends away, and in front of one
/// where it bends back. Cloth that was beside a feature of a rigid surface needs only its corners in
/// front, because its plane may have been far behind the feature. On a surface that deforms that is not
/// enough: the surface may have moved past the corners.
fn was_outside(
    own: Option<StartPlane>,
    is_rigid: bool,
    gap: f32,
    mut are_outside: impl Iterator<Item = bool>,
) -> bool {
    let (height, is_beside) = own.map_or((0.0, false), |own| (own.height, own.is_beside));
    let is_near = is_rigid && is_beside || height >= -SHALLOW * gap;
    height > 0.0 || is_near && are_outside.all(|is_outside| is_outside)
}

/// Returns the height at which a point of the cloth started, given that height along the normal of
/// now. Cloth that has turned was not below the plane that it is below now, and cloth that slid here
/// from beside the feature was not below it either.
fn corrected_start_height(height: f32, gap: f32, is_fast: bool, own: Option<StartPlane>) -> f32 {
    match own {
        Some(own) if height < -gap || is_fast && height < 0.0 => {
            max(height, if own.is_beside { max(own.height, 0.0) } else { own.height })
        }
        _ => height,
    }
}

/// Returns the normal perpendicular to an edge feature and a cloth edge, and the height of the
/// cloth edge along it [m]; `None` if the normal lies outside the normal cone of the feature, or if
/// the faces of the feature lie in one plane now, so that it has no cone.
fn edge_normal(edge: &EdgeFeature, [a, b]: [Vec3; 2]) -> Option<(Vec3, f32)> {
    if edge.bend.angle == 0.0 {
        return None;
    }
    let normal = outward_normal(edge, [a, b])?;
    let is_in_cone = edge.inward.iter().all(|inward| normal.dot(*inward) <= CONE_TOLERANCE);
    is_in_cone.then(|| (normal, (a - edge.ends[0]).dot(normal)))
}

/// Returns the normal perpendicular to an edge feature and a cloth edge, on the outward side;
/// `None` if they are parallel.
fn outward_normal(edge: &EdgeFeature, [a, b]: [Vec3; 2]) -> Option<Vec3> {
    let (along, span) = (edge.ends[1] - edge.ends[0], b - a);
    let normal = along.cross(span);
    let length2 = normal.length_squared();
    if length2 <= MIN_SINE2 * along.length_squared() * span.length_squared() {
        return None;
    }
    let normal = normal * (1.0 / length2.sqrt());
    Some(if normal.dot(edge.outward) < 0.0 { -normal } else { normal })
}

/// Returns the contact that moves a cloth edge back to its side if it passed through a two-sided edge
/// feature in this substep; otherwise `None`. The edge is given by its particles and by their positions
/// at the start and at the end of the substep.
#[inline(never)]
fn edge_passage(
    edge: &EdgeFeature,
    ([i, j], start, end): ([usize; 2], [Vec3; 2], [Vec3; 2]),
    gap: f32,
) -> Option<([usize; 3], TriangleContact)> {
    if !edge.sides.is_two_sided() {
        return None;
    }
    let (first, last) = (outward_normal(edge, start)?, outward_normal(edge, end)?);
    let first = if first.dot(last) < 0.0 { -first } else { first };
    let height = |at: [Vec3; 2], normal: Vec3| (at[0] - edge.ends[0]).dot(normal);
    let (before, now) = (height(start, first), height(end, last));
    if before * now >= 0.0 {
        return None;
    }
    let time = before / (before - now);
    let crossing = [0, 1].map(|k| start[k] + (end[k] - start[k]) * time);
    let fraction = edge_crossing(edge, crossing, last)?;
    let penetration =
        Penetration::new(last * 1.0_f32.copysign(before), gap * PASSED_GAP + now.abs());
    Some(([i, j, i], TriangleContact { weights: [1.0 - fraction, fraction, 0.0], penetration }))
}

/// Returns the contact that moves a cloth triangle back to its side if a two-sided vertex feature passed
/// through it in this substep; otherwise `None`.
#[inline(never)]
fn vertex_passage(
    vertex: &VertexFeature,
    (corners, start, end): ([usize; 3], [Vec3; 3], [Vec3; 3]),
    (gap, is_rigid): (f32, bool),
) -> Option<([usize; 3], TriangleContact)> {
    if !vertex.sides.is_two_sided() {
        return None;
    }
    let beside = if is_rigid { BESIDE_RIGID } else { BESIDE };
    let (weights, back, depth) = point_crossing(vertex.position, start, end, beside)?;
    let penetration = Penetration::new(back, gap * PASSED_GAP + depth);
    Some((corners, TriangleContact { weights, penetration }))
}

/// Returns where a cloth edge crosses an edge feature, seen along `normal`, as a fraction of the
/// cloth edge; `None` if they do not cross.
fn edge_crossing(edge: &EdgeFeature, [a, b]: [Vec3; 2], normal: Vec3) -> Option<f32> {
    let (along, span, between) = (edge.ends[1] - edge.ends[0], b - a, a - edge.ends[0]);
    // Projected along the normal, both are segments in one plane.
    let determinant = normal.dot(along.cross(span));
    let s = normal.dot(between.cross(span)) / determinant;
    let t = normal.dot(between.cross(along)) / determinant;
    let is_within = |fraction: f32| (0.0..=1.0).contains(&fraction);
    (is_within(s) && is_within(t)).then_some(t)
}

/// Returns the contact of a cloth triangle with a vertex feature.
fn vertex_contact(
    query: &FeatureQuery<'_>,
    features: &Features,
    particles: &LocalParticles<'_>,
    (pair, step): (&VertexTrianglePair, Option<&RigidStep>),
) -> Option<([usize; 3], TriangleContact)> {
    let vertex = &features.vertices[pair.vertex as usize];
    let corners = pair.particles.map(|i| i as usize);
    let end = corners.map(|i| particles.end_position(i));
    let start = corners.map(|i| start_position(particles, i, step));
    let gap = query.gap * particles.contact_scales.thickness(&corners);
    let passed = || vertex_passage(vertex, (corners, start, end), (gap, step.is_none()));
    let Some((normal, height)) = vertex_normal(features, vertex, end, start) else {
        return passed();
    };
    if height >= gap {
        return if normal.dot(vertex.outward) < FOLD_COSINE { passed() } else { None };
    }
    let center_depth = query.shape.depth_of_center(vertex.position, normal);
    let most = min(center_depth, query.max_depth);
    let contact = if height > -most {
        let weights = projected_weights(end, vertex.position, normal)?;
        let start_height = (interpolate(start, weights) - vertex.position).dot(normal);
        let [p, q, r] = start.map(|x| x - vertex.position);
        let own = (q - p).cross(r - p);
        let length = own.length().copysign(own.dot(vertex.outward));
        let is_fast = query.is_fast(start, end);
        let own = (length.abs() > TINY).then(|| {
            let own = own * (1.0 / length);
            let is_beside = is_fast && projected_weights(start, vertex.position, own).is_none();
            StartPlane { height: p.dot(own), is_beside }
        });
        let are_outside = start.iter().map(|x| features.is_outside_vertex(vertex, *x));
        if vertex.sides.is_two_sided() && !was_outside(own, step.is_none(), gap, are_outside) {
            return passed();
        }
        let start_height = corrected_start_height(start_height, gap, is_fast, own);
        let depenetration = particles.depenetration;
        let penetration = depenetration.penetration(normal, gap, start_height, height)?;
        TriangleContact { weights, penetration }
    } else {
        let (weights, back, _) = point_crossing(vertex.position, start, end, BESIDE)?;
        if back.dot(normal) <= 0.0 {
            return None;
        }
        let penetration = Penetration::new(normal, gap - height);
        TriangleContact { weights, penetration }
    };
    Some((corners, contact))
}

/// Returns the outward normal of a cloth triangle at a vertex feature, and the height of the
/// triangle along it [m]; `None` if the normal lies outside the normal cone of the feature, or if
/// its faces lie in one plane now.
fn vertex_normal(
    features: &Features,
    vertex: &VertexFeature,
    [a, b, c]: [Vec3; 3],
    start: [Vec3; 3],
) -> Option<(Vec3, f32)> {
    let normal = (b - a).cross(c - a);
    let length = normal.length();
    if length <= TINY || vertex.bend.angle == 0.0 {
        return None;
    }
    let normal = normal * (1.0 / length);
    let outward = if vertex.sides.is_boundary() {
        let [p, q, r] = start;
        // At a boundary, outward is the side where the triangle was.
        let start_normal = (q - p).cross(r - p);
        normal * start_normal.dot(p - vertex.position)
    } else {
        vertex.outward
    };
    let normal = if normal.dot(outward) < 0.0 { -normal } else { normal };
    let is_in_cone = features.is_in_normal_cone(vertex, normal, CONE_TOLERANCE);
    is_in_cone.then(|| (normal, (a - vertex.position).dot(normal)))
}

/// Returns the barycentric weights of a point projected along `normal` onto a triangle; `None` if
/// it lies beside it.
fn projected_weights([a, b, c]: [Vec3; 3], at: Vec3, normal: Vec3) -> Option<[f32; 3]> {
    let area = |p: Vec3, q: Vec3| normal.dot((p - at).cross(q - at));
    let (u, v, w) = (area(b, c), area(c, a), area(a, b));
    let whole = u + v + w;
    let weights = [u / whole, v / whole, w / whole];
    weights.iter().all(|weight| *weight >= 0.0).then_some(weights)
}
