//! Pushes particles that are inside solid meshes towards the nearest place of the surface, when a
//! tick begins.
//!
//! ```text
//! x ← x + min(depth + gap, speed · tick) · outward        speed: MAX_DEPENETRATION_SPEED
//! ```
//! The surface of a mesh has two sides, and contacts keep a particle on the side where it is. So a
//! particle within two gaps of the surface comes out in one step: any place nearer to the surface
//! would be pushed in again. The steps give no velocity.
//!
//! Reads colliders where the tick begins; writes positions, and counts who stays inside.
//! Invariant: particles outside do not move.

use crate::math::max;
use crate::model::maps::Map;
use crate::solver::collide::MAX_DEPENETRATION_SPEED;
use crate::solver::collide::contact_distance::{contact_gap, smoothing};
use crate::solver::world::World;

/// How much farther than the gap a particle comes out, as a share of it, so that rounding does not
/// leave it inside.
const CLEARANCE: f32 = 1.05;

/// Pushes particles out of all solid meshes.
pub(crate) fn push_out(world: &mut World) {
    let [_, largest_scale] = world.maps.range(Map::Thickness);
    let step = MAX_DEPENETRATION_SPEED * world.settings.tick;
    let mut has_pushed = false;
    for body in world.colliders.iter().filter(|body| body.desc.solid > 0.0) {
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
            let Some((place, outward)) = body.nearest_from_inside(point) else { continue };
            let depth = (place - point).length();
            let (is_free, comes_out) = (world.particles.w[i] > 0.0, depth <= max(gap, step));
            if !(is_free && comes_out) {
                world.scratch.contacts.in_solid_meshes[usize::from(is_free)].add(i as u32);
            }
            if !is_free {
                continue;
            }
            let way = if comes_out { depth + gap } else { step };
            world.particles.x.set(i, frame.point_to_world(point + outward * way));
            has_pushed = true;
        }
    }
    if has_pushed {
        world.wake();
    }
}
