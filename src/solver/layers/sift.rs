//! The vertices, triangles and edges that may meet in a substep.
//!
//! Patches that may meet come from a tree (`patches`), what is in them is told apart by boxes, many at once
//! (`sweep`), and what is left is looked at closely (`contacts`). All goes by where particles are, in the order
//! of the mesh.

use super::candidates::{Candidate, Candidates};
use super::contacts::{Contact, EDGES, Kind, VERTEX};
use super::motion::Motion;
use super::distant::Distant;
use super::near::Near;
use super::patches::Patches;
use super::push::NEAR;
use super::quads::{Quads, Run};
use super::reach::Reach;
use super::slits::HAIR;
use super::sweep::LANES;
use crate::geom::aabb::Aabb;
use crate::math::{max, min};
use crate::solver::World;
use glam::Vec3;

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
    pub reach: &'a Reach,
    pub candidacy: &'a mut Candidacy,
    /// How far layers keep apart [m].
    pub gap: f32,
}

impl Sift<'_> {
    /// Finds all that may meet; of these `distant` gets what is too far from each other to push.
    pub fn find(
        &mut self,
        pairs: &mut Vec<u32>,
        near: &mut [Near; 2],
        contacts: &mut Vec<Contact>,
        distant: &mut Vec<Distant>,
    ) {
        contacts.clear();
        distant.clear();
        self.patches.fit(&self.world.mesh, self.motion);
        self.patches.pair(self.gap, false, pairs);
        for at in &*pairs {
            self.run(*at);
        }
        let Quads { vertices, edges, .. } = &mut self.patches.quads;
        vertices.judge::<VERTEX>(self.world.level, self.motion, self.gap);
        edges.judge::<EDGES>(self.world.level, self.motion, self.gap);
        for at in &*pairs {
            let run = self.run(*at);
            let Quads { vertices, edges, .. } = &self.patches.quads;
            let is_woven = run.is_woven;
            let [v, e] = &mut *near;
            self.tell_distant::<VERTEX>(vertices, run.vertices, is_woven, v, contacts, distant);
            self.tell_distant::<EDGES>(edges, run.edges, is_woven, e, contacts, distant);
        }
        let (level, motion, gap) = (self.world.level, self.motion, self.gap);
        let unsure = |ids| self.contact::<VERTEX>(ids, false);
        near[0].finish::<VERTEX>(level, motion, gap, contacts, unsure);
        let unsure = |ids| self.contact::<EDGES>(ids, false);
        near[1].finish::<EDGES>(level, motion, gap, contacts, unsure);
    }

    /// What may meet of a listed pair of patches.
    fn run(&mut self, at: u32) -> Run {
        let near = self.gap / WOVEN;
        self.patches.run(at, &self.world.mesh, self.reach, self.gap, near)
    }

    #[inline(always)]
    fn tell_distant<const FIRST: Kind>(
        &self,
        candidates: &Candidates,
        [from, to]: [u32; 2],
        is_woven: bool,
        near: &mut Near,
        contacts: &mut Vec<Contact>,
        distant: &mut Vec<Distant>,
    ) {
        let far = self.gap * NEAR[FIRST as usize - 1];
        for candidate in candidates.meeting(from, to) {
            let Candidate { ids, n, distance } = candidate;
            if distance >= far {
                distant.push(Distant { ids, first: FIRST, is_woven, n });
            } else if !is_woven {
                near.push(ids, FIRST, contacts);
            } else {
                contacts.extend(self.contact::<FIRST>(ids, is_woven));
            }
        }
    }

    /// Adds what of the distant is apart no more, or all of it.
    pub fn find_distant(
        &mut self,
        distant: &mut Vec<Distant>,
        all: bool,
        contacts: &mut Vec<Contact>,
    ) {
        distant.retain(|pair| {
            let stays = !all && pair.is_apart(&self.motion.now, self.gap);
            if !stays {
                contacts.extend(if pair.first == VERTEX {
                    self.contact::<VERTEX>(pair.ids, pair.is_woven)
                } else {
                    self.contact::<EDGES>(pair.ids, pair.is_woven)
                });
            }
            stays
        });
    }

    /// Adds to the distant what those may meet that strayed.
    pub fn find_strays(&mut self, pairs: &mut Vec<u32>, distant: &mut Vec<Distant>) {
        self.patches.follow_strays(self.motion);
        self.patches.pair(self.gap, true, pairs);
        for at in &*pairs {
            let run = self.run(*at);
            let Candidacy { vertices, edges, runs } = &mut *self.candidacy;
            let quads = &self.patches.quads;
            for (to, from, [first, end]) in [
                (&mut *vertices, &quads.vertices, run.vertices),
                (&mut *edges, &quads.edges, run.edges),
            ] {
                let own = (first..end).map(|at| from.ids(at as usize));
                own.filter(|ids| ids.iter().any(|id| self.motion.strays(*id)))
                    .for_each(|ids| to.push(ids));
            }
            let counts = [vertices.len() as u32, edges.len() as u32];
            if runs.last().map_or([0; 2], |(before, _)| *before) == counts {
                continue;
            }
            runs.push((counts, run.is_woven));
            if counts[0].max(counts[1]) > TOGETHER as u32 {
                self.judge(distant);
            }
        }
        self.judge(distant);
    }

    /// Judges the strays so far.
    fn judge(&mut self, distant: &mut Vec<Distant>) {
        let Candidacy { vertices, edges, runs } = &mut *self.candidacy;
        vertices.judge::<VERTEX>(self.world.level, self.motion, self.gap);
        edges.judge::<EDGES>(self.world.level, self.motion, self.gap);
        let mut from = [0; 2];
        for (to, is_woven) in runs.iter() {
            for (first, candidates, k) in [(VERTEX, &*vertices, 0), (EDGES, &*edges, 1)] {
                let own = candidates.meeting(from[k], to[k]);
                distant.extend(own.map(|Candidate { ids, n, .. }| Distant {
                    ids,
                    first,
                    is_woven: *is_woven,
                    n,
                }));
            }
            from = *to;
        }
        vertices.clear();
        edges.clear();
        runs.clear();
    }

    #[inline(always)]
    fn contact<const FIRST: Kind>(&self, ids: [u32; 4], is_woven: bool) -> Option<Contact> {
        let gap = || if is_woven { self.own_gap::<FIRST>(ids) } else { self.gap };
        Contact::find::<FIRST>(ids, self.motion, self.gap, gap)
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
