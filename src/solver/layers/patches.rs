//! The cloth in patches of a few triangles, in a tree: which patches may be near each other.
//!
//! The tree is made of the mesh and its rest shape alone, so patches always come in the same order; its boxes
//! follow the cloth.

use super::spots::{Spot, place};
use crate::geom::aabb::Aabb;
use crate::math::sort::{sort, sort_by};
use crate::mesh::{Mesh, NONE, after};
use glam::Vec3;

/// Triangles in a patch at most.
pub(super) const PATCH: usize = 8;

/// In a flat patch no normal is farther from the mean one than the first, and flat patches lie in line if
/// their means are no farther apart than the second (cosines of 25° and 40°). So no two normals are more
/// than a right angle apart, and neighbours cannot meet.
const FLAT: f32 = 0.9064;
const IN_LINE: f32 = 0.7661;

/// Some triangles beside each other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    /// Its triangles: from, to.
    pub triangles: [u32; 2],
    /// Its vertices: from, to; those up to the middle one are of no patch before.
    pub vertices: [u32; 3],
    /// Its edges that are of no patch before: from, to.
    pub edges: [u32; 2],
    /// Whether a tear or a cut goes through it, so that its triangles may meet each other.
    is_frayed: bool,
    /// The mean normal; zero where normals differ much.
    normal: Vec3,
    pub bounds: Aabb,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    /// The other child; the first comes right behind.
    second: u32,
    /// The patch of a leaf, else `NONE`.
    patch: u32,
    /// Patches below.
    count: u32,
}

/// All patches of a cloth.
#[derive(Clone, Debug)]
pub(super) struct Patches {
    nodes: Vec<Node>,
    bounds: Vec<Aabb>,
    pub patches: Vec<Patch>,
    /// Triangles, patch by patch.
    pub triangles: Vec<u32>,
    pub vertices: Vec<u32>,
    pub edges: Vec<[u32; 2]>,
    /// Patches that share a vertex, the lower first, in order.
    beside: Vec<[u32; 2]>,
    /// The patch of each triangle.
    patch_of: Vec<u32>,
    /// The last patch that had each vertex.
    seen_in: Vec<u32>,
    frayed: Vec<bool>,
    stack: Vec<[u32; 2]>,
}

impl Patches {
    /// Patches of a cloth with rest positions and pieces of sites; `capacity` particles there may be.
    pub fn new(mesh: &Mesh, rest: &[Vec3], pieces: &[u32], capacity: usize) -> Self {
        let count = mesh.triangles.len();
        let sites =
            |triangle: u32| mesh.triangles[triangle as usize].map(|v| mesh.source[v as usize]);
        let center =
            |triangle: u32| sites(triangle).iter().map(|site| rest[*site as usize]).sum::<Vec3>();
        let mut order: Vec<u32> = (0..count as u32).collect();
        let piece = |triangle: u32| pieces[sites(triangle)[0] as usize];
        sort_by(&mut order, |p, q| (piece(*p), p).cmp(&(piece(*q), q)));
        let mut patches = Self {
            nodes: Vec::new(),
            bounds: Vec::new(),
            patches: Vec::new(),
            triangles: order,
            vertices: Vec::with_capacity(3 * count),
            edges: Vec::with_capacity(3 * count),
            beside: Vec::new(),
            patch_of: vec![0; count],
            seen_in: Vec::with_capacity(capacity),
            frayed: Vec::with_capacity(capacity),
            stack: Vec::with_capacity(256),
        };
        patches.grow(&piece, &center, 0, count);
        patches.bounds = vec![Aabb::EMPTY; patches.nodes.len()];
        for (at, patch) in patches.patches.iter().enumerate() {
            let [from, to] = patch.triangles.map(|t| t as usize);
            for triangle in &patches.triangles[from..to] {
                patches.patch_of[*triangle as usize] = at as u32;
            }
        }
        patches.follow(mesh);
        patches.find_neighbours(mesh);
        patches
    }

    fn grow(
        &mut self,
        piece: &impl Fn(u32) -> u32,
        center: &impl Fn(u32) -> Vec3,
        from: usize,
        to: usize,
    ) {
        let (at, first) = (self.nodes.len(), self.patches.len());
        self.nodes.push(Node { second: 0, patch: NONE, count: 0 });
        let part = &mut self.triangles[from..to];
        let is_whole = piece(part[0]) == piece(part[part.len() - 1]);
        if is_whole && part.len() <= PATCH {
            self.nodes[at].patch = first as u32;
            let triangles = [from as u32, to as u32];
            self.patches.push(Patch {
                triangles,
                vertices: [0; 3],
                edges: [0; 2],
                is_frayed: false,
                normal: Vec3::ZERO,
                bounds: Aabb::EMPTY,
            });
        } else {
            let middle = if is_whole {
                let mut all = Aabb::EMPTY;
                part.iter().for_each(|triangle| all.add(center(*triangle)));
                let size = all.half().to_array();
                let axis = if size[0] >= size[1] && size[0] >= size[2] {
                    0
                } else if size[1] >= size[2] {
                    1
                } else {
                    2
                };
                let place = |triangle: &u32| center(*triangle)[axis];
                // Equal ones by their numbers, so that the order is always the same.
                sort_by(part, |a, b| place(a).total_cmp(&place(b)).then(a.cmp(b)));
                part.len() / 2
            } else {
                // A piece is not torn apart.
                let half = piece(part[part.len() / 2]);
                let start = part.partition_point(|triangle| piece(*triangle) < half);
                if start > 0 { start } else { part.partition_point(|t| piece(*t) <= half) }
            };
            self.grow(piece, center, from, from + middle);
            self.nodes[at].second = self.nodes.len() as u32;
            self.grow(piece, center, from + middle, to);
        }
        self.nodes[at].count = (self.patches.len() - first) as u32;
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let words = self.triangles.capacity()
            + self.vertices.capacity()
            + self.patch_of.capacity()
            + self.seen_in.capacity()
            + 2 * (self.edges.capacity() + self.beside.capacity() + self.stack.capacity());
        size_of::<Node>() * self.nodes.capacity()
            + size_of::<Aabb>() * self.bounds.capacity()
            + size_of::<Patch>() * self.patches.capacity()
            + size_of::<u32>() * words
            + self.frayed.capacity()
    }

    /// Finds the vertices and the edges of all patches, after the mesh tore.
    pub fn follow(&mut self, mesh: &Mesh) {
        mesh.find_frayed(&mut self.frayed);
        self.vertices.clear();
        self.edges.clear();
        self.seen_in.clear();
        self.seen_in.resize(mesh.vertex_count(), NONE);
        for at in 0..self.patches.len() {
            let mut patch = self.patches[at];
            let triangles = patch.triangles[0] as usize..patch.triangles[1] as usize;
            let first = self.vertices.len();
            let mut is_frayed = false;
            for is_fresh in [true, false] {
                for triangle in &self.triangles[triangles.clone()] {
                    for vertex in mesh.triangles[*triangle as usize] {
                        is_frayed |= self.frayed[vertex as usize];
                        let seen = &mut self.seen_in[vertex as usize];
                        let is_new = if is_fresh { *seen == NONE } else { *seen != at as u32 };
                        if is_new {
                            *seen = at as u32;
                            self.vertices.push(vertex);
                        }
                    }
                }
                if is_fresh {
                    patch.vertices[1] = self.vertices.len() as u32;
                }
            }
            patch.vertices[0] = first as u32;
            patch.vertices[2] = self.vertices.len() as u32;
            patch.edges[0] = self.edges.len() as u32;
            for triangle in &self.triangles[triangles] {
                for edge in 3 * triangle..3 * triangle + 3 {
                    let across = mesh.across(edge);
                    let is_first = across == NONE || {
                        let other = self.patch_of[across as usize];
                        other > at as u32 || (other == at as u32 && across > *triangle)
                    };
                    if is_first {
                        self.edges.push([mesh.vertex(edge), mesh.vertex(after(edge))]);
                    }
                }
            }
            patch.edges[1] = self.edges.len() as u32;
            patch.is_frayed = is_frayed;
            self.patches[at] = patch;
        }
    }

    fn find_neighbours(&mut self, mesh: &Mesh) {
        let mut around: Vec<[u32; 2]> = Vec::new();
        for (at, patch) in self.patches.iter().enumerate() {
            let [from, _, to] = patch.vertices.map(|v| v as usize);
            around.extend(self.vertices[from..to].iter().map(|v| [*v, at as u32]));
        }
        sort(&mut around);
        let mut beside = Vec::new();
        for of_vertex in around.chunk_by(|a, b| a[0] == b[0]) {
            for (at, [_, one]) in of_vertex.iter().enumerate() {
                beside.extend(of_vertex[at + 1..].iter().map(|[_, other]| [*one, *other]));
            }
        }
        sort(&mut beside);
        beside.dedup();
        debug_assert!(
            beside.iter().all(|[a, b]| a < b) && mesh.triangles.len() >= self.patches.len()
        );
        self.beside = beside;
    }

    /// Fits boxes around where vertices are, each with so much room around it, and finds which patches
    /// are flat.
    pub fn fit(&mut self, mesh: &Mesh, x: &[Spot], room: &[f32]) {
        for at in (0..self.nodes.len()).rev() {
            let node = self.nodes[at];
            let mut all = Aabb::EMPTY;
            if node.patch == NONE {
                all = self.bounds[at + 1];
                all.join(&self.bounds[node.second as usize]);
            } else {
                let patch = self.patches[node.patch as usize];
                for vertex in &self.vertices[patch.vertices[0] as usize..patch.vertices[2] as usize]
                {
                    let (x, room) =
                        (place(&x[*vertex as usize]), Vec3::splat(room[*vertex as usize]));
                    all.add(x - room);
                    all.add(x + room);
                }
                let normal = self.normal(mesh, x, &patch);
                let patch = &mut self.patches[node.patch as usize];
                (patch.normal, patch.bounds) = (normal, all);
            }
            self.bounds[at] = all;
        }
    }

    /// The mean normal of a patch that is flat, else zero.
    fn normal(&self, mesh: &Mesh, x: &[Spot], patch: &Patch) -> Vec3 {
        if patch.is_frayed {
            return Vec3::ZERO;
        }
        let triangles = &self.triangles[patch.triangles[0] as usize..patch.triangles[1] as usize];
        let mut normals = [Vec3::ZERO; PATCH];
        let mut sum = Vec3::ZERO;
        for (normal, triangle) in normals.iter_mut().zip(triangles) {
            let [a, b, c] = mesh.triangles[*triangle as usize].map(|v| place(&x[v as usize]));
            let doubled = (b - a).cross(c - a);
            *normal = doubled * (1.0 / doubled.length());
            sum += *normal;
        }
        let mean = sum * (1.0 / sum.length());
        let is_flat = normals[..triangles.len()].iter().all(|normal| normal.dot(mean) > FLAT);
        if is_flat { mean } else { Vec3::ZERO }
    }

    /// Whether triangles of two patches cannot meet, since the patches are neighbours and flat.
    fn is_quiet(&self, [one, other]: [u32; 2]) -> bool {
        let [a, b] = [one, other].map(|patch| self.patches[patch as usize].normal);
        if one == other {
            return a != Vec3::ZERO;
        }
        a.dot(b) > IN_LINE && self.beside.binary_search(&[one, other]).is_ok()
    }

    /// The pairs of patches whose boxes come nearer than `gap`, the lower first: always in the same order.
    /// Patches are visited with themselves as well.
    pub fn visit(&mut self, gap: f32, mut visit: impl FnMut(&Self, [u32; 2])) {
        let mut stack = core::mem::take(&mut self.stack);
        stack.clear();
        stack.push([0, 0]);
        while let Some([a, b]) = stack.pop() {
            let (one, other) = (self.nodes[a as usize], self.nodes[b as usize]);
            if a == b {
                if one.patch == NONE {
                    stack.push([one.second, one.second]);
                    stack.push([a + 1, one.second]);
                    stack.push([a + 1, a + 1]);
                } else if !self.is_quiet([one.patch; 2]) {
                    visit(self, [one.patch; 2]);
                }
            } else if self.bounds[a as usize].grown(gap).meets(&self.bounds[b as usize]) {
                if one.patch != NONE && other.patch != NONE {
                    if !self.is_quiet([one.patch, other.patch]) {
                        visit(self, [one.patch, other.patch]);
                    }
                } else if one.patch == NONE && one.count >= other.count {
                    stack.push([one.second, b]);
                    stack.push([a + 1, b]);
                } else {
                    stack.push([a, other.second]);
                    stack.push([a, b + 1]);
                }
            }
        }
        self.stack = stack;
    }
}
