//! The pairs that may come near each other while no particle leaves the room that it was given.

use super::contacts::{of_all, places};
use super::patches::{PATCH, Patch, Patches};
use super::slits::HAIR;
use super::spots::{Spot, drift, place};
use crate::geom::aabb::Aabb;
use crate::geom::closest;
use crate::math::{max, min};
use crate::solver::World;
use glam::Vec3;

/// The room that each particle gets beyond what it needs at once: a share of the mean rest length, …
const ROOM: f32 = 0.02;

/// … and so many times what it needs, but no more than another share of the mean rest length.
const AHEAD: f32 = 1.5;
const MOST: f32 = 0.25;

/// Only a list of so little room outlasts a tick, as a share of the mean rest length: a patch that was flat may fold up
/// in more, and what is in it is listed from then on in a cloth that was saved and restored.
const LASTING: f32 = 0.1;

/// Listing anew begins a little before it must, which covers rounding.
const HASTE: f32 = 0.98;

/// Pairs of one piece keep no farther apart than this share of their distance at rest.
const WOVEN: f32 = 0.5;

/// A vertex and a triangle, or two edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pair {
    /// The vertex, then the corners; or the ends of one edge, then of the other.
    pub ids: [u32; 4],
    /// How far they were from each other when they were listed [m].
    pub distance: f32,
    /// How far they keep apart [m].
    pub gap: f32,
}

/// What is listed.
#[derive(Clone, Debug)]
pub(super) struct List {
    /// Vertices and triangles; edges and edges.
    pub pairs: [Vec<Pair>; 2],
    /// Where particles were, and the room they have around it [m].
    pub at: Vec<Spot>,
    pub room: Vec<f32>,
    /// Whether it is good for the next tick too.
    is_lasting: bool,
    boxes: [Vec<Aabb>; 3],
}

impl List {
    pub fn new(particles: usize, capacity: usize, triangles: usize) -> Self {
        let boxes = [capacity, triangles, 3 * triangles].map(Vec::with_capacity);
        Self {
            // As many as layers that lie on each other have; of more, lists grow.
            pairs: [Vec::with_capacity(20 * particles), Vec::with_capacity(56 * particles)],
            at: Vec::with_capacity(capacity),
            room: Vec::with_capacity(capacity),
            is_lasting: false,
            boxes,
        }
    }

    pub fn bytes(&self) -> usize {
        let pairs: usize = self.pairs.iter().map(Vec::capacity).sum();
        let boxes: usize = self.boxes.iter().map(Vec::capacity).sum();
        size_of::<Pair>() * pairs + size_of::<Aabb>() * boxes + 20 * self.room.capacity()
    }

    /// Nothing is known any more.
    pub fn forget(&mut self) {
        self.room.clear();
    }

    /// A tick begins: forgets what a cloth that was just restored would list otherwise.
    pub fn begin_tick(&mut self) {
        if !self.is_lasting {
            self.forget();
        }
    }

    /// Whether particles have the room they need around where they are, but for how all moved; `needs` gets what
    /// each needs from where it was.
    pub fn holds(&self, x: &[Spot], reach: &[f32], needs: &mut Vec<f32>) -> bool {
        if self.room.len() != x.len() {
            return false;
        }
        let drift = drift(&self.at, x);
        let mut holds = true;
        needs.clear();
        for ((x, at), (reach, room)) in x.iter().zip(&self.at).zip(reach.iter().zip(&self.room)) {
            let need = (place(x) - place(at) - drift).length() + reach;
            needs.push(need);
            holds &= need <= room * HASTE;
        }
        holds
    }

    /// Lists all anew around where particles are at `x`, of which each needs so much room.
    pub fn make(
        &mut self,
        world: &World,
        patches: &mut Patches,
        pieces: &[u32],
        x: &[Spot],
        needs: &[f32],
        gap: f32,
    ) {
        let spacing = world.spacing;
        self.at.clear();
        self.at.extend_from_slice(x);
        self.room.clear();
        let room = |need: &f32| need * 1.1 + min(need * AHEAD, spacing * MOST) + spacing * ROOM;
        self.room.extend(needs.iter().map(room));
        self.is_lasting = self.room.iter().all(|room| *room <= spacing * LASTING);
        patches.fit(&world.mesh, x, &self.room);
        let Self { pairs, at, room, boxes, .. } = self;
        let boxed = |ids: &[u32]| {
            let mut all = Aabb::EMPTY;
            for id in ids {
                let (x, room) = (place(&at[*id as usize]), Vec3::splat(room[*id as usize]));
                all.add(x - room);
                all.add(x + room);
            }
            all
        };
        let [of_vertices, of_triangles, of_edges] = boxes;
        of_vertices.clear();
        of_vertices.extend((0..x.len() as u32).map(|v| boxed(&[v]).grown(gap)));
        of_triangles.clear();
        of_triangles
            .extend(patches.triangles.iter().map(|t| boxed(&world.mesh.triangles[*t as usize])));
        of_edges.clear();
        of_edges.extend(patches.edges.iter().map(|ends| boxed(ends)));
        pairs.iter_mut().for_each(Vec::clear);
        let mut lister = Lister {
            world,
            pieces,
            at,
            room,
            gap,
            pairs,
            boxes: [of_vertices, of_triangles, of_edges],
            chosen: [NOTHING; 2],
        };
        patches.visit(gap, |patches, pair| {
            let [one, other] = pair.map(|patch| patches.patches[patch as usize]);
            let Some(place) = overlap(&one.bounds.grown(gap), &other.bounds.grown(gap)) else {
                return;
            };
            lister.choose(patches, [&one, &other], &place);
            lister.vertices(patches, 0);
            if pair[0] != pair[1] {
                lister.vertices(patches, 1);
            }
            lister.edges(patches, pair[0] == pair[1]);
        });
    }
}

/// What two boxes have in common.
fn overlap(a: &Aabb, b: &Aabb) -> Option<Aabb> {
    a.meets(b).then(|| Aabb { low: a.low.max(b.low), high: a.high.min(b.high) })
}

/// The parts of a patch that are where another patch may be.
#[derive(Clone, Copy)]
struct Chosen {
    vertices: Few<{ 3 * PATCH }>,
    triangles: Few<PATCH>,
    edges: Few<{ 3 * PATCH }>,
}

const NOTHING: Chosen = Chosen { vertices: Few::NONE, triangles: Few::NONE, edges: Few::NONE };

/// A few numbers.
#[derive(Clone, Copy)]
struct Few<const MOST: usize> {
    all: [u32; MOST],
    count: usize,
}

impl<const MOST: usize> Few<MOST> {
    const NONE: Self = Self { all: [0; MOST], count: 0 };

    #[inline(always)]
    fn choose(&mut self, from: u32, to: u32, is_in: impl Fn(u32) -> bool) {
        self.count = 0;
        for at in from..to {
            self.all[self.count] = at;
            self.count += usize::from(is_in(at));
        }
    }

    #[inline(always)]
    fn all(&self) -> &[u32] {
        &self.all[..self.count]
    }
}

struct Lister<'a> {
    world: &'a World,
    pieces: &'a [u32],
    at: &'a [Spot],
    room: &'a [f32],
    gap: f32,
    pairs: &'a mut [Vec<Pair>; 2],
    boxes: [&'a [Aabb]; 3],
    chosen: [Chosen; 2],
}

impl Lister<'_> {
    /// Chooses what of two patches is in a place.
    fn choose(&mut self, patches: &Patches, pair: [&Patch; 2], place: &Aabb) {
        let [of_vertices, of_triangles, of_edges] = self.boxes;
        for (chosen, patch) in self.chosen.iter_mut().zip(pair) {
            let [from, to, _] = patch.vertices;
            let vertex = |at: u32| patches.vertices[at as usize] as usize;
            chosen.vertices.choose(from, to, |at| of_vertices[vertex(at)].meets(place));
            let [from, to] = patch.triangles;
            chosen.triangles.choose(from, to, |at| of_triangles[at as usize].meets(place));
            let [from, to] = patch.edges;
            chosen.edges.choose(from, to, |at| of_edges[at as usize].meets(place));
        }
    }

    /// Lists the own vertices of one patch with the triangles of the other one.
    fn vertices(&mut self, patches: &Patches, one: usize) {
        let (chosen, others) = (self.chosen[one], self.chosen[1 - one]);
        for at in chosen.vertices.all() {
            let vertex = patches.vertices[*at as usize];
            let own = self.boxes[0][vertex as usize];
            for at in others.triangles.all() {
                if !own.meets(&self.boxes[1][*at as usize]) {
                    continue;
                }
                let [a, b, c] = self.world.mesh.triangles[patches.triangles[*at as usize] as usize];
                if vertex != a && vertex != b && vertex != c {
                    self.list_vertex([vertex, a, b, c]);
                }
            }
        }
    }

    fn edges(&mut self, patches: &Patches, is_same: bool) {
        let [chosen, others] = self.chosen;
        for i in chosen.edges.all() {
            let own = self.boxes[2][*i as usize].grown(self.gap);
            let [p, q] = patches.edges[*i as usize];
            for j in others.edges.all() {
                let [r, s] = patches.edges[*j as usize];
                if own.meets(&self.boxes[2][*j as usize])
                    && (!is_same || i < j)
                    && p != r
                    && p != s
                    && q != r
                    && q != s
                {
                    self.list_edges([p, q, r, s]);
                }
            }
        }
    }

    fn list_vertex(&mut self, ids: [u32; 4]) {
        let room = of_all(self.room, ids);
        let reach = room[0] + max(room[1], max(room[2], room[3]));
        let distance = vertex_distance(places(self.at, ids));
        if distance <= self.gap + reach {
            let gap = self.own_gap(ids, 1, vertex_distance);
            self.pairs[0].push(Pair { ids, distance, gap });
        }
    }

    fn list_edges(&mut self, ids: [u32; 4]) {
        let room = of_all(self.room, ids);
        let reach = max(room[0], room[1]) + max(room[2], room[3]);
        let distance = edge_distance(places(self.at, ids));
        if distance <= self.gap + reach {
            let gap = self.own_gap(ids, 2, edge_distance);
            self.pairs[1].push(Pair { ids, distance, gap });
        }
    }

    /// What is near at rest keeps a smaller gap.
    fn own_gap(&self, ids: [u32; 4], first: usize, distance: impl Fn([Vec3; 4]) -> f32) -> f32 {
        let [a, b, c, d] = ids;
        let site = |id: u32| self.world.mesh.source[id as usize] as usize;
        let sites = [site(a), site(b), site(c), site(d)];
        if self.pieces[sites[0]] != self.pieces[sites[3]] {
            return self.gap;
        }
        let rest = |at: usize| self.world.rest[sites[at]];
        let x = [rest(0), rest(1), rest(2), rest(3)];
        let (one, other) = x.split_at(first);
        let sides = [one, other].map(|side| Aabb::around(side.iter().copied()));
        if !sides[0].grown(self.gap / WOVEN).meets(&sides[1]) {
            return self.gap;
        }
        // The sides of a slit are at the same place at rest, and a hair apart as they part.
        let least = self.world.spacing * (WOVEN * HAIR);
        min(self.gap, max(WOVEN * distance(x), least))
    }
}

#[inline(always)]
fn vertex_distance([v, a, b, c]: [Vec3; 4]) -> f32 {
    let corners = [a - v, b - v, c - v];
    closest::blend(corners, closest::of_triangle(corners)).length()
}

#[inline(always)]
fn edge_distance([p, q, r, s]: [Vec3; 4]) -> f32 {
    let (along, across) = closest::of_segments([p, q], [r, s]);
    (p - r + (q - p) * along - (s - r) * across).length()
}
