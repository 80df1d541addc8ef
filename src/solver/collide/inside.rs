//! Reports particles that are inside a collider when a tick ends: those that pins, attachments or
//! grabs hold there, and those that two colliders, or a collider and held cloth, leave no room.
//!
//! Reads positions, inverse masses, colliders and the blocks near them; writes `violations` and
//! events. Invariants: the cloth does not move, and a particle counts once.

use crate::geometry::collision_shape::CollisionShape;
use crate::solver::collide::distance_cull;
use crate::solver::collide::inside_count::InsideCount;
use crate::solver::collide::nearby_blocks::BLOCK;
use crate::solver::world::World;
use crate::state::events::EventKind;

/// The depth from which a particle counts as inside [m].
const DEPTH: f32 = 1.0e-4;

/// Counts the particles inside colliders, and reports them by one event each for held and for free
/// ones. Inside a mesh, which
/// has two sides, only those count that `solid_meshes` found there.
pub(crate) fn report(world: &mut World) {
    let [held, free] = find(world);
    if world.violations.held_inside.update(held.count) {
        push_event(world, EventKind::HeldInside, held);
    }
    if world.violations.free_inside.update(free.count) {
        push_event(world, EventKind::FreeInside, free);
    }
}

#[inline(never)]
fn push_event(world: &mut World, kind: EventKind, found: InsideCount) {
    let mut event = world.event_at(kind, world.particles.x.get(found.first as usize));
    (event.particle_a, event.count) = (found.first, found.count);
    world.events.push(event);
}

/// Returns the held particles and the free ones that are inside a collider.
fn find(world: &mut World) -> [InsideCount; 2] {
    let mut found = world.scratch.contacts.in_solid_meshes;
    let (contacts, particles) = (&mut world.scratch.contacts, &world.particles);
    let (count, is_counted) = (particles.len(), &mut contacts.is_inside);
    is_counted.clear();
    for (at, body) in world.colliders.iter().take(contacts.nearby.entries.len()).enumerate() {
        let Some(shape) = body.collision_shape() else { continue };
        if matches!(shape, CollisionShape::TriangleSurface(..)) {
            continue;
        }
        let (frame, bound) = (body.next.to_transform(), shape.distance_bound());
        for block in contacts.nearby.of_collider(at).particle_blocks {
            let first = *block as usize * BLOCK;
            let range = first..(first + BLOCK).min(count);
            let x = &particles.x;
            if !distance_cull::is_any_below(world.level, x, &frame, bound, range.clone(), -DEPTH) {
                continue;
            }
            is_counted.resize(count, false);
            for i in range {
                if !is_counted[i] && shape.depth(frame.point_to_local(x.get(i))) > DEPTH {
                    is_counted[i] = true;
                    found[usize::from(particles.w[i] > 0.0)].add(i as u32);
                }
            }
        }
    }
    found
}
