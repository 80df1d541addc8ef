//! The vertices, triangles and edges that may meet in a substep.
//!
//! Patches that may meet come from a tree (`patches`), what is in them is told apart by boxes, many at once
//! (`sweep`), and what is left is looked at closely (`contacts`). All goes by where particles are, in the order
//! of the mesh.

use super::contacts::{Contact, EDGES, Kind, VERTEX};
use super::motion::Motion;
use super::patches::Patches;
use super::slits::HAIR;
use super::sweep::LANES;
use crate::geom::aabb::Aabb;
use crate::math::{max, min};
use crate::solver::World;
use glam::Vec3;

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
        self.patches.pair(self.gap, pairs);
        for [one, other] in &*pairs {
            self.patches.split(*one, &self.world.mesh, self.motion);
            self.patches.split(*other, &self.world.mesh, self.motion);
            let is_woven = self.patches.is_near_at_rest([*one, *other], self.gap / WOVEN);
            self.vertices([*one, *other], is_woven, contacts);
            if one != other {
                self.vertices([*other, *one], is_woven, contacts);
            }
            self.edges([*one, *other], is_woven, contacts);
        }
    }

    /// The own vertices of one patch and the triangles of another one.
    fn vertices(&self, [one, other]: [u32; 2], is_woven: bool, contacts: &mut Vec<Contact>) {
        let patches = &*self.patches;
        let [from, to, _] = patches.patches[one as usize].vertices.map(|at| at as usize);
        let first = patches.patches[other as usize].triangles[0];
        let (all, each) = (patches.sweep(other), patches.triangle_sweeps(other));
        for vertex in &patches.vertices[from..to] {
            let own = self.motion.one(*vertex);
            if !own.meets(all, self.gap) {
                continue;
            }
            let mut bits = each.meet(&own, self.gap);
            while bits != 0 {
                let triangle = patches.triangles[(first + bits.trailing_zeros()) as usize];
                bits &= bits - 1;
                let [a, b, c] = self.world.mesh.triangles[triangle as usize];
                if *vertex != a && *vertex != b && *vertex != c {
                    self.look::<VERTEX>([*vertex, a, b, c], is_woven, contacts);
                }
            }
        }
    }

    /// The edges of two patches, each pair once.
    fn edges(&self, [one, other]: [u32; 2], is_woven: bool, contacts: &mut Vec<Contact>) {
        let patches = &*self.patches;
        let [from, to] = patches.patches[one as usize].edges;
        let [first, end] = patches.patches[other as usize].edges;
        let (all, blocks) = (patches.sweep(other), patches.edge_sweeps(other));
        let blocks = &blocks[..(end - first).div_ceil(LANES as u32) as usize];
        for i in from..to {
            let [p, q] = patches.edges[i as usize];
            let own = self.motion.of(&[p, q]);
            if !own.meets(all, self.gap) {
                continue;
            }
            for (block, start) in blocks.iter().zip((first..end).step_by(LANES)) {
                let mut bits = block.meet(&own, self.gap);
                while bits != 0 {
                    let j = start + bits.trailing_zeros();
                    bits &= bits - 1;
                    let [r, s] = patches.edges[j as usize];
                    let is_apart = p != r && p != s && q != r && q != s;
                    if is_apart && (one != other || i < j) {
                        self.look::<EDGES>([p, q, r, s], is_woven, contacts);
                    }
                }
            }
        }
    }

    #[inline(always)]
    fn look<const FIRST: Kind>(
        &self,
        ids: [u32; 4],
        is_woven: bool,
        contacts: &mut Vec<Contact>,
    ) {
        let gap = || if is_woven { self.own_gap::<FIRST>(ids) } else { self.gap };
        if let Some(contact) = Contact::find::<FIRST>(ids, self.motion, self.gap, gap) {
            contacts.push(contact);
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
