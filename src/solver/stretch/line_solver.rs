//! Stage `Stretch`, first sweep of a substep: direct solve of whole chains (straight runs of
//! links).
//!
//! ```text
//! x₀ ●──── 1 ────● x₁ ──── 2 ────● x₂ ──── 3 ────● x₃
//!
//! s_i = x_i − x_{i−1}    l_i = |s_i|    n_i = s_i / l_i      link i joins particles i − 1 and i
//! ```
//! **Tensions.** A link of a chain is coupled only to its neighbours in the chain. So the
//! multipliers λ of the linearised distance constraints (XPBD: Macklin, Müller, Chentanez, MIG
//! 2016, eq. 18, for all links of the chain at once) form a tridiagonal system with one row per
//! link:
//!
//! ```text
//! (w₋ + w₊ + α̃) λ − w₋ (n₋·n) λ₋ − w₊ (n·n₊) λ₊ = C         C = l − target
//!
//! w₋, w₊   inverse masses of the two ends of the link
//! λ₋, λ₊   multipliers of the links before and after it; λ > 0 is tension
//! α̃        compliance / h², 0 for rigid links
//! ```
//! It is solved by elimination forward and substitution backward (Thomas algorithm). One solve
//! carries a load from one end of the chain to the other; sweeps would need as many iterations as
//! the chain has links.
//!
//! **Displacements.** A link under tension pulls along its direction at the *end* of the substep,
//! not along its predicted direction: its pull is q (s + u − u₋), where q is λ over the length at
//! the end, target + α̃ λ. A link under compression pulls with λ n. So the displacements u of the
//! particles solve a second tridiagonal system with one row per particle, eliminated backward and
//! substituted forward:
//!
//! ```text
//! (1 + w (q + q₊)) u − w q u₋ − w q₊ u₊ = w (t₊ n₊ − t n)
//!
//! q, t     of the link before the particle: q = λ / (target + α̃ λ), t = q l under tension;
//!          q = 0, t = λ under compression
//! q₊, t₊   of the link after the particle
//! ```
//! Without it, a long chain whose sideways vibration is faster than a substep would jitter.
//!
//! **Targets.** The target of a compliant link is its rest length. The target of a rigid link keeps
//! 70 % of the error that the link had at the start of the substep: in a tangle, chains contradict
//! other constraints, and chains that remove the whole error at once never come to rest.
//!
//! ```text
//! target = rest + (1 − 0.3) (length at the start of the substep − rest)
//! ```
//!
//! Reads `constraints.chains` (eight chains side by side per block, see `model::chain_blocks`),
//! positions, inverse masses, the positions at the start of the substep; writes positions, and λ of
//! compliant links.
//! Invariant: the chains of a block share no particle and each lane is a chain of its own, so the
//! number of lanes does not change the result; no particle moves farther than the rest length of
//! its link.

use crate::math::max;
use crate::math::simd::{LANES, Level, Scalar};
use crate::model::chain_blocks;
use crate::model::links::{LinkKind, SoftLinks};
use crate::solver::stretch::line_gather::LinePoints;
use crate::solver::stretch::line_scratch::LineScratch;
use crate::solver::stretch::line_step::LineStep;
use crate::solver::stretch::link_projection::is_rigid;
use crate::solver::stretch::{line_gather, line_strided, tridiagonal};
use crate::solver::world::World;

/// The least load that [`is_needed`] assumes [m/s²]: wind and grabs pull where gravity is weak.
const MIN_LOAD: f32 = 9.81;

/// The strain of a hanging chain that sweeps may leave before chains are solved directly.
const MAX_SWEEP_STRAIN: f32 = 1.0e-5;

/// Whether chains are solved directly.
///
/// The plain scheme (no tethers, or one iteration) uses sweeps only. Otherwise the direct solve
/// runs if sweeps would leave too much strain: n sweeps leave a hanging chain of N links with the
/// mean strain g h² N / (2 n rest).
pub(crate) fn is_needed(world: &World) -> bool {
    let settings = &world.settings;
    let (h, sweeps) = (world.regular_scheme().h, settings.iterations as f32);
    let load = max(settings.gravity.length(), MIN_LOAD);
    let strain =
        load * h * h * world.constraints.chains.longest as f32 / (2.0 * sweeps * world.mean_edge);
    settings.tethers && settings.iterations > 1 && strain > MAX_SWEEP_STRAIN
}

/// Solves all chains.
pub(crate) fn solve(world: &mut World) {
    let is_rigid = is_rigid(&world.material, LinkKind::Stretch);
    let step = world.scheme().velocity_step;
    let scale = if is_rigid { None } else { Some(1.0 / (step * step)) };
    world.constraints.chains.blocks.rebuild_stale(&world.constraints.links);
    let are_in_columns = world.level != Level::Scalar && !world.scratch.interleaved.is_current;
    if are_in_columns && world.constraints.chains.blocks.are_all_strided() {
        solve_strided(world, scale);
    } else {
        line_gather::gather(world, is_rigid);
        solve_blocks(world, scale);
        line_gather::scatter(world);
    }
}

/// Whether a block is gathered as a whole before it is solved.
///
/// WebAssembly engines run out of registers in a loop that also gathers. On other targets the
/// gather of a step overlaps with the latency of the step before.
const GATHERS_BLOCK_FIRST: bool = cfg!(target_arch = "wasm32");

/// Solves blocks whose particles are at arbitrary indices.
fn solve_blocks(world: &mut World, scale: Option<f32>) {
    let (level, chains) = (world.level, &world.constraints.chains.blocks);
    let links = &mut SoftLinks {
        compliance: &world.constraints.links.compliance,
        lambda: &mut world.scratch.lambda[0],
    };
    let LineScratch { points, start_points, steps: scratch, .. } = &mut world.scratch.lines;
    for block in chains.blocks() {
        let steps = &mut scratch[..=block.len()];
        let gathered = LinePoints { points, start_points };
        match scale {
            None if GATHERS_BLOCK_FIRST => {
                line_gather::gather_rigid(level, block, gathered, &mut steps[1..]);
            }
            Some(_) if GATHERS_BLOCK_FIRST => {
                line_gather::gather_soft(level, block, gathered, &mut steps[1..]);
            }
            None => tridiagonal::gather_solve_rigid(level, block, gathered, steps, links, 0.0),
            Some(scale) => {
                tridiagonal::gather_solve_soft(level, block, gathered, steps, links, scale);
            }
        }
        if GATHERS_BLOCK_FIRST {
            solve_gathered(level, block, steps, links, scale);
        }
        line_gather::scatter_block(level, block, &steps[1..], points);
    }
}

/// Solves blocks whose particles are at a fixed stride in the columns.
fn solve_strided(world: &mut World, scale: Option<f32>) {
    let (level, scratch, p) = (world.level, &mut world.scratch, &mut world.particles);
    let (chains, links) = (&world.constraints.chains.blocks, &world.constraints.links);
    let links = &mut SoftLinks { compliance: &links.compliance, lambda: &mut scratch.lambda[0] };
    let LineScratch { start_columns: starts, steps, .. } = &mut scratch.lines;
    if scale.is_none() {
        line_strided::compute_starts(level, &scratch.predicted, &scratch.displacement, starts);
    }
    for (strided, block) in chains.strided_blocks() {
        let steps = &mut steps[..=block.len()];
        line_strided::gather(strided, &p.x, &p.w, &mut steps[1..]);
        if scale.is_none() {
            line_strided::set_relaxed_targets(strided, starts, block, &mut steps[1..]);
        } else {
            set_rest_targets(block, &mut steps[1..]);
        }
        solve_gathered(level, block, steps, links, scale);
        line_strided::scatter(strided, block, &steps[1..], &mut p.x);
    }
}

/// Sets the target lengths of compliant links.
fn set_rest_targets(block: &[chain_blocks::ChainStep], steps: &mut [LineStep]) {
    for (step, chain_step) in steps.iter_mut().zip(block) {
        (0..LANES).for_each(|lane| step.set_rest_target(Scalar, lane, &chain_step.rest));
    }
}

/// Solves a block that was gathered; `scale` is 1/h² [1/s²] for compliant links, none for rigid
/// ones.
fn solve_gathered(
    level: Level,
    block: &[chain_blocks::ChainStep],
    steps: &mut [LineStep],
    links: &mut SoftLinks<'_>,
    scale: Option<f32>,
) {
    let none = LinePoints { points: &[], start_points: &[] };
    match scale {
        None => tridiagonal::solve_rigid(level, block, none, steps, links, 0.0),
        Some(scale) => tridiagonal::solve_soft(level, block, none, steps, links, scale),
    }
}
