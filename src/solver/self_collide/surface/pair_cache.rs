//! What may meet of two patches, pair by pair, until those went farther against each other than there was room for:
//! a substep has only to pick from that and to judge.

use crate::math::max;
use crate::math::simd::Level;
use crate::math::sort::sort_by;
use crate::math::wide4::Float4;
use crate::mesh::{Mesh, NONE};
use crate::solver::self_collide::surface::cluster_bvh::Patches;
use crate::solver::self_collide::surface::contact::{EDGES, Kind, VERTEX};
use crate::solver::self_collide::surface::pair_store::Stock;
use crate::solver::self_collide::surface::rest_gap::RestGap;
use crate::solver::self_collide::surface::separation_test::Candidates;
use crate::solver::self_collide::surface::swept_aabb::{LANES, Sweep, Sweeps, meet, places_of};
use crate::solver::self_collide::surface::swept_particles::Motion;

/// The bits of a block of lanes.
const LANE_BITS: u32 = (1 << LANES) - 1;

/// How far patches may go against each other until the pairs in them are found anew: so many mean rest lengths, or
/// so much of how far they may go in a substep. In a crowd, with so many pairs of patches listed for each patch, it
/// takes longer to look at many pairs than to find the few anew.
const ROOM: f32 = 0.4;
const ROOM_WAY: f32 = 0.25;
const CROWD: usize = 12;
const CROWDED: f32 = 0.1;

/// Pairs that are no more, beyond as many as there are, are let be until they are so many.
const WASTE: usize = 1024;

/// The pairs in two patches.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Run {
    /// Vertices with triangles, and edges with edges: from, to.
    pub vertices: [u32; 2],
    pub edges: [u32; 2],
    /// How far apart is what was left out, at least, and how far patches went against each other since [m].
    room: f32,
    spent: f32,
}

/// All pairs found so far.
#[derive(Clone, Debug)]
pub(crate) struct Quads {
    vertices: Stock,
    edges: Stock,
    /// Those of each listed pair of patches, once they are known, and how many all of those are.
    runs: Vec<Option<Run>>,
    live: usize,
    /// Whether any is known.
    is_any_known: bool,
    /// What was listed before, and of that the first for each patch and the next after each.
    before: Before,
    /// Room to put runs in order.
    order: Vec<u32>,
}

/// Listed pairs of patches and what was known of them.
#[derive(Clone, Debug)]
struct Before {
    listed: Vec<[u32; 2]>,
    runs: Vec<Option<Run>>,
    first: Vec<u32>,
    next: Vec<u32>,
}

/// Some of what is in a patch: a bit for each, in order.
#[derive(Clone, Copy, Debug)]
struct Chosen {
    vertices: u32,
    triangles: u32,
    edges: u32,
}

/// A look at two patches.
struct Look<'a> {
    rest_gap: &'a RestGap<'a>,
    motion: &'a Motion,
    /// How far apart what is found may be [m].
    room: f32,
    /// Whether what is in them may be near at rest, so that it keeps a smaller gap.
    may_be_woven: bool,
}

impl Look<'_> {
    #[inline(always)]
    fn gap_of<const FIRST: Kind>(&self, ids: [u32; 4]) -> f32 {
        if self.may_be_woven { self.rest_gap.gap_of::<FIRST>(ids) } else { self.rest_gap.gap }
    }
}

impl Quads {
    pub fn new(count: usize) -> Self {
        let [vertices, edges] = [32, 96].map(|each| Stock::new(each * count));
        let before = Before {
            listed: Vec::with_capacity(8 * count),
            runs: Vec::with_capacity(8 * count),
            first: Vec::with_capacity(count),
            next: Vec::with_capacity(8 * count),
        };
        let runs = Vec::with_capacity(8 * count);
        Self {
            vertices,
            edges,
            runs,
            live: 0,
            is_any_known: false,
            before,
            order: Vec::with_capacity(8 * count),
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let Before { listed, runs, first, next } = &self.before;
        let runs = size_of::<Option<Run>>() * (self.runs.capacity() + runs.capacity());
        let words =
            2 * listed.capacity() + first.capacity() + next.capacity() + self.order.capacity();
        self.vertices.bytes() + self.edges.bytes() + runs + size_of::<u32>() * words
    }

    /// Nothing is known of so many pairs of patches.
    fn forget(&mut self, pairs: usize) {
        self.vertices.clear();
        self.edges.clear();
        (self.live, self.is_any_known) = (0, false);
        self.runs.clear();
        self.runs.resize(pairs, None);
    }

    /// Pairs of patches are about to be listed anew: `listed` becomes what was, and empty.
    pub fn begin_list(&mut self, listed: &mut Vec<[u32; 2]>) {
        core::mem::swap(listed, &mut self.before.listed);
        core::mem::swap(&mut self.runs, &mut self.before.runs);
        listed.clear();
        self.runs.clear();
    }

    /// Takes over what was known of those that are listed again, among so many patches.
    pub fn end_list(&mut self, listed: &[[u32; 2]], patches: usize) {
        let Before { listed: old, runs, first, next } = &mut self.before;
        first.clear();
        first.resize(patches, NONE);
        next.clear();
        next.resize(old.len(), NONE);
        for (at, [one, _]) in old.iter().enumerate().rev() {
            next[at] = core::mem::replace(&mut first[*one as usize], at as u32);
        }
        (self.live, self.is_any_known) = (0, false);
        for [one, other] in listed {
            let mut at = first[*one as usize];
            while at != NONE && old[at as usize][1] != *other {
                at = next[at as usize];
            }
            let run = if at == NONE { None } else { runs[at as usize] };
            self.live += run.as_ref().map_or(0, Run::len);
            self.is_any_known |= run.is_some();
            self.runs.push(run);
        }
    }

    /// Leaves behind what is no more, if that is much.
    fn tidy(&mut self) {
        if self.vertices.len() + self.edges.len() <= self.live + self.live / 2 + WASTE {
            return;
        }
        let Self { vertices, edges, runs, order, .. } = self;
        order.clear();
        order.extend((0..runs.len() as u32).filter(|at| runs[*at as usize].is_some()));
        // As they were found; what has nothing in it has no place among others, but one of its own.
        let place = |at: &u32| {
            let run = runs[*at as usize].as_ref();
            (run.map(|run| (run.vertices[0], run.edges[0])), *at)
        };
        sort_by(order, |a, b| place(a).cmp(&place(b)));
        let mut ends = [0; 2];
        for at in order {
            if let Some(run) = &mut runs[*at as usize] {
                run.vertices = vertices.take_back(run.vertices, ends[0]);
                run.edges = edges.take_back(run.edges, ends[1]);
                ends = [run.vertices[1], run.edges[1]];
            }
        }
        vertices.truncate(ends[0]);
        edges.truncate(ends[1]);
    }

    /// Measures what was found since the last time, as the substep begins.
    pub fn measure(&mut self, level: Level, start: &[Float4]) {
        self.vertices.measure::<VERTEX>(level, start);
        self.edges.measure::<EDGES>(level, start);
    }
}

impl Run {
    fn len(&self) -> usize {
        let [[a, b], [c, d]] = [self.vertices, self.edges];
        (b - a + d - c) as usize
    }
}

impl Patches {
    /// What is in patches may get elsewhere than was known.
    pub fn forget_runs(&mut self) {
        self.quads.forget(self.listed.len());
    }

    /// What was found of listed pairs of patches holds the less the more those went against each other.
    pub fn spend(&mut self) {
        if !self.quads.is_any_known {
            return;
        }
        for at in 0..self.listed.len() {
            if self.quads.runs[at].is_some() {
                let step = self.step_of(at as u32);
                if let Some(run) = &mut self.quads.runs[at] {
                    run.spent += step;
                }
            }
        }
        self.quads.tidy();
    }

    /// Finds what may meet of listed pair `at`, unless what was found holds still.
    pub fn find_run(&mut self, at: u32, rest_gap: &RestGap<'_>, motion: &Motion, more: f32) {
        let ways = self.ways_of(at, more);
        if let Some(run) = &self.quads.runs[at as usize] {
            // What went who knows how far leaves no room, however much there was.
            if run.spent + ways < run.room {
                return;
            }
            self.quads.live -= run.len();
        }
        let (pair, mesh) = (self.listed_pair(at), &rest_gap.world.mesh);
        pair.into_iter().for_each(|patch| self.split(patch, mesh, motion));
        let from = [self.quads.vertices.len() as u32, self.quads.edges.len() as u32];
        let [one, other] = pair;
        let is_crowded = self.listed.len() > CROWD * self.patches.len();
        let [share, of_way] = if is_crowded { [CROWDED; 2] } else { [ROOM, ROOM_WAY] };
        let room = ways + max(rest_gap.world.mean_edge * share, ways * of_way);
        let ours = self.chosen(one, other, room);
        let theirs = if one == other { ours } else { self.chosen(other, one, room) };
        let may_be_woven = self.are_near_at_rest(pair, rest_gap.near());
        let look = Look { rest_gap, motion, room, may_be_woven };
        self.find_vertices(pair, [ours.vertices, theirs.triangles], &look);
        if one != other {
            self.find_vertices([other, one], [theirs.vertices, ours.triangles], &look);
        }
        self.find_edges(pair, [ours.edges, theirs.edges], &look);
        let run = Run {
            vertices: [from[0], self.quads.vertices.len() as u32],
            edges: [from[1], self.quads.edges.len() as u32],
            room,
            spent: 0.0,
        };
        self.quads.live += run.len();
        self.quads.runs[at as usize] = Some(run);
        self.quads.is_any_known = true;
    }

    /// Adds what may meet of a kind in listed pair `at` in this substep to candidates.
    #[inline(always)]
    pub fn pick<const FIRST: Kind>(
        &self,
        at: u32,
        more: f32,
        candidates: &mut Candidates,
        is_wanted: impl Fn(&[u32; 4]) -> bool,
    ) {
        if let Some(run) = &self.quads.runs[at as usize] {
            let ways = run.spent + self.ways_of(at, more);
            if FIRST == VERTEX {
                self.quads.vertices.pick(run.vertices, ways, candidates, is_wanted);
            } else {
                self.quads.edges.pick(run.edges, ways, candidates, is_wanted);
            }
        }
    }

    /// Tells apart what is in a patch as the substep begins, unless that was done.
    fn split(&mut self, patch: u32, mesh: &Mesh, motion: &Motion) {
        let at = patch as usize;
        let patch = &mut self.patches[at];
        if patch.is_split {
            return;
        }
        patch.is_split = true;
        let [from, to] = patch.triangles;
        let (all, whole) = (&mut self.triangle_sweeps[at], &mut self.wholes[at]);
        (*all, *whole) = (Sweeps::EMPTY, Sweep::EMPTY);
        for (lane, triangle) in self.triangles[from as usize..to as usize].iter().enumerate() {
            let own = motion.still(mesh.triangles[*triangle as usize]);
            whole.join(&own);
            all.set(lane, &own);
        }
        let [from, to, _] = patch.vertices;
        let blocks = self.vertices[from as usize..to as usize].chunks(LANES);
        for (all, block) in self.vertex_sweeps[at].iter_mut().zip(blocks) {
            *all = Sweeps::EMPTY;
            for (lane, vertex) in block.iter().enumerate() {
                all.set(lane, &motion.still([*vertex]));
            }
        }
        let [from, to] = patch.edges;
        let blocks = self.edges[from as usize..to as usize].chunks(LANES);
        for (all, block) in self.edge_sweeps[at].iter_mut().zip(blocks) {
            *all = Sweeps::EMPTY;
            for (lane, ends) in block.iter().enumerate() {
                all.set(lane, &motion.still(*ends));
            }
        }
    }

    /// Which own vertices of one patch are as near as `room` to another one, which of its triangles, and which own edges.
    fn chosen(&self, one: u32, other: u32, room: f32) -> Chosen {
        let all = &self.wholes[other as usize];
        let at = one as usize;
        let patch = &self.patches[at];
        let (vertices, triangles, edges) = (patch.vertices, patch.triangles, patch.edges);
        let own = core::slice::from_ref(&self.triangle_sweeps[at]);
        Chosen {
            vertices: meet(&self.vertex_sweeps[at], vertices[1] - vertices[0], all, room),
            triangles: meet(own, triangles[1] - triangles[0], all, room),
            edges: meet(&self.edge_sweeps[at], edges[1] - edges[0], all, room),
        }
    }

    /// The own vertices of one patch and the triangles of another one.
    fn find_vertices(
        &mut self,
        [one, other]: [u32; 2],
        [vertices, triangles]: [u32; 2],
        look: &Look<'_>,
    ) {
        if triangles == 0 {
            return;
        }
        let Look { rest_gap, motion, room, .. } = look;
        let from = self.patches[one as usize].vertices[0];
        let first = self.patches[other as usize].triangles[0];
        let each = &self.triangle_sweeps[other as usize];
        for at in places_of(vertices) {
            let vertex = self.vertices[(from + at) as usize];
            for at in places_of(triangles & each.meet(&motion.still([vertex]), *room)) {
                let triangle = self.triangles[(first + at) as usize];
                let [a, b, c] = rest_gap.world.mesh.triangles[triangle as usize];
                if vertex != a && vertex != b && vertex != c {
                    let ids = [vertex, a, b, c];
                    self.quads.vertices.push(ids, look.gap_of::<VERTEX>(ids));
                }
            }
        }
    }

    /// The edges of two patches, each pair once.
    fn find_edges(&mut self, [one, other]: [u32; 2], [chosen, others]: [u32; 2], look: &Look<'_>) {
        if others == 0 {
            return;
        }
        let Look { motion, room, .. } = look;
        let from = self.patches[one as usize].edges[0];
        let first = self.patches[other as usize].edges[0];
        let blocks = &self.edge_sweeps[other as usize];
        for i in places_of(chosen) {
            let [p, q] = self.edges[(from + i) as usize];
            let own = motion.still([p, q]);
            for (at, block) in blocks.iter().enumerate() {
                let others = others >> (at * LANES) & LANE_BITS;
                if others == 0 {
                    continue;
                }
                for j in places_of(others & block.meet(&own, *room)) {
                    let j = j + (at * LANES) as u32;
                    let [r, s] = self.edges[(first + j) as usize];
                    let is_apart = p != r && p != s && q != r && q != s;
                    if is_apart && (one != other || i < j) {
                        let ids = [p, q, r, s];
                        self.quads.edges.push(ids, look.gap_of::<EDGES>(ids));
                    }
                }
            }
        }
    }

    /// Whether what is in two patches may be near at rest.
    fn are_near_at_rest(&self, pair: [u32; 2], near: f32) -> bool {
        let (a, b) = (&self.patches[pair[0] as usize], &self.patches[pair[1] as usize]);
        a.piece == b.piece && a.rest.expanded(near).overlaps(&b.rest)
    }
}
