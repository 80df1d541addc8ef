//! Chains in SIMD blocks: up to eight chains side by side, one per lane, as sequences of steps for
//! the line solver.
//!
//! ```text
//! lane      0   1   2  …            step 0: first particle of each chain (rest < 0)
//! step 0    p   p   p               step k: next link, its far particle and rest length
//! step 1    ●   ●   ●               a torn chain starts its next segment in the same lane,
//! step 2    ●   p   ●               with another starting step (rest < 0)
//! ```
//! Particles are named by slots of the interleaved position buffer: slot = particle + 1, and slot 0
//! is a sentinel that idle lanes read.
//!
//! Reads `Links`; writes steps. Lanes keep their chain when it breaks, so that neighbours in the
//! cloth stay neighbours here.
//!
//! Invariant: after `rebuild_stale` the steps contain each active link of all chains once.

use crate::math::heap_bytes::heap_bytes;
use crate::math::shared::Shared;
use crate::math::simd::{LANES, LaneArray};
use crate::mesh::NONE;
use crate::model::links::Links;

/// Sentinel slot of idle lanes. Particle p has slot p + 1.
pub(crate) const NO_PARTICLE: u32 = 0;

/// A link of a chain: its number, and whether the chain runs from its second particle to its first.
pub(crate) type ChainLink = (u32, bool);

/// One step of eight chains: the next link of each lane, or the first particle of its next segment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChainStep {
    /// Link number; `NONE` at the start of a segment and behind the last one.
    pub links: [u32; LANES],
    /// Slot of the particle that the link leads to; `NO_PARTICLE` behind the last segment.
    pub to: [u32; LANES],
    /// Rest length [m]. At the start of a segment: that of its first link, negative. Behind the
    /// last segment: 0.
    pub rest: LaneArray,
}

const NO_STEP: ChainStep =
    ChainStep { links: [NONE; LANES], to: [NO_PARTICLE; LANES], rest: [0.0; LANES] };

/// A block whose particles lie at constant strides, as in a grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct StridedBlock {
    /// First particle of the first chain.
    pub first: usize,
    /// Stride from one particle of a chain to the next, and from one chain to the next.
    pub link_stride: usize,
    pub chain_stride: usize,
    /// Number of chains.
    pub chain_count: usize,
}

/// Up to eight chains that share no particle.
#[derive(Clone, Copy, Debug)]
struct ChainBlock {
    /// First step, and number of steps.
    first_step: usize,
    steps: usize,
    /// Whether links changed since the steps were built.
    is_stale: bool,
    /// The strides, if all chains are whole, equally long and at constant strides.
    strided: Option<StridedBlock>,
}

/// All chains in blocks.
#[derive(Clone, Debug, Default)]
pub(crate) struct ChainBlocks {
    steps: Shared<Vec<ChainStep>>,
    blocks: Vec<ChainBlock>,
    /// Links of all chains at creation, chain by chain, block by block.
    links_of_chains: Shared<Vec<ChainLink>>,
    /// First entry in `links_of_chains` of each chain of a block, and the end of the last one.
    chain_starts: Vec<[u32; LANES + 1]>,
    /// Block of each link; `NONE` if it is in no chain.
    block_of: Shared<Vec<u32>>,
    /// Whether any block is stale.
    is_stale: bool,
    /// Whether all blocks are strided.
    are_all_strided: bool,
    /// Whether there are steps for chains that tear apart.
    can_break: bool,
}

heap_bytes!(
    ChainBlocks {
        steps, blocks, links_of_chains, chain_starts, block_of,
    } plain { is_stale, are_all_strided, can_break }
);

impl ChainBlocks {
    /// Builds blocks from chains. `links` are all links; `can_break` allocates for chains that tear
    /// apart.
    pub fn new(links: &Links, blocks: &[Vec<&[ChainLink]>], can_break: bool) -> Self {
        let mut result = Self { block_of: Shared::new(vec![NONE; links.len()]), ..Self::default() };
        for (at, chains) in blocks.iter().enumerate() {
            let mut chain_starts = [result.links_of_chains.len() as u32; LANES + 1];
            for (lane, chain) in chains.iter().enumerate() {
                chain.iter().for_each(|(link, _)| result.block_of[*link as usize] = at as u32);
                result.links_of_chains.extend_from_slice(chain);
                chain_starts[lane + 1..].fill(result.links_of_chains.len() as u32);
            }
            result.chain_starts.push(chain_starts);
            result.blocks.push(ChainBlock {
                first_step: 0,
                steps: 0,
                is_stale: true,
                strided: None,
            });
        }
        result.links_of_chains.shrink_to_fit();
        result.allocate_steps(links, can_break);
        result
    }

    /// Allocates steps for chains that tear apart, unless there are some.
    pub fn reserve_breaks(&mut self, links: &Links) {
        if !self.can_break {
            self.allocate_steps(links, true);
        }
    }

    /// Allocates the steps of all blocks and rebuilds them.
    fn allocate_steps(&mut self, links: &Links, can_break: bool) {
        let mut steps = 0;
        for (block, starts) in self.blocks.iter_mut().zip(&self.chain_starts) {
            (block.first_step, block.steps, block.is_stale) = (steps, 0, true);
            let lengths = starts.windows(2).map(|ends| (ends[1] - ends[0]) as usize);
            let longest = lengths.max().unwrap_or(0);
            // Each segment has a start and at least one link.
            steps += if can_break { 2 * longest } else { longest + 1 };
        }
        self.steps = Shared::new(vec![NO_STEP; steps]);
        (self.is_stale, self.can_break) = (true, can_break);
        self.rebuild_stale(links);
    }

    /// Makes the steps unique.
    pub fn make_unique(&mut self) {
        self.steps.make_unique();
    }

    /// The steps of each block, in the order in which they are solved.
    pub fn blocks(&self) -> impl Iterator<Item = &[ChainStep]> {
        self.blocks.iter().map(|block| &self.steps[block.first_step..][..block.steps])
    }

    /// Returns whether all blocks are strided.
    pub fn are_all_strided(&self) -> bool {
        self.are_all_strided
    }

    /// The strided blocks with their steps.
    pub fn strided_blocks(&self) -> impl Iterator<Item = (StridedBlock, &[ChainStep])> {
        self.blocks
            .iter()
            .zip(self.blocks())
            .filter_map(|(block, steps)| Some((block.strided?, steps)))
    }

    /// Maximum number of steps of a block.
    pub fn max_steps(&self) -> usize {
        let ends = self.blocks.iter().skip(1).map(|block| block.first_step);
        let ends = ends.chain([self.steps.len()]);
        self.blocks.iter().zip(ends).map(|(block, end)| end - block.first_step).max().unwrap_or(0)
    }

    /// Marks the block of a link that changed.
    pub fn mark_stale(&mut self, link: usize) {
        if let Some(block) = self.blocks.get_mut(self.block_of[link] as usize) {
            block.is_stale = true;
            self.is_stale = true;
        }
    }

    /// Copies the rest lengths of all links, after rebuilding stale blocks.
    pub fn update_rest_lengths(&mut self, links: &Links) {
        self.rebuild_stale(links);
        for block in &self.blocks {
            let mut next = [0.0; LANES];
            for step in self.steps[block.first_step..][..block.steps].iter_mut().rev() {
                for lane in 0..LANES {
                    let (link, starts_segment) = (step.links[lane], step.to[lane] != NO_PARTICLE);
                    if link != NONE {
                        step.rest[lane] = links.rest[link as usize];
                    } else if starts_segment {
                        step.rest[lane] = -next[lane];
                    }
                }
                next = step.rest;
            }
        }
    }

    /// Rebuilds the steps of all stale blocks.
    pub fn rebuild_stale(&mut self, links: &Links) {
        if core::mem::take(&mut self.is_stale) {
            for at in 0..self.blocks.len() {
                if core::mem::take(&mut self.blocks[at].is_stale) {
                    self.rebuild_block(links, at);
                    let block = &mut self.blocks[at];
                    block.strided =
                        StridedBlock::of(&self.steps[block.first_step..][..block.steps]);
                }
            }
            self.are_all_strided = self.blocks.iter().all(|block| block.strided.is_some());
        }
    }

    /// Rebuilds the steps of a block.
    fn rebuild_block(&mut self, links: &Links, at: usize) {
        let block = &mut self.blocks[at];
        let steps = &mut self.steps[block.first_step..];
        steps[..block.steps].fill(NO_STEP);
        block.steps = 0;
        for (lane, ends) in self.chain_starts[at].windows(2).enumerate() {
            let (mut count, mut end) = (0, NO_PARTICLE);
            for chain_link in &self.links_of_chains[ends[0] as usize..ends[1] as usize] {
                let (from, to) = slots(links, *chain_link);
                let rest = links.rest[chain_link.0 as usize];
                if from != NO_PARTICLE {
                    if from != end {
                        (steps[count].to[lane], steps[count].rest[lane]) = (from, -rest);
                        count += 1;
                    }
                    (steps[count].to[lane], steps[count].rest[lane]) = (to, rest);
                    steps[count].links[lane] = chain_link.0;
                    count += 1;
                }
                end = to;
            }
            block.steps = block.steps.max(count);
        }
    }
}

impl StridedBlock {
    /// Detects constant strides in the steps of a block. Blocks too short to be transposed in
    /// groups of four steps are not strided.
    fn of(steps: &[ChainStep]) -> Option<Self> {
        let first = steps.first()?.to;
        // If the first chain has no link left, the block is not strided.
        let before_first = first[0].checked_sub(1)?;
        let chains = first.iter().take_while(|to| **to != NO_PARTICLE).count();
        let chain_stride = if chains > 1 { first[1].checked_sub(first[0])? } else { 1 };
        let link_stride = steps.get(3)?.to[0].checked_sub(first[0])? / 3;
        let matches = |(at, step): (usize, &ChainStep)| {
            let slot =
                |lane: usize| first[0] + at as u32 * link_stride + lane as u32 * chain_stride;
            let to = |lane: usize| if lane < chains { slot(lane) } else { NO_PARTICLE };
            (0..LANES).all(|lane| {
                step.to[lane] == to(lane) && (step.rest[lane] > 0.0) == (lane < chains && at > 0)
            })
        };
        let is_strided =
            (link_stride == 1 || chain_stride == 1) && steps.iter().enumerate().all(matches);
        is_strided.then_some(Self {
            first: before_first as usize,
            link_stride: link_stride as usize,
            chain_stride: chain_stride as usize,
            chain_count: chains,
        })
    }
}

/// Slots that a link runs from and to; `NO_PARTICLE` if it is not active.
fn slots(links: &Links, (link, is_reversed): ChainLink) -> (u32, u32) {
    let link = link as usize;
    match (links.active[link], is_reversed) {
        (false, _) => (NO_PARTICLE, NO_PARTICLE),
        (true, false) => (links.a[link] + 1, links.b[link] + 1),
        (true, true) => (links.b[link] + 1, links.a[link] + 1),
    }
}
