//! Sleep: a cloth that has been still for a while stays just as it is, until something touches it.

use crate::solver::world::World;
use crate::state::anchors::AnchorConstraint;
use crate::state::wind::WindModel;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// How long a cloth is still before it sleeps [s].
const WHILE: f32 = 0.5;

/// How still a cloth has been.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Sleep {
    /// For so many ticks.
    still: u32,
}

impl World {
    /// Something about it changed.
    pub fn wake(&mut self) {
        self.sleep.still = 0;
    }

    /// Whether ticks leave it as it is, unless something moves.
    pub fn is_asleep(&self) -> bool {
        self.settings.sleep_speed > 0.0 && self.sleep.still as f32 * self.settings.tick >= WHILE
    }

    /// Whether a pin, an anchor, a grab or a collider is on its way, or the air is never the same.
    fn is_stirred(&self) -> bool {
        let wind = &self.wind;
        let is_uneven = wind.model == WindModel::SineField
            || wind.gust > 0.0
            || wind.wander > 0.0
            || wind.turbulence > 0.0;
        (is_uneven && wind.velocity != Vec3::ZERO)
            || self.pins.iter().any(|pin| pin.from != pin.target)
            || self.anchors.iter().any(AnchorConstraint::is_moving)
            || self.grabs.iter().any(|held| {
                self.pins.find(held.particle).is_none()
                    && self.particles.x.at(held.particle as usize) != held.target
            })
            || self.colliders.iter().any(|body| body.last != body.next)
    }

    fn is_still(&self) -> bool {
        let most = self.settings.sleep_speed * self.settings.sleep_speed;
        let [x, y, z] = self.particles.v.all();
        let all = x.iter().zip(y).zip(z);
        // What is no number is not still either.
        all.fold(true, |still, ((x, y), z)| still & (x * x + y * y + z * z <= most))
    }
}

/// Whether a tick is over as it begins, since the cloth sleeps.
pub(crate) fn goes_on(world: &mut World) -> bool {
    if world.settings.sleep_speed > 0.0 && world.is_stirred() {
        world.wake();
    }
    world.is_asleep()
}

/// Looks whether the cloth was still in the tick that ends. One that falls asleep has come to rest.
pub(crate) fn look(world: &mut World) {
    if world.settings.sleep_speed == 0.0 {
        return;
    }
    world.sleep.still = if world.is_still() { world.sleep.still.saturating_add(1) } else { 0 };
    if world.is_asleep() {
        let p = &mut world.particles;
        p.v.fill(Vec3::ZERO);
        p.x_last.copy_from(&p.x);
        world.restart_history();
    }
}
