//! Pairs that are near enough to push: where each is closest, many at once.
//!
//! As `Contact::find` does it one by one for what no direction tells apart well.

use crate::math::simd::{Float, Level, Scalar, Simd, gather_transpose, vectored};
use crate::math::wide4::Float4;
use crate::solver::self_collide::surface::closest_lanes::{V, between, from_edge, from_triangle};
use crate::solver::self_collide::surface::contact::{
    CLEAR, Contact, EDGES, ENOUGH, Kind, NOTHING, SAME, SLIT, VERTEX, WORSE,
};
use crate::solver::self_collide::surface::swept_particles::Motion;
use glam::Vec3;

/// Lanes that lists are filled up to.
const LANES: usize = 8;

/// What says that a pair must be looked at by itself.
const UNSURE: f32 = f32::NEG_INFINITY;

/// Pairs of one kind.
#[derive(Clone, Debug)]
pub(crate) struct Near {
    ids: [Vec<u32>; 4],
    /// How far each keeps apart [m].
    gaps: Vec<f32>,
    /// The contact that each is.
    contacts: Vec<u32>,
    found: Lanes<Vec<f32>>,
}

/// Where pairs are closest: what each particle counts for, the direction from the second side to the first, and how
/// far sides were apart along it.
#[derive(Clone, Debug)]
struct Lanes<T> {
    share: [T; 4],
    n: [T; 3],
    apart: T,
}

impl Near {
    pub fn new(capacity: usize) -> Self {
        let list = || Vec::with_capacity(capacity + LANES);
        Self {
            ids: [(); 4].map(|()| Vec::with_capacity(capacity + LANES)),
            gaps: list(),
            contacts: Vec::with_capacity(capacity),
            found: Lanes {
                share: [(); 4].map(|()| list()),
                n: [(); 3].map(|()| list()),
                apart: list(),
            },
        }
    }

    pub fn bytes(&self) -> usize {
        size_of::<u32>() * (13 * self.found.apart.capacity() + self.contacts.capacity())
    }

    /// Takes a pair, and has a contact made for it that does nothing until it is finished.
    #[inline(always)]
    pub fn push(&mut self, ids: [u32; 4], first: Kind, gap: f32, contacts: &mut Vec<Contact>) {
        for (list, id) in self.ids.iter_mut().zip(ids) {
            list.push(id);
        }
        self.gaps.push(gap);
        self.contacts.push(contacts.len() as u32);
        contacts.push(Contact::of(ids, first));
    }

    /// Finishes the contacts of all pairs.
    pub fn finish<const FIRST: Kind>(
        &mut self,
        level: Level,
        motion: &Motion,
        contacts: &mut [Contact],
    ) {
        let count = self.contacts.len().next_multiple_of(LANES);
        self.ids.iter_mut().for_each(|list| list.resize(count, 0));
        self.gaps.resize(count, 0.0);
        let Lanes { share, n, apart } = &mut self.found;
        let lists = share.iter_mut().chain(n.iter_mut()).chain([&mut *apart]);
        lists.for_each(|list| list.resize(count, 0.0));
        let [a, b, c, d] = &self.ids;
        let ([e, f, g, h], [x, y, z]) = (share, n);
        let lanes =
            Lanes { share: [&mut e[..], f, g, h], n: [&mut x[..], y, z], apart: &mut apart[..] };
        let (gaps, Motion { start, now, .. }) = (&self.gaps[..], motion);
        let pairs = Pairs { ids: [a, b, c, d], gaps, start, now, lanes };
        if FIRST == VERTEX {
            find_vertices(level, pairs);
        } else {
            find_edges(level, pairs);
        }
        let Lanes { share, n, apart } = &self.found;
        for (at, contact) in self.contacts.iter().enumerate() {
            let contact = &mut contacts[*contact as usize];
            if apart[at] == UNSURE {
                let gap = self.gaps[at];
                if let Some(found) = Contact::find::<FIRST>(contact.ids, motion, gap, gap) {
                    *contact = found;
                }
                continue;
            }
            contact.share = [share[0][at], share[1][at], share[2][at], share[3][at]];
            contact.n = Vec3::new(n[0][at], n[1][at], n[2][at]);
            contact.gap = self.gaps[at];
            contact.leave(apart[at]);
        }
        self.gaps.clear();
        self.contacts.clear();
        self.ids.iter_mut().for_each(Vec::clear);
    }
}

/// Pairs with where their particles were as the substep began and are now.
struct Pairs<'a> {
    ids: [&'a [u32]; 4],
    start: &'a [Float4],
    now: &'a [Float4],
    gaps: &'a [f32],
    lanes: Lanes<&'a mut [f32]>,
}

vectored! {
    fn find_vertices(pairs: Pairs<'_>) = find::<_, VERTEX>, Avx2, find_vertices_apart
}

vectored! {
    fn find_edges(pairs: Pairs<'_>) = find::<_, EDGES>, Avx2, find_edges_apart
}

fn find_vertices_apart(pairs: Pairs<'_>) {
    find::<_, VERTEX>(Scalar, pairs);
}

fn find_edges_apart(pairs: Pairs<'_>) {
    find::<_, EDGES>(Scalar, pairs);
}

#[inline(always)]
fn find<S: Simd, const FIRST: Kind>(s: S, pairs: Pairs<'_>) {
    let Pairs { ids, start, now, gaps, lanes } = pairs;
    let Lanes { share: mut shares, n: mut normals, apart: aparts } = lanes;
    for at in (0..aparts.len()).step_by(S::LANES) {
        let own = at..at + S::LANES;
        let nothing = V { x: s.splat(0.0), y: s.splat(0.0), z: s.splat(0.0) };
        let [mut then, mut x] = [[nothing; 4]; 2];
        for k in 0..4 {
            then[k] = V::new(gather_transpose(s, start, &ids[k][own.clone()]));
            x[k] = V::new(gather_transpose(s, now, &ids[k][own.clone()]));
        }
        let before = closest::<S, FIRST>(s, then);
        let after = closest::<S, FIRST>(s, x);
        let mut apart = along::<_, FIRST>(then, before.n);
        let turned = along::<_, FIRST>(then, after.n);
        let mut is_sure = before.distance - s.splat(NOTHING);
        if FIRST == EDGES {
            is_sure = Float::min(is_sure, apart - s.splat(CLEAR) * before.distance);
        }
        // What came nearer than the gap takes the direction that it has now, if that told sides apart before, and not
        // much less.
        let mut distance = s.splat(0.0);
        for k in 0..4 {
            distance = distance + before.share[k] * before.n.dot(x[k]);
        }
        let is_near = Float::min(turned, after.distance) - s.splat(NOTHING);
        let gap = s.load(gaps, at);
        let enough = gap * s.splat(SLIT * ENOUGH);
        let is_better = Float::min(turned, enough) - s.splat(WORSE) * Float::min(apart, enough);
        let turns = Float::min(Float::min(gap - distance, is_near), is_better);
        apart = s.select(turns, turned, apart);
        let n = [before.n.x, before.n.y, before.n.z].into_iter();
        let new = [after.n.x, after.n.y, after.n.z];
        for ((list, old), new) in normals.iter_mut().zip(n).zip(new) {
            s.store(list, at, s.select(turns, new, old));
        }
        for (list, (old, new)) in shares.iter_mut().zip(before.share.into_iter().zip(after.share)) {
            s.store(list, at, s.select(turns, new, old));
        }
        s.store(aparts, at, s.select(is_sure, apart, s.splat(UNSURE)));
    }
}

/// A pair as it is closest.
struct Closest<F> {
    share: [F; 4],
    n: V<F>,
    distance: F,
}

#[inline(always)]
fn closest<S: Simd, const FIRST: Kind>(s: S, x: [V<S::F>; 4]) -> Closest<S::F> {
    let zero = s.splat(0.0);
    let (way, share) = if FIRST == VERTEX { from_triangle(s, x) } else { from_edge(s, x) };
    let distance = way.dot(way).sqrt();
    // Inside of a triangle or of both edges the way is along the normal, which is more exact where it is short.
    let (normal, inside) = if FIRST == VERTEX {
        let most = Float::max(share[1], Float::max(share[2], share[3]));
        (x[2].minus(x[1]).cross(x[3].minus(x[1])), zero - most)
    } else {
        let first = Float::min(share[0], share[1]);
        let second = Float::max(share[2], share[3]);
        (x[1].minus(x[0]).cross(x[3].minus(x[2])), Float::min(first, zero - second))
    };
    let (along, length) = (way.dot(normal), normal.dot(normal).sqrt());
    let least = s.splat(SAME) * distance * distance * length * length;
    let is_normal = Float::min(inside, along * along - least);
    let one = s.splat(1.0);
    let side = s.select(along, one, zero - one);
    let by_normal = normal.times(side / length);
    let by_way = way.times(one / distance);
    let n = V {
        x: s.select(is_normal, by_normal.x, by_way.x),
        y: s.select(is_normal, by_normal.y, by_way.y),
        z: s.select(is_normal, by_normal.z, by_way.z),
    };
    Closest { share, n, distance }
}

/// How far one side is from the other along a direction, at least.
#[inline(always)]
fn along<F: Float, const FIRST: Kind>(x: [V<F>; 4], n: V<F>) -> F {
    between::<_, FIRST>([n.dot(x[0]), n.dot(x[1]), n.dot(x[2]), n.dot(x[3])])
}
