//! Stage `SelfContacts`: particles of different parts of the cloth keep apart as if they were balls.
//!
//! ```text
//! i ◀── 0.4 o ── ●   ● ── 0.4 o ──▶ j        o = distance - |j - i|
//! ```
//! Of unequal masses the lighter one moves farther, in proportion, so that nothing drives itself along.
//! The plain scheme of many demos, once a substep: what is held does not count, nor do neighbours in the
//! weave, and triangles may still cross. Only pairs that are too near when the pass begins are moved, so
//! that it makes no difference to the bits when the list of those that may be was made.

use crate::solver::self_collide::surface;

use crate::error::{Result, check};
use crate::geometry::hash_grid::HashGrid;
use crate::math::TINY;
use crate::mesh::Mesh;
use crate::solver::world::World;
use crate::state::particles::Particles;
use crate::state::settings::{SelfCollision, Settings};
use glam::Vec3;

/// What `self_distance` 0 is, in mean rest lengths.
const DISTANCE: f32 = 2.0 / 3.0;

/// The most that it may be, in mean rest lengths: who is near whom would be too many.
const MOST: f32 = 2.0;

/// How far neighbours are woven from each other at most, in mean rest lengths: a diagonal of a grid.
const WOVEN: f32 = 1.5;

/// How far particles may move before pairs are listed anew, in mean rest lengths.
const MARGIN: f32 = 0.25;

/// For fewer passes than this no list is worth a margin: then each pass makes one of its own.
const PASSES: f32 = 4.0;

/// How much longer cells are than what is looked for, which covers rounding.
const CELL: f32 = 1.02;

/// Listing anew begins a little before it must, which covers rounding, …
const HASTE: f32 = 0.95;

/// … so long as all did not move together by more than so many margins.
const FAR: f32 = 1000.0;

/// What two particles that are too near move by together, as a share of what is missing.
const SHARE: f32 = 0.8;

/// The particles of a cloth that keep apart.
#[derive(Clone, Debug)]
pub(crate) struct ParticleCollision {
    grid: HashGrid,
    /// The pairs that may come too near until a particle moved by `margin`, …
    pairs: Vec<[u32; 2]>,
    /// … where particles were when they were listed, …
    listed_at: Vec<Vec3>,
    /// … and which of the pairs are too near; room to sort them in before.
    touching: Vec<[u32; 2]>,
    /// Where the pairs of each particle begin, while they are sorted.
    firsts: Vec<u32>,
    /// The piece that each site was part of before anything tore.
    pieces: Vec<u32>,
    distance: f32,
    /// What lies no farther apart at rest in one piece does not count [m].
    woven: f32,
    /// The margin of the list as it is, 0 for one that does for a single pass, and of those that do for more [m].
    margin: f32,
    wide: f32,
    /// Passes that the list has been asked for.
    passes: u32,
}

impl ParticleCollision {
    fn new(world: &World) -> Self {
        let distance = distance(world);
        let wider = |a: f32, b: f32| if a > b { a } else { b };
        let woven = wider(WOVEN * world.mean_edge, distance);
        let wide = MARGIN * world.mean_edge;
        let (capacity, count) = (world.capacity(), world.particles.len());
        Self {
            grid: HashGrid::new(capacity),
            // As many as balls that lie close have around them; of more, lists grow.
            pairs: Vec::with_capacity(16 * count),
            listed_at: Vec::with_capacity(capacity),
            touching: Vec::with_capacity(16 * count),
            firsts: Vec::with_capacity(capacity + 1),
            pieces: pieces(&world.mesh, world.rest.len()),
            distance,
            woven,
            margin: wide,
            wide,
            passes: 0,
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let pairs = self.pairs.capacity() + self.touching.capacity();
        self.grid.bytes()
            + size_of::<[u32; 2]>() * pairs
            + size_of::<Vec3>() * self.listed_at.capacity()
            + size_of::<u32>() * (self.firsts.capacity() + self.pieces.capacity())
    }

    /// Sees to it that the list holds: that no particle moved farther than the margin since, but for what all did.
    fn see_to_list(&mut self, world: &World) {
        let x = &world.particles.x;
        if self.listed_at.len() != world.particles.len() {
            self.list(world, self.wide);
            return;
        }
        let ways = || x.iter().zip(&self.listed_at).map(|(x, at)| x - *at);
        let drift = ways().fold(Vec3::ZERO, |sum, way| sum + way) * (1.0 / x.x.len() as f32);
        let (most, far) = (HASTE * self.margin, FAR * self.wide);
        let is_near = drift.length_squared() <= far * far;
        let (mut holds, mut farthest) = (is_near && self.margin > 0.0, 0.0);
        for way in ways() {
            let moved = (way - drift).length_squared();
            holds &= moved <= most * most;
            farthest = if moved > farthest { moved } else { farthest };
        }
        self.passes += 1;
        if holds {
            return;
        }
        let lasts = HASTE * self.wide * self.passes as f32;
        let is_calm = farthest * (PASSES * PASSES) <= lasts * lasts;
        self.list(world, if is_calm { self.wide } else { 0.0 });
    }

    fn list(&mut self, world: &World, margin: f32) {
        (self.margin, self.passes) = (margin, 0);
        let Self { grid, pairs, listed_at, touching, firsts, pieces, .. } = self;
        listed_at.clear();
        listed_at.extend(world.particles.x.iter());
        let most = self.distance + 2.0 * margin;
        grid.rebuild(listed_at, CELL * most);
        pairs.clear();
        grid.push_close_pairs(world.level, most * most, pairs);
        let mut count = 0;
        for at in 0..pairs.len() {
            let pair = pairs[at];
            let [site, other] = pair.map(|particle| world.mesh.source[particle as usize] as usize);
            let apart = (world.rest[other] - world.rest[site]).length_squared();
            let is_woven = (pieces[site] == pieces[other]) & (apart <= self.woven * self.woven);
            // Who is woven to whom follows no rule that a processor could learn: so each is written down, and the
            // next one over it if it is.
            pairs[count] = pair;
            count += usize::from(!is_woven);
        }
        pairs.truncate(count);
        for end in [1, 0] {
            sort_by_end(end, pairs, touching, firsts, listed_at.len());
            core::mem::swap(pairs, touching);
        }
    }
}

/// Copies pairs into `sorted`, by one of their ends; those that have the same one there stay in order.
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
    for at in 1..firsts.len() {
        firsts[at] += firsts[at - 1];
    }
    sorted.resize(pairs.len(), [0; 2]);
    for pair in pairs {
        let next = &mut firsts[pair[end] as usize];
        sorted[*next as usize] = *pair;
        *next += 1;
    }
}

impl World {
    /// Refuses a distance between parts of the cloth that is too long for one like this.
    pub fn check_self_distance(&self, settings: &Settings) -> Result<()> {
        let own = settings.self_distance;
        let (most, must) = match settings.self_collision {
            SelfCollision::None => return Ok(()),
            SelfCollision::Surface => {
                (surface::THICK, "be at most half of the mean rest length of the edges")
            }
            SelfCollision::Particles => {
                (MOST, "be at most twice the mean rest length of the edges")
            }
        };
        check(own <= most * self.mean_edge, "settings.self_distance", must)
    }

    /// Makes what particles need that keep apart, or drops it, as settings say.
    pub fn see_to_crowd(&mut self) {
        let is_wanted = self.settings.self_collision == SelfCollision::Particles;
        self.particle_collision = is_wanted.then(|| Box::new(ParticleCollision::new(self)));
    }
}

/// Distance that particles keep [m].
fn distance(world: &World) -> f32 {
    let own = world.settings.self_distance;
    if own > 0.0 { own } else { DISTANCE * world.mean_edge }
}

/// The piece of each site: the lowest site that triangles join it to. Vertices that tore apart are one site.
pub(crate) fn pieces(mesh: &Mesh, sites: usize) -> Vec<u32> {
    let mut parents: Vec<u32> = (0..sites as u32).collect();
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|vertex| mesh.source[vertex as usize]);
        for (p, q) in [(a, b), (b, c)] {
            let (p, q) = (root(&mut parents, p), root(&mut parents, q));
            parents[p.max(q) as usize] = p.min(q);
        }
    }
    (0..sites as u32).map(|site| root(&mut parents, site)).collect()
}

/// The lowest site that `site` is known to be joined to; the way there is halved for the next time.
fn root(parents: &mut [u32], mut site: u32) -> u32 {
    while parents[site as usize] != site {
        parents[site as usize] = parents[parents[site as usize] as usize];
        site = parents[site as usize];
    }
    site
}

/// Lists pairs anew, if something moved too far since.
pub(crate) fn pair(world: &mut World) {
    let Some(mut crowd) = world.particle_collision.take() else {
        return;
    };
    crowd.see_to_list(world);
    world.particle_collision = Some(crowd);
}

/// Moves particles apart, once and in a fixed order.
pub(crate) fn solve(world: &mut World) {
    let Some(crowd) = &mut world.particle_collision else {
        return;
    };
    let (p, distance) = (&mut world.particles, crowd.distance);
    let (pairs, touching) = (&crowd.pairs, &mut crowd.touching);
    // A list without a margin holds no others.
    let touching =
        if crowd.margin > 0.0 { find_touching(pairs, touching, p, distance) } else { pairs };
    for pair in touching {
        let [i, j] = pair.map(|particle| particle as usize);
        let span = p.x.at(j) - p.x.at(i);
        let length = span.length();
        let is_held = p.w[i] <= 0.0 || p.w[j] <= 0.0;
        if is_held || length <= TINY || length >= distance {
            continue;
        }
        let by = span * (SHARE * (distance - length) / length);
        let lightness = p.w[j] / (p.w[i] + p.w[j]);
        p.x.add(i, by * (lightness - 1.0));
        p.x.add(j, by * lightness);
    }
}

/// Finds out which pairs are too near.
fn find_touching<'a>(
    pairs: &[[u32; 2]],
    touching: &'a mut Vec<[u32; 2]>,
    p: &Particles,
    distance: f32,
) -> &'a [[u32; 2]] {
    if touching.len() < pairs.len() {
        touching.resize(pairs.len(), [0; 2]);
    }
    let mut count = 0;
    // As in `list`, each is written down.
    for pair in pairs {
        let [i, j] = pair.map(|particle| particle as usize);
        touching[count] = *pair;
        count += usize::from((p.x.at(j) - p.x.at(i)).length_squared() < distance * distance);
    }
    &touching[..count]
}
