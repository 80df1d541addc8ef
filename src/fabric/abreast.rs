//! Lines side by side, eight at a time, as they are solved.
//!
//! Where links broke, a line is pieces. Those of a block are laid side by side anew then, the longest
//! first, so that all eight of a group begin together. No two pieces of a block share a particle: in
//! whatever order they go, the bits are the same.

use crate::fabric::links::Links;
use crate::math::simd::{LANES, Lanes};
use crate::mesh::NONE;
use core::cmp::Reverse;
use core::ops::Range;

/// The seat that lanes without a link look at. Every particle has the seat after its own number.
pub(crate) const NOBODY: u32 = 0;

/// A link of a line: its number, and whether the line runs from its second particle.
pub(crate) type Member = (u32, bool);

/// The next link of each of eight pieces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Step {
    /// Its number; `NONE` after a piece's end.
    pub links: [u32; LANES],
    /// The seat that it runs to; `NOBODY` after a piece's end.
    pub to: [u32; LANES],
    /// Its length at rest [m]; 0 after a piece's end.
    pub rest: Lanes,
}

const NO_STEP: Step = Step { links: [NONE; LANES], to: [NOBODY; LANES], rest: [0.0; LANES] };

/// Eight pieces side by side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Group {
    /// The seats that they begin at; `NOBODY` for lanes without a piece.
    pub from: [u32; LANES],
    first: u32,
    count: u32,
}

const NO_GROUP: Group = Group { from: [NOBODY; LANES], first: 0, count: 0 };

/// Up to eight lines that share no particle.
#[derive(Clone, Debug)]
struct Block {
    /// Which of the members are its lines', …
    lines: Range<usize>,
    /// … and its room for steps and for groups.
    first_step: usize,
    first_group: usize,
    groups: usize,
    is_stale: bool,
}

/// Links in a row that hold: the first one's place among the members, and how many there are.
#[derive(Clone, Copy, Debug)]
struct Piece {
    first: u32,
    count: u32,
}

/// Lines in blocks, laid side by side.
#[derive(Clone, Debug, Default)]
pub(crate) struct Abreast {
    steps: Vec<Step>,
    groups: Vec<Group>,
    blocks: Vec<Block>,
    /// The links of all lines as they were woven, line after line, block after block.
    members: Vec<Member>,
    /// Whether a line begins with each of them.
    begins: Vec<bool>,
    /// The block of each link; `NONE` for those in no line.
    block_of: Vec<u32>,
    /// Whether any block is stale.
    is_stale: bool,
    pieces: Vec<Piece>,
}

impl Abreast {
    /// Lays lines by blocks. `links` are all there are; `breaks` says to have room for lines to break.
    pub fn new(links: &Links, blocks: &[Vec<&[Member]>], breaks: bool) -> Self {
        let mut laid = Self { block_of: vec![NONE; links.len()], ..Self::default() };
        let (mut steps, mut groups) = (0, 0);
        for (at, lines) in blocks.iter().enumerate() {
            let first = laid.members.len();
            for member in lines.iter().flat_map(|line| line.iter()) {
                laid.block_of[member.0 as usize] = at as u32;
            }
            for line in lines {
                laid.begins.extend((0..line.len()).map(|number| number == 0));
                laid.members.extend_from_slice(line);
            }
            let count = laid.members.len() - first;
            laid.blocks.push(Block {
                lines: first..laid.members.len(),
                first_step: steps,
                first_group: groups,
                groups: 0,
                is_stale: true,
            });
            // The longest of a group are as long as all of the group before at most.
            let longest = lines.iter().map(|line| line.len()).max().unwrap_or(0);
            steps += if breaks { longest + count.div_ceil(LANES) } else { longest };
            groups += if breaks { count.div_ceil(LANES) } else { 1 };
        }
        laid.steps = vec![NO_STEP; steps];
        laid.groups = vec![NO_GROUP; groups];
        laid.reserve();
        laid.is_stale = true;
        laid.lay(links);
        laid
    }

    /// Makes room for the pieces of any block, which a copy has not.
    pub fn reserve(&mut self) {
        let most = self.blocks.iter().map(|block| block.lines.len()).max().unwrap_or(0);
        self.pieces.reserve_exact(most.saturating_sub(self.pieces.len()));
    }

    /// All groups, in the order that they are to be solved in.
    pub fn groups(&self) -> impl Iterator<Item = (&Group, &[Step])> {
        let of_block = |block: &Block| block.first_group..block.first_group + block.groups;
        let groups = self.blocks.iter().flat_map(move |block| &self.groups[of_block(block)]);
        groups.map(|group| (group, &self.steps[group.first as usize..][..group.count as usize]))
    }

    /// Takes note that a link changed.
    pub fn forget(&mut self, link: usize) {
        if let Some(block) = self.blocks.get_mut(self.block_of[link] as usize) {
            block.is_stale = true;
            self.is_stale = true;
        }
    }

    /// Lays anew what changed.
    pub fn lay(&mut self, links: &Links) {
        if core::mem::take(&mut self.is_stale) {
            for at in 0..self.blocks.len() {
                if core::mem::take(&mut self.blocks[at].is_stale) {
                    self.lay_block(links, at);
                }
            }
        }
    }

    fn lay_block(&mut self, links: &Links, at: usize) {
        self.find_pieces(links, at);
        let block = &mut self.blocks[at];
        let mut first = block.first_step;
        block.groups = self.pieces.len().div_ceil(LANES);
        let groups = &mut self.groups[block.first_group..];
        for (group, eight) in groups.iter_mut().zip(self.pieces.chunks(LANES)) {
            let count = eight[0].count as usize;
            let steps = &mut self.steps[first..first + count];
            steps.fill(NO_STEP);
            *group = Group { first: first as u32, count: count as u32, ..NO_GROUP };
            for (lane, piece) in eight.iter().enumerate() {
                let members = &self.members[piece.first as usize..][..piece.count as usize];
                group.from[lane] = seats(links, members[0]).0;
                for (step, member) in steps.iter_mut().zip(members) {
                    step.links[lane] = member.0;
                    step.to[lane] = seats(links, *member).1;
                    step.rest[lane] = links.rest[member.0 as usize];
                }
            }
            first += count;
        }
    }

    /// The pieces of a block, the longest first.
    fn find_pieces(&mut self, links: &Links, block: usize) {
        self.pieces.clear();
        let mut end = NOBODY;
        for at in self.blocks[block].lines.clone() {
            let (from, to) = seats(links, self.members[at]);
            if from != NOBODY {
                match self.pieces.last_mut().filter(|_| from == end && !self.begins[at]) {
                    Some(piece) => piece.count += 1,
                    None => self.pieces.push(Piece { first: at as u32, count: 1 }),
                }
            }
            end = to;
        }
        self.pieces.sort_unstable_by_key(|piece| (Reverse(piece.count), piece.first));
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of::<Step>() * self.steps.len()
            + size_of::<Group>() * self.groups.len()
            + (size_of::<Member>() + size_of::<bool>()) * self.members.len()
            + size_of::<u32>() * self.block_of.len()
            + size_of::<Piece>() * self.pieces.capacity()
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
