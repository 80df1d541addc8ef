//! The tick, read from top to bottom.

use super::stage::Stage;
use super::{World, contacts, forces, guard, hold, links, predict, tear, tethers, velocities};
use crate::fabric::weave::LinkKind;

/// Times one stage.
macro_rules! timed {
    ($world:ident, $stage:ident, $work:expr) => {{
        let start = $world.profile.start();
        $work;
        $world.profile.book(Stage::$stage, start);
    }};
}

/// Runs one tick.
pub(crate) fn tick(world: &mut World) {
    world.particles.x_last.copy_from(&world.particles.x);
    timed!(world, Forces, forces::gather(world));
    for substep in 0..world.settings.substeps {
        let share = (substep + 1) as f32 / world.settings.substeps as f32;
        run_substep(world, share);
    }
    world.pins.arrive();
    timed!(world, Colliders, contacts::arrive(world));
    world.time += f64::from(world.settings.tick);
    world.tick = world.tick.wrapping_add(1);
    timed!(world, Guard, guard::mend(world));
    if world.settings.tearing && world.material.tear_stretch > 0.0 {
        timed!(world, Tear, tear::tear(world));
    }
}

/// One substep, which ends a `share` of the way through the tick.
fn run_substep(world: &mut World, share: f32) {
    timed!(world, Predict, predict::advance(world));
    timed!(world, Hold, hold::hold(world, share));
    links::restart(world);
    for _ in 0..world.settings.iterations {
        if world.settings.tethers {
            timed!(world, Tethers, tethers::solve(world));
        }
        timed!(world, Stretch, links::solve(world, LinkKind::Stretch));
        timed!(world, Shear, links::solve(world, LinkKind::Shear));
        timed!(world, Bend, links::solve(world, LinkKind::Bend));
    }
    timed!(world, Contacts, contacts::solve(world, share));
    timed!(world, Velocities, velocities::derive(world));
}
