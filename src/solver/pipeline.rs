//! The tick, read from top to bottom.

use super::stage::Stage;
use super::{
    World, bend, brake, contacts, crowd, forces, guard, hold, layers, leash, limit, lines, links,
    packed, predict, sleep, spin, tear, tethers, velocities,
};
use crate::fabric::links::LinkKind;
use links::Order;

/// Times one stage.
macro_rules! timed {
    ($world:ident, $stage:ident, $work:expr) => {{
        let start = $world.profile.start();
        apart($world, |$world| {
            $work;
        });
        $world.profile.book(Stage::$stage, start);
    }};
}

/// Each stage is a function of its own: engines leave one that is too long as it is, uncompiled.
#[inline(never)]
fn apart(world: &mut World, work: impl FnOnce(&mut World)) {
    work(world);
}

/// Runs one tick; false if the cloth sleeps through it.
pub(crate) fn tick(world: &mut World) -> bool {
    if sleep::goes_on(world) {
        hold::arrive(world);
        end(world);
        return false;
    }
    world.particles.x_last.copy_from(&world.particles.x);
    if world.settings.max_stretch > 0.0 {
        timed!(world, Limit, limit::begin(world));
    }
    timed!(world, Colliders, contacts::begin(world));
    timed!(world, Pairs, layers::begin(world));
    timed!(world, Forces, forces::gather(world));
    if world.settings.tethers {
        timed!(world, Tethers, tethers::measure_slack(world));
    } else {
        world.tether_slack = f32::INFINITY;
    }
    for substep in 0..world.settings.substeps {
        run_substep(world, substep);
    }
    timed!(world, Bend, bend::yield_folds(world));
    world.pins.arrive();
    timed!(world, Colliders, contacts::arrive(world));
    end(world);
    // What is no longer a number must not steer a tear.
    timed!(world, Guard, guard::mend(world));
    if world.settings.tearing && world.material.tear_stretch > 0.0 {
        timed!(world, Tear, tear::tear(world));
    }
    let is_bounded = world.settings.max_stretch > 0.0;
    if is_bounded || !world.leashes.is_empty() {
        timed!(world, Pairs, layers::begin(world));
        if is_bounded {
            timed!(world, Limit, limit::enforce(world));
        }
        timed!(world, Hold, leash::keep_in(world));
        timed!(world, SelfContacts, layers::hold_at_last(world));
        // What was put as far off as a number can say is no number when it is pulled at.
        timed!(world, Guard, guard::mend(world));
    }
    hold::arrive(world);
    sleep::look(world);
    true
}

/// Time goes on.
fn end(world: &mut World) {
    world.time += f64::from(world.settings.tick);
    world.tick = world.tick.wrapping_add(1);
}

/// Substep `number` of the tick.
fn run_substep(world: &mut World, number: u32) {
    timed!(world, Predict, predict::advance(world));
    timed!(world, Hold, hold::hold(world, number));
    if world.settings.tethers && !world.is_apart_current {
        timed!(world, Tethers, tethers::look(world));
    }
    links::restart(world);
    timed!(world, Bend, bend::begin(world));
    timed!(world, Stretch, brake::begin(world));
    timed!(world, Stretch, packed::pack(world));
    for iteration in 0..world.settings.iterations {
        run_iteration(world, iteration);
    }
    timed!(world, Stretch, brake::end(world));
    if world.settings.max_stretch > 0.0 {
        timed!(world, Limit, limit::draw_in(world));
    }
    timed!(world, Bend, packed::unpack(world));
    timed!(world, Pairs, crowd::pair(world));
    timed!(world, SelfContacts, crowd::solve(world));
    timed!(world, SelfContacts, spin::keep(world));
    timed!(world, Pairs, contacts::near::pair(world));
    timed!(world, Contacts, contacts::solve(world, number));
    timed!(world, Hold, leash::keep(world, number));
    timed!(world, Pairs, layers::pair(world));
    timed!(world, SelfContacts, layers::solve(world));
    timed!(world, SelfContacts, layers::hold(world));
    timed!(world, Velocities, velocities::derive(world));
    timed!(world, SelfContacts, layers::calm(world));
}

/// Sweep `iteration` of a substep: to and fro in turn.
fn run_iteration(world: &mut World, iteration: u32) {
    let is_back = !iteration.is_multiple_of(2);
    if is_back {
        timed!(world, Bend, bend::go_on(world, Order::Backward, iteration));
        timed!(world, Shear, links::solve(world, LinkKind::Shear, Order::Backward));
        timed!(world, Stretch, links::solve(world, LinkKind::Stretch, Order::Backward));
    } else if iteration == 0 && lines::are_used(world) {
        // Lines bear a load as wholes, so that tethers and sweeps have little left to do.
        timed!(world, Stretch, lines::solve(world));
    } else {
        timed!(world, Stretch, links::solve(world, LinkKind::Stretch, Order::Forward));
    }
    if world.settings.tethers {
        timed!(world, Tethers, tethers::solve(world));
    }
    if !is_back {
        timed!(world, Shear, links::solve(world, LinkKind::Shear, Order::Forward));
        timed!(world, Bend, bend::go_on(world, Order::Forward, iteration));
    }
}
