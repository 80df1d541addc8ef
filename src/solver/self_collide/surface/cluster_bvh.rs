//! The cloth in patches of a few triangles, in a tree: which patches may be near each other.
//!
//! The tree is made of the mesh and its rest shape alone, so patches always come in the same order; its boxes
//! follow the cloth.

use crate::geometry::aabb::Aabb;
use crate::math::simd::{Baseline, Float, Level, Simd};
use crate::math::sort::{sort, sort_by};
use crate::math::wide4::Float4;
use crate::mesh::{Mesh, NONE, next_corner};
use crate::solver::self_collide::surface::normal_cones::Leans;
use crate::solver::self_collide::surface::pair_cache::Quads;
use crate::solver::self_collide::surface::swept_aabb::{LANES, Sweep, Sweeps};
use crate::solver::self_collide::surface::swept_particles::Motion;
use glam::Vec3;

/// Triangles in a patch at most.
pub(crate) const PATCH: usize = LANES;

/// Blocks of lanes that its vertices take at most, and its edges.
const BLOCKS: usize = 3 * PATCH / LANES;

/// Triangles whose vertices move less than this against each other in a substep turn little [mean rest lengths].
const TURNING: f32 = 0.12;

/// Some triangles beside each other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Patch {
    /// Its triangles: from, to.
    pub triangles: [u32; 2],
    /// Its vertices: from, to; those up to the middle one are of no patch before.
    pub vertices: [u32; 3],
    /// Its edges that are of no patch before: from, to.
    pub edges: [u32; 2],
    /// Whether a tear or a cut goes through it, so that its triangles may meet each other.
    is_frayed: bool,
    /// Whether what is in it was told apart in this substep.
    pub(crate) is_split: bool,
    /// Whether one of its vertices strayed.
    pub(crate) has_strays: bool,
    /// The patches beside it that come after it: from, to.
    pub(crate) beside: [u32; 2],
    /// The piece that it is of, and where it is at rest.
    pub(crate) piece: u32,
    pub(crate) rest: Aabb,
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    /// The other child; the first comes right behind.
    pub(crate) second: u32,
    /// The patch of a leaf, else `NONE`.
    pub(crate) patch: u32,
    /// Patches below.
    pub(crate) count: u32,
}

/// All patches of a cloth.
#[derive(Clone, Debug)]
pub(crate) struct Patches {
    pub(crate) nodes: Vec<Node>,
    /// Where what is below each node may get in this tick, and the pairs of patches that may meet in it.
    pub(crate) reaches: Vec<Sweep>,
    pub(crate) listed: Vec<[u32; 2]>,
    /// The place of each among the pairs that are beside each other; `NONE` for others.
    pub(crate) places: Vec<u32>,
    pub(crate) leans: Leans,
    /// What may meet of those.
    pub(crate) quads: Quads,
    /// Where each patch is and goes in a substep, and what is in it in the tick.
    pub(crate) sweeps: Vec<Sweep>,
    /// How its vertices moved since patches were fitted before: from, to; and where all vertices were then.
    pub(crate) steps: Vec<[Float4; 2]>,
    before: Vec<Float4>,
    pub(crate) wholes: Vec<Sweep>,
    pub(crate) triangle_sweeps: Vec<Sweeps>,
    pub(crate) vertex_sweeps: Vec<[Sweeps; BLOCKS]>,
    pub(crate) edge_sweeps: Vec<[Sweeps; BLOCKS]>,
    pub patches: Vec<Patch>,
    /// Triangles, patch by patch.
    pub triangles: Vec<u32>,
    pub vertices: Vec<u32>,
    pub edges: Vec<[u32; 2]>,
    /// Patches beside one before, and the place of each such pair among all.
    pub(crate) beside: Vec<[u32; 2]>,
    /// The patch of each triangle.
    patch_of: Vec<u32>,
    /// The last patch that had each vertex.
    seen_in: Vec<u32>,
    frayed: Vec<bool>,
    pub(crate) stack: Vec<[u32; 2]>,
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
            reaches: Vec::new(),
            listed: Vec::with_capacity(8 * rest.len()),
            places: Vec::with_capacity(8 * rest.len()),
            leans: Leans::new(0, &mut []),
            quads: Quads::new(rest.len()),
            sweeps: Vec::new(),
            steps: Vec::new(),
            before: Vec::with_capacity(capacity),
            wholes: Vec::new(),
            triangle_sweeps: Vec::new(),
            vertex_sweeps: Vec::new(),
            edge_sweeps: Vec::new(),
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
        patches.reaches = vec![Sweep::EMPTY; patches.nodes.len()];
        patches.sweeps = vec![Sweep::EMPTY; patches.patches.len()];
        patches.steps = vec![[[0.0; 4]; 2]; patches.patches.len()];
        patches.wholes = patches.sweeps.clone();
        patches.triangle_sweeps = vec![Sweeps::EMPTY; patches.patches.len()];
        patches.vertex_sweeps = vec![[Sweeps::EMPTY; BLOCKS]; patches.patches.len()];
        patches.edge_sweeps = vec![[Sweeps::EMPTY; BLOCKS]; patches.patches.len()];
        for (at, patch) in patches.patches.iter_mut().enumerate() {
            let [from, to] = patch.triangles.map(|t| t as usize);
            let own = &patches.triangles[from..to];
            own.iter().for_each(|triangle| patches.patch_of[*triangle as usize] = at as u32);
            let all = own.iter().flat_map(|triangle| sites(*triangle));
            patch.rest = Aabb::from_points(all.map(|site| rest[site as usize]));
            patch.piece = piece(own[0]);
        }
        patches.find_parts(mesh);
        patches.find_neighbours();
        patches.set_leans(mesh);
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
                is_split: false,
                has_strays: false,
                beside: [0; 2],
                piece: 0,
                rest: Aabb::EMPTY,
            });
        } else {
            let middle = if is_whole {
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
                let place = |triangle: &u32| center(*triangle)[axis];
                // Equal ones by their numbers, so that the order is always the same.
                sort_by(part, |a, b| place(a).total_cmp(&place(b)).then(a.cmp(b)));
                // Where there is most room near the middle, so that patches have straight sides.
                let jump = |at: usize| place(&part[at]) - place(&part[at - 1]);
                let half = part.len() / 2;
                let mut best = half;
                for off in 1..=part.len() / 4 {
                    for at in [half - off, half + off] {
                        if at < part.len() && at > 0 && jump(at) > jump(best) * 1.01 {
                            best = at;
                        }
                    }
                }
                best
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
            + 2 * (self.beside.capacity()
                + self.edges.capacity()
                + self.stack.capacity()
                + self.listed.capacity())
            + self.places.capacity();
        size_of::<Node>() * self.nodes.capacity()
            + size_of::<Sweep>() * (2 * self.sweeps.capacity() + self.reaches.capacity())
            + size_of::<[Float4; 2]>() * self.steps.capacity()
            + size_of::<Float4>() * self.before.capacity()
            + size_of::<Sweeps>() * (1 + 2 * BLOCKS) * self.triangle_sweeps.capacity()
            + size_of::<Patch>() * self.patches.capacity()
            + size_of::<u32>() * words
            + self.frayed.capacity()
            + self.quads.bytes()
            + self.leans.bytes()
    }

    /// Finds what is in all patches, after the mesh tore.
    pub fn follow(&mut self, mesh: &Mesh) {
        self.find_parts(mesh);
        self.set_leans(mesh);
    }

    fn set_leans(&mut self, mesh: &Mesh) {
        for (at, patch) in self.patches.iter().enumerate() {
            let [from, to] = patch.triangles.map(|t| t as usize);
            let own = if patch.is_frayed { &[] } else { &self.triangles[from..to] };
            self.leans.set(at, own.iter().map(|triangle| mesh.triangles[*triangle as usize]));
        }
    }

    /// Finds the vertices and the edges of all patches.
    fn find_parts(&mut self, mesh: &Mesh) {
        mesh.mark_torn_borders(&mut self.frayed);
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
                        self.edges.push([mesh.vertex(edge), mesh.vertex(next_corner(edge))]);
                    }
                }
            }
            patch.edges[1] = self.edges.len() as u32;
            patch.is_frayed = is_frayed;
            self.patches[at] = patch;
        }
    }

    /// Finds the patches after each that share edges with it, or a vertex and a patch between them around that.
    fn find_neighbours(&mut self) {
        let mut around: Vec<[u32; 2]> = Vec::new();
        for (at, patch) in self.patches.iter().enumerate() {
            let [from, _, to] = patch.vertices.map(|v| v as usize);
            around.extend(self.vertices[from..to].iter().map(|v| [*v, at as u32]));
        }
        sort(&mut around);
        let of_vertices = || around.chunk_by(|a, b| a[0] == b[0]);
        let mut common: Vec<[u32; 2]> = Vec::new();
        for of_vertex in of_vertices() {
            for (at, [_, one]) in of_vertex.iter().enumerate() {
                common.extend(of_vertex[at + 1..].iter().map(|[_, other]| [*one, *other]));
            }
        }
        sort(&mut common);
        // Two vertices are an edge, or as good as one.
        let edges: Vec<[u32; 2]> = common
            .chunk_by(|a, b| a == b)
            .filter(|same| same.len() > 1)
            .map(|same| same[0])
            .collect();
        let share_edges =
            |one: u32, other: u32| edges.binary_search(&[one.min(other), one.max(other)]).is_ok();
        let mut beside: Vec<([u32; 2], Option<u32>, u32)> =
            edges.iter().map(|pair| (*pair, None, NONE)).collect();
        for of_vertex in of_vertices() {
            for (at, [_, one]) in of_vertex.iter().enumerate() {
                for [_, other] in &of_vertex[at + 1..] {
                    let is_between = |[_, patch]: &&[u32; 2]| {
                        share_edges(*one, *patch) && share_edges(*patch, *other)
                    };
                    let between = of_vertex.iter().find(is_between);
                    if !share_edges(*one, *other)
                        && let Some([_, between]) = between
                    {
                        beside.push(([*one, *other], Some(*between), NONE));
                    }
                }
            }
        }
        sort(&mut beside);
        self.leans = Leans::new(self.patches.len(), &mut beside);
        for of_patch in beside.chunk_by(|(a, ..), (b, ..)| a[0] == b[0]) {
            let from = self.beside.len() as u32;
            self.beside.extend(of_patch.iter().map(|([_, other], _, place)| [*other, *place]));
            self.patches[of_patch[0].0[0] as usize].beside = [from, self.beside.len() as u32];
        }
    }

    /// Fits boxes around where vertices are and get to, and finds which patches are flat.
    pub fn fit(&mut self, level: Level, motion: &Motion, spacing: f32) {
        if self.before.len() != motion.start.len() {
            self.before.clone_from(&motion.start);
        }
        let turning = spacing * TURNING;
        for (at, patch) in self.patches.iter_mut().enumerate() {
            let own = patch.vertices[0] as usize..patch.vertices[2] as usize;
            let all = Sweep::around(&self.vertices[own.clone()], motion.rooms());
            let step = step_of(&self.vertices[own], &motion.start, &self.before);
            (self.sweeps[at], self.steps[at]) = (all, step);
            let is_stiff = all.most_against() <= turning;
            self.leans.set_turning(at, !is_stiff);
            patch.is_split = false;
        }
        self.before.clone_from(&motion.start);
        self.leans.find(level, &motion.start, &motion.now);
    }

    /// Fits boxes around where vertices get to that strayed.
    pub fn follow_strays(&mut self, level: Level, motion: &Motion) {
        for at in 0..self.patches.len() {
            let patch = &mut self.patches[at];
            patch.has_strays = false;
            let own = patch.vertices[0] as usize..patch.vertices[2] as usize;
            for vertex in &self.vertices[own] {
                if motion.strays(*vertex) {
                    patch.has_strays = true;
                    motion.add_to(&mut self.sweeps[at], *vertex);
                }
            }
            self.leans.set_turning(at, patch.has_strays);
        }
        self.leans.find_again(level, &motion.now);
    }
}

/// How vertices went since they were where they were `before`: from, to.
#[inline(always)]
fn step_of(vertices: &[u32], now: &[Float4], before: &[Float4]) -> [Float4; 2] {
    let (simd, mut step, mut sound) = (Baseline::new(), [[0.0; 4]; 2], [0.0; 4]);
    for k in (0..4).step_by(Baseline::LANES) {
        let zero = simd.splat(0.0);
        let mut still = zero;
        let [mut least, mut most] =
            [f32::INFINITY, f32::NEG_INFINITY].map(|endless| simd.splat(endless));
        for vertex in vertices {
            let load = |spots: &[Float4]| simd.load(&spots[*vertex as usize], k);
            let way = load(now) - load(before);
            // What is no number, or has no end, leaves none in the last.
            (least, most, still) =
                (Float::min(way, least), Float::max(way, most), still + way * zero);
        }
        simd.store(&mut step[0], k, least);
        simd.store(&mut step[1], k, most);
        simd.store(&mut sound, k, still);
    }
    if sound[..3].iter().any(|still| *still != 0.0) {
        step = [[f32::NEG_INFINITY; 4], [f32::INFINITY; 4]];
    }
    step
}
