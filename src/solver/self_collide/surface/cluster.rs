//! Clusters of neighbouring triangles: the leaves of the cluster BVH.
//!
//! ```text
//!   ┌───┬───┐      up to 8 triangles of one piece, and
//!   │╲  │╲  │      · the vertices of them, those that no earlier cluster owns first
//!   │ ╲ │ ╲ │      · the edges that no earlier cluster owns
//!   └───┴───┘
//! ```
//! Every vertex and every edge of the mesh has one owner, so a pair of them is found once. Clusters
//! hold ranges into the lists of the [`ClusterBvh`], which fills them.
//!
//! Reads and writes nothing.
//!
//! Invariant: the triangles of a cluster never change, and they belong to one connected piece of
//! the rest mesh. Vertices and edges change when the mesh tears.
//!
//! [`ClusterBvh`]: super::cluster_bvh::ClusterBvh

use crate::geometry::aabb::Aabb;
use crate::solver::self_collide::surface::swept_aabb::LANES;

/// Largest number of triangles in a cluster: one block of lanes.
pub(crate) const CLUSTER_SIZE: usize = LANES;

/// Largest number of blocks of lanes that the vertices of a cluster take, or its edges.
pub(crate) const MAX_BLOCKS: usize = 3 * CLUSTER_SIZE / LANES;

/// Ranges of a cluster in the lists of the BVH, and its state in a substep.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cluster {
    /// Range of its triangles: from, to.
    pub triangles: [u32; 2],
    /// Range of its vertices: from, middle, to. It owns those before the middle.
    pub vertices: [u32; 3],
    /// Range of the edges that it owns: from, to.
    pub edges: [u32; 2],
    /// Whether a tear or a cut runs through it, so that its triangles may meet each other.
    pub is_torn: bool,
    /// Whether the AABBs of its triangles, vertices and edges were fitted in this substep.
    pub has_feature_aabbs: bool,
    /// Whether one of its vertices escaped from its motion bound.
    pub has_escaped: bool,
    /// Range of its neighbours that come after it: from, to.
    pub neighbours: [u32; 2],
    /// The connected piece of the rest mesh that it is part of.
    pub piece: u32,
    /// Its AABB at rest.
    pub rest: Aabb,
}

impl Cluster {
    /// A cluster of the triangles in a range; all else is empty.
    pub fn new(triangles: [u32; 2]) -> Self {
        Self {
            triangles,
            vertices: [0; 3],
            edges: [0; 2],
            is_torn: false,
            has_feature_aabbs: false,
            has_escaped: false,
            neighbours: [0; 2],
            piece: 0,
            rest: Aabb::EMPTY,
        }
    }
}

/// A node of the cluster BVH. Its first child is the next node.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ClusterNode {
    /// Index of the second child.
    pub second: u32,
    /// The cluster of a leaf, else `NONE`.
    pub cluster: u32,
    /// Number of clusters below.
    pub count: u32,
}
