//! Stages `Stretch`, `Shear` and `Bend`: Gauss-Seidel sweeps over the distance constraints (links).
//!
//! ```text
//! a ●───── n ─────▶ ● b        C = |x_b − x_a| − rest
//! ```
//! One sweep projects every link of one kind, colour by colour (see `link_projection` for the
//! arithmetic). A colour is stored as one batch of links. Three kernels solve a batch:
//!
//! ```text
//! links of a grid             row by row                      grid_links, on threads: tiling
//! links of any other mesh     interleaved positions           mesh_kernel
//! irregular, dynamic links    gathered, colours of their own  sparse
//! ```
//! Macklin, Müller, Chentanez, "XPBD", MIG 2016, eq. 18.
//!
//! Reads `constraints`, `material`, `particles.w`; writes `particles.x` (or the interleaved copy
//! while that is current) and λ of the links.
//! Invariant: the links of one colour share no particle, so the order inside a colour does not
//! change the result; the dynamic links of torn edges come after all batches (before them in a
//! backward sweep).

use crate::model::links::{LinkKind, SoftLinks};
use crate::solver::stretch::link_projection::{BOUND, RIGID, SOFT, is_rigid, project_link};
use crate::solver::stretch::sweep_order::SweepOrder;
#[cfg(feature = "parallel")]
use crate::solver::stretch::tiling;
use crate::solver::stretch::{grid_links, inverse_masses, mesh_kernel, sparse};
use crate::solver::world::World;

/// Prepares the sweeps of a substep: refreshes the weights of the links' ends and resets λ to 0.
pub(crate) fn reset(world: &mut World) {
    inverse_masses::refresh(world);
    let is_rigid = is_rigid(&world.material, LinkKind::Shear);
    let links = [&world.constraints.links, &world.constraints.dynamic];
    for (lambda, links) in world.scratch.lambda.iter_mut().zip(links) {
        lambda.resize(links.len());
        if !is_rigid {
            lambda.fill(0.0);
        }
    }
}

/// Runs one sweep over all links of a kind.
pub(crate) fn solve(world: &mut World, kind: LinkKind, order: SweepOrder) {
    if kind == LinkKind::Bend && world.material.bend_stiffness == 0.0 {
        return;
    }
    if is_rigid(&world.material, kind) {
        sweep::<RIGID>(world, kind, order, 0.0);
    } else {
        // A correction changes the velocity through `step`, so the compliance is divided by step².
        let step = world.scheme().velocity_step;
        sweep::<SOFT>(world, kind, order, 1.0 / (step * step));
    }
}

/// Runs one sweep that shortens the links of a kind that are longer than `limit` times their rest
/// length.
pub(crate) fn project_upper_bound(
    world: &mut World,
    kind: LinkKind,
    order: SweepOrder,
    limit: f32,
) {
    sweep::<BOUND>(world, kind, order, limit);
}

fn sweep<const LAW: u8>(world: &mut World, kind: LinkKind, order: SweepOrder, scale: f32) {
    match order {
        SweepOrder::Forward => {
            solve_batches::<LAW>(world, kind, order, scale);
            let batches = world.constraints.sparse.batches_of(kind);
            batches.for_each(|at| solve_dynamic::<LAW>(world, at, order, scale));
        }
        SweepOrder::Backward => {
            let batches = world.constraints.sparse.batches_of(kind).rev();
            batches.for_each(|at| solve_dynamic::<LAW>(world, at, order, scale));
            solve_batches::<LAW>(world, kind, order, scale);
        }
    }
}

fn solve_batches<const LAW: u8>(world: &mut World, kind: LinkKind, order: SweepOrder, scale: f32) {
    let batches = world.constraints.batches_of(kind);
    #[cfg(feature = "parallel")]
    if world.constraints.irregular_links_of(kind).is_empty()
        && tiling::solve::<LAW>(world, batches.clone(), order, scale)
    {
        return;
    }
    match order {
        SweepOrder::Forward => batches.for_each(|at| solve_batch::<LAW>(world, at, scale)),
        SweepOrder::Backward => batches.rev().for_each(|at| solve_batch::<LAW>(world, at, scale)),
    }
}

fn solve_batch<const LAW: u8>(world: &mut World, at: usize, scale: f32) {
    let batch = world.constraints.batches[at];
    let range = batch.first..batch.first + batch.count;
    #[cfg(feature = "parallel")]
    let is_solved = tiling::solve::<LAW>(world, at..at + 1, SweepOrder::Forward, scale);
    #[cfg(not(feature = "parallel"))]
    let is_solved = false;
    let (constraints, p) = (&world.constraints, &mut world.particles);
    let (links, lambda) = (&constraints.links, &mut world.scratch.lambda[0][..]);
    let interleaved = &mut world.scratch.interleaved;
    if let Some(grid) = &constraints.rows {
        if !is_solved {
            let ends = &world.scratch.end_weights.ends;
            let links = (links, &mut *lambda);
            grid_links::solve::<LAW>(world.level, grid, range.clone(), links, ends, p, scale);
        }
        // The irregular links of one batch share no particle, so that the order does not matter.
        let order = SweepOrder::Forward;
        let links = SoftLinks { compliance: &links.compliance, lambda };
        sparse::solve::<LAW, _>(world.level, &grid.sparse, (at, order), links, p, scale);
    } else if interleaved.is_current {
        let weights = &world.scratch.end_weights;
        mesh_kernel::solve::<LAW>(
            world.level,
            world.threads,
            range,
            (links, lambda),
            weights,
            interleaved,
            scale,
        );
    } else {
        range.for_each(|link| project_link::<LAW, _>((links, &mut *lambda), link, p, scale));
    }
}

/// Solves one batch of dynamic links, which tears made.
fn solve_dynamic<const LAW: u8>(world: &mut World, at: usize, order: SweepOrder, scale: f32) {
    let (level, at) = (world.level, (at, order));
    let (p, interleaved) = (&mut world.particles, &mut world.scratch.interleaved);
    let sparse_links = &world.constraints.sparse;
    let compliance = &world.constraints.dynamic.compliance[..];
    let links = SoftLinks { compliance, lambda: &mut world.scratch.lambda[1] };
    if interleaved.is_current {
        sparse::solve::<LAW, _>(level, sparse_links, at, links, interleaved, scale);
    } else {
        sparse::solve::<LAW, _>(level, sparse_links, at, links, p, scale);
    }
}
