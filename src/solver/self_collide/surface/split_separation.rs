//! Split separation: moves the copies of freshly split vertices apart by a small distance.
//!
//! ```text
//!      ╲   │   ╱                ╲   │   ╱       The copies of a split vertex start at one place,
//!       ╲  │  ╱                  ╲  │  ╱        where no direction separates their triangles. So
//!   ──── ●=●=● ────    ─▶    ──── ● ● ● ────    no contact has a normal. Each copy moves towards
//!       ╱  │  ╲              ──── ● ● ● ────    its own triangles, along directions that separate
//!      ╱   │   ╲                 ╱  │  ╲        them from the others, also in folded cloth.
//! ```
//! For each pair of corner wedges of two copies, candidate directions are the normals of separating
//! planes through the vertex (separating axis test of two cones). Displacements follow by
//! Gauss–Seidel over all pairs: the relative displacement along one direction of each pair must
//! reach the split distance.
//!
//! Reads mesh, positions and inverse masses; writes its own lists. `surface_stages` moves the
//! particles.
//!
//! Invariant: momentum is conserved: each step is weighted by inverse masses, and the final limit
//! scales all displacements at one place by the same factor.

use crate::math::sort::sort_by;
use crate::math::{TINY, min};
use crate::mesh::{Fan, Mesh, next_corner, prev_corner};
use crate::state::particles::Particles;
use glam::Vec3;

/// Distance by which two sides move apart: in mean rest lengths, and at most in lengths of their
/// shortest edge.
pub(crate) const SPLIT_DISTANCE: f32 = 0.001;
const MAX_EDGE_SHARE: f32 = 0.02;

/// Largest number of Gauss–Seidel rounds, the share of the split distance that may be missing at
/// the end, and the largest displacement of a vertex in split distances.
const MAX_ROUNDS: u32 = 16;
const MISSING_SHARE: f32 = 0.05;
const MAX_DISPLACEMENT: f32 = 4.0;

/// A direction separates two wedges if no edge points to the wrong side by more than this sine,
/// which covers rounding. A candidate vector shorter than the second limit is too inexact.
const ROUNDING_SINE: f32 = 1.0e-5;
const MIN_LENGTH: f32 = 1.0e-4;

/// Largest number of separating directions of two wedges.
const MAX_DIRECTIONS: usize = 13;

/// Scratch buffers.
#[derive(Clone, Debug, Default)]
pub(crate) struct SplitSeparation {
    /// Vertices, sorted by source vertex and position, and the displacement of each [m].
    pub copies: Vec<u32>,
    pub displacements: Vec<Vec3>,
    /// Wedges of the copies at one place, and the separating directions of their pairs.
    wedges: Vec<CornerWedge>,
    pairs: Vec<WedgePair>,
    fan: Fan,
}

/// A triangle corner at the split place: the index of its copy, and the unit directions of its two
/// edges.
#[derive(Clone, Copy, Debug)]
struct CornerWedge {
    copy: usize,
    edges: [Vec3; 2],
}

/// Two wedges of different copies, and the directions that separate them; one of them is enough.
#[derive(Clone, Copy, Debug)]
struct WedgePair {
    copies: [usize; 2],
    /// Least sine between an edge and the separating plane, and the unit normal of the plane.
    directions: [(f32, Vec3); MAX_DIRECTIONS],
    count: usize,
}

impl SplitSeparation {
    pub fn new(capacity: usize) -> Self {
        let (corners, ring) = (Vec::with_capacity(64), Vec::with_capacity(65));
        Self {
            copies: Vec::with_capacity(capacity),
            displacements: Vec::with_capacity(capacity),
            wedges: Vec::with_capacity(64),
            pairs: Vec::with_capacity(64),
            fan: Fan { corners, ring, is_closed: false },
        }
    }

    /// Heap memory [bytes].
    pub fn bytes(&self) -> usize {
        let fan = self.fan.corners.capacity() + self.fan.ring.capacity();
        size_of::<Vec3>() * self.displacements.capacity()
            + size_of::<CornerWedge>() * self.wedges.capacity()
            + size_of::<WedgePair>() * self.pairs.capacity()
            + 4 * (self.copies.capacity() + fan)
    }

    /// Computes the displacements of those of `vertices` that share their source vertex and their
    /// position with another one; all others get zero. Fills `copies` and `displacements`.
    /// `mean_edge` is the mean rest length [m].
    pub fn compute(
        &mut self,
        mesh: &Mesh,
        particles: &Particles,
        mean_edge: f32,
        vertices: impl Iterator<Item = u32>,
    ) {
        let mut copies = core::mem::take(&mut self.copies);
        copies.clear();
        copies.extend(vertices);
        let place = |vertex: u32| {
            let bits = particles.x.get(vertex as usize).to_array().map(f32::to_bits);
            (mesh.source[vertex as usize], bits)
        };
        sort_by(&mut copies, |a, b| (place(*a), *a).cmp(&(place(*b), *b)));
        copies.dedup();
        self.displacements.clear();
        for vertices in copies.chunk_by(|a, b| place(*a) == place(*b)) {
            self.push_displacements(mesh, particles, mean_edge, vertices);
        }
        self.copies = copies;
    }

    /// Appends the displacements of the vertices at one place [m]. Fixed vertices get zero.
    fn push_displacements(
        &mut self,
        mesh: &Mesh,
        particles: &Particles,
        mean_edge: f32,
        vertices: &[u32],
    ) {
        let first = self.displacements.len();
        self.displacements.extend(vertices.iter().map(|_| Vec3::ZERO));
        if vertices.len() < 2 {
            return;
        }
        let distance = self.collect_wedges(mesh, particles, mean_edge, vertices);
        self.collect_pairs();
        let w = |copy: usize| particles.w[vertices[copy] as usize];
        let displacements = &mut self.displacements[first..];
        for round in 0..MAX_ROUNDS {
            let mut is_done = true;
            for pair in &self.pairs {
                let [one, other] = pair.copies;
                let relative = displacements[one] - displacements[other];
                let sum = w(one) + w(other);
                let n = if round == 0 { pair.clearest() } else { pair.farthest_along(relative) };
                let missing = distance - n.dot(relative);
                if missing > MISSING_SHARE * distance && sum > 0.0 {
                    displacements[one] += n * (missing * w(one) / sum);
                    displacements[other] -= n * (missing * w(other) / sum);
                    is_done = false;
                }
            }
            if is_done {
                break;
            }
        }
        // One factor for all, so that momentum is conserved.
        let lengths = displacements.iter().map(|displacement| displacement.length());
        let largest = lengths.fold(0.0, crate::math::max);
        let share = min(1.0, MAX_DISPLACEMENT * distance / (largest + TINY));
        displacements.iter_mut().for_each(|displacement| *displacement *= share);
    }

    /// Collects the wedges of vertices at one place, and returns the distance that they are to move
    /// apart [m].
    fn collect_wedges(
        &mut self,
        mesh: &Mesh,
        particles: &Particles,
        mean_edge: f32,
        vertices: &[u32],
    ) -> f32 {
        let x = &particles.x;
        let mut distance = mean_edge * SPLIT_DISTANCE;
        self.wedges.clear();
        for (copy, vertex) in vertices.iter().enumerate() {
            mesh.gather_fan(mesh.corner_of[*vertex as usize], &mut self.fan);
            let center = x.get(*vertex as usize);
            for corner in &self.fan.corners {
                let edges = [next_corner(*corner), prev_corner(*corner)].map(|end| {
                    let edge = x.get(mesh.vertex(end) as usize) - center;
                    let length = edge.length();
                    distance = min(distance, length * MAX_EDGE_SHARE);
                    edge * (1.0 / (length + TINY))
                });
                self.wedges.push(CornerWedge { copy, edges });
            }
        }
        distance
    }

    /// Collects the separating directions of each pair of wedges of different copies.
    fn collect_pairs(&mut self) {
        self.pairs.clear();
        for (i, one) in self.wedges.iter().enumerate() {
            for other in self.wedges[i + 1..].iter().filter(|other| other.copy != one.copy) {
                let pair = WedgePair::new(one, other);
                if pair.count > 0 {
                    self.pairs.push(pair);
                }
            }
        }
    }
}

impl WedgePair {
    fn new(one: &CornerWedge, other: &CornerWedge) -> Self {
        let copies = [one.copy, other.copy];
        let mut pair = Self { copies, directions: [(0.0, Vec3::ZERO); MAX_DIRECTIONS], count: 0 };
        let ([a, b], [c, d]) = (one.edges, other.edges);
        let sides = [one.edges, other.edges];
        // Wedges that had a common edge move apart across that edge. The copies at its other end do
        // the same.
        for (edge, inner) in [(a, b), (b, a)] {
            for (same, outer) in [(c, d), (d, c)] {
                if edge == same {
                    let direction = perpendicular(edge, inner) - perpendicular(edge, outer);
                    pair.push_if_separating(sides, direction);
                }
            }
        }
        if pair.count > 0 {
            return pair;
        }
        pair.push_if_separating(sides, a + b - c - d);
        for normal in [a.cross(b), c.cross(d), a.cross(c), a.cross(d), b.cross(c), b.cross(d)] {
            pair.push_if_separating(sides, normal);
            pair.push_if_separating(sides, -normal);
        }
        pair
    }

    /// Appends a direction if it separates both wedges.
    fn push_if_separating(&mut self, [[a, b], [c, d]]: [[Vec3; 2]; 2], direction: Vec3) {
        let length = direction.length();
        if length < MIN_LENGTH {
            return;
        }
        let n = direction * (1.0 / length);
        let least_sine = min(min(n.dot(a), n.dot(b)), min(-n.dot(c), -n.dot(d)));
        if least_sine > -ROUNDING_SINE {
            self.directions[self.count] = (least_sine, n);
            self.count += 1;
        }
    }

    /// The direction with the largest angle between edges and plane.
    fn clearest(&self) -> Vec3 {
        first_max(self.directions[..self.count].iter().copied())
    }

    /// The direction along which a displacement is largest.
    fn farthest_along(&self, displacement: Vec3) -> Vec3 {
        first_max(self.directions[..self.count].iter().map(|(_, n)| (n.dot(displacement), *n)))
    }
}

/// The unit component of `v` perpendicular to `edge`.
fn perpendicular(edge: Vec3, v: Vec3) -> Vec3 {
    let across = v - edge * v.dot(edge);
    across * (1.0 / (across.length() + TINY))
}

/// The vector with the greatest key; the first one of equals.
fn first_max(all: impl Iterator<Item = (f32, Vec3)>) -> Vec3 {
    all.fold((f32::MIN, Vec3::ZERO), |most, next| if next.0 > most.0 { next } else { most }).1
}
