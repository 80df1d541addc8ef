//! Stage `Guard`: what is no longer a number, or has run away, goes back to where it last was.

use crate::math::simd::leveled;
use crate::solver::world::{MIN_PARTICLES_PER_THREAD, World};
use crate::state::events::{Event, EventKind};
use core::sync::atomic::{AtomicBool, Ordering};
use glam::Vec3;

/// No cloth is this far from its origin [m]; f32 would have lost the millimetres long before.
const REALM: f32 = 1.0e6;

/// Mends the state and reports how many particles it mended.
pub(crate) fn mend(world: &mut World) {
    if is_all_sound(world) {
        return;
    }
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

fn is_all_sound(world: &World) -> bool {
    let (level, p) = (world.level, &world.particles);
    let is_one_not = AtomicBool::new(false);
    let columns = (p.x.all(), p.moved.all(), p.v.all(), p.v_ahead.all());
    world.threads.parallel_for(columns, MIN_PARTICLES_PER_THREAD, |(x, moved, v, v_ahead)| {
        let mut all_sound = true;
        for column in [x, moved, v, v_ahead].into_iter().flatten() {
            look_over(level, column, &mut all_sound);
        }
        if !all_sound {
            is_one_not.store(true, Ordering::Relaxed);
        }
    });
    !is_one_not.into_inner()
}

leveled! {
    /// Whether all numbers of a column are sound, and all before it were.
    fn look_over(column: &[f32], all_sound: &mut bool) = look_over_column
}

#[inline(always)]
fn look_over_column(column: &[f32], all_sound: &mut bool) {
    let mut sound = *all_sound;
    for c in column {
        sound &= is_within(*c);
    }
    *all_sound = sound;
}

fn is_sound(v: Vec3) -> bool {
    is_within(v.x) && is_within(v.y) && is_within(v.z)
}

#[inline(always)]
fn is_within(c: f32) -> bool {
    c > -REALM && c < REALM
}
