//! Sleep: the cloth skips its ticks after it has been at rest for a while.
//!
//! Method: as in rigid-body engines, a tick counts as still if no particle is faster than
//! `sleep_speed` [m/s]. After `TIME_TO_SLEEP` of still ticks the cloth sleeps: velocities become
//! zero and later ticks only advance the clock. A moving pin, anchor, grab or collider, uneven
//! wind, or any call that changes the cloth wakes it.
//!
//! Reads velocities, wind and kinematic targets; writes `world.sleep`, and velocities and history
//! as the cloth falls asleep.
//! Invariant: with `sleep_speed = 0` the cloth never sleeps. A sleeping cloth keeps its positions
//! bit for bit.

use crate::solver::world::World;
use crate::state::anchors::AnchorConstraint;
use crate::state::wind::WindModel;
use glam::Vec3;

/// Time at rest after which a cloth sleeps [s].
const TIME_TO_SLEEP: f32 = 0.5;

impl World {
    /// Resets the sleep timer, because something changed the cloth.
    pub fn wake(&mut self) {
        self.sleep.still_ticks = 0;
    }

    /// Whether the cloth sleeps.
    pub fn is_asleep(&self) -> bool {
        self.settings.sleep_speed > 0.0
            && self.sleep.still_ticks as f32 * self.settings.tick >= TIME_TO_SLEEP
    }

    /// Whether a pin, an anchor, a grab, a sewn pair or a collider moves, or the wind varies in time or space.
    fn is_driven(&self) -> bool {
        let wind = &self.wind;
        let is_uneven = wind.model == WindModel::SineField
            || wind.gust > 0.0
            || wind.wander > 0.0
            || wind.turbulence > 0.0;
        (is_uneven && wind.velocity != Vec3::ZERO)
            || self.sewing.is_drawing()
            || self.pins.iter().any(|pin| pin.from != pin.target)
            || self.anchors.iter().any(AnchorConstraint::is_moving)
            || self.grabs.iter().any(|grab| {
                self.pins.get(grab.particle).is_none()
                    && self.particles.x.get(grab.particle as usize) != grab.target
            })
            || self.colliders.iter().any(|body| body.is_moving())
    }

    fn is_still(&self) -> bool {
        let max_speed2 = self.settings.sleep_speed * self.settings.sleep_speed;
        let [x, y, z] = self.particles.v.slices();
        let all = x.iter().zip(y).zip(z);
        // A NaN speed fails this comparison, so it does not count as still.
        all.fold(true, |still, ((x, y), z)| still & (x * x + y * y + z * z <= max_speed2))
    }
}

/// Wakes the cloth if something drives it, and returns whether the tick can be skipped.
pub(crate) fn is_tick_skipped(world: &mut World) -> bool {
    if world.settings.sleep_speed > 0.0 && world.is_driven() {
        world.wake();
    }
    world.is_asleep()
}

/// Updates the sleep timer at the end of a tick. A cloth that falls asleep gets zero velocities.
pub(crate) fn update_timer(world: &mut World) {
    if world.settings.sleep_speed == 0.0 {
        return;
    }
    let timer = &world.sleep;
    let still_ticks = if world.is_still() { timer.still_ticks.saturating_add(1) } else { 0 };
    world.sleep.still_ticks = still_ticks;
    if world.is_asleep() {
        let p = &mut world.particles;
        p.v.fill(Vec3::ZERO);
        p.x_prev_tick.copy_from(&p.x);
        world.reset_history();
    }
}
