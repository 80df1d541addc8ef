//! Pushes the triangles of the cloth out of one collider: rounds of triangles for round shapes, of
//! edges and vertices for shapes with flat faces.
//!
//! ```text
//! round     all triangles that penetrate ─▶ their corners, as particles     until none is too deep
//! rollback  corners of triangles that stay too deep go back to where the substep began
//! ```
//! Reads the blocks and candidates near the collider, long triangles and clearances; writes
//! positions and contacts through [`LocalParticles`].
//! Invariant: each round tests particles last, so a correction of a triangle does not leave a
//! particle inside.

use crate::geometry::collision_shape::CollisionShape;
use crate::math::max;
use crate::math::simd::Level;
use crate::mesh::Mesh;
use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::collide::contact_distance::TRIANGLE_GAP;
use crate::solver::collide::edge_vs_feature::FeatureQuery;
use crate::solver::collide::local_particles::LocalParticles;
use crate::solver::collide::long_pairs::LongPairs;
use crate::solver::collide::long_triangles::{LongTriangles, MeasuredSurface};
use crate::solver::collide::mid_phase::PairSearch;
use crate::solver::collide::nearby_blocks::Neighbours;
use crate::solver::collide::push_accumulator::PushAccumulator;
use crate::solver::collide::pushed_corners::{PushedCorner, PushedCorners};
use crate::solver::collide::{
    edge_vs_feature, long_pairs, mid_phase, particle_vs_shape, slack, triangle_vs_round,
};
use crate::state::colliders::ColliderBody;

/// Rounds per substep that push triangles out of a shape: the smallest number while any triangle
/// penetrates, and the largest number while one is too deep.
const TRIANGLE_ROUNDS: [u32; 2] = [2, 40];

/// The largest number of times that the slacks of one collider are computed in a substep.
const MAX_SEARCHES: u32 = 4;

/// The largest number of rounds that roll triangles back.
const MAX_ROLLBACK_ROUNDS: u32 = 100;

/// The fraction of the gap that the last round may leave to the next substep.
pub(super) const ROUND_TOLERANCE: f32 = 0.1;

/// The triangles of a cloth.
#[derive(Clone, Copy)]
pub(super) struct ClothTriangles<'a> {
    pub mesh: &'a Mesh,
    /// [m]
    pub mean_edge: f32,
    pub level: Level,
}

/// The buffers of the rounds at one collider.
pub(super) struct RoundScratch<'a> {
    pub long: &'a mut LongTriangles,
    /// A lower bound of the distance of each particle from the collider [m].
    pub clearance: &'a mut Vec<f32>,
    pub pushes: &'a mut PushAccumulator,
    pub long_pairs: &'a mut LongPairs,
    pub slacks: &'a mut Vec<f32>,
    pub corners: &'a mut Vec<PushedCorner>,
}

/// Pushes the triangles near a collider out of it. `part` is the end and the length of the way of a
/// surface that deforms, in ticks. Returns the sum of the largest depths of all rounds [m].
pub(super) fn push_triangles(
    body: &mut ColliderBody,
    particles: &mut LocalParticles<'_>,
    neighbours: &Neighbours<'_>,
    cloth: ClothTriangles<'_>,
    scratch: &mut RoundScratch<'_>,
    part: [f32; 2],
) -> f32 {
    let largest_gap = particles.gap * TRIANGLE_GAP * particles.contact_scales.thickness_range[1];
    let long = scratch.long.list();
    if let Some(deformation) = body.deformation_mut().filter(|_| !long.is_empty()) {
        let free = neighbours.longest_free_edge;
        let boxes = long_pairs::boxes(particles, cloth.mesh, (long, free), largest_gap);
        deformation.pose_features(boxes, part);
    }
    match body.collision_shape() {
        Some(shape) if shape.bends().is_some() => {
            push_features(shape, particles, neighbours, cloth.mesh, scratch, largest_gap)
        }
        Some(shape) => push_round(shape, particles, neighbours, cloth, scratch),
        None => 0.0,
    }
}

/// Pushes cloth out of the edges and vertices of a shape with flat faces. Triangles and edges keep
/// at most `largest_gap` [m].
fn push_features(
    shape: &CollisionShape,
    particles: &mut LocalParticles<'_>,
    neighbours: &Neighbours<'_>,
    mesh: &Mesh,
    scratch: &mut RoundScratch<'_>,
    largest_gap: f32,
) -> f32 {
    let (pairs, long) = (&mut *scratch.long_pairs, scratch.long.list());
    match mid_phase::features_of(shape).filter(|_| !long.is_empty()) {
        Some(own) => {
            let search = PairSearch { distance: largest_gap, smooth: neighbours.smooth };
            pairs.collect(own, search, particles, mesh, (long, neighbours.longest_free_edge));
        }
        None => pairs.clear(),
    }
    let features = FeatureQuery {
        shape,
        features: neighbours.candidates.features(shape),
        edges: neighbours.candidates.edges,
        vertices: neighbours.candidates.vertices,
        gap: particles.gap * TRIANGLE_GAP,
        largest_scale: particles.contact_scales.thickness_range[1],
        max_depth: neighbours.longest_edge * 0.5,
    };
    let long_features = FeatureQuery { edges: &pairs.edges, vertices: &pairs.vertices, ..features };
    if features.is_empty() && long_features.is_empty() {
        return 0.0;
    }
    let slacks = &mut *scratch.slacks;
    let mut sum = 0.0;
    // Rounds that push far may bring other pairs close.
    for _ in 0..MAX_SEARCHES {
        let mut corners = PushedCorners::begin(scratch.corners, particles);
        slack::set_slacks(&features, particles, &corners, slacks);
        slack::set_slacks(&long_features, particles, &corners, &mut pairs.slacks);
        scratch.pushes.reset(particles.w.len());
        let mut push = |particles: &mut LocalParticles<'_>, pushes: &mut PushAccumulator| {
            corners.measure(pushes.pushed(), particles);
            pushes.reset(particles.w.len());
            let (sharp, smooth) = ((&slacks[..], &corners), (&pairs.slacks[..], &corners));
            let sharp = edge_vs_feature::push(&features, particles, sharp, pushes);
            let smooth = edge_vs_feature::push(&long_features, particles, smooth, pushes);
            pushes.apply(particles);
            max(sharp, smooth)
        };
        let pushed = solve_rounds(shape, particles, neighbours, scratch.pushes, &mut push);
        sum += pushed;
        if pushed <= largest_gap * (slack::CLOSE_GAPS - 1.0) {
            break;
        }
    }
    sum
}

/// Pushes triangles out of a round shape.
fn push_round(
    shape: &CollisionShape,
    particles: &mut LocalParticles<'_>,
    neighbours: &Neighbours<'_>,
    ClothTriangles { mesh, mean_edge, level }: ClothTriangles<'_>,
    scratch: &mut RoundScratch<'_>,
) -> f32 {
    let (triangles, mut sum) = (&mesh.triangles[..], 0.0);
    // Rounds that push far may make other triangles long.
    for _ in 0..MAX_SEARCHES {
        let (long, clearance) = (&*scratch.long, &mut *scratch.clearance);
        if neighbours.triangle_blocks.is_empty() && long.list().is_empty() {
            break;
        }
        let gap = particles.gap;
        let mut push = |particles: &mut LocalParticles<'_>, pushes: &mut PushAccumulator| {
            let surface = (triangles, long);
            triangle_vs_round::solve(shape, particles, surface, neighbours, gap, clearance, pushes)
        };
        let pushed = solve_rounds(shape, particles, neighbours, scratch.pushes, &mut push);
        sum += pushed;
        let (x, room) = (&*particles.x, particles.contact_scales.all_room());
        let predicted = [particles.predicted, particles.displacement];
        let surface = MeasuredSurface { x, predicted, triangles, room, level };
        if !scratch.long.measure_after_rounds(pushed, mean_edge, surface) {
            break;
        }
    }
    sum
}

/// Sets the clearances so that only triangles with a corner that another collider pushed count as
/// near, and returns whether there may be one near the collider of `particles`.
pub(super) fn mark_pushed_by_others(
    shape: &CollisionShape,
    particles: &LocalParticles<'_>,
    neighbours: &Neighbours<'_>,
    mesh: &Mesh,
    scratch: &mut RoundScratch<'_>,
) -> bool {
    if shape.bends().is_none() && neighbours.longest_free_edge == f32::INFINITY {
        return false;
    }
    let others = particles.contacts.iter().filter(|contact| contact.body != particles.body);
    let clearance = &mut *scratch.clearance;
    clearance.clear();
    clearance.resize(particles.w.len(), f32::INFINITY);
    others.for_each(|contact| clearance[contact.particle as usize] = 0.0);
    if shape.bends().is_none() {
        return true;
    }
    let is_near = |corners: &[u32]| corners.iter().any(|i| clearance[*i as usize] == 0.0);
    let candidates = &neighbours.candidates;
    candidates.edges.iter().any(|pair| is_near(&pair.particles))
        || candidates.vertices.iter().any(|pair| is_near(&pair.particles))
        || scratch.long.list().iter().any(|at| is_near(&mesh.triangles[*at as usize]))
}

/// Calls `push`, which pushes triangles out and returns the largest depth [m], until none is too
/// deep. After each round the corners that it moved are pushed out as particles.
///
/// Returns the sum of these depths over all rounds [m].
///
/// If that does not end, the corners of triangles that are still too deep go back to where the
/// substep began, as the collider carries it along: there no triangle penetrated.
fn solve_rounds(
    shape: &CollisionShape,
    particles: &mut LocalParticles<'_>,
    neighbours: &Neighbours<'_>,
    pushes: &mut PushAccumulator,
    push: &mut dyn FnMut(&mut LocalParticles<'_>, &mut PushAccumulator) -> f32,
) -> f32 {
    let (gap, mut pushed) = (particles.gap, 0.0);
    for round in 1..=TRIANGLE_ROUNDS[1] {
        let deepest = push(particles, pushes);
        if deepest == 0.0 {
            return pushed;
        }
        pushed += deepest;
        // A push of a triangle may push its corners into the shape elsewhere.
        for i in pushes.pushed() {
            let candidates = &neighbours.candidates;
            particle_vs_shape::solve_particle(shape, particles, candidates, *i as usize);
        }
        if round >= TRIANGLE_ROUNDS[0] && deepest <= gap * ROUND_TOLERANCE {
            return pushed;
        }
    }
    pushes.set_rollback(Some(particles.depenetration.max_step + gap * ROUND_TOLERANCE));
    for _ in 0..MAX_ROLLBACK_ROUNDS {
        push(particles, pushes);
        if !pushes.has_moved() {
            break;
        }
    }
    pushes.set_rollback(None);
    if shape.deforms() {
        // A corner was carried along by features near it, which may move into the face below it.
        let own = |contact: &ColliderContact| contact.body == particles.body;
        let first = particles.contacts.iter().position(own).unwrap_or(particles.contacts.len());
        for at in first..particles.contacts.len() {
            let i = particles.contacts[at].particle as usize;
            particle_vs_shape::solve_particle(shape, particles, &neighbours.candidates, i);
        }
    }
    pushed
}
