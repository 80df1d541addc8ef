//! Stage `Limit`: after a tick no stretch or shear link is longer than (1 + `max_stretch`) times
//! its rest length.
//!
//! With e = `max_stretch`, l and r the length and rest length of a link:
//!
//! ```text
//! 1. In each substep, one sweep:     l > (1 + e/2) r  →  l = (1 + e/2) r         project_once
//! 2. At the end of the tick, until no l > (1 + 0.996 e) r, at most 24 rounds:    project_all
//!      every 8th round              one pass along the pin order                 sweep_from_pins
//!      every round                  a sweep as in 1 (forward, backward in turn),
//!                                   then colliders (triangles too from round 16
//!                                   on), anchors and sewn pairs
//! 3. Repeat: both ends of every l > (1 + 0.996 e) r go to their rollback         roll_back
//!    positions, until none moves; then colliders. If the largest excess has
//!    grown since step 2, the positions of step 2 are restored
//! 4. Velocities follow the corrections                                           update_velocities
//! ```
//! The sweeps are those of Provot, "Deformation constraints in a mass-spring model", Graphics
//! Interface 1995: the ends of a long link move towards each other by their inverse masses. They
//! converge fast but guarantee nothing. The rollback does: at the rollback positions (see
//! `rollback`) the limit held a tick ago, and every pass moves at least one more particle there,
//! where it stays. The margins 0.996 and e/2 cover rounding and make the sweeps end early.
//!
//! A cloth that pins, grabs or anchors hold apart cannot satisfy the limit. This is reported once.
//! Once they release it, its last tick is not within the limit, so there is no state to roll back
//! to. It then contracts by tethers and up to 2000 rounds, over several ticks if it was stretched
//! far; among colliders up to 100 rounds a tick, and only while rounds make progress. The particles that move get zero velocity,
//! so that the contraction does not fling the cloth.
//!
//! **Velocities** (4). The corrections x − x₀ of the tick of length T count as velocity, but
//! bounded: links that contradict each other push a particle out and the limit pulls it back, which
//! must not add energy. With the mean velocity m = (x − x_last) / T of the tick and the velocity v₀
//! at its start:
//!
//! ```text
//! d = v + (x − x₀) / T − m
//! v ← 0                          if v₀ · m < 0: the particle was pulled back; it would oscillate
//! v ← m + d min(1, |m| / |d|)    otherwise: a body that accelerates evenly from rest has v = 2 m
//! ```
//! At the end of the last phase `piece_momentum` gives free pieces back what this took of their
//! momentum.
//!
//! Reads `constraints`, `pin_order`, `tethers`, pins, grabs, anchors; writes positions, velocities,
//! `violations` and one event. Invariant: a link that was within the limit a tick ago is within
//! it now.

use crate::math::columns::Columns;
use crate::math::max;
use crate::model::links::{LinkKind, Links};
use crate::solver::collide::{self, Projection};
use crate::solver::kinematic::anchors;
use crate::solver::stretch::distance::project_upper_bound;
use crate::solver::stretch::sweep_order::SweepOrder;
use crate::solver::stretch::{rollback, sewn_pairs, tethers};
use crate::solver::world::World;
use crate::state::collider_desc::Shape;
use crate::state::colliders::ColliderBody;
use crate::state::events::EventKind;
use glam::Vec3;

/// The largest number of rounds before the cloth rolls back.
const MAX_ROUNDS: u32 = 24;

/// The largest number of rounds for a cloth that was held apart and cannot roll back.
const MAX_CONTRACTION_ROUNDS: u32 = 2000;

/// The same among colliders. The contraction continues in the next tick, so no tick costs much more
/// than a normal one.
const MAX_CONTRACTION_ROUNDS_AMONG_COLLIDERS: u32 = 100;

/// The first round that pushes triangles out of colliders too. Most cloth satisfies the limit before.
/// The rest may keep the positions of the last round, so these must be outside colliders.
const FIRST_SURFACE_ROUND: u32 = 16;

/// The rounding margin, as a share of `max_stretch`: the solver aims at a limit below the
/// guaranteed one.
const ROUNDING_MARGIN: f32 = 4.0e-3;

/// The share of `max_stretch` that a projected link keeps, so that the sweeps end.
const TARGET_SHARE: f32 = 0.5;

/// Number of rounds between two measurements of a contraction among colliders, and the share of the
/// excess that it must lose in them. Otherwise they hold the cloth apart, and it goes on in the next
/// tick.
const CONTRACTION_CHECK: u32 = 20;
const LEAST_PROGRESS: f32 = 0.05;

/// Number of rounds between two passes along the pin order.
const ROUNDS_PER_PIN_SWEEP: u32 = 8;

const KINDS: [LinkKind; 2] = [LinkKind::Stretch, LinkKind::Shear];

/// Stores the velocities at the start of the tick.
pub(crate) fn store_initial_velocities(world: &mut World) {
    world.scratch.initial_velocity.copy_from(&world.particles.v);
}

/// Runs one sweep within a substep, so that little is left to do at the end of the tick.
pub(crate) fn project_once(world: &mut World) {
    let target = 1.0 + world.settings.max_stretch * TARGET_SHARE;
    KINDS
        .into_iter()
        .for_each(|kind| project_upper_bound(world, kind, SweepOrder::Forward, target));
}

/// Enforces the limit at the end of a tick, as far as colliders, pins, grabs and anchors allow.
pub(crate) fn enforce(world: &mut World) {
    let max_stretch = world.settings.max_stretch;
    let inner = 1.0 + max_stretch * (1.0 - ROUNDING_MARGIN);
    if find_over_stretched(world, inner).is_some() {
        project_all(world, inner);
    }
}

/// Counts the links that exceed the limit when the tick ends, and reports them.
///
/// Where pins, grabs, anchors, colliders or other layers of the cloth hold it apart the limit
/// cannot hold. That is reported by one event, and again only after it held in between.
pub(crate) fn report(world: &mut World) {
    let limit = 1.0 + world.settings.max_stretch;
    let count = over_stretched_links(world, limit).count() as u32;
    if world.violations.over_stretched.update(count) {
        push_event(world, limit);
    }
}

/// Steps 2 to 4 of the module doc, for links longer than `limit` times their rest length.
fn project_all(world: &mut World, limit: f32) {
    let target = 1.0 + world.settings.max_stretch * TARGET_SHARE;
    let was_over = world.violations.over_stretched.count > 0;
    let has_anchors = !world.anchors.is_empty();
    let is_free_again = was_over && !has_anchors && !is_held_apart(world, limit);
    tethers::refresh_pin_positions(world);
    let has_colliders = world.colliders.iter().next().is_some();
    let mut excess = f32::INFINITY;
    let most = match (is_free_again, has_colliders) {
        (true, true) => MAX_CONTRACTION_ROUNDS_AMONG_COLLIDERS,
        (true, false) => MAX_CONTRACTION_ROUNDS,
        (false, _) => MAX_ROUNDS,
    };
    for round in 0..most {
        if is_free_again {
            tethers::project(world, target);
        }
        // With several tethers per particle the links have no single order outward from the pins.
        if round % ROUNDS_PER_PIN_SWEEP == 0 && world.tethers.sets().len() == 1 {
            sweep_from_pins(world, target);
        }
        if round % 2 == 0 {
            KINDS
                .into_iter()
                .for_each(|kind| project_upper_bound(world, kind, SweepOrder::Forward, target));
        } else {
            KINDS
                .into_iter()
                .rev()
                .for_each(|kind| project_upper_bound(world, kind, SweepOrder::Backward, target));
        }
        let is_late = !is_free_again && round >= FIRST_SURFACE_ROUND;
        collide::project_out(
            world,
            if is_late { Projection::Surface } else { Projection::Particles },
        );
        anchors::project_at_end(world);
        sewn_pairs::join(world);
        if find_over_stretched(world, limit).is_none() {
            break;
        }
        let is_checked = round % CONTRACTION_CHECK == CONTRACTION_CHECK - 1;
        if is_free_again && has_colliders && is_checked {
            let left = largest_excess(world, limit);
            if left > excess * (1.0 - LEAST_PROGRESS) {
                break;
            }
            excess = left;
        }
    }
    if is_free_again {
        // The last tick is no state to roll back to, and the contraction must not fling the cloth.
        rollback::compute(world);
        collide::project_out(world, Projection::Surface);
        stop_moved(world);
    } else {
        // If anchors hold the cloth apart now, they did so in the last tick too, and there is no
        // valid state to roll back to. The cloth contracts as far as the anchors permit.
        if !(was_over && has_anchors) {
            roll_back_unless_worse(world, limit);
        }
        anchors::project_at_end(world);
        update_velocities(world);
    }
}

/// Returns the largest excess of a link over `limit` times its rest length, as a share of that.
fn largest_excess(world: &World, limit: f32) -> f32 {
    let x = &world.particles.x;
    let mut most = 0.0;
    for links in [&world.constraints.links, &world.constraints.dynamic] {
        for at in (0..links.len()).filter(|at| is_over_stretched(links, *at, x, limit)) {
            let span = x.get(links.b[at] as usize) - x.get(links.a[at] as usize);
            most = max(span.length() / (links.rest[at] * limit) - 1.0, most);
        }
    }
    most
}

/// Sets the velocities of all particles to zero that moved since `scratch.predicted` was stored. What
/// their history still adds stays: it may belong to the impulse of a collider.
fn stop_moved(world: &mut World) {
    let h = world.regular_scheme().h;
    let (p, before) = (&mut world.particles, &world.scratch.predicted);
    for i in 0..p.len() {
        if p.x.get(i) != before.get(i) {
            p.add_velocity(i, -p.v.get(i), h);
        }
    }
}

/// Shortens links that are too long, in pin order. Only the end that is farther from the pins
/// moves, so that one pass is exact for a hanging chain.
fn sweep_from_pins(world: &mut World, target: f32) {
    let (links, p) = (&world.constraints.links, &mut world.particles);
    for link in world.pin_order.order() {
        let link = *link as usize;
        let (a, b) = (links.a[link] as usize, links.b[link] as usize);
        let span = p.x.get(b) - p.x.get(a);
        let (length2, longest) = (span.length_squared(), links.rest[link] * target);
        if !links.active[link] || length2 <= longest * longest {
            continue;
        }
        let excess = span * (1.0 - longest / length2.sqrt());
        if p.w[b] > 0.0 && world.pin_order.is_nearer(a, b) {
            p.x.add(b, -excess);
        } else if p.w[a] > 0.0 && world.pin_order.is_nearer(b, a) {
            p.x.add(a, excess);
        }
    }
}

/// Whether a held particle is farther from a pin than `limit` times their geodesic distance.
fn is_held_apart(world: &World, limit: f32) -> bool {
    let p = &world.particles;
    let held = || (0..p.len()).filter(|i| p.w[*i] <= 0.0);
    world.tethers.sets().iter().any(|set| {
        held().any(|i| {
            let span = p.x.get(i) - p.x.get(set.pin[i] as usize);
            span.length() > set.length[i] * limit
        })
    })
}

/// Rolls back, and then pushes the cloth out of colliders, which take precedence. If that makes the
/// largest excess grow, restores the positions from before; the excess is reported.
///
/// Beside two-sided surfaces it always rolls back: the restored cloth may be pinched between two
/// colliders, and cloth on the wrong side of a two-sided surface stays there.
fn roll_back_unless_worse(world: &mut World, limit: f32) {
    let is_two_sided =
        |body: &ColliderBody| body.desc.shape == Shape::Mesh && !body.is_solid_mesh();
    let bodies = || world.colliders.iter();
    let can_restore = bodies().next().is_some() && !bodies().any(|body| is_two_sided(body));
    let excess = if can_restore { largest_excess(world, limit) } else { 0.0 };
    if excess > 0.0 {
        world.scratch.rollback.before.copy_from(&world.particles.x);
    }
    roll_back(world, limit);
    // What rests on a collider may stay within a part of the gap: pushing it farther out in every
    // tick would never let it rest.
    collide::project_out(world, Projection::Surface);
    if excess > 0.0 && largest_excess(world, limit) > excess {
        world.particles.x.copy_from(&world.scratch.rollback.before);
        collide::project_out(world, Projection::Surface);
    }
}

/// Moves the ends of every link that is too long to their rollback positions (see `rollback`), and
/// then those of the links that this stretches, until no particle moves.
fn roll_back(world: &mut World, limit: f32) {
    rollback::compute(world);
    let count = world.constraints.links.len();
    let mut has_moved = true;
    while core::mem::take(&mut has_moved) {
        for link in 0..count + world.constraints.dynamic.len() {
            let (links, at) = if link < count {
                (&world.constraints.links, link)
            } else {
                (&world.constraints.dynamic, link - count)
            };
            if !is_over_stretched(links, at, &world.particles.x, limit) {
                continue;
            }
            for end in [links.a[at] as usize, links.b[at] as usize] {
                let target = world.scratch.rollback.positions.get(end);
                if world.particles.x.get(end) != target {
                    world.particles.x.set(end, target);
                    has_moved = true;
                }
            }
        }
        has_moved |= sewn_pairs::roll_back_partners(world);
    }
}

/// Adds the corrections since `scratch.predicted` to the velocities, as the module doc describes (4).
fn update_velocities(world: &mut World) {
    let inv_tick = 1.0 / world.settings.tick;
    let h = world.regular_scheme().h;
    let (p, scratch) = (&mut world.particles, &world.scratch);
    for i in 0..p.len() {
        if p.w[i] <= 0.0 {
            continue;
        }
        let mean = (p.x.get(i) - p.x_prev_tick.get(i)) * inv_tick;
        let difference = p.v.get(i) + (p.x.get(i) - scratch.predicted.get(i)) * inv_tick - mean;
        let (difference2, mean2) = (difference.length_squared(), mean.length_squared());
        // A particle that a tear made in this tick has no initial velocity.
        let was_pulled_back =
            i < scratch.initial_velocity.x.len() && scratch.initial_velocity.get(i).dot(mean) < 0.0;
        let v = if was_pulled_back {
            Vec3::ZERO
        } else if difference2 > mean2 {
            mean + difference * (mean2 / difference2).sqrt()
        } else {
            mean + difference
        };
        p.add_velocity(i, v - p.v.get(i), h);
    }
}

/// Whether an active stretch or shear link is longer than `limit` times its rest length.
fn is_over_stretched(links: &Links, link: usize, x: &Columns, limit: f32) -> bool {
    let span = x.get(links.b[link] as usize) - x.get(links.a[link] as usize);
    let longest = links.rest[link] * limit;
    links.active[link]
        && links.kind(link) != LinkKind::Bend
        && span.length_squared() > longest * longest
}

/// The ends of all links that are longer than `limit` times their rest length.
fn over_stretched_links(world: &World, limit: f32) -> impl Iterator<Item = (usize, usize)> + '_ {
    [&world.constraints.links, &world.constraints.dynamic].into_iter().flat_map(move |links| {
        let long = (0..links.len())
            .filter(move |link| is_over_stretched(links, *link, &world.particles.x, limit));
        long.map(|link| (links.a[link] as usize, links.b[link] as usize))
    })
}

#[inline(never)]
fn find_over_stretched(world: &World, limit: f32) -> Option<(usize, usize)> {
    over_stretched_links(world, limit).next()
}

/// Reports one link that is too long, and how many there are.
fn push_event(world: &mut World, limit: f32) {
    let Some((a, b)) = find_over_stretched(world, limit) else {
        return;
    };
    let middle = (world.particles.x.get(a) + world.particles.x.get(b)) * 0.5;
    let mut event = world.event_at(EventKind::HeldApart, middle);
    (event.particle_a, event.particle_b) = (a as u32, b as u32);
    event.count = world.violations.over_stretched.count;
    world.events.push(event);
}
