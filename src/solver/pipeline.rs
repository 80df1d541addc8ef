//! The tick: the order of the stages, from top to bottom.
//!
//! ```text
//! tick
//! ├─ asleep?      advance the clock and return
//! ├─ rebase       the origin moves along with the cloth
//! ├─ Colliders    number of substeps         Limit  store the velocities at the start of the tick
//! ├─ Colliders    swept broad phase          Pairs  candidate pairs of surface collision
//! ├─ Forces       pressure of closed pieces         Tethers  slack
//! ├─ substep × substeps
//! │  ├─ Forces        gravity + air ─▶ acceleration, once per tick or more often
//! │  ├─ Predict       x ← x + displacement
//! │  ├─ Hold          pins and grabs move their particles   Forces  pressure of closed pieces
//! │  ├─ Bend          first implicit solve   Stretch  start of damping, particle layout
//! │  ├─ sweep × iterations
//! │  │    even   Stretch ▶ Tethers ▶ Shear ▶ Bend        (forward; the first by line solver)
//! │  │    odd    Bend ▶ Shear ▶ Stretch ▶ Tethers        (backward)
//! │  │    both    sewn pairs
//! │  ├─ Stretch       end of damping         Limit  one sweep of strain limiting
//! │  ├─ SelfContacts  momentum of several pieces, particle collision, then momentum of all
//! │  ├─ Contacts      colliders: narrow phase and response
//! │  ├─ Hold          anchors: max distance and backstop
//! │  ├─ SelfContacts  surface collision: contact solver, held by colliders, and their friction, then
//! │  │                non-crossing pass and colliders
//! │  └─ Velocities    v ← (x - x_start) / h by BDF, then velocities of surface contacts, then
//! │                   momentum of a free cloth that hits a collider
//! ├─ Bend         folds (plasticity)         Colliders  colliders reach their end poses
//! ├─ Guard        restore particles with invalid numbers
//! ├─ Tear         split vertices of overstretched links; stitches
//! ├─ last pass    Limit ▶ colliders ▶ Hold ▶ SelfContacts and colliders ▶ report ▶ Guard
//! │                                                       (with a strain limit or anchors)
//! ├─ report       particles inside colliders, layers that cross
//! └─ finish       targets reach the end of the tick, sleep timer
//! ```
//! Method: extended position-based dynamics with small substeps (Macklin, Müller, Chentanez,
//! "XPBD", MIG 2016; Macklin et al., "Small Steps in Physics Simulation", SCA 2019). Sweeps
//! alternate in direction, because the BDF2 scheme (`state::settings::BdfScheme`) needs a symmetric
//! solver.
//!
//! Reads and writes `World`. Each line of the code below is one stage, timed under its `Stage`.
//! Invariant: the order of the stages is part of the result; the same input gives the same bits.
//! Where hard constraints contradict each other, pins and grabs hold before colliders, colliders
//! before non-crossing surfaces, and these before the strain limit, whose excess is reported.

use crate::model::links::LinkKind;
use crate::solver::integrate::{
    forces, impact_momentum, piece_momentum, predict, pressure, recover, sleep, time_step,
    velocities,
};
use crate::solver::kinematic::{anchors, targets, tick_targets};
use crate::solver::rebase;
use crate::solver::self_collide::particle_contacts;
use crate::solver::self_collide::surface::{contact_damping, crossing_report, surface_stages};
use crate::solver::stage::Stage;
use crate::solver::stretch::sweep_order::SweepOrder;
use crate::solver::stretch::{
    damping, distance, line_solver, mesh_kernel, sewn_pairs, strain_limit, tether_slack, tethers,
};
use crate::solver::topology::tear;
use crate::solver::world::World;
use crate::solver::{bend, collide};

/// Runs one stage and adds its time to the profile.
macro_rules! timed {
    ($world:ident, $stage:ident, $work:expr) => {
        run_stage($world, Stage::$stage, &|$world| {
            $work;
        })
    };
}

/// Runs one stage in a function of its own, and adds its time to the profile.
///
/// The call is dynamic, so that no stage is inlined into the tick: V8 does not optimise functions
/// above 61,440 bytes of bytecode.
#[inline(never)]
fn run_stage(world: &mut World, stage: Stage, work: &dyn Fn(&mut World)) {
    let start = world.profile.start();
    work(world);
    world.profile.add(stage, start);
}

/// Runs the ticks of one `advance`, over which kinematic targets move evenly. Returns whether the
/// cloth was awake in any of them.
pub(crate) fn ticks_of_frame(world: &mut World, ticks: u32) -> bool {
    if ticks == 1 {
        return tick(world);
    }
    tick_targets::store_final(world);
    let mut has_moved = false;
    for ticks_left in (1..=ticks).rev() {
        timed!(world, Hold, tick_targets::update(world, ticks_left));
        has_moved |= tick(world);
    }
    has_moved
}

/// Runs `ticks` ticks; the first one takes the whole motion of kinematic targets. Returns whether
/// the cloth was awake in any of them.
pub(crate) fn ticks(world: &mut World, ticks: u32) -> bool {
    (0..ticks).fold(false, |has_moved, _| tick(world) || has_moved)
}

/// Runs one tick. Returns false if the cloth sleeps through it; then only the clock advances.
pub(crate) fn tick(world: &mut World) -> bool {
    if sleep::is_tick_skipped(world) {
        targets::finish_tick(world);
        advance_clock(world);
        return false;
    }
    rebase::follow_cloth(world);
    world.particles.x_prev_tick.copy_from(&world.particles.x);
    timed!(world, Colliders, time_step::begin_tick(world));
    if world.settings.max_stretch > 0.0 {
        timed!(world, Limit, strain_limit::store_initial_velocities(world));
    }
    timed!(world, Colliders, collide::begin_tick(world));
    timed!(world, Colliders, collide::solid_meshes::push_out(world));
    timed!(world, Pairs, surface_stages::begin_tick(world));
    timed!(world, Forces, pressure::begin_tick(world));
    if world.settings.tethers {
        timed!(world, Tethers, tether_slack::update(world));
    } else {
        world.tether_slack = f32::INFINITY;
    }
    sewn_pairs::begin_tick(world);
    for substep in 0..world.substeps {
        run_substep(world, substep);
    }
    timed!(world, Bend, bend::update_folds(world));
    world.pins.finish_tick();
    timed!(world, Colliders, collide::finish_tick(world));
    advance_clock(world);
    // Restore invalid particles first, so that a NaN does not cause a tear.
    timed!(world, Guard, recover::restore_invalid(world));
    if world.settings.tearing && world.material.tear_stretch > 0.0 {
        timed!(world, Tear, tear::tear_overstretched(world));
    }
    sewn_pairs::end_tick(world);
    let is_bounded = world.settings.max_stretch > 0.0;
    if is_bounded || !world.anchors.is_empty() {
        timed!(world, Colliders, begin_last_phase(world));
        timed!(world, Pairs, surface_stages::begin_tick(world));
        if is_bounded {
            timed!(world, Limit, strain_limit::enforce(world));
        }
        timed!(world, Hold, anchors::project_at_end(world));
        timed!(world, Stretch, sewn_pairs::join(world));
        timed!(world, SelfContacts, surface_stages::enforce_non_crossing_at_tick_end(world));
        timed!(world, SelfContacts, piece_momentum::end_last_phase(world));
        timed!(world, Stretch, sewn_pairs::join_motion(world));
        if is_bounded {
            timed!(world, Limit, strain_limit::report(world));
        }
        // Corrections of particles near the largest f32 overflow, so check once more.
        timed!(world, Guard, recover::restore_invalid(world));
    }
    sewn_pairs::report(world);
    timed!(world, Contacts, collide::inside::report(world));
    timed!(world, SelfContacts, crossing_report::report(world));
    targets::finish_tick(world);
    world.relax_stiffness_step();
    sleep::update_timer(world);
    true
}

/// Starts the phase after the last substep.
fn begin_last_phase(world: &mut World) {
    collide::begin_last_phase(world);
    piece_momentum::begin_last_phase(world);
}

/// Advances time and tick count by one tick.
fn advance_clock(world: &mut World) {
    world.clock.count_tick(world.settings.tick);
}

/// Runs substep `number` of the tick, counted from 0.
fn run_substep(world: &mut World, number: u32) {
    timed!(world, Forces, forces::compute_acceleration(world, number));
    timed!(world, Predict, predict::predict_positions(world));
    timed!(world, Hold, targets::apply(world, number));
    timed!(world, Forces, pressure::apply(world));
    if world.settings.tethers && !world.is_pin_stretch_current {
        timed!(world, Tethers, tethers::refresh_pin_positions(world));
    }
    distance::reset(world);
    timed!(world, Bend, bend::solve_first(world));
    timed!(world, Stretch, sewn_pairs::begin_substep(world));
    timed!(world, Stretch, damping::apply(world));
    timed!(world, Stretch, mesh_kernel::gather(world));
    for iteration in 0..world.settings.iterations {
        run_iteration(world, iteration);
    }
    timed!(world, Stretch, damping::remove(world));
    if world.settings.max_stretch > 0.0 {
        timed!(world, Limit, strain_limit::project_once(world));
    }
    timed!(world, Bend, mesh_kernel::scatter(world));
    timed!(world, Stretch, sewn_pairs::join(world));
    timed!(world, Pairs, particle_contacts::refresh_pairs(world));
    timed!(world, SelfContacts, piece_momentum::begin_particle_contacts(world));
    timed!(world, SelfContacts, particle_contacts::solve(world));
    timed!(world, SelfContacts, piece_momentum::remove_internal_momentum(world));
    timed!(world, Pairs, collide::refresh_pairs(world, number));
    timed!(world, Contacts, collide::solve(world, number));
    timed!(world, Hold, anchors::project(world, number));
    timed!(world, Stretch, sewn_pairs::join(world));
    timed!(world, Pairs, surface_stages::detect_contacts(world));
    timed!(world, SelfContacts, surface_stages::solve_contacts(world));
    timed!(world, SelfContacts, surface_stages::enforce_non_crossing(world, Some(number)));
    timed!(world, Velocities, velocities::update(world));
    timed!(world, SelfContacts, contact_damping::damp_velocities(world));
    timed!(world, Velocities, impact_momentum::restore(world));
    timed!(world, Stretch, sewn_pairs::join_motion(world));
    time_step::end_substep(world);
}

/// Runs solver sweep `iteration` of a substep: forward if even, backward if odd.
fn run_iteration(world: &mut World, iteration: u32) {
    let is_backward = !iteration.is_multiple_of(2);
    if is_backward {
        timed!(world, Bend, bend::solve_in_sweep(world, SweepOrder::Backward, iteration));
        timed!(world, Shear, distance::solve(world, LinkKind::Shear, SweepOrder::Backward));
        timed!(world, Stretch, distance::solve(world, LinkKind::Stretch, SweepOrder::Backward));
    } else if iteration == 0 && line_solver::is_needed(world) {
        // The line solver solves each chain exactly, so tethers and later sweeps have little to do.
        timed!(world, Stretch, line_solver::solve(world));
    } else {
        timed!(world, Stretch, distance::solve(world, LinkKind::Stretch, SweepOrder::Forward));
    }
    if world.settings.tethers {
        timed!(world, Tethers, tethers::solve(world));
    }
    if !is_backward {
        timed!(world, Shear, distance::solve(world, LinkKind::Shear, SweepOrder::Forward));
        timed!(world, Bend, bend::solve_in_sweep(world, SweepOrder::Forward, iteration));
    }
    timed!(world, Stretch, sewn_pairs::project(world));
}
