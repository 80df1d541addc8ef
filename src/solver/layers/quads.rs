//! What may meet of two patches, pair by pair, in all that is left of a tick: found when patches first come near
//! each other, so that a substep has only to judge.

use super::candidates::Candidates;
use super::contacts::{EDGES, Kind, VERTEX};
use super::patches::Patches;
use super::reach::Reach;
use super::sweep::{LANES, Sweep, Sweeps, meet, places_of};
use super::weave::Weave;
use crate::mesh::Mesh;

/// The bits of a block of lanes.
const LANE_BITS: u32 = (1 << LANES) - 1;

/// The pairs in two patches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    /// Vertices with triangles, and edges with edges: from, to.
    pub vertices: [u32; 2],
    pub edges: [u32; 2],
}

/// All pairs found so far.
#[derive(Clone, Debug)]
pub(super) struct Quads {
    pub vertices: Candidates,
    pub edges: Candidates,
    /// Those of each listed pair of patches, once they are known.
    runs: Vec<Option<Run>>,
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
    weave: &'a Weave<'a>,
    reach: &'a Reach,
    /// Whether what is in them may be near at rest, so that it keeps a smaller gap.
    may_be_woven: bool,
}

impl Look<'_> {
    #[inline(always)]
    fn gap_of<const FIRST: Kind>(&self, ids: [u32; 4]) -> f32 {
        if self.may_be_woven { self.weave.gap_of::<FIRST>(ids) } else { self.weave.gap }
    }
}

impl Quads {
    pub fn new(count: usize) -> Self {
        let [vertices, edges] = [16, 48].map(|each| Candidates::new(each * count));
        Self { vertices, edges, runs: Vec::with_capacity(8 * count) }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let runs = size_of::<Option<Run>>() * self.runs.capacity();
        self.vertices.bytes() + self.edges.bytes() + runs
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.vertices.len() + self.edges.len()
    }

    /// Nothing is known of so many pairs of patches.
    pub fn forget(&mut self, pairs: usize) {
        self.vertices.clear();
        self.edges.clear();
        self.runs.clear();
        self.runs.resize(pairs, None);
    }
}

impl Patches {
    /// What is in patches may get elsewhere than was known.
    pub fn forget_runs(&mut self) {
        self.quads.forget(self.listed.len());
        self.patches.iter_mut().for_each(|patch| patch.is_split = false);
    }

    /// What may meet of listed pair `at`.
    pub fn run(&mut self, at: u32, weave: &Weave<'_>, reach: &Reach) -> Run {
        if let Some(run) = self.quads.runs[at as usize] {
            return run;
        }
        let (pair, mesh) = (self.listed_pair(at), &weave.world.mesh);
        pair.into_iter().for_each(|patch| self.split(patch, mesh, reach));
        let from = [self.quads.vertices.len() as u32, self.quads.edges.len() as u32];
        let [one, other] = pair;
        let ours = self.chosen(one, other, weave.gap);
        let theirs = if one == other { ours } else { self.chosen(other, one, weave.gap) };
        let look = Look { weave, reach, may_be_woven: self.are_near_at_rest(pair, weave.near()) };
        self.find_vertices(pair, [ours.vertices, theirs.triangles], &look);
        if one != other {
            self.find_vertices([other, one], [theirs.vertices, ours.triangles], &look);
        }
        self.find_edges(pair, [ours.edges, theirs.edges], &look);
        let run = Run {
            vertices: [from[0], self.quads.vertices.len() as u32],
            edges: [from[1], self.quads.edges.len() as u32],
        };
        self.quads.runs[at as usize] = Some(run);
        run
    }

    /// Tells apart what is in a patch, unless that was done.
    fn split(&mut self, patch: u32, mesh: &Mesh, reach: &Reach) {
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
            let own = reach.of(mesh.triangles[*triangle as usize]);
            whole.join(&own);
            all.set(lane, &own);
        }
        let [from, to, _] = patch.vertices;
        let blocks = self.vertices[from as usize..to as usize].chunks(LANES);
        for (all, block) in self.vertex_sweeps[at].iter_mut().zip(blocks) {
            *all = Sweeps::EMPTY;
            for (lane, vertex) in block.iter().enumerate() {
                all.set(lane, &reach.one(*vertex));
            }
        }
        let [from, to] = patch.edges;
        let blocks = self.edges[from as usize..to as usize].chunks(LANES);
        for (all, block) in self.edge_sweeps[at].iter_mut().zip(blocks) {
            *all = Sweeps::EMPTY;
            for (lane, ends) in block.iter().enumerate() {
                all.set(lane, &reach.of(*ends));
            }
        }
    }

    /// Which own vertices of one patch may meet another one, which of its triangles, and which own edges.
    fn chosen(&self, one: u32, other: u32, gap: f32) -> Chosen {
        let all = &self.wholes[other as usize];
        let at = one as usize;
        let patch = &self.patches[at];
        let (vertices, triangles, edges) = (patch.vertices, patch.triangles, patch.edges);
        let own = core::slice::from_ref(&self.triangle_sweeps[at]);
        Chosen {
            vertices: meet(&self.vertex_sweeps[at], vertices[1] - vertices[0], all, gap),
            triangles: meet(own, triangles[1] - triangles[0], all, gap),
            edges: meet(&self.edge_sweeps[at], edges[1] - edges[0], all, gap),
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
        let Look { weave, reach, .. } = look;
        let from = self.patches[one as usize].vertices[0];
        let first = self.patches[other as usize].triangles[0];
        let each = &self.triangle_sweeps[other as usize];
        for at in places_of(vertices) {
            let vertex = self.vertices[(from + at) as usize];
            for at in places_of(triangles & each.meet(&reach.one(vertex), weave.gap)) {
                let triangle = self.triangles[(first + at) as usize];
                let [a, b, c] = weave.world.mesh.triangles[triangle as usize];
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
        let Look { weave, reach, .. } = look;
        let from = self.patches[one as usize].edges[0];
        let first = self.patches[other as usize].edges[0];
        let blocks = &self.edge_sweeps[other as usize];
        for i in places_of(chosen) {
            let [p, q] = self.edges[(from + i) as usize];
            let own = reach.of([p, q]);
            for (at, block) in blocks.iter().enumerate() {
                let others = others >> (at * LANES) & LANE_BITS;
                if others == 0 {
                    continue;
                }
                for j in places_of(others & block.meet(&own, weave.gap)) {
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
        a.piece == b.piece && a.rest.grown(near).meets(&b.rest)
    }
}
