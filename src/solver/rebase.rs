//! Rebase: moves the origin of the cloth along with it, before a tick.
//!
//! ```text
//!  zero ┼────────── 5 km ──────────┼ origin ──▶ x         absolute position = origin + x
//! ```
//! Method: a floating origin (`state::origin`). All state with positions is translated by whole
//! metres, which rounds no coordinate that gets smaller by it. Velocities and history are
//! differences, so they stay.
//!
//! Reads positions and velocities; writes all positions of `World`, and invalidates the caches of
//! positions.
//! Invariant: positions in `World` are relative to `World::origin`, except for `reference_pose`,
//! for events, which the host reads later, and for the descriptors of colliders. Only `cloth` and
//! this file convert.

use crate::solver::world::World;
use crate::state::events::{Event, EventKind};
use crate::state::origin::{Samples, center_near, shift_to_cloth, whole_metres};
use crate::state::pose::Pose;
use glam::Vec3;

/// Largest rounding of a position that does not move the origin [m].
const MAX_LOSS: f32 = 1.0e-6;

impl World {
    /// Converts an absolute position [m] to one relative to the origin.
    pub fn to_relative(&self, position: Vec3) -> Vec3 {
        position - self.origin
    }

    /// Converts a position relative to the origin to an absolute one [m].
    pub fn to_absolute(&self, x: Vec3) -> Vec3 {
        // Adding zero would change the sign of a negative zero.
        if self.origin == Vec3::ZERO { x } else { x + self.origin }
    }

    /// Returns the point of a frame, in whole metres, that is nearest to the origin; zero if the
    /// frame is near or the origin is zero. Near that point, local coordinates are as small as
    /// those of the cloth.
    pub fn local_center(&self, frame: &Pose) -> Vec3 {
        if self.origin == Vec3::ZERO {
            return Vec3::ZERO;
        }
        let to_origin = frame.to_transform().vector_to_local(-frame.position);
        center_near(to_origin)
    }

    /// Returns an event of this tick at a position relative to the origin.
    pub fn event_at(&self, kind: EventKind, x: Vec3) -> Event {
        Event::new(kind, self.clock.tick, self.to_absolute(x))
    }

    /// Moves the origin to the first of these absolute positions [m] that would lose digits relative
    /// to the current origin, if there is one.
    pub fn move_origin_near(&mut self, positions: &[Vec3]) {
        let loses_digits = |position: &&Vec3| {
            let loss = self.to_absolute(self.to_relative(**position)) - **position;
            loss.length_squared() > MAX_LOSS * MAX_LOSS
        };
        if let Some(position) = positions.iter().find(loses_digits) {
            self.move_origin(whole_metres(self.origin, self.to_relative(*position)));
        }
    }

    /// Positions of a few particles, which stand for all.
    pub fn sample_positions(&self) -> Samples {
        Samples::of(self.particles.len(), &|i| self.particles.x.get(i))
    }

    /// Translates the particles to an origin that is `shift` farther [m], in whole metres, and all
    /// state that stays in place with them.
    fn move_origin(&mut self, shift: Vec3) {
        let p = &mut self.particles;
        for column in [&mut p.x, &mut p.x_prev_tick] {
            for i in 0..column.x.len() {
                column.add(i, -shift);
            }
        }
        for pin in self.pins.iter_mut() {
            pin.from -= shift;
            pin.target -= shift;
            pin.final_target -= shift;
        }
        for motion in self.attachments.iter_mut() {
            motion.last.position -= shift;
            motion.next.position -= shift;
            motion.final_pose.position -= shift;
        }
        for anchor in self.anchors.iter_mut() {
            anchor.from -= shift;
            anchor.anchor -= shift;
            anchor.final_anchor[0] -= shift;
        }
        for grab in self.grabs.iter_mut() {
            grab.target -= shift;
            grab.final_target -= shift;
        }
        self.set_origin(self.origin + shift);
    }

    /// Sets the origin after particles and what holds them moved to it: colliders stay in place.
    pub fn set_origin(&mut self, origin: Vec3) {
        let shift = origin - self.origin;
        self.colliders.iter_mut().for_each(|body| body.move_origin(origin, shift));
        self.origin = origin;
        self.scratch.contacts.nearby.invalidate();
        if let Some(collision) = &mut self.scratch.particle_collision {
            collision.invalidate();
        }
        if let Some(surface) = &mut self.scratch.surface_collision {
            surface.invalidate();
        }
        // Rounding may change distances: measure pins again as a restored cloth does, and look for
        // layers that it moved through each other.
        self.is_pin_stretch_current = false;
        self.is_tangled = true;
    }
}

/// Moves the origin if most of the cloth is far from it.
pub(crate) fn follow_cloth(world: &mut World) {
    let v = &world.particles.v;
    let speed = || Samples::of(v.x.len(), &|i| v.get(i)).median().length();
    let shift = shift_to_cloth(world.origin, &world.sample_positions(), &speed);
    if shift != Vec3::ZERO {
        world.move_origin(shift);
    }
}
