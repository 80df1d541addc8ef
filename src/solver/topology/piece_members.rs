//! Particles sorted by the piece that they belong to, or by groups of pieces that touch.
//!
//! Method: counting sort; union–find over pieces for groups.
//!
//! `World::label_pieces` writes the pieces, `piece_momentum` the groups.
//! Invariant: has capacity for all particles and pieces that tears may still make, so that no tick
//! allocates.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use crate::mesh::{Mesh, NONE, triangle_of};

/// Lists of particles, one per piece, in ascending order. Particles without triangles are in none.
#[derive(Clone, Debug, Default)]
pub(crate) struct PieceMembers {
    order: Vec<u32>,
    /// Where the list of each piece ends in `order`.
    ends: Vec<u32>,
}

heap_bytes!(PieceMembers { order, ends } plain {});

impl PieceMembers {
    /// Grows the capacity to `particles` particles in at most `pieces` pieces.
    pub fn reserve(&mut self, particles: usize, pieces: usize) {
        self.order.reserve_total(particles);
        self.ends.reserve_total(pieces);
    }

    /// The particles of each piece.
    pub fn iter(&self) -> impl Iterator<Item = &[u32]> {
        let starts = core::iter::once(&0).chain(&self.ends);
        starts.zip(&self.ends).map(|(start, end)| &self.order[*start as usize..*end as usize])
    }

    /// Sorts the particles of `mesh` by `list_of(piece)`, one of `0..lists`. `label` is the piece of
    /// each triangle.
    pub fn sort(&mut self, mesh: &Mesh, label: &[u32], lists: usize, list_of: impl Fn(u32) -> u32) {
        let Self { order, ends } = self;
        let members = || {
            let corners = mesh.corner_of.iter().enumerate().filter(|(_, corner)| **corner != NONE);
            corners.map(|(i, corner)| (i as u32, list_of(label[triangle_of(*corner)]) as usize))
        };
        ends.clear();
        ends.resize(lists, 0);
        members().for_each(|(_, list)| ends[list] += 1);
        let mut before = 0;
        for end in ends.iter_mut() {
            before += core::mem::replace(end, before);
        }
        order.clear();
        order.resize(before as usize, 0);
        for (particle, list) in members() {
            order[ends[list] as usize] = particle;
            ends[list] += 1;
        }
    }
}

/// Groups of pieces that touch each other (union–find).
#[derive(Clone, Debug, Default)]
pub(crate) struct PieceGroups {
    /// For each piece another one of its group with a lower number, or itself.
    parent: Vec<u32>,
    /// The particles of each group, in the list of its lowest piece.
    pub members: PieceMembers,
    /// Whether any group has several pieces.
    pub has_joined: bool,
}

heap_bytes!(PieceGroups { parent, members } plain { has_joined });

impl PieceGroups {
    /// Grows the capacity to `particles` particles in at most `pieces` pieces.
    pub fn reserve(&mut self, particles: usize, pieces: usize) {
        self.parent.reserve_total(pieces);
        self.members.reserve(particles, pieces);
    }

    /// Makes one group of each of `pieces` pieces.
    pub fn reset(&mut self, pieces: u32) {
        self.parent.clear();
        self.parent.extend(0..pieces);
        self.has_joined = false;
    }

    /// The lowest piece in the group of `piece`.
    pub fn root(&self, mut piece: u32) -> u32 {
        while self.parent[piece as usize] != piece {
            piece = self.parent[piece as usize];
        }
        piece
    }

    /// Joins the groups of two pieces.
    pub fn join(&mut self, a: u32, b: u32) {
        let (a, b) = (self.root(a), self.root(b));
        if a != b {
            self.parent[a.max(b) as usize] = a.min(b);
            self.has_joined = true;
        }
    }

    /// Lets each piece refer to the lowest piece of its group, then sorts the particles by group.
    pub fn sort(&mut self, mesh: &Mesh, label: &[u32]) {
        for piece in 0..self.parent.len() as u32 {
            // Lower pieces have their roots already, so this takes one step or two.
            self.parent[piece as usize] = self.root(piece);
        }
        let Self { parent, members, .. } = self;
        members.sort(mesh, label, parent.len(), |piece| parent[piece as usize]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Triangles that share no vertex.
    fn separate_triangles(count: u32) -> Mesh {
        let triangles = (0..count).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        Mesh::new(triangles, 3 * count as usize, 3 * count as usize)
    }

    #[test]
    fn joined_pieces_share_one_list_and_the_others_keep_theirs() {
        let (mesh, label) = (separate_triangles(5), [0, 1, 2, 3, 4]);
        let mut groups = PieceGroups::default();
        groups.reset(5);
        assert!(!groups.has_joined);
        groups.join(4, 2);
        groups.join(1, 4);
        groups.join(2, 1);
        groups.sort(&mesh, &label);
        let lists: Vec<Vec<u32>> = groups.members.iter().map(<[u32]>::to_vec).collect();
        let joined: Vec<u32> = (3..9).chain(12..15).collect();
        assert_eq!(lists, [vec![0, 1, 2], joined, vec![], vec![9, 10, 11], vec![]]);
        assert!(groups.has_joined);
    }
}
