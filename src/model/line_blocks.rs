//! Lines side by side, eight at a time, as they are solved.
//!
//! Where links broke, a line is pieces, one after the other in the lane that is the line's: what lies next
//! to each other in the cloth stays so here, whatever is torn.

use crate::math::simd::{LANES, LaneArray};
use crate::mesh::NONE;
use crate::model::links::Links;

/// The seat that lanes without a link look at. Every particle has the seat after its own number.
pub(crate) const NOBODY: u32 = 0;

/// A link of a line: its number, and whether the line runs from its second particle.
pub(crate) type Member = (u32, bool);

/// The next link of each lane, or the particle that its next piece begins with.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    /// The link's number; `NONE` where a piece begins, and behind the last.
    pub links: [u32; LANES],
    /// The seat of the particle that it runs to; `NOBODY` behind the last piece.
    pub to: [u32; LANES],
    /// Its length at rest [m]. Where a piece begins it is that of the first link, negative; behind the last
    /// it is 0.
    pub rest: LaneArray,
}

const NO_STEP: Step = Step { links: [NONE; LANES], to: [NOBODY; LANES], rest: [0.0; LANES] };

/// Lines whose particles lie evenly: by so many apart along a line, and from one line to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Strip {
    /// The first particle of the first line.
    pub first: usize,
    pub along: usize,
    pub across: usize,
    /// How many lines.
    pub lines: usize,
}

/// Up to eight lines that share no particle.
#[derive(Clone, Debug)]
struct Block {
    /// Where its room for steps begins, and how many there are.
    first_step: usize,
    steps: usize,
    is_stale: bool,
    /// If all its lines are whole, as long as each other, and lie as those of a grid do.
    strip: Option<Strip>,
}

/// Lines in blocks, laid side by side.
#[derive(Clone, Debug, Default)]
pub(crate) struct LineBlocks {
    steps: Vec<Step>,
    blocks: Vec<Block>,
    /// The links of all lines as they were woven, line after line, block after block.
    members: Vec<Member>,
    /// Where the lines of each block begin among the members, and where the last one ends.
    starts: Vec<[u32; LANES + 1]>,
    /// The block of each link; `NONE` for those in no line.
    block_of: Vec<u32>,
    /// Whether any block is stale.
    is_stale: bool,
    /// Whether all blocks are strips.
    are_strips: bool,
}

impl LineBlocks {
    /// Lays lines by blocks. `links` are all there are; `breaks` says to have room for lines to break.
    pub fn new(links: &Links, blocks: &[Vec<&[Member]>], breaks: bool) -> Self {
        let mut laid = Self { block_of: vec![NONE; links.len()], ..Self::default() };
        let mut steps = 0;
        for (at, lines) in blocks.iter().enumerate() {
            let mut starts = [laid.members.len() as u32; LANES + 1];
            for (lane, line) in lines.iter().enumerate() {
                line.iter().for_each(|(link, _)| laid.block_of[*link as usize] = at as u32);
                laid.members.extend_from_slice(line);
                starts[lane + 1..].fill(laid.members.len() as u32);
            }
            laid.starts.push(starts);
            laid.blocks.push(Block { first_step: steps, steps: 0, is_stale: true, strip: None });
            // Each piece has a beginning, and a link at least.
            let longest = lines.iter().map(|line| line.len()).max().unwrap_or(0);
            steps += if breaks { 2 * longest } else { longest + 1 };
        }
        laid.steps = vec![NO_STEP; steps];
        laid.is_stale = true;
        laid.lay(links);
        laid
    }

    /// The steps of each block, in the order that these are to be solved in.
    pub fn blocks(&self) -> impl Iterator<Item = &[Step]> {
        self.blocks.iter().map(|block| &self.steps[block.first_step..][..block.steps])
    }

    /// Whether all blocks are strips.
    pub fn are_strips(&self) -> bool {
        self.are_strips
    }

    /// The blocks that are strips, as these.
    pub fn strips(&self) -> impl Iterator<Item = (Strip, &[Step])> {
        self.blocks
            .iter()
            .zip(self.blocks())
            .filter_map(|(block, steps)| Some((block.strip?, steps)))
    }

    /// How many steps there may be in a block.
    pub fn most_steps(&self) -> usize {
        let ends = self.blocks.iter().skip(1).map(|block| block.first_step);
        let ends = ends.chain([self.steps.len()]);
        self.blocks.iter().zip(ends).map(|(block, end)| end - block.first_step).max().unwrap_or(0)
    }

    /// Takes note that a link changed.
    pub fn forget(&mut self, link: usize) {
        if let Some(block) = self.blocks.get_mut(self.block_of[link] as usize) {
            block.is_stale = true;
            self.is_stale = true;
        }
    }

    /// Takes over lengths at rest that changed.
    pub fn measure(&mut self, links: &Links) {
        self.lay(links);
        for block in &self.blocks {
            let mut next = [0.0; LANES];
            for step in self.steps[block.first_step..][..block.steps].iter_mut().rev() {
                for lane in 0..LANES {
                    let (link, begins) = (step.links[lane], step.to[lane] != NOBODY);
                    if link != NONE {
                        step.rest[lane] = links.rest[link as usize];
                    } else if begins {
                        step.rest[lane] = -next[lane];
                    }
                }
                next = step.rest;
            }
        }
    }

    /// Lays anew what changed.
    pub fn lay(&mut self, links: &Links) {
        if core::mem::take(&mut self.is_stale) {
            for at in 0..self.blocks.len() {
                if core::mem::take(&mut self.blocks[at].is_stale) {
                    self.lay_block(links, at);
                    let block = &mut self.blocks[at];
                    block.strip = Strip::of(&self.steps[block.first_step..][..block.steps]);
                }
            }
            self.are_strips = self.blocks.iter().all(|block| block.strip.is_some());
        }
    }

    fn lay_block(&mut self, links: &Links, at: usize) {
        let block = &mut self.blocks[at];
        let room = &mut self.steps[block.first_step..];
        room[..block.steps].fill(NO_STEP);
        block.steps = 0;
        for (lane, ends) in self.starts[at].windows(2).enumerate() {
            let (mut count, mut end) = (0, NOBODY);
            for member in &self.members[ends[0] as usize..ends[1] as usize] {
                let (from, to) = seats(links, *member);
                let rest = links.rest[member.0 as usize];
                if from != NOBODY {
                    if from != end {
                        (room[count].to[lane], room[count].rest[lane]) = (from, -rest);
                        count += 1;
                    }
                    (room[count].to[lane], room[count].rest[lane]) = (to, rest);
                    room[count].links[lane] = member.0;
                    count += 1;
                }
                end = to;
            }
            block.steps = block.steps.max(count);
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of::<Step>() * self.steps.len()
            + size_of::<Member>() * self.members.len()
            + size_of::<[u32; LANES + 1]>() * self.starts.len()
            + size_of::<u32>() * self.block_of.len()
    }
}

impl Strip {
    /// What the steps of a block are, if that is a strip. Those too short to be turned in fours are none.
    fn of(steps: &[Step]) -> Option<Self> {
        let first = steps.first()?.to;
        // Where the first line has no link left, no strip begins.
        let before_first = first[0].checked_sub(1)?;
        let lines = first.iter().take_while(|to| **to != NOBODY).count();
        let across = if lines > 1 { first[1].checked_sub(first[0])? } else { 1 };
        let along = steps.get(3)?.to[0].checked_sub(first[0])? / 3;
        let lies = |(at, step): (usize, &Step)| {
            let seat = |lane: usize| first[0] + at as u32 * along + lane as u32 * across;
            let to = |lane: usize| if lane < lines { seat(lane) } else { NOBODY };
            (0..LANES).all(|lane| {
                step.to[lane] == to(lane) && (step.rest[lane] > 0.0) == (lane < lines && at > 0)
            })
        };
        let is_strip = (along == 1 || across == 1) && steps.iter().enumerate().all(lies);
        is_strip.then_some(Self {
            first: before_first as usize,
            along: along as usize,
            across: across as usize,
            lines,
        })
    }
}

/// The seats that a link runs from and to; `NOBODY` if it does not hold.
fn seats(links: &Links, (link, is_turned): Member) -> (u32, u32) {
    let link = link as usize;
    match (links.active[link], is_turned) {
        (false, _) => (NOBODY, NOBODY),
        (true, false) => (links.a[link] + 1, links.b[link] + 1),
        (true, true) => (links.b[link] + 1, links.a[link] + 1),
    }
}
