//! Hint that the cloth can be touched: it yields to the mouse that moves over it before the first
//! press.
//!
//! ```text
//! v ← v + PUSH · (1 − d² / RADIUS²)² · dt · ray      d distance from the point under the mouse
//! ```
//! Method: an acceleration along the ray of the pixel, around the point that the ray hits.
//!
//! Reads the mouse and the camera; writes velocities of particles.
//!
//! Invariant: after the first press, with reduced motion, while the blade is on and where the mouse
//! walks a person, nothing is pushed.

use glam::Vec3;
use muslin::{Cloth, Result};

use super::App;

/// Acceleration under the mouse, in drawn metres [m/s²].
const PUSH: f32 = 16.0;
/// Radius of the push, in drawn metres.
const RADIUS: f32 = 0.22;

impl App {
    /// Pushes the cloth under the mouse for a frame of `seconds` [s].
    ///
    /// # Errors
    /// As [`Cloth::raycast`].
    pub(super) fn push_under_mouse(&mut self, seconds: f32) -> Result<()> {
        let Some(at) = self.pointers.hover().filter(|_| self.is_untouched) else {
            return Ok(());
        };
        if self.reduced_motion || self.scene.walker().is_some() {
            return Ok(());
        }
        let (_, pick) = self.pick_context();
        if pick.blade {
            return Ok(());
        }
        let Some((i, hit)) = pick.nearest(at)? else {
            return Ok(());
        };
        let push = pick.ray(at) * (PUSH * pick.unit * seconds.min(super::LONGEST_FRAME));
        push_around(&mut pick.cloths[i], hit.position, RADIUS * pick.unit, push)
    }
}

/// Adds `push` [m/s] to the velocities around a point, less towards `radius` [m].
fn push_around(cloth: &mut Cloth, point: Vec3, radius: f32, push: Vec3) -> Result<()> {
    let share = |x: &Vec3| (1.0 - x.distance_squared(point) / (radius * radius)).max(0.0).powi(2);
    let shares: Vec<_> = cloth.positions().iter().map(share).collect();
    for (particle, share) in (0..).zip(shares).filter(|(_, share)| *share > 0.0) {
        if let Some(velocity) = cloth.velocity(particle) {
            cloth.set_velocity(particle, velocity + push * share)?;
        }
    }
    Ok(())
}
