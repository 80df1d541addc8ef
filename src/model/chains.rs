//! Chains: stretch links end to end, as straight as the mesh has them, to be solved as wholes.
//!
//! On a grid they are its rows and columns. On any mesh links continue each other where they meet most
//! nearly straight. Every stretch link is in one line.

use crate::math::simd::LANES;
use crate::math::sort::{sort, sort_by};
use crate::mesh::NONE;
use crate::model::chain_blocks::{ChainBlocks, ChainLink};
use crate::model::links::{LinkKind, Links};
use core::mem::take;
use glam::Vec3;

/// Links continue each other up to a turn of which this is the cosine.
const MIN_STRAIGHTNESS: f32 = 0.8;

/// So many unfinished blocks are looked at for room.
const OPEN_BLOCKS: usize = 16;

type Chain = Vec<ChainLink>;

/// All lines of a weave.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chains {
    /// Eight that share no particle side by side in a block.
    pub blocks: ChainBlocks,
    /// Links of the longest one as it was woven.
    pub longest: usize,
}

impl Chains {
    /// Finds the lines of a weave as it is woven. `rest` is the rest position of each vertex; `can_break`
    /// says to have room for lines to break.
    pub fn new(links: &Links, rest: &[Vec3], can_break: bool) -> Self {
        let next = continuations(links, rest);
        let mut lines = Vec::new();
        let mut seen = vec![false; links.len()];
        let mut visited = vec![NONE; rest.len()];
        for link in stretch_links(links) {
            if !seen[link as usize] {
                let start =
                    find_chain_start(links, &next, link, &seen, lines.len() as u32, &mut visited);
                lines.push(collect_chain(
                    links,
                    &next,
                    start,
                    &mut seen,
                    lines.len() as u32,
                    &mut visited,
                ));
            }
            // A line that ran into itself from behind did not come by.
            if !seen[link as usize] {
                seen[link as usize] = true;
                lines.push(vec![(link, false)]);
            }
        }
        // Those of a length go together, the longest first, in the order in which they were found.
        let mut order: Vec<[u32; 2]> =
            lines.iter().zip(0..).map(|(line, at)| [!(line.len() as u32), at]).collect();
        sort(&mut order);
        let lines: Vec<Chain> =
            order.iter().map(|[_, at]| take(&mut lines[*at as usize])).collect();
        let blocks = pack_into_blocks(links, &lines, rest.len());
        Self {
            blocks: ChainBlocks::new(links, &blocks, can_break),
            longest: lines.first().map_or(0, Vec::len),
        }
    }
}

fn stretch_links(links: &Links) -> impl Iterator<Item = u32> + '_ {
    (0..links.len()).filter(|link| links.kind(*link) == LinkKind::Stretch).map(|link| link as u32)
}

/// For each link the one that continues it beyond its first and beyond its second particle.
fn continuations(links: &Links, rest: &[Vec3]) -> Vec<[u32; 2]> {
    let mut at_vertex: Vec<Vec<(u32, Vec3)>> = vec![Vec::new(); rest.len()];
    for link in stretch_links(links) {
        let (a, b) = (links.a[link as usize], links.b[link as usize]);
        let way = (rest[b as usize] - rest[a as usize]).normalize_or_zero();
        at_vertex[a as usize].push((link, way));
        at_vertex[b as usize].push((link, -way));
    }
    let mut next = vec![[NONE; 2]; links.len()];
    for (vertex, around) in at_vertex.iter().enumerate() {
        let mut pairs = Vec::new();
        for (at, (p, along)) in around.iter().enumerate() {
            for (q, back) in &around[at + 1..] {
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

/// The vertex where the walk goes on after a link.
fn far_end(links: &Links, (link, turned): (u32, bool)) -> u32 {
    if turned { links.a[link as usize] } else { links.b[link as usize] }
}

/// The next link of a walk, if it leads to a new vertex.
fn next_link(
    links: &Links,
    next: &[[u32; 2]],
    from: (u32, bool),
    seen: &[bool],
    (number, visited): (u32, &[u32]),
) -> Option<(u32, bool)> {
    let end = far_end(links, from);
    let link = next[from.0 as usize][usize::from(!from.1)];
    if link == NONE || seen[link as usize] {
        return None;
    }
    let to = (link, links.b[link as usize] == end);
    (visited[far_end(links, to) as usize] != number).then_some(to)
}

/// The link where a line begins that has `link` in it, in the direction it runs.
fn find_chain_start(
    links: &Links,
    next: &[[u32; 2]],
    link: u32,
    seen: &[bool],
    number: u32,
    visited: &mut [u32],
) -> (u32, bool) {
    let mut at = (link, true);
    // Marks of this walk differ from those of the walk back along it.
    let number = number | 1 << 31;
    visited[links.b[link as usize] as usize] = number;
    visited[links.a[link as usize] as usize] = number;
    while let Some(to) = next_link(links, next, at, seen, (number, visited)) {
        visited[far_end(links, to) as usize] = number;
        at = to;
    }
    (at.0, !at.1)
}

fn collect_chain(
    links: &Links,
    next: &[[u32; 2]],
    start: (u32, bool),
    seen: &mut [bool],
    number: u32,
    visited: &mut [u32],
) -> Chain {
    let mut line = vec![start];
    seen[start.0 as usize] = true;
    visited[links.a[start.0 as usize] as usize] = number;
    visited[links.b[start.0 as usize] as usize] = number;
    let mut at = start;
    while let Some(to) = next_link(links, next, at, seen, (number, visited)) {
        seen[to.0 as usize] = true;
        visited[far_end(links, to) as usize] = number;
        line.push(to);
        at = to;
    }
    line
}

/// Puts lines side by side, so that those in a block share no vertex.
fn pack_into_blocks<'a>(
    links: &Links,
    lines: &'a [Chain],
    vertex_count: usize,
) -> Vec<Vec<&'a [ChainLink]>> {
    let mut blocks: Vec<Vec<&[ChainLink]>> = Vec::new();
    // The blocks that each vertex is in.
    let mut member: Vec<Vec<u32>> = vec![Vec::new(); vertex_count];
    for line in lines {
        let ends = |link: u32| [links.a[link as usize], links.b[link as usize]];
        let vertices: Vec<u32> = line.iter().flat_map(|(link, _)| ends(*link)).collect();
        let oldest = blocks.len().saturating_sub(OPEN_BLOCKS);
        let fits = |block: &usize| {
            let is_out = |v: &u32| !member[*v as usize].contains(&(*block as u32));
            blocks[*block].len() < LANES && vertices.iter().all(is_out)
        };
        let block = (oldest..blocks.len()).find(fits).unwrap_or(blocks.len());
        if block == blocks.len() {
            blocks.push(Vec::new());
        }
        blocks[block].push(line);
        vertices.iter().for_each(|v| member[*v as usize].push(block as u32));
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

    /// Every stretch link is in one line, lines in a block share no particle, and lines are chains.
    fn assert_sound(lines: &Chains, links: &Links) {
        let mut uses = vec![0; links.len()];
        for steps in lines.blocks.blocks() {
            let mut lane_of = std::collections::HashMap::new();
            let mut end = [NO_PARTICLE; LANES];
            for next_link in steps {
                for lane in 0..LANES {
                    let (link, to) = (next_link.links[lane], next_link.to[lane]);
                    assert_eq!(link == NONE, next_link.rest[lane] <= 0.0);
                    if link != NONE {
                        uses[link as usize] += 1;
                        let seats = [links.a[link as usize] + 1, links.b[link as usize] + 1];
                        let ends = [end[lane], to];
                        assert!(seats == ends || seats == [to, end[lane]], "a line is a chain");
                    }
                    assert!(
                        to == NO_PARTICLE || lane_of.insert(to, lane).is_none(),
                        "one place each"
                    );
                    end[lane] = to;
                }
            }
        }
        for (link, uses) in uses.iter().enumerate() {
            let holds = links.kind(link) == LinkKind::Stretch && links.active[link];
            assert_eq!(*uses, u32::from(holds), "link {link}");
        }
    }

    #[test]
    fn lines_of_a_grid_are_its_rows_and_columns() {
        let (mesh, rest) = sheet(11, 19);
        let constraints = Constraints::from_grid(11, 19, 0.1, &mesh, 0);
        let lines = Chains::new(&constraints.links, &rest, false);
        assert_sound(&lines, &constraints.links);
        // Eleven columns of eighteen links in two blocks, nineteen rows of ten in three.
        let lengths: Vec<usize> = lines.blocks.blocks().map(<[_]>::len).collect();
        assert_eq!(lengths, [19, 19, 11, 11, 11]);
    }

    #[test]
    fn lines_of_a_grid_are_all_strided_until_one_breaks() {
        let (mesh, rest) = sheet(11, 19);
        let mut constraints = Constraints::from_grid(11, 19, 0.1, &mesh, 0);
        let mut lines = Chains::new(&constraints.links, &rest, true);
        let strided = |first, link_stride, chain_stride, chain_count| StridedBlock {
            first,
            link_stride,
            chain_stride,
            chain_count,
        };
        let columns = [strided(0, 11, 1, 8), strided(8, 11, 1, 3)];
        let rows = [strided(0, 1, 11, 8), strided(88, 1, 11, 8), strided(176, 1, 11, 3)];
        assert!(lines.blocks.are_all_strided());
        let strips: Vec<StridedBlock> =
            lines.blocks.strided_blocks().map(|(strip, _)| strip).collect();
        assert_eq!(strips, [&columns[..], &rows[..]].concat());
        constraints.links.active[17] = false;
        lines.blocks.mark_stale(17);
        lines.blocks.rebuild_stale(&constraints.links);
        assert!(!lines.blocks.are_all_strided());
        assert_eq!(lines.blocks.strided_blocks().count(), 4);
    }

    #[test]
    fn pieces_of_broken_lines_follow_each_other() {
        let (mesh, rest) = sheet(17, 9);
        let mut constraints = Constraints::from_grid(17, 9, 0.1, &mesh, 0);
        let mut lines = Chains::new(&constraints.links, &rest, true);
        let count = |lines: &Chains| lines.blocks.blocks().map(<[_]>::len).sum::<usize>();
        let whole = count(&lines);
        // Every fifth link goes, and then all of them but every seventh.
        for next_link in [5, 7] {
            for link in 0..constraints.links.len() {
                constraints.links.active[link] = (link % next_link == 0) == (next_link == 7);
                lines.blocks.mark_stale(link);
            }
            lines.blocks.rebuild_stale(&constraints.links);
            assert_sound(&lines, &constraints.links);
            assert_ne!(count(&lines), whole);
        }
        constraints.links.active.fill(true);
        (0..constraints.links.len()).for_each(|link| lines.blocks.mark_stale(link));
        lines.blocks.rebuild_stale(&constraints.links);
        assert_sound(&lines, &constraints.links);
        assert_eq!(count(&lines), whole);
    }

    #[test]
    fn lines_of_a_mesh_run_straight_on() {
        let (mesh, mut rest) = sheet(9, 9);
        for (i, x) in rest.iter_mut().enumerate() {
            x.z = (i as f32 * 1.3).sin() * 0.03;
        }
        let constraints = Constraints::from_mesh(&mesh, &rest, 0);
        let lines = Chains::new(&constraints.links, &rest, false);
        assert_sound(&lines, &constraints.links);
        assert_eq!(lines.longest, 8, "from border to border");
    }
}
