//! Stages `Stretch`, `Shear` and `Bend`: every link returns to the length it was woven with.
//!
//! ```text
//! a ●───── n ─────▶ ● b        c = |b - a| - rest
//! ```
//! Macklin, Müller, Chentanez, "XPBD", MIG 2016, eq. 18. Links of one colour share no particle, so
//! inside a batch any order gives the same bits: a grid's batches go row by row (see `rows`), the
//! others link by link. The extra links of torn edges go in their order.

use super::{World, rows};
use crate::fabric::weave::{LinkKind, Links};
use crate::math::{TINY, max};
use crate::state::particles::Particles;

/// Forgets the multipliers of the last substep.
pub(crate) fn restart(world: &mut World) {
    if !is_rigid(world) {
        world.weave.links.lambda.fill(0.0);
        world.weave.extra.lambda.fill(0.0);
    }
}

/// Which way a sweep goes through the colours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Order {
    Forward,
    Backward,
}

/// One sweep over all links of a kind.
pub(crate) fn solve(world: &mut World, kind: LinkKind, order: Order) {
    if kind == LinkKind::Bend && world.material.bend_stiffness == 0.0 {
        return;
    }
    if is_rigid(world) {
        sweep::<true>(world, kind, order);
    } else {
        sweep::<false>(world, kind, order);
    }
}

fn sweep<const RIGID: bool>(world: &mut World, kind: LinkKind, order: Order) {
    // A correction acts on the velocity through `step`, so that is what compliance sees.
    let step = world.settings.scheme().step;
    let inv_h2 = 1.0 / (step * step);
    match order {
        Order::Forward => {
            for at in 0..world.weave.batches.len() {
                solve_batch::<RIGID>(world, at, kind, inv_h2);
            }
            for link in 0..world.weave.extra.len() {
                solve_extra::<RIGID>(world, link, kind, inv_h2);
            }
        }
        Order::Backward => {
            for link in (0..world.weave.extra.len()).rev() {
                solve_extra::<RIGID>(world, link, kind, inv_h2);
            }
            for at in (0..world.weave.batches.len()).rev() {
                solve_batch::<RIGID>(world, at, kind, inv_h2);
            }
        }
    }
}

fn solve_batch<const RIGID: bool>(world: &mut World, at: usize, kind: LinkKind, inv_h2: f32) {
    let batch = world.weave.batches[at];
    if batch.kind != kind {
        return;
    }
    let range = batch.first..batch.first + batch.count;
    let (weave, p) = (&mut world.weave, &mut world.particles);
    let Some(grid) = &weave.rows else {
        for link in range {
            project::<RIGID>(&mut weave.links, link, p, inv_h2);
        }
        return;
    };
    rows::solve::<RIGID>(world.level, grid, range.clone(), &mut weave.links, p, inv_h2);
    for link in grid.strays(range) {
        project::<RIGID>(&mut weave.links, *link as usize, p, inv_h2);
    }
}

fn solve_extra<const RIGID: bool>(world: &mut World, link: usize, kind: LinkKind, inv_h2: f32) {
    if world.weave.extra.kind(link) == kind {
        project::<RIGID>(&mut world.weave.extra, link, &mut world.particles, inv_h2);
    }
}

/// One link by itself.
#[inline(always)]
pub(crate) fn project<const RIGID: bool>(
    links: &mut Links,
    link: usize,
    p: &mut Particles,
    inv_h2: f32,
) {
    if !links.active[link] {
        return;
    }
    let (a, b) = (links.a[link] as usize, links.b[link] as usize);
    let (wa, wb) = (p.w[a], p.w[b]);
    let span = p.x.at(b) - p.x.at(a);
    let softness = if RIGID { 0.0 } else { links.compliance[link] * inv_h2 };
    let lambda = if RIGID { 0.0 } else { links.lambda[link] };
    let (share, lambda) =
        correct::<RIGID>(span.to_array(), wa + wb, links.rest[link], softness, lambda);
    if !RIGID {
        links.lambda[link] = lambda;
    }
    p.x.add(a, span * (share * wa));
    p.x.add(b, span * -(share * wb));
}

/// The share of its span that a link gives back for each unit of inverse mass, and its multiplier
/// then. One division and one root: what kernels spend their time on.
#[inline(always)]
pub(crate) fn correct<const RIGID: bool>(
    [dx, dy, dz]: [f32; 3],
    weight: f32,
    rest: f32,
    softness: f32,
    lambda: f32,
) -> (f32, f32) {
    let length = max((dx * dx + dy * dy + dz * dz).sqrt(), TINY);
    let stretch = length - rest;
    if RIGID {
        return (stretch / (length * max(weight, TINY)), 0.0);
    }
    let pull = stretch + softness * lambda;
    let share = pull / (length * max(weight + softness, TINY));
    (share, lambda - share * length)
}

/// Whether no link gives way at all, so that there is nothing to remember from sweep to sweep.
fn is_rigid(world: &World) -> bool {
    let m = &world.material;
    let stiff = m.stretch_stiffness_warp == 0.0 && m.stretch_stiffness_weft == 0.0;
    stiff && m.shear_stiffness == 0.0 && (m.bend_stiffness == 0.0 || m.bend_stiffness >= 1.0)
}
