//! A person on a floor, as colliders of cloths: a capsule with a ball for the head, which walks to
//! where it is sent.
//!
//! ```text
//! v ← v + clamp(RATE · (target − x) − v, ACCELERATION · dt),  |v| ≤ SPEED,   x ← x + v · dt
//! ```
//! Method: the walker turns towards its target with limited acceleration and speed, so that cloth is
//! pushed and not hit. Until it is sent somewhere it walks to and fro by itself.
//!
//! Reads the target; writes the poses of the colliders at the end of the next tick.
//!
//! Invariant: it stays within its bounds, and ticks alone advance it, whatever the frames are.

use glam::{Quat, Vec2, Vec3};
use muslin::{Cloth, Collider, ColliderDesc, Result, Shape};
use std::f32::consts::TAU;

use crate::stage::FLOOR;

/// Largest speed [m/s] and acceleration [m/s²].
const SPEED: f32 = 1.5;
const ACCELERATION: f32 = 5.0;
/// Speed per distance to the target [1/s].
const RATE: f32 = 3.5;
/// Time of one round without a target [s].
const ROUND: f32 = 9.0;

/// A person that walks through cloths.
#[derive(Debug)]
pub struct Walker {
    /// Largest distances from the middle along x and z [m].
    bounds: Vec2,
    /// Body and head, in each cloth.
    colliders: Vec<[Collider; 2]>,
    now: Step,
    /// The state after the next tick.
    next: Step,
    target: Option<Vec2>,
    /// Whether it walks to and fro until it has a target.
    is_restless: bool,
    ticks: u32,
}

/// Position and velocity on the floor, along x and z [m, m/s].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Step {
    at: Vec2,
    velocity: Vec2,
}

impl Walker {
    /// Radii of body and head [m].
    pub const RADII: [f32; 2] = [0.19, 0.13];
    /// Height of the shoulders, and of the centre of the head [m].
    pub const HEIGHTS: [f32; 2] = [1.32, 1.44];

    /// Adds the walker at the far end of its bounds to all cloths.
    ///
    /// # Errors
    /// As [`Cloth::add_collider`].
    pub fn new(cloths: &mut [Cloth], bounds: Vec2) -> Result<Self> {
        let now = Step { at: Vec2::new(0.0, bounds.y), velocity: Vec2::ZERO };
        let [body, head] = shapes();
        let mut colliders = Vec::new();
        for cloth in cloths {
            let mut add = |desc: &ColliderDesc| {
                let position = desc.position + Vec3::new(now.at.x, 0.0, now.at.y);
                cloth.add_collider(&ColliderDesc { position, ..desc.clone() })
            };
            colliders.push([add(&body)?, add(&head)?]);
        }
        Ok(Self { bounds, colliders, now, next: now, target: None, is_restless: true, ticks: 0 })
    }

    /// Sends it to a point of the floor; the nearest one within its bounds if that is outside.
    pub fn walk_to(&mut self, target: Vec3) {
        if target.is_finite() {
            let target = Vec2::new(target.x, target.z);
            self.target = Some(target.clamp(-self.bounds, self.bounds));
        }
    }

    /// Sets whether it walks to and fro while it has no target.
    pub fn set_restless(&mut self, is_restless: bool) {
        self.is_restless = is_restless;
    }

    /// Returns the point of the floor that it stands on [m].
    pub fn position(&self) -> Vec3 {
        Vec3::new(self.now.at.x, FLOOR, self.now.at.y)
    }

    /// Moves the colliders to the pose at the end of the next tick.
    pub(crate) fn set_targets(&mut self, cloths: &mut [Cloth]) {
        let tick = cloths.first().map_or(1.0 / 60.0, |cloth| cloth.settings().tick);
        self.next = self.after(tick);
        let on_floor = Vec3::new(self.next.at.x, 0.0, self.next.at.y);
        for (cloth, colliders) in cloths.iter_mut().zip(&self.colliders) {
            for (collider, desc) in colliders.iter().zip(shapes()) {
                let moved =
                    cloth.move_collider(*collider, desc.position + on_floor, Quat::IDENTITY);
                debug_assert!(moved.is_ok(), "the walker does not move: {moved:?}");
            }
        }
    }

    /// Counts ticks that have run.
    pub(crate) fn add_ticks(&mut self, ticks: u32) {
        if ticks > 0 {
            self.now = self.next;
            self.ticks = self.ticks.wrapping_add(ticks);
        }
    }

    /// Returns the state one tick of `dt` [s] later.
    fn after(&self, dt: f32) -> Step {
        let Step { at, velocity } = self.now;
        let wanted = (RATE * (self.goal(dt) - at)).clamp_length_max(SPEED);
        let velocity = velocity + (wanted - velocity).clamp_length_max(ACCELERATION * dt);
        let to = at + velocity * dt;
        Step { at: to.clamp(-self.bounds, self.bounds), velocity }
    }

    fn goal(&self, dt: f32) -> Vec2 {
        let round = (ROUND / dt).round().max(1.0);
        let share = (f64::from(self.ticks) % f64::from(round)) as f32 / round;
        let to_and_fro = Vec2::new(0.25 * (TAU * share).sin(), (TAU * share).cos());
        match self.target {
            Some(target) => target,
            None if self.is_restless => to_and_fro * self.bounds,
            None => self.now.at,
        }
    }
}

/// Body and head over the middle of the floor.
fn shapes() -> [ColliderDesc; 2] {
    let ([body, head], [shoulders, centre]) = (Walker::RADII, Walker::HEIGHTS);
    [
        ColliderDesc {
            shape: Shape::Capsule,
            position: Vec3::Y * (FLOOR + 0.5 * shoulders),
            radius: body,
            top_radius: body,
            half_height: 0.5 * shoulders - body,
            friction: 0.2,
            ..ColliderDesc::default()
        },
        ColliderDesc {
            shape: Shape::Sphere,
            position: Vec3::Y * (FLOOR + centre),
            radius: head,
            friction: 0.2,
            ..ColliderDesc::default()
        },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn walker() -> Walker {
        Walker::new(&mut [], Vec2::new(0.5, 1.2)).unwrap()
    }

    #[test]
    fn a_walker_arrives_within_its_bounds_and_no_faster_than_it_may() {
        let mut walker = walker();
        walker.walk_to(Vec3::new(9.0, 3.0, -40.0));
        for _ in 0..240 {
            let from = walker.position();
            walker.set_targets(&mut []);
            walker.add_ticks(1);
            assert!(walker.position().distance(from) < SPEED / 60.0 + 1.0e-5);
        }
        let at = walker.position();
        assert!(at.distance(Vec3::new(0.5, FLOOR, -1.2)) < 0.01, "it is at {at}");
        walker.walk_to(Vec3::NAN);
        walker.set_targets(&mut []);
        walker.add_ticks(1);
        assert!(walker.position().distance(at) < 0.01);
    }

    #[test]
    fn a_walker_without_a_target_goes_to_both_sides_unless_it_is_at_rest() {
        let range = |is_restless| {
            let mut walker = walker();
            walker.set_restless(is_restless);
            let z = (0..600).map(|_| {
                walker.set_targets(&mut []);
                walker.add_ticks(1);
                walker.position().z
            });
            z.fold((f32::MAX, f32::MIN), |(low, high), z| (low.min(z), high.max(z)))
        };
        let (low, high) = range(true);
        assert!(low < -0.9 && high > 0.9, "from {low} m to {high} m");
        let (low, high) = range(false);
        assert!(high - low < 1.0e-6, "from {low} m to {high} m");
    }
}
