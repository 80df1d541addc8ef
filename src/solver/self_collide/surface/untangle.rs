//! Where a surface already goes through itself, it is drawn out again.
//!
//! ```text
//!          q ●                    Edge p q goes through triangle T. Without the edges that go through
//!            │    ▲ n             something, p hangs together with less of the cloth than q, so p is
//!   T ───────┼────┴──             what got through: it goes back along T's normal n, to q's side.
//!          p ●                    Where both hang together still, the edge goes along the line in which
//!                                 surfaces cross, so that it becomes shorter.
//! ```
//!
//! What got through is found as in Baraff, Witkin and Kass, "Untangling cloth", 2003; the line becomes shorter as in
//! Volino and Magnenat-Thalmann, "Resolving surface collisions through intersection contour minimization", 2006, but
//! only along itself: what leads off it, where surfaces hardly cross, is little else than noise. What tells sides
//! apart would keep them crossed, so that much of it is let be meanwhile.

use crate::geometry::aabb::Aabb;
use crate::math::columns::Columns;
use crate::math::sort::sort;
use crate::math::wide4::{Float4, xyz};
use crate::math::{TINY, min};
use crate::mesh::{Fan, Mesh, triangle_of};
use crate::solver::particle_stage::interleaved::shift;
use crate::solver::self_collide::surface::cluster_bvh::Patches;
use crate::solver::self_collide::surface::contact::{Contact, NOTHING};
use crate::solver::self_collide::surface::contact_solver::Weight;
use crate::solver::self_collide::surface::speculative::Distant;
use crate::solver::self_collide::surface::swept_particles::Motion;
use glam::Vec3;

/// How fast crossed sides are drawn out [mean rest lengths per second], and how far at most in a substep [mean rest
/// lengths].
const PACE: f32 = 40.0;
const STEP: f32 = 1.0 / 6.0;

/// A part of all patches is looked at in each tick, so that in so many ticks all were.
const ROUND: u32 = 16;

/// What a particle is in crossings: it got through; it is of a triangle that something got through, or beside that; it
/// is of what crosses where nobody knows what got through; the line along which surfaces cross ends there, since they
/// hang together.
const INNER: u8 = 1;
const PIERCED: u8 = 2;
const LOOSE: u8 = 4;
const HUB: u8 = 8;

/// An edge that goes through a triangle.
#[derive(Clone, Copy, Debug)]
struct Crossing {
    /// The edge, and the triangle.
    ids: [u32; 5],
    /// What each counts for where they meet, or of the edge the end that got through alone: from 0 up on the edge,
    /// below 0 on the triangle.
    share: [f32; 5],
    /// Where the edge is to go against the triangle, and how far in a substep [m].
    way: Vec3,
    by: f32,
}

/// All crossings of a cloth.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tangles {
    crossings: Vec<Crossing>,
    /// What each particle is in them.
    parts: Vec<u8>,
    /// The first particle of the lot that each hangs together with by edges that cross nothing, and how many those are.
    lots: Vec<u32>,
    counts: Vec<u32>,
    /// The edges that cross something, in order.
    cut: Vec<[u32; 2]>,
    fan: Fan,
}

impl Tangles {
    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let fan = self.fan.corners.capacity() + self.fan.ring.capacity();
        let words = self.lots.capacity() + self.counts.capacity() + 2 * self.cut.capacity() + fan;
        size_of::<Crossing>() * self.crossings.capacity() + self.parts.capacity() + 4 * words
    }

    pub fn is_empty(&self) -> bool {
        self.crossings.is_empty()
    }

    pub fn clear(&mut self) {
        self.crossings.clear();
    }

    /// Whether anything crosses in the patches that are due in a tick, as a substep begins in which these `pairs` of
    /// them may meet.
    pub fn look_round(
        &mut self,
        mesh: &Mesh,
        patches: &Patches,
        pairs: &[u32],
        start: &[Float4],
        tick: u32,
    ) -> bool {
        self.list(mesh, patches, pairs, start, Some(tick % ROUND));
        !self.is_empty()
    }

    /// Finds all crossings as a substep begins of length `h` [s], among these `pairs` of patches that may meet in it,
    /// and how each is drawn out. `gap` is what sides keep, `spacing` the mean rest length [m].
    pub fn find(
        &mut self,
        mesh: &Mesh,
        (patches, pairs): (&Patches, &[u32]),
        start: &[Float4],
        [gap, spacing, h]: [f32; 3],
    ) {
        self.list(mesh, patches, pairs, start, None);
        if self.is_empty() {
            return;
        }
        self.parts.clear();
        self.parts.resize(start.len(), 0);
        self.find_hubs(mesh);
        self.find_lots(patches, start.len());
        let most = spacing * min(PACE * h, STEP);
        for at in 0..self.crossings.len() {
            let crossing = self.crossings[at];
            self.crossings[at] = self
                .push_out(&crossing, mesh, start, gap, most)
                .unwrap_or_else(|| self.shorten(&crossing, mesh, start, most));
        }
    }

    /// Lists the crossings in pairs of patches whose first is due, or in all.
    #[inline(never)]
    fn list(
        &mut self,
        mesh: &Mesh,
        patches: &Patches,
        pairs: &[u32],
        x: &[Float4],
        due: Option<u32>,
    ) {
        self.crossings.clear();
        for at in pairs {
            let [one, other] = patches.listed_pair(*at);
            if due.is_none_or(|due| one % ROUND == due) {
                self.look(mesh, patches, [one, other], x);
                if one != other {
                    self.look(mesh, patches, [other, one], x);
                }
            }
        }
    }

    /// Finds the own edges of one patch that go through triangles of the other.
    #[inline(never)]
    fn look(&mut self, mesh: &Mesh, patches: &Patches, [one, other]: [u32; 2], x: &[Float4]) {
        let at = |id: u32| xyz(&x[id as usize]);
        let [from, to] = patches.patches[one as usize].edges;
        let edges = &patches.edges[from as usize..to as usize];
        let [from, to] = patches.patches[other as usize].triangles;
        let triangles = &patches.triangles[from as usize..to as usize];
        let sweep = &patches.sweeps[other as usize];
        let whole = Aabb { low: xyz(&sweep.low), high: xyz(&sweep.high) };
        for ends in edges {
            let edge = ends.map(at);
            let bounds = Aabb::from_points(edge);
            if !whole.overlaps(&bounds) {
                continue;
            }
            for triangle in triangles {
                let corners = mesh.triangles[*triangle as usize];
                let all = corners.map(at);
                let are_joined = corners.iter().any(|corner| ends.contains(corner));
                if are_joined || !Aabb::from_points(all).overlaps(&bounds) {
                    continue;
                }
                if let Some(share) = pierces(edge, all) {
                    let ([p, q], [a, b, c]) = (*ends, corners);
                    let ids = [p, q, a, b, c];
                    self.crossings.push(Crossing { ids, share, way: Vec3::ZERO, by: 0.0 });
                }
            }
        }
    }

    /// Marks where lines end along which surfaces cross: at a common corner of two triangles that do.
    fn find_hubs(&mut self, mesh: &Mesh) {
        for crossing in &self.crossings {
            let [p, q, corners @ ..] = crossing.ids;
            for third in beside([p, q], mesh, &mut self.fan) {
                if corners.contains(&third) {
                    self.parts[third as usize] |= HUB;
                }
            }
        }
    }

    /// Finds what hangs together without the edges that cross something, and without hubs.
    fn find_lots(&mut self, patches: &Patches, particles: usize) {
        self.cut.clear();
        self.cut.extend(self.crossings.iter().map(|crossing| [crossing.ids[0], crossing.ids[1]]));
        sort(&mut self.cut);
        self.lots.clear();
        self.lots.extend(0..particles as u32);
        for ends in &patches.edges {
            if !self.has_hub(*ends) && self.cut.binary_search(ends).is_err() {
                let [one, other] = ends.map(|end| first_of(&mut self.lots, end));
                self.lots[one.max(other) as usize] = one.min(other);
            }
        }
        self.counts.clear();
        self.counts.resize(particles, 0);
        for at in 0..particles as u32 {
            let first = first_of(&mut self.lots, at);
            self.counts[first as usize] += 1;
        }
    }

    fn has_hub(&self, ends: [u32; 2]) -> bool {
        ends.into_iter().any(|end| self.parts[end as usize] & HUB != 0)
    }

    /// The end that hangs together with less goes back to the other's side, if they do not hang together.
    fn push_out(
        &mut self,
        crossing: &Crossing,
        mesh: &Mesh,
        x: &[Float4],
        gap: f32,
        most: f32,
    ) -> Option<Crossing> {
        let at = |id: u32| xyz(&x[id as usize]);
        let [p, q, corners @ ..] = crossing.ids;
        let lots = [p, q].map(|end| first_of(&mut self.lots, end));
        if lots[0] == lots[1] || self.has_hub([p, q]) {
            return None;
        }
        let [size_p, size_q] = lots.map(|first| (self.counts[first as usize], first));
        let goes_first = size_p < size_q;
        let inner = if goes_first { p } else { q };
        self.parts[inner as usize] |= INNER;
        for corner in corners {
            self.parts[corner as usize] |= PIERCED;
            mesh.gather_fan(mesh.corner_of[corner as usize], &mut self.fan);
            for beside in &self.fan.ring {
                self.parts[*beside as usize] |= PIERCED;
            }
        }
        let [_, _, a, b, c] = crossing.share;
        let share = if goes_first { [1.0, 0.0, a, b, c] } else { [0.0, 1.0, a, b, c] };
        let normal = normal(corners.map(at));
        let over = normal.dot(at(inner) - at(corners[0]));
        let way = if over > 0.0 { -normal } else { normal };
        Some(Crossing { share, way, by: min(over.abs() + gap, most), ..*crossing })
    }

    /// The edge goes along the line in which its triangles cross the other one: as far as that leads, where it is a
    /// border, and else where the line bends to.
    fn shorten(&mut self, crossing: &Crossing, mesh: &Mesh, x: &[Float4], most: f32) -> Crossing {
        let at = |id: u32| xyz(&x[id as usize]);
        let [p, q, corners @ ..] = crossing.ids;
        for id in crossing.ids {
            self.parts[id as usize] |= LOOSE;
        }
        let (edge, normal) = (at(q) - at(p), normal(corners.map(at)));
        let mut way = Vec3::ZERO;
        for third in beside([p, q], mesh, &mut self.fan) {
            let inwards = at(third) - at(p);
            let line = edge.cross(inwards).cross(normal);
            // Of both directions the one into the triangle.
            let is_inwards = line.cross(edge).dot(inwards.cross(edge)) > 0.0;
            let length = if is_inwards { line.length() } else { -line.length() };
            if length != 0.0 {
                way += line * (1.0 / length);
            }
        }
        let length = way.length();
        let by = min(length, 1.0) * most;
        Crossing { way: way * (1.0 / (length + TINY)), by, ..*crossing }
    }

    /// Whether what tells the sides of a pair apart may keep them crossed.
    fn is_tangled(&self, ids: [u32; 4], first: u32) -> bool {
        let all = ids.map(|id| self.parts[id as usize]);
        let (one, other) = all.split_at(first as usize);
        let [one, other] = [one, other].map(|side| side.iter().fold(0, |sum, part| sum | part));
        let got_through = |one: u8, other: u8| one & INNER != 0 && other & (INNER | PIERCED) != 0;
        got_through(one, other) || got_through(other, one) || one & other & LOOSE != 0
    }

    /// Lets be what may keep sides crossed.
    pub fn let_be(&self, contacts: &mut [Contact], distant: &mut Vec<Distant>) {
        if self.is_empty() {
            return;
        }
        for contact in contacts {
            if self.is_tangled(contact.ids, contact.first) {
                contact.let_be();
            }
        }
        distant.retain(|pair| !self.is_tangled(pair.ids, pair.first));
    }

    /// Draws sides out that cross each other, which gives them no velocity.
    pub fn draw_out(&self, motion: &mut Motion, predicted: &mut Columns) {
        let Motion { start, now, .. } = motion;
        for Crossing { ids, share, way, by } in &self.crossings {
            let all = ids.map(|id| id as usize).into_iter().zip(*share);
            let (mut gone, mut sum) = (0.0, 0.0);
            for (id, share) in all.clone() {
                gone += share * way.dot(xyz(&now[id]) - xyz(&start[id]));
                sum += share * share * now[id][3];
            }
            let missing = by - gone;
            if missing <= 0.0 || sum <= 0.0 {
                continue;
            }
            for (id, share) in all {
                let by = *way * (missing * share * now[id][3] / sum);
                shift(&mut now[id], by);
                predicted.add(id, by);
            }
        }
    }

    /// What leads further in stops. All count by their masses: were what a collider bears heavier here, what is crumpled
    /// there would gain by it.
    #[inline(never)]
    pub fn calm(&self, weights: &[Weight], motion: &mut Columns) {
        for Crossing { ids, share, way, .. } in &self.crossings {
            let all = ids.map(|id| id as usize).into_iter().zip(*share);
            let (mut gone, mut sum) = (0.0, 0.0);
            for (id, share) in all.clone() {
                gone += share * way.dot(motion.at(id));
                sum += share * share * weights[id].w;
            }
            if gone < 0.0 && sum > 0.0 {
                for (id, share) in all {
                    motion.add(id, *way * (-gone * share * weights[id].w / sum));
                }
            }
        }
    }
}

/// The third corners of the triangles beside an edge.
fn beside<'a>(
    [p, q]: [u32; 2],
    mesh: &'a Mesh,
    fan: &'a mut Fan,
) -> impl Iterator<Item = u32> + 'a {
    mesh.gather_fan(mesh.corner_of[p as usize], fan);
    let all = fan.corners.iter().map(|corner| mesh.triangles[triangle_of(*corner)]);
    all.filter(move |corners| corners.contains(&q))
        .flat_map(move |corners| corners.into_iter().filter(move |at| *at != p && *at != q))
}

/// The first of the lot of a particle.
fn first_of(lots: &mut [u32], mut at: u32) -> u32 {
    while lots[at as usize] != at {
        lots[at as usize] = lots[lots[at as usize] as usize];
        at = lots[at as usize];
    }
    at
}

/// A normal of a triangle.
fn normal([a, b, c]: [Vec3; 3]) -> Vec3 {
    let doubled = (b - a).cross(c - a);
    doubled * (1.0 / (doubled.length() + TINY))
}

/// Where an edge goes through a triangle, by what each of them counts for there.
fn pierces([p, q]: [Vec3; 2], [a, b, c]: [Vec3; 3]) -> Option<[f32; 5]> {
    let normal = (b - a).cross(c - a);
    let (over_p, over_q) = (normal.dot(p - a), normal.dot(q - a));
    let least = normal.length() * NOTHING;
    let is_clear = over_p.abs() > least && over_q.abs() > least;
    if !is_clear || (over_p > 0.0) == (over_q > 0.0) {
        return None;
    }
    let t = over_p / (over_p - over_q);
    let at = p + (q - p) * t;
    let part = |b: Vec3, c: Vec3| (b - at).cross(c - at).dot(normal);
    let [u, v, w] = [part(b, c), part(c, a), part(a, b)];
    let is_within = u > 0.0 && v > 0.0 && w > 0.0;
    let all = u + v + w;
    is_within.then(|| [1.0 - t, t, -u / all, -v / all, -w / all])
}
