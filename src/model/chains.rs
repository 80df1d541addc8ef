//! Chains: straight runs of stretch links, each solved as a whole (tridiagonal) by the line solver.
//!
//! ```text
//! grid:  rows and columns          mesh:  at each vertex, the straightest pairs of links continue
//! ●──●──●──●                       each other, if they turn by less than 37° (cosine 0.8)
//! ```
//! Chains are packed into blocks of up to eight that share no particle, one per SIMD lane, the
//! longest first.
//!
//! Reads `Links` and rest positions; writes `Chains`.
//!
//! Invariants: every stretch link is in exactly one chain; a chain visits no vertex twice; chains
//! of one block share no particle.

use crate::math::heap_bytes::heap_bytes;
use crate::math::simd::LANES;
use crate::math::sort::{sort, sort_by};
use crate::mesh::NONE;
use crate::model::chain_blocks::{ChainBlocks, ChainLink};
use crate::model::links::{LinkKind, Links};
use core::mem::take;
use glam::Vec3;

/// Minimum cosine of the turn between two links that continue each other.
const MIN_STRAIGHTNESS: f32 = 0.8;

/// Number of unfinished blocks that are searched for a free lane.
const OPEN_BLOCKS: usize = 16;

/// Links of a chain, in order.
type Chain = Vec<ChainLink>;

/// All chains of a cloth.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chains {
    /// The chains, eight side by side.
    pub blocks: ChainBlocks,
    /// Number of links of the longest chain at creation.
    pub longest: usize,
}

heap_bytes!(Chains { blocks } plain { longest });

impl Chains {
    /// Divides the stretch links into chains. `rest` is the rest position of each vertex [m];
    /// `can_break` allocates for chains that tear apart.
    pub fn new(links: &Links, rest: &[Vec3], can_break: bool) -> Self {
        let next = continuations(links, rest);
        let mut chains = Vec::new();
        let mut is_used = vec![false; links.len()];
        let mut visited = vec![NONE; rest.len()];
        for link in stretch_links(links) {
            if !is_used[link as usize] {
                let start = find_chain_start(
                    links,
                    &next,
                    link,
                    &is_used,
                    chains.len() as u32,
                    &mut visited,
                );
                chains.push(collect_chain(
                    links,
                    &next,
                    start,
                    &mut is_used,
                    chains.len() as u32,
                    &mut visited,
                ));
            }
            // The walk back may have entered a loop that does not contain this link; it becomes a
            // chain of its own.
            if !is_used[link as usize] {
                is_used[link as usize] = true;
                chains.push(vec![(link, false)]);
            }
        }
        // Longest first, equal lengths in the order in which they were found.
        let mut order: Vec<[u32; 2]> =
            chains.iter().zip(0..).map(|(chain, at)| [!(chain.len() as u32), at]).collect();
        sort(&mut order);
        let chains: Vec<Chain> =
            order.iter().map(|[_, at]| take(&mut chains[*at as usize])).collect();
        let blocks = pack_into_blocks(links, &chains, rest.len());
        Self {
            blocks: ChainBlocks::new(links, &blocks, can_break),
            longest: chains.first().map_or(0, Vec::len),
        }
    }
}

fn stretch_links(links: &Links) -> impl Iterator<Item = u32> + '_ {
    (0..links.len()).filter(|link| links.kind(*link) == LinkKind::Stretch).map(|link| link as u32)
}

/// For each link the links that continue it beyond its first and beyond its second particle.
fn continuations(links: &Links, rest: &[Vec3]) -> Vec<[u32; 2]> {
    let mut links_at_vertex: Vec<Vec<(u32, Vec3)>> = vec![Vec::new(); rest.len()];
    for link in stretch_links(links) {
        let (a, b) = (links.a[link as usize], links.b[link as usize]);
        let direction = (rest[b as usize] - rest[a as usize]).normalize_or_zero();
        links_at_vertex[a as usize].push((link, direction));
        links_at_vertex[b as usize].push((link, -direction));
    }
    let mut next = vec![[NONE; 2]; links.len()];
    for (vertex, links_here) in links_at_vertex.iter().enumerate() {
        let mut pairs = Vec::new();
        for (at, (p, along)) in links_here.iter().enumerate() {
            for (q, back) in &links_here[at + 1..] {
                let straight = -along.dot(*back);
                if straight > MIN_STRAIGHTNESS {
                    pairs.push((straight, *p, *q));
                }
            }
        }
        sort_by(&mut pairs, |p, q| q.0.total_cmp(&p.0).then(p.1.cmp(&q.1)).then(p.2.cmp(&q.2)));
        for (_, p, q) in pairs {
            let end = |link: u32| usize::from(links.b[link as usize] == vertex as u32);
            if next[p as usize][end(p)] == NONE && next[q as usize][end(q)] == NONE {
                next[p as usize][end(p)] = q;
                next[q as usize][end(q)] = p;
            }
        }
    }
    next
}

/// The vertex at which a walk leaves a link.
fn far_end(links: &Links, (link, is_reversed): (u32, bool)) -> u32 {
    if is_reversed { links.a[link as usize] } else { links.b[link as usize] }
}

/// The next link of a walk, if it exists, is unused and leads to a vertex that this walk has not
/// visited.
fn next_link(
    links: &Links,
    next: &[[u32; 2]],
    from: (u32, bool),
    is_used: &[bool],
    (number, visited): (u32, &[u32]),
) -> Option<(u32, bool)> {
    let end = far_end(links, from);
    let link = next[from.0 as usize][usize::from(!from.1)];
    if link == NONE || is_used[link as usize] {
        return None;
    }
    let to = (link, links.b[link as usize] == end);
    (visited[far_end(links, to) as usize] != number).then_some(to)
}

/// Walks back from `link` to the start of its chain. Returns the first link and its direction.
fn find_chain_start(
    links: &Links,
    next: &[[u32; 2]],
    link: u32,
    is_used: &[bool],
    number: u32,
    visited: &mut [u32],
) -> (u32, bool) {
    let mut at = (link, true);
    // The marks differ from those of the walk forward along the same links.
    let number = number | 1 << 31;
    visited[links.b[link as usize] as usize] = number;
    visited[links.a[link as usize] as usize] = number;
    while let Some(to) = next_link(links, next, at, is_used, (number, visited)) {
        visited[far_end(links, to) as usize] = number;
        at = to;
    }
    (at.0, !at.1)
}

/// Walks from `start` to the end of the chain, and marks its links as seen.
fn collect_chain(
    links: &Links,
    next: &[[u32; 2]],
    start: (u32, bool),
    is_used: &mut [bool],
    number: u32,
    visited: &mut [u32],
) -> Chain {
    let mut chain = vec![start];
    is_used[start.0 as usize] = true;
    visited[links.a[start.0 as usize] as usize] = number;
    visited[links.b[start.0 as usize] as usize] = number;
    let mut at = start;
    while let Some(to) = next_link(links, next, at, is_used, (number, visited)) {
        is_used[to.0 as usize] = true;
        visited[far_end(links, to) as usize] = number;
        chain.push(to);
        at = to;
    }
    chain
}

/// Packs chains into blocks of lanes, so that chains of one block share no vertex.
fn pack_into_blocks<'a>(
    links: &Links,
    chains: &'a [Chain],
    vertex_count: usize,
) -> Vec<Vec<&'a [ChainLink]>> {
    let mut blocks: Vec<Vec<&[ChainLink]>> = Vec::new();
    // Blocks that contain each vertex.
    let mut blocks_of_vertex: Vec<Vec<u32>> = vec![Vec::new(); vertex_count];
    for chain in chains {
        let ends = |link: u32| [links.a[link as usize], links.b[link as usize]];
        let vertices: Vec<u32> = chain.iter().flat_map(|(link, _)| ends(*link)).collect();
        let oldest = blocks.len().saturating_sub(OPEN_BLOCKS);
        let fits = |block: &usize| {
            let is_absent = |v: &u32| !blocks_of_vertex[*v as usize].contains(&(*block as u32));
            blocks[*block].len() < LANES && vertices.iter().all(is_absent)
        };
        let block = (oldest..blocks.len()).find(fits).unwrap_or(blocks.len());
        if block == blocks.len() {
            blocks.push(Vec::new());
        }
        blocks[block].push(chain);
        vertices.iter().for_each(|v| blocks_of_vertex[*v as usize].push(block as u32));
    }
    blocks
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::Mesh;
    use crate::mesh::grid;
    use crate::mesh::grid::GridFrame;
    use crate::model::chain_blocks::{NO_PARTICLE, StridedBlock};
    use crate::model::constraints::Constraints;

    fn sheet(columns: u32, rows: u32) -> (Mesh, Vec<Vec3>) {
        let frame =
            GridFrame { origin: Vec3::ZERO, right: Vec3::X, down: Vec3::NEG_Y, spacing: 0.1 };
        let rest = grid::positions(columns, rows, &frame);
        (Mesh::new(grid::triangles(columns, rows), rest.len(), rest.len()), rest)
    }

    /// Asserts that every active stretch link is in one chain, chains are connected, and chains of
    /// a block share no particle.
    fn assert_sound(chains: &Chains, links: &Links) {
        let mut uses = vec![0; links.len()];
        for steps in chains.blocks.blocks() {
            let mut lane_of = std::collections::HashMap::new();
            let mut end = [NO_PARTICLE; LANES];
            for step in steps {
                for lane in 0..LANES {
                    let (link, to) = (step.links[lane], step.to[lane]);
                    assert_eq!(link == NONE, step.rest[lane] <= 0.0);
                    if link != NONE {
                        uses[link as usize] += 1;
                        let slots = [links.a[link as usize] + 1, links.b[link as usize] + 1];
                        let ends = [end[lane], to];
                        assert!(
                            slots == ends || slots == [to, end[lane]],
                            "the links of a chain are connected"
                        );
                    }
                    assert!(
                        to == NO_PARTICLE || lane_of.insert(to, lane).is_none(),
                        "each particle is in one lane"
                    );
                    end[lane] = to;
                }
            }
        }
        for (link, uses) in uses.iter().enumerate() {
            let is_active = links.kind(link) == LinkKind::Stretch && links.active[link];
            assert_eq!(*uses, u32::from(is_active), "link {link}");
        }
    }

    #[test]
    fn chains_of_a_grid_are_its_rows_and_columns() {
        let (mesh, rest) = sheet(11, 19);
        let constraints = Constraints::from_grid(11, 19, 0.1, &mesh, 0);
        let chains = Chains::new(&constraints.links, &rest, false);
        assert_sound(&chains, &constraints.links);
        // Eleven columns of eighteen links in two blocks, nineteen rows of ten in three.
        let lengths: Vec<usize> = chains.blocks.blocks().map(<[_]>::len).collect();
        assert_eq!(lengths, [19, 19, 11, 11, 11]);
    }

    #[test]
    fn chains_of_a_grid_are_strided_until_one_breaks() {
        let (mesh, rest) = sheet(11, 19);
        let mut constraints = Constraints::from_grid(11, 19, 0.1, &mesh, 0);
        let mut chains = Chains::new(&constraints.links, &rest, true);
        let strided = |first, link_stride, chain_stride, chain_count| StridedBlock {
            first,
            link_stride,
            chain_stride,
            chain_count,
        };
        let columns = [strided(0, 11, 1, 8), strided(8, 11, 1, 3)];
        let rows = [strided(0, 1, 11, 8), strided(88, 1, 11, 8), strided(176, 1, 11, 3)];
        assert!(chains.blocks.are_all_strided());
        let strided_blocks: Vec<StridedBlock> =
            chains.blocks.strided_blocks().map(|(strided, _)| strided).collect();
        assert_eq!(strided_blocks, [&columns[..], &rows[..]].concat());
        constraints.links.active[17] = false;
        chains.blocks.mark_stale(17);
        chains.blocks.rebuild_stale(&constraints.links);
        assert!(!chains.blocks.are_all_strided());
        assert_eq!(chains.blocks.strided_blocks().count(), 4);
    }

    #[test]
    fn segments_of_broken_chains_stay_in_their_lane() {
        let (mesh, rest) = sheet(17, 9);
        let mut constraints = Constraints::from_grid(17, 9, 0.1, &mesh, 0);
        let mut chains = Chains::new(&constraints.links, &rest, true);
        let count = |chains: &Chains| chains.blocks.blocks().map(<[_]>::len).sum::<usize>();
        let whole = count(&chains);
        // First every fifth link is removed, then all but every seventh.
        for next_link in [5, 7] {
            for link in 0..constraints.links.len() {
                constraints.links.active[link] = (link % next_link == 0) == (next_link == 7);
                chains.blocks.mark_stale(link);
            }
            chains.blocks.rebuild_stale(&constraints.links);
            assert_sound(&chains, &constraints.links);
            assert_ne!(count(&chains), whole);
        }
        constraints.links.active.fill(true);
        (0..constraints.links.len()).for_each(|link| chains.blocks.mark_stale(link));
        chains.blocks.rebuild_stale(&constraints.links);
        assert_sound(&chains, &constraints.links);
        assert_eq!(count(&chains), whole);
    }

    #[test]
    fn chains_of_a_mesh_run_straight() {
        let (mesh, mut rest) = sheet(9, 9);
        for (i, x) in rest.iter_mut().enumerate() {
            x.z = (i as f32 * 1.3).sin() * 0.03;
        }
        let constraints = Constraints::from_mesh(&mesh, &rest, 0);
        let chains = Chains::new(&constraints.links, &rest, false);
        assert_sound(&chains, &constraints.links);
        assert_eq!(chains.longest, 8, "from border to border");
    }
}
