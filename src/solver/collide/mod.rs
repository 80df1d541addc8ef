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
mod collider_solver;
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
mod projection;
mod push_accumulator;
mod pushed_corners;
pub(crate) mod relative_motion;
pub(crate) mod response;
mod room;
pub(crate) mod second_response;
mod slack;
mod solid_distances;
pub(crate) mod solid_meshes;
mod squeezed;
mod triangle_rounds;
mod triangle_vs_round;

pub(crate) use crate::solver::collide::projection::{PROJECTION_GAP, Projection};

use crate::geometry::transform::Transform;
use crate::math::reserve::ReserveTotal;
use crate::math::wide4::{Float4, xyz};
use crate::solver::collide::projection::MAX_DEPENETRATION_SPEED;
use crate::solver::scratch_pool;
use crate::solver::world::World;
use crate::state::colliders::{ColliderBody, Impulse};
use glam::Vec3;

/// Depths below this are rounding, and are left [m].
const MIN_PROJECTION: f32 = 1.0e-6;

impl World {
    /// Allocates the contact buffers for all live colliders; without colliders it changes nothing.
    pub(crate) fn reserve_contacts(&mut self) {
        let (bodies, particles) = (self.colliders.iter().count(), self.allocated_particles());
        if bodies > 0 {
            let triangles = self.allocated_triangles();
            let contacts = &mut self.scratch.contacts;
            contacts.reserve(bodies, particles, triangles);
            if self.colliders.iter().any(|body| body.deformation().is_some()) {
                contacts.nearby.displacements.reserve_total(particles);
            }
            scratch_pool::reserve(self);
        }
    }

    /// Allocates the lent contact buffers for all live colliders.
    pub(crate) fn reserve_lent_contacts(&mut self) {
        let (bodies, particles) = (self.colliders.iter().count(), self.capacity());
        let contacts = &mut self.scratch.contacts;
        contacts.reserve_lent(bodies, particles, self.triangle_capacity);
        let has_flat_faces = self
            .colliders
            .iter()
            .any(|body| body.collision_shape().is_none_or(|shape| shape.bends().is_some()));
        if has_flat_faces {
            contacts.nearby.candidates.reserve(bodies, particles, self.triangle_capacity);
        }
        if self.colliders.iter().any(|body| body.deformation().is_some()) {
            contacts.nearby.reserve_for_deforming(bodies, particles, self.triangle_capacity);
        }
    }
}

/// Begins a tick: clears contacts and impulses, and updates the swept bounds of colliders.
pub(crate) fn begin_tick(world: &mut World) {
    let scratch = &mut world.scratch.contacts;
    scratch.collider_contacts.clear();
    scratch.long.invalidate();
    scratch.room.reset();
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
    collider_solver::solve(world, &frames, [1.0, 0.0], Some(projection));
    world.scratch.contacts.collider_contacts.clear();
}

/// Pushes particles and triangles out of every collider in its pose at the end of this substep,
/// without friction and restitution, and lists the particles that this moved in `pushed`. The
/// contacts of the substep stay. Without a substep, colliders rest where they ended.
///
/// With `starts`, the positions at the start of the substep, these particles go back to their start
/// instead, as it moves along with the collider.
pub(crate) fn project_out_in_substep(
    world: &mut World,
    substep: Option<u32>,
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
    // Contacts between layers stretch triangles far.
    contacts.long.invalidate();
    let frames = |body: &ColliderBody| match substep {
        Some(substep) => substep_frames(body, substep, substeps),
        None => [body.next.to_transform(); 2],
    };
    let part = substep.map_or([1.0, 0.0], |substep| substep_part(substep, substeps));
    broad_phase::refresh(world, part);
    collider_solver::solve(world, &frames, part, Some(Projection::Surface));
    let contacts = &mut world.scratch.contacts;
    core::mem::swap(&mut contacts.collider_contacts, &mut contacts.projections);
    let x = &mut world.particles.x;
    // At the start of the substep some are nearer than the gap, and rise by a step.
    let least = if starts.is_some() { max_step * 1.01 } else { MIN_PROJECTION };
    // Two colliders that squeeze a particle push it against each other and may leave it where it was.
    let net = &mut contacts.net_corrections;
    contacts.projections.iter().for_each(|one| net[one.particle as usize] = Vec3::ZERO);
    contacts.projections.iter().for_each(|one| net[one.particle as usize] += one.correction);
    contacts.projections.retain(|projection| {
        let i = projection.particle as usize;
        let is_deep = net[i].length_squared() > least * least;
        if !is_deep {
            x.add(i, -projection.correction);
        }
        is_deep
    });
    pushed.extend(contacts.projections.iter().map(|projection| projection.particle));
    for projection in &contacts.projections {
        let i = projection.particle as usize;
        let (mut end, mut push) = (world.particles.x.get(i), projection.correction);
        let body = world.colliders.iter().nth(projection.body as usize);
        if let (Some(starts), Some(body)) = (starts, body) {
            let [from, to] = frames(body);
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
    collider_solver::solve(world, &frames, substep_part(substep, substeps), None);
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
