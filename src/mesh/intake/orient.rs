//! Orientation: gives all triangles of a piece the same winding, that of the majority.
//!
//! Breadth-first search over neighbours. A piece that is not orientable, such as a Möbius strip,
//! keeps its windings unless flipping leaves fewer edges with inconsistent windings.
//!
//! Reads a sound `Mesh`; returns which triangles to flip.

use crate::mesh::{Corner, Mesh, NONE, next_corner};

/// Result of the orientation.
#[derive(Clone, Debug, Default)]
pub(super) struct Orientation {
    /// Whether to flip each triangle.
    pub flipped: Vec<bool>,
    /// Number of pieces (connected components).
    pub pieces: u32,
    /// Number of pieces that are not orientable.
    pub non_orientable: u32,
}

/// Computes which triangles of a sound mesh must be flipped.
pub(super) fn orient(mesh: &Mesh) -> Orientation {
    let count = mesh.triangles.len();
    let mut orientation = Orientation { flipped: vec![false; count], ..Orientation::default() };
    let mut is_visited = vec![false; count];
    let mut piece = Vec::new();
    for seed in 0..count as u32 {
        if is_visited[seed as usize] {
            continue;
        }
        is_visited[seed as usize] = true;
        piece.clear();
        piece.push(seed);
        // Edges with inconsistent windings: as given, and after flipping.
        let (mut conflicts, mut remaining_conflicts) = (0, 0);
        let mut at = 0;
        while let Some(triangle) = piece.get(at).copied() {
            at += 1;
            for edge in 3 * triangle..3 * triangle + 3 {
                let Some((next, is_consistent)) = neighbor(mesh, edge) else { continue };
                let should_flip = orientation.flipped[triangle as usize] == is_consistent;
                let is_new = !core::mem::replace(&mut is_visited[next as usize], true);
                if is_new {
                    orientation.flipped[next as usize] = should_flip;
                    piece.push(next);
                }
                conflicts += u32::from(!is_consistent);
                remaining_conflicts += u32::from(orientation.flipped[next as usize] != should_flip);
            }
        }
        let flipped = |orientation: &Orientation| {
            piece.iter().filter(|triangle| orientation.flipped[**triangle as usize]).count()
        };
        orientation.pieces += 1;
        if remaining_conflicts > 0 {
            orientation.non_orientable += 1;
            if conflicts <= remaining_conflicts {
                piece.iter().for_each(|triangle| orientation.flipped[*triangle as usize] = false);
            }
        }
        if 2 * flipped(&orientation) > piece.len() {
            for triangle in &piece {
                let flipped = &mut orientation.flipped[*triangle as usize];
                *flipped = !*flipped;
            }
        }
    }
    orientation
}

/// The triangle across an edge, and whether both have consistent windings.
fn neighbor(mesh: &Mesh, edge: Corner) -> Option<(u32, bool)> {
    let next = mesh.across(edge);
    if next == NONE {
        return None;
    }
    let (from, to) = (mesh.vertex(edge), mesh.vertex(next_corner(edge)));
    // With consistent windings the neighbour runs along the edge in the opposite direction.
    let runs_back =
        |other: Corner| mesh.vertex(other) == to && mesh.vertex(next_corner(other)) == from;
    Some((next, (3 * next..3 * next + 3).any(runs_back)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn orientation(triangles: &[[u32; 3]]) -> Orientation {
        let count = 1 + triangles.iter().flatten().copied().max().unwrap() as usize;
        orient(&Mesh::new(triangles.to_vec(), count, count))
    }

    #[test]
    fn the_minority_of_every_piece_is_flipped() {
        let strip = [[0, 1, 2], [1, 3, 2], [2, 4, 3], [3, 5, 4], [6, 7, 8], [7, 8, 9], [8, 10, 9]];
        let orientation = orientation(&strip);
        // With two against two the first triangle decides.
        assert_eq!(orientation.flipped, [false, false, true, false, true, false, false]);
        assert_eq!((orientation.pieces, orientation.non_orientable), (2, 0));
    }

    /// A strip of `count` quads whose ends are joined with a half twist; neighbours have consistent
    /// windings except at the joint.
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
    fn a_moebius_strip_keeps_one_inconsistent_edge() {
        let strip = orientation(&moebius(8));
        assert_eq!((strip.pieces, strip.non_orientable), (1, 1));
        assert!(
            strip.flipped.iter().all(|flipped| !flipped),
            "one inconsistent edge is the minimum"
        );
        let mut mixed = moebius(8);
        mixed[5].swap(1, 2);
        mixed[9].swap(1, 2);
        let orientation = orientation(&mixed);
        let flipped: Vec<usize> = (0..16).filter(|at| orientation.flipped[*at]).collect();
        mixed.iter_mut().enumerate().for_each(|(at, triangle)| {
            if flipped.contains(&at) {
                triangle.swap(1, 2);
            }
        });
        let mesh = Mesh::new(mixed, 16, 16);
        let conflicting = mesh
            .edges()
            .filter(|e| neighbor(&mesh, *e).is_some_and(|(_, is_consistent)| !is_consistent));
        assert_eq!(conflicting.count(), 1);
    }
}
