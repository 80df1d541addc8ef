//! Turning: the triangles of a piece come to face one way, that of most of them.
//!
//! A piece that has no two sides, such as a Möbius strip, stays as it is unless turning some triangles
//! leaves fewer edges where neighbours face opposite ways.

use crate::mesh::{Corner, Mesh, NONE, after};

/// How pieces face.
#[derive(Clone, Debug, Default)]
pub(super) struct Facing {
    /// Whether each triangle is to be turned.
    pub turned: Vec<bool>,
    /// How many pieces there are.
    pub pieces: u32,
    /// How many of them have no two sides.
    pub one_sided: u32,
}

/// Finds the triangles of a sound mesh that have to be turned.
pub(super) fn orient(mesh: &Mesh) -> Facing {
    let count = mesh.triangles.len();
    let mut facing = Facing { turned: vec![false; count], ..Facing::default() };
    let mut is_met = vec![false; count];
    let mut piece = Vec::new();
    for seed in 0..count as u32 {
        if is_met[seed as usize] {
            continue;
        }
        is_met[seed as usize] = true;
        piece.clear();
        piece.push(seed);
        // Edges where neighbours face opposite ways: as they are, and as they are turned.
        let (mut opposed, mut left) = (0, 0);
        let mut at = 0;
        while let Some(triangle) = piece.get(at).copied() {
            at += 1;
            for edge in 3 * triangle..3 * triangle + 3 {
                let Some((next, alike)) = neighbour(mesh, edge) else { continue };
                let wanted = facing.turned[triangle as usize] == alike;
                let is_new = !core::mem::replace(&mut is_met[next as usize], true);
                if is_new {
                    facing.turned[next as usize] = wanted;
                    piece.push(next);
                }
                opposed += u32::from(!alike);
                left += u32::from(facing.turned[next as usize] != wanted);
            }
        }
        let turned = |facing: &Facing| {
            piece.iter().filter(|triangle| facing.turned[**triangle as usize]).count()
        };
        facing.pieces += 1;
        if left > 0 {
            facing.one_sided += 1;
            if opposed <= left {
                piece.iter().for_each(|triangle| facing.turned[*triangle as usize] = false);
            }
        }
        if 2 * turned(&facing) > piece.len() {
            for triangle in &piece {
                let turned = &mut facing.turned[*triangle as usize];
                *turned = !*turned;
            }
        }
    }
    facing
}

/// The triangle across an edge, and whether both face the same way.
fn neighbour(mesh: &Mesh, edge: Corner) -> Option<(u32, bool)> {
    let next = mesh.across(edge);
    if next == NONE {
        return None;
    }
    let (from, to) = (mesh.vertex(edge), mesh.vertex(after(edge)));
    // Alike they run along their edge in opposite directions.
    let runs_back = |other: Corner| mesh.vertex(other) == to && mesh.vertex(after(other)) == from;
    Some((next, (3 * next..3 * next + 3).any(runs_back)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facing(triangles: &[[u32; 3]]) -> Facing {
        let count = 1 + triangles.iter().flatten().copied().max().unwrap() as usize;
        orient(&Mesh::new(triangles.to_vec(), count, count))
    }

    #[test]
    fn the_few_turn_to_the_many_in_every_piece() {
        let strip = [[0, 1, 2], [1, 3, 2], [2, 4, 3], [3, 5, 4], [6, 7, 8], [7, 8, 9], [8, 10, 9]];
        let facing = facing(&strip);
        // Of two against two the first triangle decides.
        assert_eq!(facing.turned, [false, false, true, false, true, false, false]);
        assert_eq!((facing.pieces, facing.one_sided), (2, 0));
    }

    /// A strip of `count` quads whose ends meet with a half twist; every triangle as its neighbour before.
    fn moebius(count: u32) -> Vec<[u32; 3]> {
        let vertex = |at: u32, side: u32| {
            if at == count { 1 - side } else { 2 * at + side }
        };
        let quad = |at| {
            let [a, b, c, d] = [vertex(at, 0), vertex(at, 1), vertex(at + 1, 0), vertex(at + 1, 1)];
            [[a, c, b], [b, c, d]]
        };
        (0..count).flat_map(quad).collect()
    }

    #[test]
    fn a_strip_without_two_sides_keeps_one_line_of_odds() {
        let whole = facing(&moebius(8));
        assert_eq!((whole.pieces, whole.one_sided), (1, 1));
        assert!(
            whole.turned.iter().all(|turned| !turned),
            "one edge at odds is as good as it gets"
        );
        let mut spoilt = moebius(8);
        spoilt[5].swap(1, 2);
        spoilt[9].swap(1, 2);
        let facing = facing(&spoilt);
        let turned: Vec<usize> = (0..16).filter(|at| facing.turned[*at]).collect();
        spoilt.iter_mut().enumerate().for_each(|(at, triangle)| {
            if turned.contains(&at) {
                triangle.swap(1, 2);
            }
        });
        let mesh = Mesh::new(spoilt, 16, 16);
        let odds = mesh.edges().filter(|e| neighbour(&mesh, *e).is_some_and(|(_, alike)| !alike));
        assert_eq!(odds.count(), 1);
    }
}
