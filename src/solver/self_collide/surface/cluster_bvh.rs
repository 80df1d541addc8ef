//! Cluster BVH: a binary tree over clusters of up to eight triangles.
//!
//! ```text
//!        ┌──────── root ────────┐       Built once, top down: the triangle centres at rest are
//!    ┌── · ──┐              ┌── · ──┐   split along their longest axis, near the median.
//! cluster  cluster      cluster  cluster Refitted bottom up to where the cloth is.
//! ```
//! Built from the mesh and its rest shape (Wald, Boulos, Shirley, "Ray Tracing Deformable Scenes
//! Using Dynamic Bounding Volume Hierarchies", ACM TOG 2007: fixed topology, refitted boxes).
//! Clusters bring three gains over a tree of triangles: fewer nodes, overlap tests of eight lanes,
//! and normal cones.
//!
//! Reads the mesh, and [`SweptParticles`]; writes its own lists: swept AABBs of clusters,
//! displacements since the last substep, normal cones.
//!
//! Invariant: the order of clusters depends on the mesh and the rest shape alone, so pairs always
//! come out in the same order.

use crate::geometry::aabb::Aabb;
use crate::math::simd::{Baseline, Float, Level, Simd};
use crate::math::sort::{sort, sort_by};
use crate::math::wide4::Float4;
use crate::mesh::{Mesh, NONE, next_corner};
use crate::solver::self_collide::surface::cluster::{
    CLUSTER_SIZE, Cluster, ClusterNode, MAX_BLOCKS,
};
use crate::solver::self_collide::surface::normal_cones::{NeighbourPair, NormalCones};
use crate::solver::self_collide::surface::pair_cache::PairCache;
use crate::solver::self_collide::surface::swept_aabb::{SweptAabb, SweptAabbBlock};
use crate::solver::self_collide::surface::swept_particles::SweptParticles;
use glam::Vec3;

/// If the vertices of a cluster move less than this relative to each other in a substep, its normal
/// cone counts as constant [mean rest lengths].
const TURNING_DISPLACEMENT: f32 = 0.12;

/// All clusters of a cloth, their tree, and their data of the current tick and substep.
#[derive(Clone, Debug)]
pub(crate) struct ClusterBvh {
    pub nodes: Vec<ClusterNode>,
    pub clusters: Vec<Cluster>,
    /// Triangles, vertices and edges, cluster by cluster.
    pub triangles: Vec<u32>,
    pub vertices: Vec<u32>,
    pub edges: Vec<[u32; 2]>,
    /// Neighbours of the clusters: the other cluster, and the index of the pair in `normal_cones`.
    pub neighbours: Vec<[u32; 2]>,
    /// Swept AABB of each node for the rest of the tick.
    pub tick_aabbs: Vec<SweptAabb>,
    /// Cluster pairs that may meet in the rest of the tick.
    pub tick_pairs: Vec<[u32; 2]>,
    /// For each of those: its index in `normal_cones` if both are neighbours, else `NONE`.
    pub tick_pair_neighbours: Vec<u32>,
    pub normal_cones: NormalCones,
    pub pair_cache: PairCache,
    /// Swept AABB of each cluster in the substep.
    pub swept_aabbs: Vec<SweptAabb>,
    /// Box of the displacements of each cluster's vertices since the last refit: low, high.
    pub step_displacements: Vec<[Float4; 2]>,
    /// AABBs at the start of the substep, fitted on demand: of each cluster, and of its triangles,
    /// vertices and edges.
    pub start_aabbs: Vec<SweptAabb>,
    pub triangle_aabbs: Vec<SweptAabbBlock>,
    pub vertex_aabbs: Vec<[SweptAabbBlock; MAX_BLOCKS]>,
    pub edge_aabbs: Vec<[SweptAabbBlock; MAX_BLOCKS]>,
    /// Stack of node pairs for the traversal.
    pub stack: Vec<[u32; 2]>,
    /// Positions at the last refit.
    last_start: Vec<Float4>,
    cluster_of_triangle: Vec<u32>,
    /// The last cluster that listed each vertex, while features are listed.
    last_cluster: Vec<u32>,
    is_vertex_torn: Vec<bool>,
}

impl ClusterBvh {
    /// Builds the tree from rest positions, for a cloth that may grow to `capacity` particles.
    /// `pieces` has the connected piece of each rest vertex.
    pub fn new(mesh: &Mesh, rest: &[Vec3], pieces: &[u32], capacity: usize) -> Self {
        let count = mesh.triangles.len();
        let sites =
            |triangle: u32| mesh.triangles[triangle as usize].map(|v| mesh.source[v as usize]);
        let center =
            |triangle: u32| sites(triangle).iter().map(|site| rest[*site as usize]).sum::<Vec3>();
        let mut order: Vec<u32> = (0..count as u32).collect();
        let piece = |triangle: u32| pieces[sites(triangle)[0] as usize];
        sort_by(&mut order, |p, q| (piece(*p), p).cmp(&(piece(*q), q)));
        let mut bvh = Self {
            nodes: Vec::new(),
            clusters: Vec::new(),
            triangles: order,
            vertices: Vec::with_capacity(3 * count),
            edges: Vec::with_capacity(3 * count),
            neighbours: Vec::new(),
            tick_aabbs: Vec::new(),
            tick_pairs: Vec::with_capacity(8 * rest.len()),
            tick_pair_neighbours: Vec::with_capacity(8 * rest.len()),
            normal_cones: NormalCones::new(0, &mut []),
            pair_cache: PairCache::new(rest.len()),
            swept_aabbs: Vec::new(),
            step_displacements: Vec::new(),
            start_aabbs: Vec::new(),
            triangle_aabbs: Vec::new(),
            vertex_aabbs: Vec::new(),
            edge_aabbs: Vec::new(),
            stack: Vec::with_capacity(256),
            last_start: Vec::with_capacity(capacity),
            cluster_of_triangle: vec![0; count],
            last_cluster: Vec::with_capacity(capacity),
            is_vertex_torn: Vec::with_capacity(capacity),
        };
        bvh.build_node(&piece, &center, 0, count);
        let clusters = bvh.clusters.len();
        bvh.tick_aabbs = vec![SweptAabb::EMPTY; bvh.nodes.len()];
        bvh.swept_aabbs = vec![SweptAabb::EMPTY; clusters];
        bvh.step_displacements = vec![[[0.0; 4]; 2]; clusters];
        bvh.start_aabbs = bvh.swept_aabbs.clone();
        bvh.triangle_aabbs = vec![SweptAabbBlock::EMPTY; clusters];
        bvh.vertex_aabbs = vec![[SweptAabbBlock::EMPTY; MAX_BLOCKS]; clusters];
        bvh.edge_aabbs = vec![[SweptAabbBlock::EMPTY; MAX_BLOCKS]; clusters];
        for (i, cluster) in bvh.clusters.iter_mut().enumerate() {
            let [from, to] = cluster.triangles.map(|t| t as usize);
            let own = &bvh.triangles[from..to];
            own.iter().for_each(|triangle| bvh.cluster_of_triangle[*triangle as usize] = i as u32);
            let all = own.iter().flat_map(|triangle| sites(*triangle));
            cluster.rest = Aabb::from_points(all.map(|site| rest[site as usize]));
            cluster.piece = piece(own[0]);
        }
        bvh.rebuild_features(mesh);
        bvh.build_neighbours();
        bvh.update_cone_triangles(mesh);
        bvh
    }

    /// Appends the subtree of the triangles `from..to`, and sorts these so that clusters are
    /// contiguous.
    fn build_node(
        &mut self,
        piece: &impl Fn(u32) -> u32,
        center: &impl Fn(u32) -> Vec3,
        from: usize,
        to: usize,
    ) {
        let (node, first) = (self.nodes.len(), self.clusters.len());
        self.nodes.push(ClusterNode { second: 0, cluster: NONE, count: 0 });
        let part = &mut self.triangles[from..to];
        let is_one_piece = piece(part[0]) == piece(part[part.len() - 1]);
        if is_one_piece && part.len() <= CLUSTER_SIZE {
            self.nodes[node].cluster = first as u32;
            self.clusters.push(Cluster::new([from as u32, to as u32]));
        } else {
            let middle = if is_one_piece {
                let mut all = Aabb::EMPTY;
                part.iter().for_each(|triangle| all.include(center(*triangle)));
                let size = all.half_extents().to_array();
                let axis = if size[0] >= size[1] && size[0] >= size[2] {
                    0
                } else if size[1] >= size[2] {
                    1
                } else {
                    2
                };
                let coordinate = |triangle: &u32| center(*triangle)[axis];
                // Equal coordinates are sorted by index, so that the order is deterministic.
                sort_by(part, |a, b| coordinate(a).total_cmp(&coordinate(b)).then(a.cmp(b)));
                // The split is at the widest gap near the median, so that clusters have straight
                // borders.
                let gap_before = |i: usize| coordinate(&part[i]) - coordinate(&part[i - 1]);
                let half = part.len() / 2;
                let mut best = half;
                for offset in 1..=part.len() / 4 {
                    for i in [half - offset, half + offset] {
                        if i < part.len() && i > 0 && gap_before(i) > gap_before(best) * 1.01 {
                            best = i;
                        }
                    }
                }
                best
            } else {
                // The split is at a border between pieces.
                let half = piece(part[part.len() / 2]);
                let start = part.partition_point(|triangle| piece(*triangle) < half);
                if start > 0 { start } else { part.partition_point(|t| piece(*t) <= half) }
            };
            self.build_node(piece, center, from, from + middle);
            self.nodes[node].second = self.nodes.len() as u32;
            self.build_node(piece, center, from + middle, to);
        }
        self.nodes[node].count = (self.clusters.len() - first) as u32;
    }

    /// Heap memory [bytes].
    pub fn bytes(&self) -> usize {
        let words = self.triangles.capacity()
            + self.vertices.capacity()
            + self.cluster_of_triangle.capacity()
            + self.last_cluster.capacity()
            + 2 * (self.neighbours.capacity()
                + self.edges.capacity()
                + self.stack.capacity()
                + self.tick_pairs.capacity())
            + self.tick_pair_neighbours.capacity();
        let aabbs = 2 * self.swept_aabbs.capacity() + self.tick_aabbs.capacity();
        size_of::<ClusterNode>() * self.nodes.capacity()
            + size_of::<SweptAabb>() * aabbs
            + size_of::<[Float4; 2]>() * self.step_displacements.capacity()
            + size_of::<Float4>() * self.last_start.capacity()
            + size_of::<SweptAabbBlock>() * (1 + 2 * MAX_BLOCKS) * self.triangle_aabbs.capacity()
            + size_of::<Cluster>() * self.clusters.capacity()
            + size_of::<u32>() * words
            + self.is_vertex_torn.capacity()
            + self.pair_cache.bytes()
            + self.normal_cones.bytes()
    }

    /// Updates vertices, edges and normal cones of all clusters after the mesh tore.
    pub fn update_topology(&mut self, mesh: &Mesh) {
        self.rebuild_features(mesh);
        self.update_cone_triangles(mesh);
    }

    fn update_cone_triangles(&mut self, mesh: &Mesh) {
        for (i, cluster) in self.clusters.iter().enumerate() {
            let [from, to] = cluster.triangles.map(|t| t as usize);
            let own = if cluster.is_torn { &[] } else { &self.triangles[from..to] };
            let corners = own.iter().map(|triangle| mesh.triangles[*triangle as usize]);
            self.normal_cones.set_triangles(i, corners);
        }
    }

    /// Rebuilds the vertices and edges of all clusters.
    fn rebuild_features(&mut self, mesh: &Mesh) {
        mesh.mark_torn_borders(&mut self.is_vertex_torn);
        self.vertices.clear();
        self.edges.clear();
        self.last_cluster.clear();
        self.last_cluster.resize(mesh.vertex_count(), NONE);
        for i in 0..self.clusters.len() {
            let mut cluster = self.clusters[i];
            let triangles = cluster.triangles[0] as usize..cluster.triangles[1] as usize;
            let first = self.vertices.len();
            let mut is_torn = false;
            for owned in [true, false] {
                for triangle in &self.triangles[triangles.clone()] {
                    for vertex in mesh.triangles[*triangle as usize] {
                        is_torn |= self.is_vertex_torn[vertex as usize];
                        let last = &mut self.last_cluster[vertex as usize];
                        let is_new = if owned { *last == NONE } else { *last != i as u32 };
                        if is_new {
                            *last = i as u32;
                            self.vertices.push(vertex);
                        }
                    }
                }
                if owned {
                    cluster.vertices[1] = self.vertices.len() as u32;
                }
            }
            cluster.vertices[0] = first as u32;
            cluster.vertices[2] = self.vertices.len() as u32;
            cluster.edges[0] = self.edges.len() as u32;
            for triangle in &self.triangles[triangles] {
                for edge in 3 * triangle..3 * triangle + 3 {
                    let across = mesh.across(edge);
                    let is_owner = across == NONE || {
                        let other = self.cluster_of_triangle[across as usize];
                        other > i as u32 || (other == i as u32 && across > *triangle)
                    };
                    if is_owner {
                        self.edges.push([mesh.vertex(edge), mesh.vertex(next_corner(edge))]);
                    }
                }
            }
            cluster.edges[1] = self.edges.len() as u32;
            cluster.is_torn = is_torn;
            self.clusters[i] = cluster;
        }
    }

    /// Builds the list of neighbours: pairs of clusters that share an edge, or that share a vertex
    /// and have a cluster between them that shares an edge with both.
    fn build_neighbours(&mut self) {
        let mut clusters_of_vertices: Vec<[u32; 2]> = Vec::new();
        for (i, cluster) in self.clusters.iter().enumerate() {
            let [from, _, to] = cluster.vertices.map(|v| v as usize);
            let own = self.vertices[from..to].iter().map(|vertex| [*vertex, i as u32]);
            clusters_of_vertices.extend(own);
        }
        sort(&mut clusters_of_vertices);
        let by_vertex = || clusters_of_vertices.chunk_by(|a, b| a[0] == b[0]);
        let mut common: Vec<[u32; 2]> = Vec::new();
        for of_vertex in by_vertex() {
            for (i, [_, one]) in of_vertex.iter().enumerate() {
                common.extend(of_vertex[i + 1..].iter().map(|[_, other]| [*one, *other]));
            }
        }
        sort(&mut common);
        // Two common vertices count as a common edge.
        let edges: Vec<[u32; 2]> = common
            .chunk_by(|a, b| a == b)
            .filter(|same| same.len() > 1)
            .map(|same| same[0])
            .collect();
        let share_edge =
            |one: u32, other: u32| edges.binary_search(&[one.min(other), one.max(other)]).is_ok();
        let mut pairs: Vec<NeighbourPair> = edges.iter().map(|pair| (*pair, None, NONE)).collect();
        for of_vertex in by_vertex() {
            for (i, [_, one]) in of_vertex.iter().enumerate() {
                for [_, other] in &of_vertex[i + 1..] {
                    let is_between = |[_, cluster]: &&[u32; 2]| {
                        share_edge(*one, *cluster) && share_edge(*cluster, *other)
                    };
                    let between = of_vertex.iter().find(is_between);
                    if !share_edge(*one, *other)
                        && let Some([_, between]) = between
                    {
                        pairs.push(([*one, *other], Some(*between), NONE));
                    }
                }
            }
        }
        sort(&mut pairs);
        self.normal_cones = NormalCones::new(self.clusters.len(), &mut pairs);
        for of_cluster in pairs.chunk_by(|(a, ..), (b, ..)| a[0] == b[0]) {
            let from = self.neighbours.len() as u32;
            self.neighbours.extend(of_cluster.iter().map(|([_, other], _, pair)| [*other, *pair]));
            let one = of_cluster[0].0[0];
            self.clusters[one as usize].neighbours = [from, self.neighbours.len() as u32];
        }
    }

    /// Refits the swept AABBs of all clusters to the substep, measures how far each moved since the
    /// last refit, and updates the normal cones. `spacing` is the mean rest length [m].
    pub fn refit(&mut self, level: Level, motion: &SweptParticles, spacing: f32) {
        if self.last_start.len() != motion.start.len() {
            self.last_start.clone_from(&motion.start);
        }
        let turning = spacing * TURNING_DISPLACEMENT;
        for (i, cluster) in self.clusters.iter_mut().enumerate() {
            let own = cluster.vertices[0] as usize..cluster.vertices[2] as usize;
            let aabb =
                SweptAabb::of_particles(&self.vertices[own.clone()], motion.start_and_bounds());
            let step = displacement_box(&self.vertices[own], &motion.start, &self.last_start);
            (self.swept_aabbs[i], self.step_displacements[i]) = (aabb, step);
            let is_rigid = aabb.displacement_extent() <= turning;
            self.normal_cones.set_turning(i, !is_rigid);
            cluster.has_feature_aabbs = false;
        }
        self.last_start.clone_from(&motion.start);
        self.normal_cones.update(level, &motion.start, &motion.now);
    }

    /// Grows the swept AABBs of clusters with escaped vertices, and updates the normal cones of those
    /// and of clusters with vertices that moved.
    pub fn refit_escaped(&mut self, level: Level, motion: &SweptParticles) {
        for i in 0..self.clusters.len() {
            let cluster = &mut self.clusters[i];
            cluster.has_escaped = false;
            let mut has_moved = false;
            let own = cluster.vertices[0] as usize..cluster.vertices[2] as usize;
            for vertex in &self.vertices[own] {
                has_moved |= motion.has_moved(*vertex);
                if motion.has_escaped(*vertex) {
                    cluster.has_escaped = true;
                    self.swept_aabbs[i].merge(&motion.swept_point(*vertex));
                }
            }
            self.normal_cones.set_turning(i, cluster.has_escaped || has_moved);
        }
        self.normal_cones.update_turning(level, &motion.now);
    }
}

/// The box of the displacements of some vertices: low, high [m]. Infinite if one is NaN or
/// infinite.
#[inline(always)]
fn displacement_box(vertices: &[u32], now: &[Float4], before: &[Float4]) -> [Float4; 2] {
    let (simd, mut step, mut finite) = (Baseline::new(), [[0.0; 4]; 2], [0.0; 4]);
    for k in (0..4).step_by(Baseline::LANES) {
        let zero = simd.splat(0.0);
        let mut is_finite = zero;
        let [mut low, mut high] =
            [f32::INFINITY, f32::NEG_INFINITY].map(|infinity| simd.splat(infinity));
        for vertex in vertices {
            let load = |list: &[Float4]| simd.load(&list[*vertex as usize], k);
            let moved = load(now) - load(before);
            // `is_finite` becomes NaN if a displacement is NaN or infinite.
            (low, high, is_finite) =
                (Float::min(moved, low), Float::max(moved, high), is_finite + moved * zero);
        }
        simd.store(&mut step[0], k, low);
        simd.store(&mut step[1], k, high);
        simd.store(&mut finite, k, is_finite);
    }
    if finite[..3].iter().any(|finite| *finite != 0.0) {
        step = [[f32::NEG_INFINITY; 4], [f32::INFINITY; 4]];
    }
    step
}
