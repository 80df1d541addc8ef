//! Stage `Guard`: what is no longer a number, or has run away, goes back to where it last was.

use super::World;
use crate::state::events::{Event, EventKind};
use glam::Vec3;

/// No cloth is this far from its origin [m]; f32 would have lost the millimetres long before.
const REALM: f32 = 1.0e6;

/// Mends the state and reports how many particles it mended.
pub(crate) fn mend(world: &mut World) {
    let (h, gravity) = (world.settings.scheme().h, world.settings.gravity);
    let p = &mut world.particles;
    let (mut mended, mut first) = (0, Vec3::ZERO);
    for i in 0..p.len() {
        let sound =
            [&p.x, &p.moved, &p.v, &p.v_ahead].iter().all(|columns| is_sound(columns.at(i)));
        if sound {
            continue;
        }
        let last = p.x_last.at(i);
        if mended == 0 {
            first = last;
        }
        mended += 1;
        p.place(i, last, Vec3::ZERO, gravity, h);
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
