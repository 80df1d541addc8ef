//! Depenetration of solid meshes: pushes particles inside towards the closest point of the surface,
//! when a tick begins.
//!
//! ```text
//! depth ≤ max(gap, step):  x ← x + (depth + gap) · outward        step = MAX_DEPENETRATION_SPEED · tick
//! otherwise:               x ← x + step · outward
//! ```
//! Contacts keep a particle on its side of the surface, at the distance of the gap. So a particle that
//! is no deeper than the gap moves to the other side in one step. No step changes a velocity.
//!
//! Reads colliders at the start of the tick; writes positions and `in_solid_meshes`.
//! Invariant: particles outside do not move.

use crate::math::max;
use crate::model::maps::Map;
use crate::solver::collide::MAX_DEPENETRATION_SPEED;
use crate::solver::collide::contact_distance::{contact_gap, smoothing};
use crate::solver::world::World;

/// The gap in multiples of the contact gap. The excess covers rounding.
const CLEARANCE: f32 = 1.05;

/// Pushes free particles out of all solid meshes, and counts those that stay inside in this tick.
pub(crate) fn push_out(world: &mut World) {
    let [_, largest_scale] = world.maps.range(Map::Thickness);
    let step = MAX_DEPENETRATION_SPEED * world.settings.tick;
    let mut has_pushed = false;
    for body in world.colliders.iter().filter(|body| body.is_solid_mesh()) {
        let Some(shape) = body.collision_shape() else { continue };
        let (_, margin) = smoothing(shape, world.mean_edge);
        let gap =
            (contact_gap(body, world.material.thickness) * largest_scale + margin) * CLEARANCE;
        let (frame, bounds) = (body.last.to_transform(), shape.bounds());
        for i in 0..world.particles.len() {
            let point = frame.point_to_local(world.particles.x.get(i));
            if bounds.distance_squared(point) > 0.0 {
                continue;
            }
            let Some((closest, outward)) = body.closest_point_from_inside(point) else { continue };
            let depth = (closest - point).length();
            let (is_free, comes_out) = (world.particles.w[i] > 0.0, depth <= max(gap, step));
            if !(is_free && comes_out) {
                world.scratch.contacts.in_solid_meshes[usize::from(is_free)].add(i as u32);
            }
            if is_free {
                let distance = if comes_out { depth + gap } else { step };
                world.particles.x.set(i, frame.point_to_world(point + outward * distance));
                has_pushed = true;
            }
        }
    }
    if has_pushed {
        world.wake();
    }
}
