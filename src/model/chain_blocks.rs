//! Lines side by side, eight at a time, as they are solved.
//!
//! Where links broke, a line is pieces, one after the other in the lane that is the line's: what lies next
//! to each other in the cloth stays so here, whatever is torn.

use crate::math::simd::{LANES, LaneArray};
use crate::mesh::NONE;
use crate::model::links::Links;

/// The seat that lanes without a link look at. Every particle has the seat after its own number.
pub(crate) const NO_PARTICLE: u32 = 0;

/// A link of a line: its number, and whether the line runs from its second particle.
pub(crate) type ChainLink = (u32, bool);

/// The next link of each lane, or the particle that its next piece begins with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ChainStep {
    /// The link's number; `NONE` where a piece begins, and behind the last.
    pub links: [u32; LANES],
    /// The seat of the particle that it runs to; `NO_PARTICLE` behind the last piece.
    pub to: [u32; LANES],
    /// Its length at rest [m]. Where a piece begins it is that of the first link, negative; behind the last
    /// it is 0.
    pub rest: LaneArray,
}

const NO_STEP: ChainStep =
    ChainStep { links: [NONE; LANES], to: [NO_PARTICLE; LANES], rest: [0.0; LANES] };

/// Lines whose particles lie evenly: by so many apart along a line, and from one line to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct StridedBlock {
    /// The first particle of the first line.
    pub first: usize,
    pub link_stride: usize,
    pub chain_stride: usize,
    /// How many lines.
    pub chain_count: usize,
}

/// Up to eight lines that share no particle.
#[derive(Clone, Debug)]
struct ChainBlock {
    /// Where its room for steps begins, and how many there are.
    first_step: usize,
    steps: usize,
    is_stale: bool,
    /// If all its lines are whole, as long as each other, and lie as those of a grid do.
    strided: Option<StridedBlock>,
}

/// Lines in blocks, laid side by side.
#[derive(Clone, Debug, Default)]
pub(crate) struct ChainBlocks {
    steps: Vec<ChainStep>,
    blocks: Vec<ChainBlock>,
    /// The links of all lines as they were woven, line after line, block after block.
    links_of_chains: Vec<ChainLink>,
    /// Where the lines of each block begin among the members, and where the last one ends.
    chain_starts: Vec<[u32; LANES + 1]>,
    /// The block of each link; `NONE` for those in no line.
    block_of: Vec<u32>,
    /// Whether any block is stale.
    is_stale: bool,
    /// Whether all blocks are strips.
    are_all_strided: bool,
}

impl ChainBlocks {
    /// Lays lines by blocks. `links` are all there are; `can_break` says to have room for lines to break.
    pub fn new(links: &Links, blocks: &[Vec<&[ChainLink]>], can_break: bool) -> Self {
        let mut result = Self { block_of: vec![NONE; links.len()], ..Self::default() };
        let mut steps = 0;
        for (at, lines) in blocks.iter().enumerate() {
            let mut chain_starts = [result.links_of_chains.len() as u32; LANES + 1];
            for (lane, line) in lines.iter().enumerate() {
                line.iter().for_each(|(link, _)| result.block_of[*link as usize] = at as u32);
                result.links_of_chains.extend_from_slice(line);
                chain_starts[lane + 1..].fill(result.links_of_chains.len() as u32);
            }
            result.chain_starts.push(chain_starts);
            result.blocks.push(ChainBlock {
                first_step: steps,
                steps: 0,
                is_stale: true,
                strided: None,
            });
            // Each piece has a beginning, and a link at least.
            let longest = lines.iter().map(|line| line.len()).max().unwrap_or(0);
            steps += if can_break { 2 * longest } else { longest + 1 };
        }
        result.steps = vec![NO_STEP; steps];
        result.is_stale = true;
        result.rebuild_stale(links);
        result
    }

    /// The steps of each block, in the order that these are to be solved in.
    pub fn blocks(&self) -> impl Iterator<Item = &[ChainStep]> {
        self.blocks.iter().map(|block| &self.steps[block.first_step..][..block.steps])
    }

    /// Whether all blocks are strips.
    pub fn are_all_strided(&self) -> bool {
        self.are_all_strided
    }

    /// The blocks that are strips, as these.
    pub fn strided_blocks(&self) -> impl Iterator<Item = (StridedBlock, &[ChainStep])> {
        self.blocks
            .iter()
            .zip(self.blocks())
            .filter_map(|(block, steps)| Some((block.strided?, steps)))
    }

    /// How many steps there may be in a block.
    pub fn max_steps(&self) -> usize {
        let ends = self.blocks.iter().skip(1).map(|block| block.first_step);
        let ends = ends.chain([self.steps.len()]);
        self.blocks.iter().zip(ends).map(|(block, end)| end - block.first_step).max().unwrap_or(0)
    }

    /// Takes note that a link changed.
    pub fn mark_stale(&mut self, link: usize) {
        if let Some(block) = self.blocks.get_mut(self.block_of[link] as usize) {
            block.is_stale = true;
            self.is_stale = true;
        }
    }

    /// Takes over lengths at rest that changed.
    pub fn update_rest_lengths(&mut self, links: &Links) {
        self.rebuild_stale(links);
        for block in &self.blocks {
            let mut next = [0.0; LANES];
            for step in self.steps[block.first_step..][..block.steps].iter_mut().rev() {
                for lane in 0..LANES {
                    let (link, starts_piece) = (step.links[lane], step.to[lane] != NO_PARTICLE);
                    if link != NONE {
                        step.rest[lane] = links.rest[link as usize];
                    } else if starts_piece {
                        step.rest[lane] = -next[lane];
                    }
                }
                next = step.rest;
            }
        }
    }

    /// Lays anew what changed.
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

    fn rebuild_block(&mut self, links: &Links, at: usize) {
        let block = &mut self.blocks[at];
        let scratch = &mut self.steps[block.first_step..];
        scratch[..block.steps].fill(NO_STEP);
        block.steps = 0;
        for (lane, ends) in self.chain_starts[at].windows(2).enumerate() {
            let (mut count, mut end) = (0, NO_PARTICLE);
            for chain_link in &self.links_of_chains[ends[0] as usize..ends[1] as usize] {
                let (from, to) = slots(links, *chain_link);
                let rest = links.rest[chain_link.0 as usize];
                if from != NO_PARTICLE {
                    if from != end {
                        (scratch[count].to[lane], scratch[count].rest[lane]) = (from, -rest);
                        count += 1;
                    }
                    (scratch[count].to[lane], scratch[count].rest[lane]) = (to, rest);
                    scratch[count].links[lane] = chain_link.0;
                    count += 1;
                }
                end = to;
            }
            block.steps = block.steps.max(count);
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of::<ChainStep>() * self.steps.len()
            + size_of::<ChainLink>() * self.links_of_chains.len()
            + size_of::<[u32; LANES + 1]>() * self.chain_starts.len()
            + size_of::<u32>() * self.block_of.len()
    }
}

impl StridedBlock {
    /// What the steps of a block are, if that is a strip. Those too short to be turned in fours are none.
    fn of(steps: &[ChainStep]) -> Option<Self> {
        let first = steps.first()?.to;
        // Where the first line has no link left, no strip begins.
        let before_first = first[0].checked_sub(1)?;
        let lines = first.iter().take_while(|to| **to != NO_PARTICLE).count();
        let across = if lines > 1 { first[1].checked_sub(first[0])? } else { 1 };
        let along = steps.get(3)?.to[0].checked_sub(first[0])? / 3;
        let lies = |(at, step): (usize, &ChainStep)| {
            let slot = |lane: usize| first[0] + at as u32 * along + lane as u32 * across;
            let to = |lane: usize| if lane < lines { slot(lane) } else { NO_PARTICLE };
            (0..LANES).all(|lane| {
                step.to[lane] == to(lane) && (step.rest[lane] > 0.0) == (lane < lines && at > 0)
            })
        };
        let is_strip = (along == 1 || across == 1) && steps.iter().enumerate().all(lies);
        is_strip.then_some(Self {
            first: before_first as usize,
            link_stride: along as usize,
            chain_stride: across as usize,
            chain_count: lines,
        })
    }
}

/// The seats that a link runs from and to; `NO_PARTICLE` if it does not hold.
fn slots(links: &Links, (link, is_turned): ChainLink) -> (u32, u32) {
    let link = link as usize;
    match (links.active[link], is_turned) {
        (false, _) => (NO_PARTICLE, NO_PARTICLE),
        (true, false) => (links.a[link] + 1, links.b[link] + 1),
        (true, true) => (links.b[link] + 1, links.a[link] + 1),
    }
}
