//! The tick, read from top to bottom.

use crate::solver::stage::Stage;
use crate::solver::{bend, collide};

use crate::solver::integrate::{forces, momentum, predict, recover, sleep, velocities};

use crate::solver::kinematic::{anchors, targets};

use crate::solver::self_collide::{particle_pairs, surface};

use crate::solver::stretch::{damping, distance, line_solver, mesh_kernel, strain_limit, tethers};

use crate::solver::topology::tear;

use crate::model::links::LinkKind;
use crate::solver::stretch::sweep_order::SweepOrder;
use crate::solver::world::World;

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
    if sleep::is_tick_skipped(world) {
        targets::arrive(world);
        end(world);
        return false;
    }
    world.particles.x_last.copy_from(&world.particles.x);
    if world.settings.max_stretch > 0.0 {
        timed!(world, Limit, strain_limit::begin(world));
    }
    timed!(world, Colliders, collide::begin_tick(world));
    timed!(world, Pairs, surface::begin(world));
    timed!(world, Forces, forces::gather(world));
    if world.settings.tethers {
        timed!(world, Tethers, tethers::measure_slack(world));
    } else {
        world.tether_slack = f32::INFINITY;
    }
    for substep in 0..world.settings.substeps {
        run_substep(world, substep);
    }
    timed!(world, Bend, bend::update_folds(world));
    world.pins.arrive();
    timed!(world, Colliders, collide::finish_tick(world));
    end(world);
    // What is no longer a number must not steer a tear.
    timed!(world, Guard, recover::mend(world));
    if world.settings.tearing && world.material.tear_stretch > 0.0 {
        timed!(world, Tear, tear::tear_overstretched(world));
    }
    let is_bounded = world.settings.max_stretch > 0.0;
    if is_bounded || !world.anchors.is_empty() {
        timed!(world, Pairs, surface::begin(world));
        if is_bounded {
            timed!(world, Limit, strain_limit::enforce(world));
        }
        timed!(world, Hold, anchors::keep_in(world));
        timed!(world, SelfContacts, surface::hold_at_last(world));
        // What was put as far off as a number can say is no number when it is pulled at.
        timed!(world, Guard, recover::mend(world));
    }
    targets::arrive(world);
    sleep::update_timer(world);
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
    timed!(world, Hold, targets::hold(world, number));
    if world.settings.tethers && !world.is_pin_stretch_current {
        timed!(world, Tethers, tethers::look(world));
    }
    distance::reset(world);
    timed!(world, Bend, bend::solve_first(world));
    timed!(world, Stretch, damping::apply(world));
    timed!(world, Stretch, mesh_kernel::gather(world));
    for iteration in 0..world.settings.iterations {
        run_iteration(world, iteration);
    }
    timed!(world, Stretch, damping::remove(world));
    if world.settings.max_stretch > 0.0 {
        timed!(world, Limit, strain_limit::draw_in(world));
    }
    timed!(world, Bend, mesh_kernel::scatter(world));
    timed!(world, Pairs, particle_pairs::pair(world));
    timed!(world, SelfContacts, particle_pairs::solve(world));
    timed!(world, SelfContacts, momentum::keep(world));
    timed!(world, Pairs, collide::broad_phase::refresh(world));
    timed!(world, Contacts, collide::solve(world, number));
    timed!(world, Hold, anchors::keep(world, number));
    timed!(world, Pairs, surface::pair(world));
    timed!(world, SelfContacts, surface::solve(world));
    timed!(world, SelfContacts, surface::hold(world));
    timed!(world, Velocities, velocities::derive(world));
    timed!(world, SelfContacts, surface::calm(world));
}

/// Sweep `iteration` of a substep: to and fro in turn.
fn run_iteration(world: &mut World, iteration: u32) {
    let is_back = !iteration.is_multiple_of(2);
    if is_back {
        timed!(world, Bend, bend::solve_in_sweep(world, SweepOrder::Backward, iteration));
        timed!(world, Shear, distance::solve(world, LinkKind::Shear, SweepOrder::Backward));
        timed!(world, Stretch, distance::solve(world, LinkKind::Stretch, SweepOrder::Backward));
    } else if iteration == 0 && line_solver::are_used(world) {
        // Lines bear a load as wholes, so that tethers and sweeps have little left to do.
        timed!(world, Stretch, line_solver::solve(world));
    } else {
        timed!(world, Stretch, distance::solve(world, LinkKind::Stretch, SweepOrder::Forward));
    }
    if world.settings.tethers {
        timed!(world, Tethers, tethers::solve(world));
    }
    if !is_back {
        timed!(world, Shear, distance::solve(world, LinkKind::Shear, SweepOrder::Forward));
        timed!(world, Bend, bend::solve_in_sweep(world, SweepOrder::Forward, iteration));
    }
}
