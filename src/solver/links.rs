//! Stages `Stretch`, `Shear` and `Bend`: every link returns to the length it was woven with.
//!
//! ```text
//! a ●───── n ─────▶ ● b        c = |b - a| - rest
//! ```
//! Macklin, Müller, Chentanez, "XPBD", MIG 2016, eq. 18. Links of one colour share no particle, so
//! inside a batch any order gives the same bits; the extra links of torn edges go in their order.

use super::World;
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
    // A correction acts on the velocity through `step`, so that is what compliance sees.
    let step = world.settings.scheme().step;
    let inv_h2 = 1.0 / (step * step);
    match order {
        Order::Forward => {
            for at in 0..world.weave.batches.len() {
                solve_batch(world, at, kind, inv_h2);
            }
            for link in 0..world.weave.extra.len() {
                solve_extra(world, link, kind, inv_h2);
            }
        }
        Order::Backward => {
            for link in (0..world.weave.extra.len()).rev() {
                solve_extra(world, link, kind, inv_h2);
            }
            for at in (0..world.weave.batches.len()).rev() {
                solve_batch(world, at, kind, inv_h2);
            }
        }
    }
}

fn solve_batch(world: &mut World, at: usize, kind: LinkKind, inv_h2: f32) {
    let batch = world.weave.batches[at];
    if batch.kind == kind {
        for link in batch.first..batch.first + batch.count {
            project(&mut world.weave.links, link, &mut world.particles, inv_h2);
        }
    }
}

fn solve_extra(world: &mut World, link: usize, kind: LinkKind, inv_h2: f32) {
    if world.weave.extra.kind(link) == kind {
        project(&mut world.weave.extra, link, &mut world.particles, inv_h2);
    }
}

#[inline(always)]
fn project(links: &mut Links, link: usize, p: &mut Particles, inv_h2: f32) {
    if !links.active[link] {
        return;
    }
    let (a, b) = (links.a[link] as usize, links.b[link] as usize);
    let (wa, wb) = (p.w[a], p.w[b]);
    let span = p.x.at(b) - p.x.at(a);
    let length = max(span.length(), TINY);
    let softness = links.compliance[link] * inv_h2;
    let stretch = length - links.rest[link];
    let pull = stretch + softness * links.lambda[link];
    let change = pull / max(wa + wb + softness, TINY);
    links.lambda[link] -= change;
    let correction = span * (change / length);
    p.x.add(a, correction * wa);
    p.x.add(b, correction * -wb);
}

fn is_rigid(world: &World) -> bool {
    let m = &world.material;
    let stiff = m.stretch_stiffness_warp == 0.0 && m.stretch_stiffness_weft == 0.0;
    stiff && m.shear_stiffness == 0.0 && (m.bend_stiffness == 0.0 || m.bend_stiffness >= 1.0)
}
