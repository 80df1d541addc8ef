//! Stage `Guard`: what is no longer a number, or has run away, goes back to where it last was.

use super::World;
use crate::state::events::{Event, EventKind};
use glam::Vec3;

/// No cloth is this far from its origin [m]; f32 would have lost the millimetres long before.
const REALM: f32 = 1.0e6;

/// Mends the state and reports how many particles it mended.
pub(crate) fn mend(world: &mut World) {
    let substep = world.settings.substep();
    let p = &mut world.particles;
    let (mut mended, mut first) = (0, Vec3::ZERO);
    for i in 0..p.len() {
        if is_sound(p.x.at(i)) && is_sound(p.v.at(i)) && is_sound(p.x_prev.at(i)) {
            continue;
        }
        let last = p.x_last.at(i);
        if mended == 0 {
            first = last;
        }
        mended += 1;
        p.place(i, last, Vec3::ZERO, substep);
    }
    if mended > 0 {
        let mut event = Event::new(EventKind::Recovered, world.tick, first);
        event.count = mended;
        world.events.push(event);
    }
}

fn is_sound(v: Vec3) -> bool {
    let sound = |c: f32| c > -REALM && c < REALM;
    sound(v.x) && sound(v.y) && sound(v.z)
}
