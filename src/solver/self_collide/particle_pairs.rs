//! Pair list of particle collision: pairs of particles that may come nearer than the collision
//! distance.
//!
//! ```text
//!   ●  ← distance + 2 · margin →  ●      A list of the pairs nearer than this stays valid until a
//!                                        particle has moved by `margin` relative to the mean
//!                                        displacement.
//! ```
//! A Verlet list over a hash grid (Verlet, Phys. Rev. 159, 1967). If particles move too fast for a
//! list to last four passes, each pass makes a list without margin.
//!
//! Reads mesh, rest positions and particle positions; writes its own lists.
//!
//! Invariant: the list holds every pair that is too near, sorted by both particles. It may hold
//! others, which the solver filters out before it moves anything, so the time at which it was made
//! does not change the result.

use crate::geometry::hash_grid::HashGrid;
use crate::math::heap_bytes::heap_bytes;
use crate::math::simd::Level;
use crate::mesh::Mesh;
use crate::solver::self_collide::connected_pieces::piece_of_sites;
use crate::state::particles::Particles;
use crate::state::sewing::Sewing;
use glam::Vec3;

/// Particles of one piece that are nearer than this at rest are neighbours and do not collide [mean
/// rest lengths]. The diagonal of a grid cell is shorter.
const NEIGHBOUR_DISTANCE: f32 = 1.5;

/// Margin of a list [mean rest lengths].
const MARGIN: f32 = 0.25;

/// A margin pays off only if the list lasts for this many passes.
const MIN_PASSES: f32 = 4.0;

/// Factor by which grid cells are longer than the search distance, which covers rounding.
const CELL_FACTOR: f32 = 1.02;

/// A list is rebuilt at this share of its margin, which covers rounding.
const REBUILD_SHARE: f32 = 0.95;

/// A list is rebuilt after a mean displacement of this many margins, because rounding grows with
/// it.
const MAX_DRIFT: f32 = 1000.0;

/// Data of particle collision.
#[derive(Clone, Debug)]
pub(crate) struct ParticleCollision {
    grid: HashGrid,
    /// Pairs that may come too near before a particle moves by `margin`.
    pub pairs: Vec<[u32; 2]>,
    /// Scratch: pairs that are too near now, or pairs during sorting.
    pub touching: Vec<[u32; 2]>,
    /// Positions when the list was made.
    listed_at: Vec<Vec3>,
    /// Scratch of the counting sort: first pair of each particle.
    firsts: Vec<u32>,
    /// Connected piece of each site in the mesh as created.
    pieces: Vec<u32>,
    /// Largest distance that particles keep [m].
    pub distance: f32,
    /// Rest distance up to which particles of one piece do not collide [m].
    neighbour_distance: f32,
    /// Margin of the current list, 0 if it serves one pass only; and that of lists that last [m].
    pub margin: f32,
    full_margin: f32,
    /// Passes since the list was made.
    passes: u32,
}

/// Input of the pair list.
#[derive(Clone, Copy)]
pub(crate) struct PairListInput<'a> {
    pub level: Level,
    pub mesh: &'a Mesh,
    /// Rest position of each site [m].
    pub rest: &'a [Vec3],
    pub particles: &'a Particles,
    pub sewing: &'a Sewing,
}

heap_bytes!(
    ParticleCollision { grid, pairs, touching, listed_at, firsts, pieces }
    plain { distance, neighbour_distance, margin, full_margin, passes }
);

impl ParticleCollision {
    /// Allocates for a cloth that may grow to `capacity` particles. `distance` is the largest
    /// distance that particles keep, `mean_edge` the mean rest length [m].
    pub fn new(input: PairListInput<'_>, distance: f32, mean_edge: f32, capacity: usize) -> Self {
        let larger = |a: f32, b: f32| if a > b { a } else { b };
        let neighbour_distance = larger(NEIGHBOUR_DISTANCE * mean_edge, distance);
        let full_margin = MARGIN * mean_edge;
        let count = input.particles.len();
        Self {
            grid: HashGrid::new(capacity),
            // As many neighbours as densely packed balls have; with more, the lists grow.
            pairs: Vec::with_capacity(16 * count),
            touching: Vec::with_capacity(16 * count),
            listed_at: Vec::with_capacity(capacity),
            firsts: Vec::with_capacity(capacity + 1),
            pieces: piece_of_sites(input.mesh, input.rest.len()),
            distance,
            neighbour_distance,
            margin: full_margin,
            full_margin,
            passes: 0,
        }
    }

    /// Makes the next pass rebuild the list, after positions moved to another origin.
    pub fn invalidate(&mut self) {
        self.listed_at.clear();
    }

    /// Rebuilds the list if a particle has moved by more than the margin, relative to the mean
    /// displacement.
    pub fn refresh_pairs(&mut self, input: PairListInput<'_>) {
        let x = &input.particles.x;
        if self.listed_at.len() != input.particles.len() {
            self.rebuild_pairs(input, self.full_margin);
            return;
        }
        let displacements = || x.iter().zip(&self.listed_at).map(|(x, at)| x - *at);
        let mean =
            displacements().fold(Vec3::ZERO, |sum, moved| sum + moved) * (1.0 / x.x.len() as f32);
        let (limit, max_drift) = (REBUILD_SHARE * self.margin, MAX_DRIFT * self.full_margin);
        let is_near = mean.length_squared() <= max_drift * max_drift;
        let (mut is_valid, mut farthest) = (is_near && self.margin > 0.0, 0.0);
        for displacement in displacements() {
            let moved = (displacement - mean).length_squared();
            is_valid &= moved <= limit * limit;
            farthest = if moved > farthest { moved } else { farthest };
        }
        self.passes += 1;
        if is_valid {
            return;
        }
        let lasts = REBUILD_SHARE * self.full_margin * self.passes as f32;
        let is_slow = farthest * (MIN_PASSES * MIN_PASSES) <= lasts * lasts;
        self.rebuild_pairs(input, if is_slow { self.full_margin } else { 0.0 });
    }

    /// Rebuilds the list with a margin [m].
    fn rebuild_pairs(&mut self, input: PairListInput<'_>, margin: f32) {
        (self.margin, self.passes) = (margin, 0);
        let PairListInput { level, mesh, rest, particles, sewing } = input;
        let Self { grid, pairs, listed_at, touching, firsts, pieces, .. } = self;
        listed_at.clear();
        listed_at.extend(particles.x.iter());
        let search_distance = self.distance + 2.0 * margin;
        grid.rebuild(listed_at, CELL_FACTOR * search_distance);
        pairs.clear();
        grid.push_close_pairs(level, search_distance * search_distance, pairs);
        let neighbour_distance = self.neighbour_distance;
        let mut count = 0;
        for i in 0..pairs.len() {
            let pair = pairs[i];
            let [site, other] = pair.map(|particle| mesh.source[particle as usize] as usize);
            let distance = (rest[other] - rest[site]).length_squared();
            let is_neighbour = (pieces[site] == pieces[other])
                & (distance <= neighbour_distance * neighbour_distance);
            let is_sewn = !sewing.is_empty() && sewing.leader(pair[0]) == sewing.leader(pair[1]);
            // Compaction without a branch: the processor cannot predict which pairs are neighbours.
            pairs[count] = pair;
            count += usize::from(!(is_neighbour | is_sewn));
        }
        pairs.truncate(count);
        for end in [1, 0] {
            sort_by_end(end, pairs, touching, firsts, listed_at.len());
            core::mem::swap(pairs, touching);
        }
    }
}

/// Counting sort: copies pairs into `sorted`, by the particle at one of their ends. Stable.
fn sort_by_end(
    end: usize,
    pairs: &[[u32; 2]],
    sorted: &mut Vec<[u32; 2]>,
    firsts: &mut Vec<u32>,
    particles: usize,
) {
    firsts.clear();
    firsts.resize(particles + 1, 0);
    for pair in pairs {
        firsts[pair[end] as usize + 1] += 1;
    }
    for i in 1..firsts.len() {
        firsts[i] += firsts[i - 1];
    }
    sorted.resize(pairs.len(), [0; 2]);
    for pair in pairs {
        let next = &mut firsts[pair[end] as usize];
        sorted[*next as usize] = *pair;
        *next += 1;
    }
}
