//! The vertices, triangles and edges that may meet in a substep.
//!
//! Patches that may meet come from a tree (`patches`), what is in them is told apart by boxes, many at once
//! (`sweep`), and what is left is looked at closely (`contacts`). All goes by where particles are, in the order
//! of the mesh.

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

pub(super) struct Sift<'a> {
    pub world: &'a World,
    /// The piece that each site was part of before anything tore.
    pub pieces: &'a [u32],
    pub patches: &'a mut Patches,
    pub motion: &'a Motion,
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
            let is_woven = self.patches.is_near_at_rest([*one, *other], self.gap / WOVEN);
            let mut look = Look { sift: self, chosen, is_woven, strays, contacts };
            look.vertices([*one, *other], [0, 1]);
            if one != other {
                look.vertices([*other, *one], [1, 0]);
            }
            look.edges([*one, *other]);
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
struct Look<'a> {
    sift: &'a Sift<'a>,
    chosen: [Chosen; 2],
    is_woven: bool,
    /// Whether only those count that strayed.
    strays: bool,
    contacts: &'a mut Vec<Contact>,
}

impl Look<'_> {
    /// The own vertices of one patch and the triangles of another one.
    fn vertices(&mut self, [one, other]: [u32; 2], side: [usize; 2]) {
        let (vertices, triangles) = (self.chosen[side[0]].vertices, self.chosen[side[1]].triangles);
        if vertices == 0 || triangles == 0 {
            return;
        }
        let sift = self.sift;
        let patches = &*sift.patches;
        let (from, first) = (
            patches.patches[one as usize].vertices[0],
            patches.patches[other as usize].triangles[0],
        );
        let each = patches.triangle_sweeps(other);
        for at in places_of(vertices) {
            let vertex = patches.vertices[(from + at) as usize];
            for at in places_of(triangles & each.meet(&sift.motion.one(vertex), sift.gap)) {
                let triangle = patches.triangles[(first + at) as usize];
                let [a, b, c] = sift.world.mesh.triangles[triangle as usize];
                if vertex != a && vertex != b && vertex != c {
                    self.look::<VERTEX>([vertex, a, b, c]);
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
        let sift = self.sift;
        let patches = &*sift.patches;
        let (from, first) =
            (patches.patches[one as usize].edges[0], patches.patches[other as usize].edges[0]);
        let blocks = patches.edge_sweeps(other);
        for i in places_of(chosen) {
            let [p, q] = patches.edges[(from + i) as usize];
            let own = sift.motion.of([p, q]);
            for (at, block) in blocks.iter().enumerate() {
                let others = others >> (at * LANES) & LANE_BITS;
                if others == 0 {
                    continue;
                }
                for j in places_of(others & block.meet(&own, sift.gap)) {
                    let j = j + (at * LANES) as u32;
                    let [r, s] = patches.edges[(first + j) as usize];
                    let is_apart = p != r && p != s && q != r && q != s;
                    if is_apart && (one != other || i < j) {
                        self.look::<EDGES>([p, q, r, s]);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn look<const FIRST: Kind>(&mut self, ids: [u32; 4]) {
        let sift = self.sift;
        if self.strays && !ids.iter().any(|id| sift.motion.strays(*id)) {
            return;
        }
        let gap = || if self.is_woven { sift.own_gap::<FIRST>(ids) } else { sift.gap };
        if let Some(contact) = Contact::find::<FIRST>(ids, sift.motion, sift.gap, gap) {
            self.contacts.push(contact);
        }
    }
}
