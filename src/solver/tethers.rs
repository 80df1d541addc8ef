//! Stage `Tethers`: no particle gets farther from a pin than its way along the cloth.

use super::World;
use crate::fabric::tethers::TetherSet;
use crate::math::columns::Columns;
use crate::math::simd::{Level, leveled};

/// Looks up where the pins are, after they moved.
pub(crate) fn look(world: &mut World) {
    let x = &world.particles.x;
    for set in world.tethers.sets().iter().filter(|set| set.only.is_none()) {
        let found = &mut world.scratch.anchor;
        for (to, from) in [(&mut found.x, &x.x), (&mut found.y, &x.y), (&mut found.z, &x.z)] {
            to.clear();
            to.extend(set.anchor.iter().map(|anchor| from[*anchor as usize]));
        }
    }
}

/// Pulls every particle within reach of the pins it is tethered to.
pub(crate) fn solve(world: &mut World) {
    let material = &world.material;
    let rigid = material.stretch_stiffness_warp == 0.0 && material.stretch_stiffness_weft == 0.0;
    let slack = if rigid {
        1.0
    } else if world.settings.max_stretch > 0.0 {
        1.0 + world.settings.max_stretch
    } else {
        return;
    };
    let level = world.level;
    let p = &mut world.particles;
    for set in world.tethers.sets() {
        pull_set(level, set, slack, &world.scratch.anchor, &mut p.x, &p.w);
    }
}

fn pull_set(
    level: Level,
    set: &TetherSet,
    slack: f32,
    found: &Columns,
    x: &mut Columns,
    w: &[f32],
) {
    let length = &set.length;
    match set.only {
        Some(pin) => {
            let pin = x.at(pin as usize).to_array();
            pull_to_one(level, x, pin, length, slack, w);
        }
        None => pull_to_many(level, x, found, length, slack, w),
    }
}

leveled! {
    fn pull_to_one(x: &mut Columns, pin: [f32; 3], length: &[f32], slack: f32, w: &[f32]) = to_one
}

leveled! {
    fn pull_to_many(x: &mut Columns, pins: &Columns, length: &[f32], slack: f32, w: &[f32])
        = to_many
}

#[inline(always)]
fn to_one(columns: &mut Columns, [px, py, pz]: [f32; 3], length: &[f32], slack: f32, w: &[f32]) {
    let Columns { x, y, z } = columns;
    let particles = x.iter_mut().zip(y).zip(z);
    for ((((x, y), z), length), w) in particles.zip(length).zip(w) {
        [*x, *y, *z] = within([*x, *y, *z], [px, py, pz], length * slack, *w);
    }
}

#[inline(always)]
fn to_many(columns: &mut Columns, pins: &Columns, length: &[f32], slack: f32, w: &[f32]) {
    let Columns { x, y, z } = columns;
    let particles = x.iter_mut().zip(y).zip(z);
    let pins = pins.x.iter().zip(&pins.y).zip(&pins.z);
    for (((((x, y), z), ((px, py), pz)), length), w) in particles.zip(pins).zip(length).zip(w) {
        [*x, *y, *z] = within([*x, *y, *z], [*px, *py, *pz], length * slack, *w);
    }
}

/// `x` if it is held or within `reach` of `pin`, else as far towards it as that.
#[inline(always)]
fn within(x: [f32; 3], pin: [f32; 3], reach: f32, w: f32) -> [f32; 3] {
    let [dx, dy, dz] = [x[0] - pin[0], x[1] - pin[1], x[2] - pin[2]];
    let length2 = dx * dx + dy * dy + dz * dz;
    let is_far = length2 > reach * reach && w > 0.0;
    let share = reach / length2.sqrt();
    let take = |pulled: f32, x: f32| if is_far { pulled } else { x };
    [
        take(pin[0] + dx * share, x[0]),
        take(pin[1] + dy * share, x[1]),
        take(pin[2] + dz * share, x[2]),
    ]
}
