//! Stage `Limit`: after a tick no stretch or shear link is longer than `max_stretch` lets it be.
//!
//! Sweeps draw in what is too long, in the manner of Provot, "Deformation constraints in a
//! mass-spring model", Graphics Interface 1995. That converges fast but promises nothing, so the
//! ends of what is left go back to where they were a tick ago, and with them whatever that
//! stretches: the bound held there, so this ends. What a particle is moved by, it moved over the
//! whole tick, so its velocity changes by that, as far as it got anywhere. A cloth that was held
//! apart has nowhere to go back to: it gets more sweeps, a few ticks of them where it was pulled
//! far out, and no velocity from them.

use crate::solver::collide;
use crate::solver::stretch::distance::project_upper_bound;
use crate::solver::stretch::sweep_order::SweepOrder;
use crate::solver::stretch::tethers;

use crate::solver::kinematic::anchors;

use crate::solver::stretch::rollback;

use crate::math::columns::Columns;
use crate::model::links::{LinkKind, Links};
use crate::solver::world::World;
use crate::state::events::{Event, EventKind};
use glam::Vec3;

/// Sweeps before the cloth goes back.
const FEW_SWEEPS: u32 = 24;

/// Sweeps where there is nothing to go back to, since the cloth was held apart until now.
const MANY_SWEEPS: u32 = 2000;

/// What is worked towards is less than what is promised by this share of the allowance, which
/// covers rounding.
const HAIR: f32 = 4.0e-3;

/// Links are drawn in to this share of what they may be stretched by, so that the sweeps end.
const AIM: f32 = 0.5;

/// Every so many sweeps one goes from the pins outward.
const HANG_EVERY: u32 = 8;

const KINDS: [LinkKind; 2] = [LinkKind::Stretch, LinkKind::Shear];

/// A tick begins.
pub(crate) fn begin(world: &mut World) {
    world.scratch.initial_velocity.copy_from(&world.particles.v);
}

/// In a substep: a sweep that keeps what the solver has not got to yet within the bound, so that at
/// the end of the tick there is little to do.
pub(crate) fn draw_in(world: &mut World) {
    let aim = 1.0 + world.settings.max_stretch * AIM;
    KINDS.into_iter().for_each(|kind| project_upper_bound(world, kind, SweepOrder::Forward, aim));
}

/// Makes the bound hold. Where pins, grabs or leashes hold a cloth apart it cannot; that is told
/// once, until it holds again.
pub(crate) fn enforce(world: &mut World) {
    let allowance = world.settings.max_stretch;
    let (most, inner) = (1.0 + allowance, 1.0 + allowance * (1.0 - HAIR));
    if first_over(world, inner).is_some() {
        draw_together(world, inner);
    }
    world.over_stretched = over(world, most).count() as u32;
    if world.over_stretched == 0 {
        world.over_stretch_reported = false;
    } else if !core::mem::replace(&mut world.over_stretch_reported, true) {
        tell(world, most);
    }
}

fn draw_together(world: &mut World, most: f32) {
    world.scratch.predicted.copy_from(&world.particles.x);
    world.scratch.displacement.fill(Vec3::ZERO);
    let aim = 1.0 + world.settings.max_stretch * AIM;
    let was_over = world.over_stretched > 0;
    let is_led = !world.anchors.is_empty();
    let is_free_again = was_over && !is_led && !is_held_apart(world, most);
    tethers::look(world);
    for number in 0..if is_free_again { MANY_SWEEPS } else { FEW_SWEEPS } {
        if is_free_again {
            tethers::draw_in(world, aim);
        }
        // Between a few pins none is outward of all.
        if number % HANG_EVERY == 0 && world.tethers.sets().len() == 1 {
            hang(world, aim);
        }
        if number % 2 == 0 {
            KINDS
                .into_iter()
                .for_each(|kind| project_upper_bound(world, kind, SweepOrder::Forward, aim));
        } else {
            KINDS
                .into_iter()
                .rev()
                .for_each(|kind| project_upper_bound(world, kind, SweepOrder::Backward, aim));
        }
        collide::project_out(world);
        anchors::project_at_end(world);
        if first_over(world, most).is_none() {
            break;
        }
    }
    if is_free_again {
        // There is nothing to go back to; and what was held apart comes together, but is not flung.
        stop(world);
    } else {
        // What leashes hold apart finds its way together as they let it: that it was, is not to go
        // back to.
        if !(was_over && is_led) {
            go_back(world, most);
        }
        anchors::project_at_end(world);
        follow(world);
    }
}

/// Velocities end where something was moved since `scratch.predicted`.
fn stop(world: &mut World) {
    let (p, before) = (&mut world.particles, &world.scratch.predicted);
    for i in (0..p.len()).filter(|i| p.x.at(*i) != before.at(*i)) {
        p.v.set(i, Vec3::ZERO);
        p.v_extrapolated.set(i, Vec3::ZERO);
        p.displacement.set(i, Vec3::ZERO);
    }
}

/// Draws in what is too long from the pins outward. Of the two ends of a link the one that is
/// farther from the pins gives way, so that a chain that hangs is right after one sweep.
fn hang(world: &mut World, aim: f32) {
    let (links, p) = (&world.constraints.links, &mut world.particles);
    for link in world.pin_order.order() {
        let link = *link as usize;
        let (a, b) = (links.a[link] as usize, links.b[link] as usize);
        let span = p.x.at(b) - p.x.at(a);
        let (length2, longest) = (span.length_squared(), links.rest[link] * aim);
        if !links.active[link] || length2 <= longest * longest {
            continue;
        }
        let over = span * (1.0 - longest / length2.sqrt());
        if p.w[b] > 0.0 && world.pin_order.is_nearer(a, b) {
            p.x.add(b, -over);
        } else if p.w[a] > 0.0 && world.pin_order.is_nearer(b, a) {
            p.x.add(a, over);
        }
    }
}

/// Whether something held is farther from a pin than the cloth between them can reach.
fn is_held_apart(world: &World, most: f32) -> bool {
    let p = &world.particles;
    let held = || (0..p.len()).filter(|i| p.w[*i] <= 0.0);
    world.tethers.sets().iter().any(|set| {
        held().any(|i| {
            let span = p.x.at(i) - p.x.at(set.pin[i] as usize);
            span.length() > set.length[i] * most
        })
    })
}

/// Takes the ends of every link that is too long back to where they were, see `home`, and with them
/// what that stretches, until nothing is too long that was not before.
fn go_back(world: &mut World, most: f32) {
    rollback::compute(world);
    let woven = world.constraints.links.len();
    let mut went = true;
    while core::mem::take(&mut went) {
        for link in 0..woven + world.constraints.dynamic.len() {
            let (links, at) = if link < woven {
                (&world.constraints.links, link)
            } else {
                (&world.constraints.dynamic, link - woven)
            };
            if !is_over(links, at, &world.particles.x, most) {
                continue;
            }
            for end in [links.a[at] as usize, links.b[at] as usize] {
                let home = world.scratch.rollback.positions.at(end);
                if world.particles.x.at(end) != home {
                    world.particles.x.set(end, home);
                    went = true;
                }
            }
        }
    }
}

/// Velocities follow what happened since `scratch.predicted`, but not everywhere.
///
/// Links that cannot all have their lengths push each other out, and the bound puts them back: that
/// gets nowhere, and there must be no velocity left. So none differs from the mean over the tick by
/// more than that itself, for what gets on from rest by an even push ends at twice its mean. And
/// what came back from where it was going keeps none, or it would go to and fro for
/// ever.
fn follow(world: &mut World) {
    let inv_tick = 1.0 / world.settings.tick;
    let h = world.settings.scheme().h;
    let (p, scratch) = (&mut world.particles, &world.scratch);
    for i in (0..p.len()).filter(|i| p.w[*i] > 0.0) {
        let mean = (p.x.at(i) - p.x_prev_tick.at(i)) * inv_tick;
        let own = p.v.at(i) + (p.x.at(i) - scratch.predicted.at(i)) * inv_tick - mean;
        let (own2, mean2) = (own.length_squared(), mean.length_squared());
        // What tore off in this tick has no velocity from before.
        let came_back =
            i < scratch.initial_velocity.x.len() && scratch.initial_velocity.at(i).dot(mean) < 0.0;
        let v = if came_back {
            Vec3::ZERO
        } else if own2 > mean2 {
            mean + own * (mean2 / own2).sqrt()
        } else {
            mean + own
        };
        let change = v - p.v.at(i);
        p.v.add(i, change);
        p.v_extrapolated.add(i, change);
        p.displacement.add(i, change * h);
    }
}

/// Whether a link is longer than `most` times its rest length.
fn is_over(links: &Links, link: usize, x: &Columns, most: f32) -> bool {
    let span = x.at(links.b[link] as usize) - x.at(links.a[link] as usize);
    let longest = links.rest[link] * most;
    links.active[link]
        && links.kind(link) != LinkKind::Bend
        && span.length_squared() > longest * longest
}

/// The ends of links that are too long.
fn over(world: &World, most: f32) -> impl Iterator<Item = (usize, usize)> + '_ {
    [&world.constraints.links, &world.constraints.dynamic].into_iter().flat_map(move |links| {
        let over =
            (0..links.len()).filter(move |link| is_over(links, *link, &world.particles.x, most));
        over.map(|link| (links.a[link] as usize, links.b[link] as usize))
    })
}

#[inline(never)]
fn first_over(world: &World, most: f32) -> Option<(usize, usize)> {
    over(world, most).next()
}

fn tell(world: &mut World, most: f32) {
    let Some((a, b)) = first_over(world, most) else {
        return;
    };
    let middle = (world.particles.x.at(a) + world.particles.x.at(b)) * 0.5;
    let mut event = Event::new(EventKind::HeldApart, world.tick, middle);
    (event.particle_a, event.particle_b) = (a as u32, b as u32);
    event.count = world.over_stretched;
    world.events.push(event);
}
