//! Solves the contacts of all colliders in one substep, one collider after the other.
//!
//! ```text
//! each collider    particles ─▶ long triangles ─▶ rounds of triangles or of edges and vertices
//! then             particles between two colliders, and in the creases where solids overlap
//!                  (`squeezed`)
//! ```
//! Reads colliders, the blocks near them, positions and predicted positions; writes positions and
//! the list of contacts.
//! Invariant: each round tests particles last, so a correction of a triangle does not leave a
//! particle inside.

use crate::geometry::collision_shape::CollisionShape;
use crate::geometry::transform::Transform;
use crate::math::max;
use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::collide::contact_distance::{TRIANGLE_GAP, contact_gap};
use crate::solver::collide::edge_vs_feature::FeatureQuery;
use crate::solver::collide::local_particles::{
    ContactMaterial, ContactScales, Depenetration, LocalParticles,
};
use crate::solver::collide::mid_phase::PairSearch;
use crate::solver::collide::nearby_blocks::Neighbours;
use crate::solver::collide::projection::{MAX_DEPENETRATION_SPEED, Projection};
use crate::solver::collide::push_accumulator::PushAccumulator;
use crate::solver::collide::{
    edge_vs_feature, long_pairs, mid_phase, particle_vs_shape, squeezed, triangle_vs_round,
};
use crate::solver::world::World;
use crate::state::colliders::ColliderBody;
use glam::Vec3;

/// Rounds per substep that push triangles out of a shape: the smallest number while any triangle
/// penetrates, and the largest number while one is too deep.
const TRIANGLE_ROUNDS: [u32; 2] = [2, 40];

/// The largest number of times that the pairs of one collider are searched in a substep.
const MAX_SEARCHES: u32 = 4;

/// The largest number of rounds that roll triangles back.
const MAX_ROLLBACK_ROUNDS: u32 = 100;

/// The largest number of times that particles in a crease are pushed out of each collider.
const MAX_CREASE_ROUNDS: u32 = 40;

/// A penetration deeper than this, in mean edge lengths, is not the result of motion. The first
/// value is for round shapes, the second for shapes with flat faces, whose vertices may stick
/// through the cloth.
const DEEP: [f32; 2] = [0.25, 0.75];

/// The fraction of the gap that the last round may leave to the next substep.
const ROUND_TOLERANCE: f32 = 0.1;

/// Solves the contacts of all colliders, one after the other. `frames` gives the frames of a
/// collider at the start and at the end, and `part` is the end and the length of the way of surfaces
/// that deform, in ticks. With `projection` it only pushes out, without friction and
/// restitution.
pub(super) fn solve(
    world: &mut World,
    frames: &dyn Fn(&ColliderBody) -> [Transform; 2],
    part: [f32; 2],
    projection: Option<Projection>,
) {
    let mut run = |pass| run_pass(world, frames, part, projection, pass);
    run(Pass::First);
    run(Pass::Again);
    let mut are_inside = run(Pass::Distances);
    for _ in 0..MAX_CREASE_ROUNDS {
        if !are_inside {
            break;
        }
        are_inside = run(Pass::Creases);
    }
}

/// What is done with each collider.
#[derive(Clone, Copy, PartialEq)]
enum Pass {
    /// Pushes particles and triangles out.
    First,
    /// Pushes particles out again that another collider pushed into this one.
    Again,
    /// Measures the distances of particles that two colliders push towards each other; then these are
    /// separated.
    Distances,
    /// Pushes out particles that two colliders leave no room on the line between them.
    Creases,
}

/// Runs one pass over all colliders. Without particles between two colliders only the first does
/// anything. Returns whether particles may be left that two colliders leave no room.
fn run_pass(
    world: &mut World,
    frames: &dyn Fn(&ColliderBody) -> [Transform; 2],
    part: [f32; 2],
    projection: Option<Projection>,
    pass: Pass,
) -> bool {
    let contacts = &mut world.scratch.contacts;
    let count = contacts.collider_contacts.len();
    let is_needed = match pass {
        Pass::First => true,
        Pass::Again => count > 0 && contacts.nearby.are_several_near(),
        Pass::Distances => squeezed::select(contacts),
        Pass::Creases => true,
    };
    if !is_needed {
        return false;
    }
    let mut are_inside = false;
    let scheme = world.scheme();
    let is_projection = projection.is_some();
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let contacts = &mut scratch.contacts;
    let scales = ContactScales::new(&world.maps, &contacts.room);
    for (at, body) in world.colliders.iter_mut().enumerate() {
        let neighbours = contacts.nearby.of_collider(at);
        if neighbours.particle_blocks.is_empty() {
            continue;
        }
        if let Some(deformation) = body.deformation_mut().filter(|_| pass == Pass::First) {
            deformation.pose(part);
        }
        let Some(shape) = body.collision_shape() else { continue };
        let gap = contact_gap(body, world.material.thickness)
            * projection.map_or(1.0, Projection::gap_share);
        let mut particles = LocalParticles {
            x: &mut p.x,
            v: &p.v,
            w: &p.w,
            displacement: &scratch.displacement,
            predicted: &scratch.predicted,
            frames: frames(body),
            material: if is_projection {
                ContactMaterial::FRICTIONLESS
            } else {
                ContactMaterial::of(body, world.material.friction, world.material.restitution)
            },
            contact_scales: scales,
            gap,
            margin: neighbours.sagitta_margin,
            depenetration: Depenetration {
                max_step: MAX_DEPENETRATION_SPEED * scheme.h,
                deep: if is_projection {
                    2.0 * gap
                } else {
                    DEEP[usize::from(shape.bends().is_some())] * world.mean_edge
                },
                holds_deep: is_projection,
            },
            scheme,
            body: at as u32,
            is_far_from_zero: world.origin != Vec3::ZERO,
            contacts: &mut contacts.collider_contacts,
            contact_slots: &mut contacts.contact_slots,
        };
        if pass == Pass::Creases {
            let candidates = &neighbours.candidates;
            are_inside |= squeezed::push_along_creases(shape, &mut particles, candidates, count);
            continue;
        }
        if pass != Pass::First {
            let (candidates, is_again) = (&neighbours.candidates, pass == Pass::Again);
            squeezed::visit(shape, &mut particles, candidates, count, is_again);
            continue;
        }
        let (clearance, pushes) = (&mut contacts.clearance, &mut contacts.pushes);
        let has_triangles = neighbours.longest_free_edge < f32::INFINITY;
        if has_triangles || clearance.len() != particles.w.len() {
            // Corners of triangles that lie in no listed particle block count as near.
            clearance.clear();
            clearance.resize(particles.w.len(), 0.0);
        }
        let first_contact = particles.contacts.len();
        particle_vs_shape::solve_blocks(
            world.level,
            shape,
            &mut particles,
            neighbours.particle_blocks,
            &neighbours.candidates,
            clearance,
        );
        if projection == Some(Projection::Particles) {
            continue;
        }
        if has_triangles {
            let new = &particles.contacts[first_contact..];
            let surface = (&*particles.x, &world.mesh.triangles[..]);
            contacts.long.measure_after_pushes(new, world.mean_edge, surface, world.level);
        }
        let long = contacts.long.list();
        let free = neighbours.longest_free_edge;
        let largest_gap = gap * TRIANGLE_GAP * scales.thickness_range[1];
        if let Some(deformation) = body.deformation_mut().filter(|_| !long.is_empty()) {
            let boxes = long_pairs::boxes(&particles, &world.mesh, (long, free), largest_gap);
            deformation.pose_features(boxes, part);
        }
        let Some(shape) = body.collision_shape() else { continue };
        if shape.bends().is_some() {
            let pairs = &mut contacts.long_pairs;
            let own = mid_phase::features_of(shape);
            match own.filter(|_| !long.is_empty()) {
                Some(own) => {
                    let search = PairSearch { distance: largest_gap, smooth: neighbours.smooth };
                    pairs.collect(own, search, &particles, &world.mesh, (long, free));
                }
                None => pairs.clear(),
            }
            let features = FeatureQuery {
                shape,
                features: neighbours.candidates.features(shape),
                edges: neighbours.candidates.edges,
                vertices: neighbours.candidates.vertices,
                gap: gap * TRIANGLE_GAP,
                largest_scale: scales.thickness_range[1],
                max_depth: neighbours.longest_edge * 0.5,
            };
            let long_features =
                FeatureQuery { edges: &pairs.edges, vertices: &pairs.vertices, ..features };
            let (positions, close_pairs) =
                (&mut contacts.local_positions, &mut contacts.close_pairs);
            if features.is_empty() && long_features.is_empty() {
                continue;
            }
            // Rounds that push far may bring other pairs close.
            for _ in 0..MAX_SEARCHES {
                positions.clear();
                positions.extend((0..particles.w.len()).map(|i| particles.end_position(i)));
                edge_vs_feature::collect_close_pairs(&features, positions, close_pairs);
                edge_vs_feature::collect_close_pairs(&long_features, positions, &mut pairs.close);
                let pushed = solve_rounds(
                    shape,
                    &mut particles,
                    &neighbours,
                    gap,
                    pushes,
                    &mut |particles, pushes| {
                        pushes.reset(particles.w.len());
                        let sharp =
                            edge_vs_feature::push(&features, particles, close_pairs, pushes);
                        let smooth =
                            edge_vs_feature::push(&long_features, particles, &pairs.close, pushes);
                        pushes.apply(particles);
                        max(sharp, smooth)
                    },
                );
                if pushed <= largest_gap * (edge_vs_feature::CLOSE_GAPS - 1.0) {
                    break;
                }
            }
            continue;
        }
        // Rounds that push far may make other triangles long.
        for _ in 0..MAX_SEARCHES {
            let long = contacts.long.list();
            if neighbours.triangle_blocks.is_empty() && long.is_empty() {
                break;
            }
            let triangles = &world.mesh.triangles[..];
            let pushed = solve_rounds(
                shape,
                &mut particles,
                &neighbours,
                gap,
                pushes,
                &mut |particles, pushes| {
                    triangle_vs_round::solve(
                        shape,
                        particles,
                        (triangles, long),
                        &neighbours,
                        gap,
                        clearance,
                        pushes,
                    )
                },
            );
            let surface = (&*particles.x, triangles);
            if !contacts.long.measure_after_rounds(pushed, world.mean_edge, surface, world.level) {
                break;
            }
        }
    }
    if pass == Pass::Distances {
        are_inside = squeezed::separate(&mut p.x, contacts);
    }
    are_inside
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
    gap: f32,
    pushes: &mut PushAccumulator,
    push: &mut dyn FnMut(&mut LocalParticles<'_>, &mut PushAccumulator) -> f32,
) -> f32 {
    let mut pushed = 0.0;
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
