//! Stage `Contacts`: collisions of the cloth with colliders, with Coulomb friction.
//!
//! ```text
//! motion        cloth relative to colliders: substeps of the tick           every tick
//! broad phase   collider × blocks of particles and triangles, by AABB       when particles moved
//! mid phase     particle × face, edge × edge feature, triangle × vertex     with the broad phase
//! narrow phase  distance cull, then particles, then triangles or features   every substep
//! response      restitution, sliding, impulses                              every substep
//! ```
//! Position-based contacts: each penetration is projected out, and friction takes back part of the
//! tangential motion (`local_particles`). All tests run in the local frame of the collider:
//! positions at the start of the substep use its frame at the start, current positions its frame at
//! the end. In these coordinates the collider is at rest, so continuous detection works for moving
//! colliders too.
//!
//! Reads colliders, positions and predicted positions; writes positions, velocities (in `response`)
//! and the impulses on colliders. Invariant: no particle that started a substep outside a collider
//! ends it inside. Each round tests particles last, so a correction of a triangle does not leave a
//! particle inside.

mod any_moved;
mod body_motion;
pub(crate) mod broad_phase;
pub(crate) mod collider_contact;
mod contact_distance;
pub(crate) mod contact_scratch;
mod distance_cull;
mod edge_vs_feature;
pub(crate) mod inside;
mod inside_count;
mod local_particles;
mod long_pairs;
mod long_triangles;
mod mid_phase;
mod nearby_blocks;
mod particle_bounds;
mod particle_motions;
mod particle_vs_shape;
mod push_accumulator;
pub(crate) mod relative_motion;
pub(crate) mod response;
pub(crate) mod second_response;
pub(crate) mod solid_meshes;
mod triangle_vs_round;

use crate::geometry::collision_shape::CollisionShape;
use crate::geometry::transform::Transform;
use crate::math::max;
use crate::math::wide4::{Float4, xyz};
use crate::solver::collide::collider_contact::ColliderContact;
use crate::solver::collide::contact_distance::{TRIANGLE_GAP, contact_gap};
use crate::solver::collide::edge_vs_feature::FeatureQuery;
use crate::solver::collide::local_particles::{
    ContactMaterial, ContactScales, Depenetration, LocalParticles,
};
use crate::solver::collide::mid_phase::PairSearch;
use crate::solver::collide::nearby_blocks::Neighbours;
use crate::solver::collide::push_accumulator::PushAccumulator;
use crate::solver::world::World;
use crate::state::colliders::{ColliderBody, Impulse};
use glam::Vec3;

/// Rounds per substep that push triangles out of a shape: the smallest number while any triangle
/// penetrates, and the largest number while one is too deep.
const TRIANGLE_ROUNDS: [u32; 2] = [2, 40];

/// The largest number of times that the pairs of one collider are searched in a substep.
const MAX_SEARCHES: u32 = 4;

/// The largest number of rounds that roll triangles back.
const MAX_ROLLBACK_ROUNDS: u32 = 100;

/// The largest speed at which cloth that started inside a shape comes out [m/s]. A larger speed
/// would overstretch the cloth around it and fling it away.
const MAX_DEPENETRATION_SPEED: f32 = 0.05;

/// A penetration deeper than this, in mean edge lengths, is not the result of motion. The first
/// value is for round shapes, the second for shapes with flat faces, whose vertices may stick
/// through the cloth.
const DEEP: [f32; 2] = [0.25, 0.75];

/// The fraction of the gap that the last round may leave to the next substep.
const ROUND_TOLERANCE: f32 = 0.1;

/// The fraction of the contact gap that the last projections restore.
pub(crate) const PROJECTION_GAP: f32 = 0.5;

/// Depths below this are rounding, and are left [m].
const MIN_PROJECTION: f32 = 1.0e-6;

impl World {
    /// Allocates the contact buffers for all live colliders; without colliders it changes nothing.
    pub(crate) fn reserve_contacts(&mut self) {
        let (bodies, particles) = (self.colliders.iter().count(), self.capacity());
        if bodies > 0 {
            self.scratch.contacts.reserve(bodies, particles, self.triangle_capacity);
            self.scratch.rollback.before.reserve(particles);
            if self.colliders.iter().any(|body| body.deformation().is_some()) {
                let nearby = &mut self.scratch.contacts.nearby;
                nearby.reserve_for_deforming(bodies, particles, self.triangle_capacity);
            }
        }
    }
}

/// Begins a tick: clears contacts and impulses, and updates the swept bounds of colliders.
pub(crate) fn begin_tick(world: &mut World) {
    let scratch = &mut world.scratch.contacts;
    scratch.collider_contacts.clear();
    scratch.long.invalidate();
    scratch.first_pusher = 0;
    scratch.in_solid_meshes = Default::default();
    scratch.impulses.clear();
    scratch.impulses.extend(world.colliders.iter().map(|_| Impulse::default()));
    scratch.late_pushes.clone_from(&scratch.impulses);
    broad_phase::update_swept_bounds(world);
}

/// Ends a tick: moves every collider to its next pose and gives it the impulses of the tick, about
/// its position.
pub(crate) fn finish_tick(world: &mut World) {
    for (body, impulse) in world.colliders.iter_mut().zip(&world.scratch.contacts.impulses) {
        body.finish_tick();
        body.impulse = impulse.about(body.position()).saturate();
        body.pending = body.pending.saturate();
    }
}

/// Starts the phase after the last substep, in which colliders rest where they ended: paths of
/// particles start at the current positions. The start of the substep may be inside a collider that
/// has moved on since.
pub(crate) fn begin_last_phase(world: &mut World) {
    world.scratch.predicted.copy_from(&world.particles.x);
    world.scratch.displacement.fill(Vec3::ZERO);
}

/// Prepares colliders for stages that run between two ticks: colliders may have come or gone since
/// the last one, and paths of particles start at the current positions.
pub(crate) fn begin_between_ticks(world: &mut World) {
    begin_tick(world);
    begin_last_phase(world);
}

/// What a projection pushes out of colliders, without friction and restitution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Projection {
    /// Particles, as far as the whole contact gap.
    Particles,
    /// Particles and triangles, as far as a part of the gap. The next substep restores the whole;
    /// demanding it at once would let constraints alternate more often.
    Surface,
}

impl Projection {
    /// Returns the fraction of the contact gap that is restored.
    fn gap_share(self) -> f32 {
        if self == Self::Particles { 1.0 } else { PROJECTION_GAP }
    }
}

/// Pushes the cloth out of every collider in its pose at the end of the tick. For stages that moved
/// particles after the last substep; paths start at `scratch.predicted` minus
/// `scratch.displacement`.
pub(crate) fn project_out(world: &mut World, projection: Projection) {
    if world.scratch.contacts.impulses.is_empty() {
        return;
    }
    if projection == Projection::Surface {
        world.scratch.contacts.long.invalidate();
    }
    broad_phase::refresh(world, [1.0, 0.0]);
    let frames = |body: &ColliderBody| [body.next.to_transform(); 2];
    solve_colliders(world, &frames, [1.0, 0.0], Some(projection));
    world.scratch.contacts.collider_contacts.clear();
}

/// Pushes particles and triangles out of every collider in its pose at the end of this substep,
/// without friction and restitution, and lists the particles that this moved in `pushed`. The
/// contacts of the substep stay.
///
/// With `starts`, the positions at the start of the substep, these particles go back to their start
/// instead, as it moves along with the collider.
pub(crate) fn project_out_in_substep(
    world: &mut World,
    substep: u32,
    starts: Option<&[Float4]>,
    pushed: &mut Vec<u32>,
) {
    pushed.clear();
    world.scratch.contacts.projections.clear();
    if world.scratch.contacts.impulses.is_empty() {
        return;
    }
    let (substeps, h) = (world.substeps, world.regular_scheme().h);
    let max_step = MAX_DEPENETRATION_SPEED * h;
    let contacts = &mut world.scratch.contacts;
    core::mem::swap(&mut contacts.collider_contacts, &mut contacts.projections);
    contacts.collider_contacts.clear();
    broad_phase::refresh(world, substep_part(substep, substeps));
    solve_colliders(
        world,
        &|body| substep_frames(body, substep, substeps),
        substep_part(substep, substeps),
        Some(Projection::Surface),
    );
    let contacts = &mut world.scratch.contacts;
    core::mem::swap(&mut contacts.collider_contacts, &mut contacts.projections);
    let x = &mut world.particles.x;
    // At the start of the substep some are nearer than the gap, and rise by a step.
    let least = if starts.is_some() { max_step * 1.01 } else { MIN_PROJECTION };
    contacts.projections.retain(|projection| {
        let is_deep = projection.correction.length_squared() > least * least;
        if !is_deep {
            x.add(projection.particle as usize, -projection.correction);
        }
        is_deep
    });
    pushed.extend(contacts.projections.iter().map(|projection| projection.particle));
    for projection in &contacts.projections {
        let i = projection.particle as usize;
        let (mut end, mut push) = (world.particles.x.get(i), projection.correction);
        let body = world.colliders.iter().nth(projection.body as usize);
        if let (Some(starts), Some(body)) = (starts, body) {
            let [from, to] = substep_frames(body, substep, substeps);
            let start = xyz(&starts[i]);
            let mut carried =
                if from == to { start } else { to.point_to_world(from.point_to_local(start)) };
            if body.deformation().is_some() {
                carried = start + projection.surface_velocity * h;
            }
            push += carried - end;
            end = carried;
            world.particles.x.set(i, end);
        }
        let pushes = &mut contacts.late_pushes[projection.body as usize];
        pushes.add_at(end, push * world.particles.mass[i]);
    }
}

/// Finds the pairs of this substep.
pub(crate) fn refresh_pairs(world: &mut World, substep: u32) {
    broad_phase::refresh(world, substep_part(substep, world.substeps));
}

/// Pushes free particles, edges and triangles out of every collider in its pose at the end of this
/// substep.
pub(crate) fn solve(world: &mut World, substep: u32) {
    let contacts = &mut world.scratch.contacts;
    contacts.collider_contacts.clear();
    contacts.forget_late_pushes();
    let substeps = world.substeps;
    let frames = |body: &ColliderBody| substep_frames(body, substep, substeps);
    solve_colliders(world, &frames, substep_part(substep, substeps), None);
}

/// Solves the contacts of all colliders, one after the other. `frames` gives the frames of a
/// collider at the start and at the end, and `part` is the end and the length of the way of surfaces
/// that deform, in ticks. With `projection` it only pushes out, without friction and
/// restitution.
fn solve_colliders(
    world: &mut World,
    frames: &dyn Fn(&ColliderBody) -> [Transform; 2],
    part: [f32; 2],
    projection: Option<Projection>,
) {
    let scheme = world.scheme();
    let is_projection = projection.is_some();
    let (p, scratch) = (&mut world.particles, &mut world.scratch);
    let contacts = &mut scratch.contacts;
    let scales = ContactScales::of(&world.maps);
    for (at, body) in world.colliders.iter_mut().enumerate() {
        let neighbours = contacts.nearby.of_collider(at);
        if neighbours.particle_blocks.is_empty() {
            continue;
        }
        if let Some(deformation) = body.deformation_mut() {
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

/// Returns the frames of a collider at the start and at the end of a substep.
fn substep_frames(body: &ColliderBody, substep: u32, substeps: u32) -> [Transform; 2] {
    if body.last == body.next {
        return [body.next.to_transform(); 2];
    }
    [substep, substep + 1].map(|at| body.last.at_substep(&body.next, at, substeps).to_transform())
}

/// The part of a tick that a substep is: its end and its length, in ticks.
fn substep_part(substep: u32, substeps: u32) -> [f32; 2] {
    let end = if substep + 1 == substeps { 1.0 } else { (substep + 1) as f32 / substeps as f32 };
    [end, 1.0 / substeps as f32]
}
