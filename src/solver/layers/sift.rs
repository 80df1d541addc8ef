//! The vertices, triangles and edges that may meet in a substep.
//!
//! Patches that may meet come from a tree (`patches`), what is in them is told apart by boxes, many at once
//! (`sweep`), and what is left is looked at closely (`contacts`). All goes by where particles are, in the order
//! of the mesh.

use super::candidates::Candidates;
use super::contacts::{Contact, EDGES, Kind, VERTEX};
use super::motion::Motion;
use super::patches::{Chosen, Patches};
use super::slits::HAIR;
use super::sweep::{LANES, places_of};
use crate::geom::aabb::Aabb;
use crate::math::{max, min};
use crate::solver::World;
use glam::Vec3;

/// The bits of a block of lanes.
const LANE_BITS: u32 = (1 << LANES) - 1;

/// Pairs of one piece keep no farther apart than this share of their distance at rest.
const WOVEN: f32 = 0.5;

/// So many pairs that boxes do not tell apart are judged together; two patches make at most `MANY` more.
const TOGETHER: usize = 1024;
const MANY: usize = (3 * LANES) * (3 * LANES);

/// Pairs that boxes do not tell apart.
#[derive(Clone, Debug)]
pub(super) struct Candidacy {
    vertices: Candidates,
    edges: Candidates,
    /// How many of both there were after each two patches, and whether those are near at rest.
    runs: Vec<([u32; 2], bool)>,
}

impl Candidacy {
    pub fn new() -> Self {
        let [vertices, edges] = [(); 2].map(|()| Candidates::new(TOGETHER + MANY));
        Self { vertices, edges, runs: Vec::with_capacity(2 * (TOGETHER + MANY)) }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let runs = size_of::<([u32; 2], bool)>() * self.runs.capacity();
        self.vertices.bytes() + self.edges.bytes() + runs
    }
}

pub(super) struct Sift<'a> {
    pub world: &'a World,
    /// The piece that each site was part of before anything tore.
    pub pieces: &'a [u32],
    pub patches: &'a mut Patches,
    pub motion: &'a Motion,
    pub candidacy: &'a mut Candidacy,
    /// How far layers keep apart [m].
    pub gap: f32,
}

impl Sift<'_> {
    /// Finds all that may meet.
    pub fn find(&mut self, pairs: &mut Vec<[u32; 2]>, contacts: &mut Vec<Contact>) {
        contacts.clear();
        self.patches.fit(&self.world.mesh, self.motion);
        self.patches.pair(self.gap, false, pairs);
        self.look(pairs, false, contacts);
    }

    /// Adds what those may meet that strayed.
    pub fn find_strays(&mut self, pairs: &mut Vec<[u32; 2]>, contacts: &mut Vec<Contact>) {
        self.patches.follow_strays(self.motion);
        self.patches.pair(self.gap, true, pairs);
        self.look(pairs, true, contacts);
    }

    fn look(&mut self, pairs: &[[u32; 2]], strays: bool, contacts: &mut Vec<Contact>) {
        for [one, other] in pairs {
            self.patches.split(*one, &self.world.mesh, self.motion);
            self.patches.split(*other, &self.world.mesh, self.motion);
            let ours = self.patches.chosen(*one, *other, self.gap);
            let theirs =
                if one == other { ours } else { self.patches.chosen(*other, *one, self.gap) };
            let can_meet = |vertices, triangles| vertices != 0 && triangles != 0;
            if !can_meet(ours.vertices, theirs.triangles)
                && !can_meet(theirs.vertices, ours.triangles)
                && !can_meet(ours.edges, theirs.edges)
            {
                continue;
            }
            let chosen = [ours, theirs];
            let mut look = Look { sift: self, chosen, strays };
            look.vertices([*one, *other], [0, 1]);
            if one != other {
                look.vertices([*other, *one], [1, 0]);
            }
            look.edges([*one, *other]);
            let is_woven = self.patches.is_near_at_rest([*one, *other], self.gap / WOVEN);
            let Candidacy { vertices, edges, runs } = &mut *self.candidacy;
            let counts = [vertices.len(), edges.len()];
            let counts = counts.map(|count| count as u32);
            if runs.last().map_or([0; 2], |(before, _)| *before) == counts {
                continue;
            }
            runs.push((counts, is_woven));
            if counts[0].max(counts[1]) > TOGETHER as u32 {
                self.judge(contacts);
            }
        }
        self.judge(contacts);
    }

    /// Judges the pairs so far, and looks closely at those that are not told apart.
    fn judge(&mut self, contacts: &mut Vec<Contact>) {
        let Candidacy { vertices, edges, .. } = &mut *self.candidacy;
        vertices.judge::<VERTEX>(self.world.level, self.motion, self.gap);
        edges.judge::<EDGES>(self.world.level, self.motion, self.gap);
        let Candidacy { vertices, edges, runs } = &*self.candidacy;
        let mut from = [0; 2];
        for (to, is_woven) in runs {
            self.look_closely::<VERTEX>(vertices, [from[0], to[0]], *is_woven, contacts);
            self.look_closely::<EDGES>(edges, [from[1], to[1]], *is_woven, contacts);
            from = *to;
        }
        let Candidacy { vertices, edges, runs } = &mut *self.candidacy;
        vertices.clear();
        edges.clear();
        runs.clear();
    }

    #[inline(always)]
    fn look_closely<const FIRST: Kind>(
        &self,
        candidates: &Candidates,
        [from, to]: [u32; 2],
        is_woven: bool,
        contacts: &mut Vec<Contact>,
    ) {
        for ids in (from..to).filter_map(|at| candidates.may_meet(at as usize)) {
            let gap = || if is_woven { self.own_gap::<FIRST>(ids) } else { self.gap };
            contacts.extend(Contact::find::<FIRST>(ids, self.motion, self.gap, gap));
        }
    }

    /// What is near at rest keeps a smaller gap.
    fn own_gap<const FIRST: Kind>(&self, ids: [u32; 4]) -> f32 {
        let [a, b, c, d] = ids;
        let site = |id: u32| self.world.mesh.source[id as usize] as usize;
        let sites = [site(a), site(b), site(c), site(d)];
        if self.pieces[sites[0]] != self.pieces[sites[3]] {
            return self.gap;
        }
        let rest = |at: usize| self.world.rest[sites[at]];
        let x = [rest(0), rest(1), rest(2), rest(3)];
        let (one, other) = x.split_at(FIRST as usize);
        let sides = [one, other].map(|side: &[Vec3]| Aabb::around(side.iter().copied()));
        if !sides[0].grown(self.gap / WOVEN).meets(&sides[1]) {
            return self.gap;
        }
        // The sides of a slit are at the same place at rest, and a hair apart as they part.
        let least = self.world.spacing * (WOVEN * HAIR);
        min(self.gap, max(WOVEN * Contact::distance::<FIRST>(x), least))
    }
}

/// A look at two patches.
struct Look<'a, 'b> {
    sift: &'a mut Sift<'b>,
    chosen: [Chosen; 2],
    /// Whether only those count that strayed.
    strays: bool,
}

impl Look<'_, '_> {
    /// The own vertices of one patch and the triangles of another one.
    fn vertices(&mut self, [one, other]: [u32; 2], side: [usize; 2]) {
        let (vertices, triangles) = (self.chosen[side[0]].vertices, self.chosen[side[1]].triangles);
        if vertices == 0 || triangles == 0 {
            return;
        }
        let Sift { patches, motion, world, candidacy, gap, .. } = &mut *self.sift;
        let (patches, gap) = (&**patches, *gap);
        let (from, first) = (
            patches.patches[one as usize].vertices[0],
            patches.patches[other as usize].triangles[0],
        );
        let each = patches.triangle_sweeps(other);
        for at in places_of(vertices) {
            let vertex = patches.vertices[(from + at) as usize];
            for at in places_of(triangles & each.meet(&motion.one(vertex), gap)) {
                let triangle = patches.triangles[(first + at) as usize];
                let [a, b, c] = world.mesh.triangles[triangle as usize];
                let ids = [vertex, a, b, c];
                if vertex != a && vertex != b && vertex != c && counts(motion, self.strays, ids) {
                    candidacy.vertices.push(ids);
                }
            }
        }
    }

    /// The edges of two patches, each pair once.
    fn edges(&mut self, [one, other]: [u32; 2]) {
        let [chosen, others] = [self.chosen[0].edges, self.chosen[1].edges];
        if chosen == 0 || others == 0 {
            return;
        }
        let Sift { patches, motion, candidacy, gap, .. } = &mut *self.sift;
        let (patches, gap) = (&**patches, *gap);
        let (from, first) =
            (patches.patches[one as usize].edges[0], patches.patches[other as usize].edges[0]);
        let blocks = patches.edge_sweeps(other);
        for i in places_of(chosen) {
            let [p, q] = patches.edges[(from + i) as usize];
            let own = motion.of([p, q]);
            for (at, block) in blocks.iter().enumerate() {
                let others = others >> (at * LANES) & LANE_BITS;
                if others == 0 {
                    continue;
                }
                for j in places_of(others & block.meet(&own, gap)) {
                    let j = j + (at * LANES) as u32;
                    let [r, s] = patches.edges[(first + j) as usize];
                    let is_apart = p != r && p != s && q != r && q != s;
                    let is_first = one != other || i < j;
                    if is_apart && is_first && counts(motion, self.strays, [p, q, r, s]) {
                        candidacy.edges.push([p, q, r, s]);
                    }
                }
            }
        }
    }
}

/// Whether a pair counts, where only those may that strayed.
#[inline(always)]
fn counts(motion: &Motion, strays: bool, ids: [u32; 4]) -> bool {
    !strays || ids.iter().any(|id| motion.strays(*id))
}
