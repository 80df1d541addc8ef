//! Piece labels: which connected set of triangles each triangle belongs to.
//!
//! Method: connected components by flood fill over shared edges (`Mesh::pieces`), numbered in the
//! order of their first triangle. The labels from before the last tears stay, so that
//! `tear::update_pieces` can tell which pieces were detached.
//!
//! Data only; `World::label_pieces` and `topology` write it.
//! Invariant: `label` has one entry per triangle, and `members` belong to these labels.

use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::ReserveTotal;
use crate::mesh::NONE;
use crate::solver::topology::piece_members::PieceMembers;

/// Piece of each triangle, now and before the last tears, with buffers to compare both. The labels
/// from before are empty until the cloth can tear.
#[derive(Clone, Debug, Default)]
pub(crate) struct PieceLabels {
    pub label: Vec<u32>,
    pub old_label: Vec<u32>,
    /// Number of triangles of each piece.
    pub size: Vec<u32>,
    /// For each old piece, the new piece that continues it: its largest part.
    pub successor: Vec<u32>,
    /// Side of the triangles of each closed piece on which its outside is: 1 along their normals, -1
    /// against them; 0 for pieces that are not closed. Empty until `integrate::pressure` needs it.
    pub outward: Vec<f32>,
    /// The particles of each piece.
    pub members: PieceMembers,
}

heap_bytes!(PieceLabels { label, old_label, size, successor, outward, members } plain {});

impl PieceLabels {
    /// Appends the label of a new triangle that a cut splits off `triangle`.
    pub fn push_split_of(&mut self, triangle: usize) {
        self.label.push(self.label[triangle]);
        self.old_label.push(NONE);
    }

    /// Allocates for `particles` particles in at most `pieces` pieces.
    pub fn reserve(&mut self, particles: usize, pieces: usize) {
        self.outward.reserve_total(pieces);
        self.members.reserve(particles, pieces);
    }

    /// Allocates what only tears and cuts need. Each triangle may become a piece.
    pub fn reserve_for_tears(&mut self) {
        let count = self.label.len();
        self.old_label.resize(count, NONE);
        self.size.reserve_total(count);
        self.successor.reserve_total(count);
    }
}
