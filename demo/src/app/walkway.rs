//! Pointers and keys that walk a person through the curtain of the doorway.
//!
//! Method: the ray of a pixel meets the floor, and the walker is sent there; a ray that passes over
//! the floor sends it to the far end. While keys are held, the walker is sent ahead of where it is;
//! after a short press it takes one step.
//!
//! Reads pointers, keys and the camera; writes the target of the walker.
//!
//! Invariant: scenes without a walker are not changed.

use glam::{Vec2, Vec3};
use muslin::Result;
use muslin_scenes::{Doorway, Walker};

use super::App;
use crate::render::light::FLOOR;

/// Largest distance along a ray that looks over the floor [m].
const FAR: f32 = 20.0;
/// How far ahead keys send the walker [m].
pub(super) const STEP: f32 = 0.4;
/// How far beside the walker, or beside where it may go, a press still means it [m].
const REACH: f32 = 0.15;

impl App {
    /// Returns the point of the floor that the walker stands on [m], if there is one.
    pub fn walker(&self) -> Option<Vec3> {
        self.scene.walker().map(Walker::position)
    }

    /// Walks the person in a direction while it is not zero: x to the right, y away from the
    /// camera. The mouse does not lead again until it moves. Returns whether there is a person;
    /// there is none in a photo.
    pub fn walk(&mut self, direction: Vec2) -> bool {
        let is_there = self.scene.walker().is_some() && !self.is_photo && direction.is_finite();
        self.stride = if is_there { direction.clamp_length_max(1.0) } else { Vec2::ZERO };
        if self.stride != Vec2::ZERO {
            self.pointers.clear_hover();
            self.step_ahead();
        }
        is_there
    }

    /// Sends the walker one step ahead.
    fn step_ahead(&mut self) {
        let view = self.camera.view();
        let ahead = view.forward().with_y(0.0).normalize_or(Vec3::NEG_Z);
        let step = (view.right() * self.stride.x + ahead * self.stride.y) * STEP;
        if let Some(walker) = self.scene.walker_mut() {
            walker.walk_to(walker.position() + step);
        }
    }

    /// Sends the walker where keys or the pointer lead it, if there are any.
    pub(super) fn send_walker(&mut self) {
        if self.stride != Vec2::ZERO {
            self.step_ahead();
            return;
        }
        let Some(at) = self.pointers.walker_target() else {
            return;
        };
        let (_, pick) = self.pick_context();
        let target = on_floor(pick.view.eye, pick.ray(at)).0;
        if let Some(walker) = self.scene.walker_mut() {
            walker.walk_to(target);
        }
    }

    /// Returns whether a pixel shows the walker or the floor that it may walk on, in front of all
    /// cloth; while the blade is on, nothing is.
    ///
    /// # Errors
    /// As [`muslin::Cloth::raycast`].
    pub(super) fn is_on_walkway(&mut self, at: Vec2) -> Result<bool> {
        let Some(walker) = self.walker() else {
            return Ok(false);
        };
        let (_, pick) = self.pick_context();
        if pick.blade || !at.is_finite() {
            return Ok(false);
        }
        let (eye, ray) = (pick.view.eye, pick.ray(at));
        let cloth = pick.nearest(at)?.map_or(FAR, |(_, hit)| hit.distance);
        let (floor, away) = on_floor(eye, ray);
        let beside = Vec2::new(floor.x, floor.z).abs() - Doorway::BOUNDS;
        let is_floor = away < cloth && beside.max_element() < REACH;
        Ok(is_floor || body_distance(eye, ray, walker).is_some_and(|body| body < cloth))
    }
}

/// Returns where a ray meets the floor, and how far that is from the eye [m].
fn on_floor(eye: Vec3, ray: Vec3) -> (Vec3, f32) {
    let away = if ray.y < 0.0 { ((FLOOR - eye.y) / ray.y).min(FAR) } else { FAR };
    (eye + ray * away, away)
}

/// Returns how far along a ray it passes the body of a walker [m]; `None` if it passes beside.
fn body_distance(eye: Vec3, ray: Vec3, walker: Vec3) -> Option<f32> {
    let ([radius, _], [_, head]) = (Walker::RADII, Walker::HEIGHTS);
    let flat = Vec2::new(ray.x, ray.z);
    let to = Vec2::new(walker.x - eye.x, walker.z - eye.z);
    let away = to.dot(flat) / flat.length_squared().max(1.0e-6);
    let passes = (flat * away).distance(to) < radius + REACH;
    let height = eye.y + ray.y * away - FLOOR;
    (passes && away > 0.0 && (0.0..head + REACH).contains(&height)).then_some(away)
}
