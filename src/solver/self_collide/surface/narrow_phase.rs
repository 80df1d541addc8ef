//! Narrow phase: closest points, normals and separations of the pairs that the contact solver works
//! on.
//!
//! ```text
//! at the start: closest points ─▶ weights, normal n, separation along n
//! now:          nearer than the gap along n?  then the current closest points, if their normal
//!                                             also separated both sides at the start
//! ```
//! SIMD version of [`Contact::detect`], a pair in each lane. Pairs whose start normal is ambiguous
//! (touching sides, nearly parallel edges) go to [`Contact::detect`] one by one.
//!
//! Reads [`SweptParticles`]; writes the contacts that [`NarrowPhase::push`] reserved.
//!
//! Invariant: contacts keep the order in which their pairs were pushed, whatever the batch size.

use crate::math::simd::{Float, Level, Scalar, Simd, gather_transpose, vectored};
use crate::math::wide4::Float4;
use crate::solver::self_collide::surface::closest_lanes::{
    self, Vec3Lanes, closest_edge_edge, closest_vertex_triangle,
};
use crate::solver::self_collide::surface::contact::{
    ALIGNED_COS2, CLEAR_SHARE, Contact, ContactKind, EDGE_EDGE, MIN_DISTANCE, MIN_KEPT_SHARE,
    SEPARATION_SHARE, TOLERATED_SHARE, VERTEX_TRIANGLE,
};
use crate::solver::self_collide::surface::swept_particles::SweptParticles;
use glam::Vec3;

/// Lists are padded to a multiple of this many pairs.
const LANES: usize = 8;

/// The separation of a pair that needs [`Contact::detect`].
const AMBIGUOUS: f32 = f32::NEG_INFINITY;

/// A batch of pairs of one kind.
#[derive(Clone, Debug)]
pub(crate) struct NarrowPhase {
    ids: [Vec<u32>; 4],
    /// Distance that each pair keeps [m].
    gaps: Vec<f32>,
    /// The index of each pair's contact.
    contacts: Vec<u32>,
    results: ContactLanes<Vec<f32>>,
}

/// Weights, normals and separations at the start, in columns.
#[derive(Clone, Debug)]
struct ContactLanes<T> {
    weights: [T; 4],
    n: [T; 3],
    separation: T,
}

impl NarrowPhase {
    pub fn new(capacity: usize) -> Self {
        let list = || Vec::with_capacity(capacity + LANES);
        Self {
            ids: [(); 4].map(|()| Vec::with_capacity(capacity + LANES)),
            gaps: list(),
            contacts: Vec::with_capacity(capacity),
            results: ContactLanes {
                weights: [(); 4].map(|()| list()),
                n: [(); 3].map(|()| list()),
                separation: list(),
            },
        }
    }

    /// Heap memory [bytes].
    pub fn bytes(&self) -> usize {
        size_of::<u32>() * (13 * self.results.separation.capacity() + self.contacts.capacity())
    }

    /// Pushes a pair, and an inactive contact for it that [`Self::fill_contacts`] fills in.
    #[inline(always)]
    pub fn push(
        &mut self,
        ids: [u32; 4],
        kind: ContactKind,
        gap: f32,
        contacts: &mut Vec<Contact>,
    ) {
        for (list, id) in self.ids.iter_mut().zip(ids) {
            list.push(id);
        }
        self.gaps.push(gap);
        self.contacts.push(contacts.len() as u32);
        contacts.push(Contact::inactive(ids, kind));
    }

    /// Fills in the contacts of all pairs and clears the batch. A contact that [`Contact::detect`]
    /// rejects stays inactive.
    pub fn fill_contacts<const KIND: ContactKind>(
        &mut self,
        level: Level,
        motion: &SweptParticles,
        contacts: &mut [Contact],
    ) {
        let count = self.contacts.len().next_multiple_of(LANES);
        self.ids.iter_mut().for_each(|list| list.resize(count, 0));
        self.gaps.resize(count, 0.0);
        let ContactLanes { weights, n, separation } = &mut self.results;
        let lists = weights.iter_mut().chain(n.iter_mut()).chain([&mut *separation]);
        lists.for_each(|list| list.resize(count, 0.0));
        let [a, b, c, d] = &self.ids;
        let ([e, f, g, h], [x, y, z]) = (weights, n);
        let lanes = ContactLanes {
            weights: [&mut e[..], f, g, h],
            n: [&mut x[..], y, z],
            separation: &mut separation[..],
        };
        let (gaps, SweptParticles { start, now, .. }) = (&self.gaps[..], motion);
        let batch = NarrowPhaseBatch { ids: [a, b, c, d], gaps, start, now, lanes };
        if KIND == VERTEX_TRIANGLE {
            compute_vertex_triangle(level, batch);
        } else {
            compute_edge_edge(level, batch);
        }
        let ContactLanes { weights, n, separation } = &self.results;
        for (i, contact) in self.contacts.iter().enumerate() {
            let contact = &mut contacts[*contact as usize];
            if separation[i] == AMBIGUOUS {
                let gap = self.gaps[i];
                if let Some(found) = Contact::detect::<KIND>(contact.ids, motion, gap, gap) {
                    *contact = found;
                }
                continue;
            }
            contact.weights = [weights[0][i], weights[1][i], weights[2][i], weights[3][i]];
            contact.n = Vec3::new(n[0][i], n[1][i], n[2][i]);
            contact.gap = self.gaps[i];
            contact.set_separation(separation[i]);
        }
        self.gaps.clear();
        self.contacts.clear();
        self.ids.iter_mut().for_each(Vec::clear);
    }
}

/// Input and output of the kernels.
struct NarrowPhaseBatch<'a> {
    ids: [&'a [u32]; 4],
    start: &'a [Float4],
    now: &'a [Float4],
    gaps: &'a [f32],
    lanes: ContactLanes<&'a mut [f32]>,
}

vectored! {
    fn compute_vertex_triangle(batch: NarrowPhaseBatch<'_>)
        = compute_lanes::<_, VERTEX_TRIANGLE>, compute_vertex_triangle_scalar
}

vectored! {
    fn compute_edge_edge(batch: NarrowPhaseBatch<'_>)
        = compute_lanes::<_, EDGE_EDGE>, compute_edge_edge_scalar
}

fn compute_vertex_triangle_scalar(batch: NarrowPhaseBatch<'_>) {
    compute_lanes::<_, VERTEX_TRIANGLE>(Scalar, batch);
}

fn compute_edge_edge_scalar(batch: NarrowPhaseBatch<'_>) {
    compute_lanes::<_, EDGE_EDGE>(Scalar, batch);
}

#[inline(always)]
fn compute_lanes<S: Simd, const KIND: ContactKind>(s: S, batch: NarrowPhaseBatch<'_>) {
    let NarrowPhaseBatch { ids, start, now, gaps, lanes } = batch;
    let ContactLanes { weights: mut weight_lists, n: mut normals, separation: separations } = lanes;
    for i in (0..separations.len()).step_by(S::LANES) {
        let own = i..i + S::LANES;
        let zero3 = Vec3Lanes { x: s.splat(0.0), y: s.splat(0.0), z: s.splat(0.0) };
        let [mut then, mut x] = [[zero3; 4]; 2];
        for k in 0..4 {
            then[k] = Vec3Lanes::new(gather_transpose(s, start, &ids[k][own.clone()]));
            x[k] = Vec3Lanes::new(gather_transpose(s, now, &ids[k][own.clone()]));
        }
        let before = closest::<S, KIND>(s, then);
        let after = closest::<S, KIND>(s, x);
        let mut separation = separation_along::<_, KIND>(then, before.n);
        let separation_after = separation_along::<_, KIND>(then, after.n);
        let mut is_clear = before.distance - s.splat(MIN_DISTANCE);
        if KIND == EDGE_EDGE {
            let clear_separation = s.splat(CLEAR_SHARE) * before.distance;
            is_clear = Float::min(is_clear, separation - clear_separation);
        }
        // A pair nearer than the gap takes its current normal, if that separated both sides at the
        // start, and not by much less. See `Contact::update_normal`.
        let mut distance = s.splat(0.0);
        for k in 0..4 {
            distance = distance + before.weights[k] * before.n.dot(x[k]);
        }
        let is_valid = Float::min(separation_after, after.distance) - s.splat(MIN_DISTANCE);
        let gap = s.load(gaps, i);
        let enough = gap * s.splat(SEPARATION_SHARE * TOLERATED_SHARE);
        let is_better = Float::min(separation_after, enough)
            - s.splat(MIN_KEPT_SHARE) * Float::min(separation, enough);
        let replaces = Float::min(Float::min(gap - distance, is_valid), is_better);
        separation = s.select(replaces, separation_after, separation);
        let n = [before.n.x, before.n.y, before.n.z].into_iter();
        let new = [after.n.x, after.n.y, after.n.z];
        for ((list, old), new) in normals.iter_mut().zip(n).zip(new) {
            s.store(list, i, s.select(replaces, new, old));
        }
        for (list, (old, new)) in
            weight_lists.iter_mut().zip(before.weights.into_iter().zip(after.weights))
        {
            s.store(list, i, s.select(replaces, new, old));
        }
        s.store(separations, i, s.select(is_clear, separation, s.splat(AMBIGUOUS)));
    }
}

/// Closest points of a pair: weights, unit normal from the second side to the first, and distance
/// [m].
struct ClosestLanes<F> {
    weights: [F; 4],
    n: Vec3Lanes<F>,
    distance: F,
}

#[inline(always)]
fn closest<S: Simd, const KIND: ContactKind>(s: S, x: [Vec3Lanes<S::F>; 4]) -> ClosestLanes<S::F> {
    let zero = s.splat(0.0);
    let (d, weights) = if KIND == VERTEX_TRIANGLE {
        closest_vertex_triangle(s, x)
    } else {
        closest_edge_edge(s, x)
    };
    let distance = d.dot(d).sqrt();
    // Where the closest points are inside the triangle or inside both edges, d is along the face
    // normal, which is more exact for a short d.
    let (normal, inside) = if KIND == VERTEX_TRIANGLE {
        let most = Float::max(weights[1], Float::max(weights[2], weights[3]));
        (x[2].minus(x[1]).cross(x[3].minus(x[1])), zero - most)
    } else {
        let first = Float::min(weights[0], weights[1]);
        let second = Float::max(weights[2], weights[3]);
        (x[1].minus(x[0]).cross(x[3].minus(x[2])), Float::min(first, zero - second))
    };
    let (along, length) = (d.dot(normal), normal.dot(normal).sqrt());
    let least = s.splat(ALIGNED_COS2) * distance * distance * length * length;
    let is_normal = Float::min(inside, along * along - least);
    let one = s.splat(1.0);
    let sign = s.select(along, one, zero - one);
    let by_normal = normal.times(sign / length);
    let by_d = d.times(one / distance);
    let n = Vec3Lanes {
        x: s.select(is_normal, by_normal.x, by_d.x),
        y: s.select(is_normal, by_normal.y, by_d.y),
        z: s.select(is_normal, by_normal.z, by_d.z),
    };
    ClosestLanes { weights, n, distance }
}

/// The separation of both sides along `n` [m].
#[inline(always)]
fn separation_along<F: Float, const KIND: ContactKind>(x: [Vec3Lanes<F>; 4], n: Vec3Lanes<F>) -> F {
    let along = [n.dot(x[0]), n.dot(x[1]), n.dot(x[2]), n.dot(x[3])];
    closest_lanes::separation::<_, KIND>(along)
}
