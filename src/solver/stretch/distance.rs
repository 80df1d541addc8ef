//! Stages `Stretch`, `Shear` and `Bend`: every link returns to the length it was woven with.
//!
//! ```text
//! a ●───── n ─────▶ ● b        c = |b - a| - rest
//! ```
//! Macklin, Müller, Chentanez, "XPBD", MIG 2016, eq. 18. Links of one colour share no particle, so
//! inside a batch any order gives the same bits: a grid's batches go row by row (see `rows`), those of
//! other meshes some at a time (see `packed`). After them come the extra links of torn edges, which have
//! colours of their own.

use crate::solver::particle_stage::access::Spots;
#[cfg(feature = "parallel")]
use crate::solver::stretch::tiling;
use crate::solver::stretch::{grid_links, inverse_masses, mesh_kernel, sparse};

use crate::math::simd::{Arithmetic, Number, Scalar};
use crate::math::{TINY, max};
use crate::model::links::{LinkKind, Links};
use crate::solver::world::World;

/// How a link resists, as a number that kernels can be compiled for: …
/// by its compliance;
pub(crate) const SOFT: u8 = 0;
/// … not giving way at all;
pub(crate) const RIGID: u8 = 1;
/// … only to being longer than a bound.
pub(crate) const BOUND: u8 = 2;

/// Gets ready for the sweeps of a substep: weights are those of now, multipliers begin at 0.
pub(crate) fn restart(world: &mut World) {
    inverse_masses::weigh(world);
    if !is_rigid(world, LinkKind::Shear) {
        world.constraints.links.lambda.fill(0.0);
        world.constraints.extra.lambda.fill(0.0);
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
    if is_rigid(world, kind) {
        sweep::<RIGID>(world, kind, order, 0.0);
    } else {
        // A correction acts on the velocity through `step`, so that is what compliance sees.
        let step = world.settings.scheme().step;
        sweep::<SOFT>(world, kind, order, 1.0 / (step * step));
    }
}

/// One sweep over all links of a kind that draws in those longer than `most` rest lengths.
pub(crate) fn shorten(world: &mut World, kind: LinkKind, order: Order, most: f32) {
    sweep::<BOUND>(world, kind, order, most);
}

fn sweep<const LAW: u8>(world: &mut World, kind: LinkKind, order: Order, scale: f32) {
    match order {
        Order::Forward => {
            solve_batches::<LAW>(world, kind, order, scale);
            let batches = world.constraints.loose.batches_of(kind);
            batches.for_each(|at| solve_extra::<LAW>(world, at, order, scale));
        }
        Order::Backward => {
            let batches = world.constraints.loose.batches_of(kind).rev();
            batches.for_each(|at| solve_extra::<LAW>(world, at, order, scale));
            solve_batches::<LAW>(world, kind, order, scale);
        }
    }
}

fn solve_batches<const LAW: u8>(world: &mut World, kind: LinkKind, order: Order, scale: f32) {
    let batches = world.constraints.batches_of(kind);
    #[cfg(feature = "parallel")]
    if world.constraints.strays_of(kind).is_empty()
        && tiling::solve::<LAW>(world, batches.clone(), order, scale)
    {
        return;
    }
    match order {
        Order::Forward => batches.for_each(|at| solve_batch::<LAW>(world, at, scale)),
        Order::Backward => batches.rev().for_each(|at| solve_batch::<LAW>(world, at, scale)),
    }
}

fn solve_batch<const LAW: u8>(world: &mut World, at: usize, scale: f32) {
    let batch = world.constraints.batches[at];
    let range = batch.first..batch.first + batch.count;
    #[cfg(feature = "parallel")]
    let is_solved = tiling::solve::<LAW>(world, at..at + 1, Order::Forward, scale);
    #[cfg(not(feature = "parallel"))]
    let is_solved = false;
    let (constraints, p) = (&mut world.constraints, &mut world.particles);
    let packed = &mut world.scratch.interleaved;
    if let Some(grid) = &constraints.rows {
        if !is_solved {
            let ends = &world.scratch.end_weights.ends;
            let links = &mut constraints.links;
            grid_links::solve::<LAW>(world.level, grid, range.clone(), links, ends, p, scale);
        }
        // These are of a colour for sure, so that any order does.
        let (links, order) = (&mut constraints.links, Order::Forward);
        sparse::solve::<LAW, _>(world.level, &grid.loose, (at, order), links, p, scale);
    } else if packed.is_current {
        let (links, weights) = (&mut constraints.links, &world.scratch.end_weights);
        mesh_kernel::solve::<LAW>(world.level, world.threads, range, links, weights, packed, scale);
    } else {
        range.for_each(|link| project::<LAW, _>(&mut constraints.links, link, p, scale));
    }
}

fn solve_extra<const LAW: u8>(world: &mut World, at: usize, order: Order, scale: f32) {
    let (level, at) = (world.level, (at, order));
    let (p, packed) = (&mut world.particles, &mut world.scratch.interleaved);
    let (loose, links) = (&world.constraints.loose, &mut world.constraints.extra);
    if packed.is_current {
        sparse::solve::<LAW, _>(level, loose, at, links, packed, scale);
    } else {
        sparse::solve::<LAW, _>(level, loose, at, links, p, scale);
    }
}

/// One link by itself.
#[inline(always)]
pub(crate) fn project<const LAW: u8, S: Spots>(
    links: &mut Links,
    link: usize,
    spots: &mut S,
    scale: f32,
) {
    if !links.active[link] {
        return;
    }
    let ends = (links.a[link] as usize, links.b[link] as usize);
    let (compliance, lambda) = (links.compliance[link], links.lambda[link]);
    let lambda = pull::<LAW, _>(ends, links.rest[link], compliance, lambda, spots, scale);
    if LAW == SOFT {
        links.lambda[link] = lambda;
    }
}

/// Moves the ends of a link, and gives its multiplier then.
#[inline(always)]
pub(crate) fn pull<const LAW: u8, S: Spots>(
    (a, b): (usize, usize),
    rest: f32,
    compliance: f32,
    lambda: f32,
    spots: &mut S,
    scale: f32,
) -> f32 {
    let ((xa, wa), (xb, wb)) = (spots.spot(a), spots.spot(b));
    let span = xb - xa;
    let weights = if LAW == RIGID { over_mean([wa, wb]) } else { [wa, wb] };
    let ([to_a, to_b], lambda) =
        correct::<LAW, _>(Scalar, span.to_array(), weights, rest, compliance, lambda, scale);
    spots.put(a, xa + span * to_a);
    spots.put(b, xb - span * to_b);
    lambda
}

/// Inverse masses over the mean of both.
#[inline(always)]
pub(crate) fn over_mean([wa, wb]: [f32; 2]) -> [f32; 2] {
    let mean = max(0.5 * (wa + wb), TINY);
    [wa / mean, wb / mean]
}

/// The shares of its span that a link gives back at its two ends, and its multiplier then.
///
/// Weights are inverse masses, of rigid links those over the mean of both. `scale` is 1/h² for soft
/// links and the greatest length over rest for bounded ones. Rigid ones take Halley's step towards the
/// root of |span|² = rest², which needs no root of its own: a length l becomes
/// l (l² + 3 rest²) / (3 l² + rest²), so an error of 10 % is one of 0.03 % then.
#[inline(always)]
pub(crate) fn correct<const LAW: u8, S: Arithmetic>(
    s: S,
    [dx, dy, dz]: [S::F; 3],
    [wa, wb]: [S::F; 2],
    rest: S::F,
    compliance: S::F,
    lambda: S::F,
    scale: f32,
) -> ([S::F; 2], S::F) {
    let tiny = s.splat(TINY);
    let length2 = dx * dx + dy * dy + dz * dz;
    if LAW == RIGID {
        // Guarded beforehand, where nothing waits for it.
        let rest2 = (rest * rest).max(tiny);
        let share = (length2 - rest2) / (length2 * s.splat(3.0) + rest2);
        return ([share * wa, share * wb], lambda);
    }
    let (length, weight) = (length2.sqrt().max(tiny), wa + wb);
    if LAW == SOFT {
        let softness = compliance * s.splat(scale);
        let pull = length - rest + softness * lambda;
        let share = pull / (length * (weight + softness).max(tiny));
        return ([share * wa, share * wb], lambda - share * length);
    }
    let stretch = (length - rest * s.splat(scale)).max(s.splat(0.0));
    let share = stretch / (length * weight.max(tiny));
    ([share * wa, share * wb], lambda)
}

/// Whether no link of a kind gives way at all, so that there is nothing to remember from sweep to
/// sweep; else each does as its compliance says.
pub(crate) fn is_rigid(world: &World, kind: LinkKind) -> bool {
    let m = &world.material;
    let stretch_is_rigid = m.stretch_stiffness_warp == 0.0 && m.stretch_stiffness_weft == 0.0;
    match kind {
        LinkKind::Stretch => stretch_is_rigid,
        LinkKind::Shear => stretch_is_rigid && m.shear_stiffness == 0.0,
        // Softer ones are plates and hinges.
        LinkKind::Bend => true,
    }
}
