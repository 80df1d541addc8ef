//! Stages `Pairs` and `SelfContacts` with particle collision: particles keep apart as if they were
//! balls.
//!
//! ```text
//! i ◀── 0.4 o ── ●   ● ── 0.4 o ──▶ j        o = distance − |j − i|,  for equal masses
//! ```
//! One Gauss–Seidel pass per substep over all pairs that are too near when it begins, with
//! relaxation 0.8. Of unequal masses the lighter one moves farther, so momentum is conserved. Fixed
//! particles and neighbours in the mesh do not collide, and triangles may still cross.
//!
//! Reads `particle_collision`, particles and the painted thickness; writes particle positions.
//!
//! Invariant: only pairs that are nearer than the largest distance at the start of the pass move, in
//! the order of their particles; so the result does not depend on when the pair list was made.

use crate::error::{Result, check};
use crate::math::{TINY, min};
use crate::mesh::{NONE, triangle_of};
use crate::model::maps::Map;
use crate::solver::self_collide::MAX_GAP;
use crate::solver::self_collide::particle_pairs::{PairListInput, ParticleCollision};
use crate::solver::world::World;
use crate::state::particles::Particles;
use crate::state::settings::{SelfCollision, Settings};

/// Collision distance for `self_distance` 0 [mean rest lengths].
const DEFAULT_DISTANCE: f32 = 2.0 / 3.0;

/// Largest collision distance [mean rest lengths]. A larger one would make too many pairs.
const MAX_DISTANCE: f32 = 2.0;

/// Share of the overlap that a pass removes.
const RELAXATION: f32 = 0.8;

impl World {
    /// Checks `self_distance` against the mean rest length of this cloth.
    ///
    /// # Errors
    /// `BadValue` if it is larger than half of that for surface collision, or than twice that for
    /// particle collision.
    pub fn check_self_distance(&self, settings: &Settings) -> Result<()> {
        let own = settings.self_distance;
        let (most, must) = match settings.self_collision {
            SelfCollision::None => return Ok(()),
            SelfCollision::Surface => {
                (MAX_GAP, "be at most half of the mean rest length of the edges")
            }
            SelfCollision::Particles => {
                (MAX_DISTANCE, "be at most twice the mean rest length of the edges")
            }
        };
        check(own <= most * self.mean_edge, "settings.self_distance", must)
    }

    /// Rebuilds the data of particle collision, or drops it, by `settings.self_collision`.
    pub fn rebuild_particle_collision(&mut self) {
        let is_wanted = self.settings.self_collision == SelfCollision::Particles;
        self.scratch.particle_collision = is_wanted.then(|| {
            let input = pair_list_input(self);
            let (distance, capacity) = (largest_distance(self), self.capacity());
            Box::new(ParticleCollision::new(input, distance, self.mean_edge, capacity))
        });
    }
}

fn pair_list_input(world: &World) -> PairListInput<'_> {
    let World { level, mesh, rest, particles, sewing, .. } = world;
    PairListInput { level: *level, mesh, rest, particles, sewing }
}

/// Distance that particles keep at scale 1 [m].
fn collision_distance(world: &World) -> f32 {
    let own = world.settings.self_distance;
    if own > 0.0 { own } else { DEFAULT_DISTANCE * world.mean_edge }
}

/// Largest distance that particles keep [m].
fn largest_distance(world: &World) -> f32 {
    match world.maps.get(Map::Thickness) {
        Some(_) => {
            let [_, largest] = world.maps.range(Map::Thickness);
            min(collision_distance(world) * largest, MAX_DISTANCE * world.mean_edge)
        }
        None => collision_distance(world),
    }
}

/// Distance that each pair keeps.
#[derive(Clone, Copy)]
struct PairDistance<'a> {
    /// At scale 1, and at most [m].
    unscaled: f32,
    largest: f32,
    /// Painted thickness of each particle; `None` if all are 1.
    scales: Option<&'a [f32]>,
}

impl PairDistance<'_> {
    #[inline(always)]
    fn of(&self, [i, j]: [usize; 2]) -> f32 {
        self.scales.map_or(self.largest, |scales| {
            min(self.unscaled * 0.5 * (scales[i] + scales[j]), self.largest)
        })
    }
}

/// Rebuilds the pair list if particles moved too far since it was made.
pub(crate) fn refresh_pairs(world: &mut World) {
    let Some(mut collision) = world.scratch.particle_collision.take() else {
        return;
    };
    collision.refresh_pairs(pair_list_input(world));
    world.scratch.particle_collision = Some(collision);
}

/// Joins the pieces of free particles that are too near, in `scratch.piece_groups`.
pub(crate) fn join_touching_pieces(world: &mut World) {
    let unscaled = collision_distance(world);
    let groups = &mut world.scratch.piece_groups;
    groups.reset(world.pieces);
    let Some(collision) = &world.scratch.particle_collision else {
        return;
    };
    let (p, labels, mesh) = (&world.particles, &world.scratch.pieces, &world.mesh);
    let own = PairDistance {
        unscaled,
        largest: collision.distance,
        scales: world.maps.get(Map::Thickness),
    };
    for [i, j] in collision.pairs.iter().map(|pair| pair.map(|particle| particle as usize)) {
        let corners = [mesh.corner_of[i], mesh.corner_of[j]];
        let is_held = p.w[i] <= 0.0 || p.w[j] <= 0.0;
        if is_held || corners.contains(&NONE) {
            continue;
        }
        let [a, b] = corners.map(|corner| labels.label[triangle_of(corner)]);
        let distance2 = (p.x.get(j) - p.x.get(i)).length_squared();
        let distance = own.of([i, j]);
        if a != b && distance2 < distance * distance {
            groups.join(a, b);
        }
    }
}

/// Separates the pairs of particles that are too near, in one pass.
pub(crate) fn solve(world: &mut World) {
    let unscaled = collision_distance(world);
    let Some(collision) = &mut world.scratch.particle_collision else {
        return;
    };
    let (p, largest) = (&mut world.particles, collision.distance);
    let own = PairDistance { unscaled, largest, scales: world.maps.get(Map::Thickness) };
    let (pairs, touching) = (&collision.pairs, &mut collision.touching);
    // A list without margin holds touching pairs only.
    let touching =
        if collision.margin > 0.0 { collect_touching(pairs, touching, p, largest) } else { pairs };
    for pair in touching {
        let [i, j] = pair.map(|particle| particle as usize);
        let d = p.x.get(j) - p.x.get(i);
        let length = d.length();
        let (is_fixed, distance) = (p.w[i] <= 0.0 || p.w[j] <= 0.0, own.of([i, j]));
        if is_fixed || length <= TINY || length >= distance {
            continue;
        }
        let by = d * (RELAXATION * (distance - length) / length);
        let share = p.w[j] / (p.w[i] + p.w[j]);
        p.x.add(i, by * (share - 1.0));
        p.x.add(j, by * share);
    }
}

/// Collects the pairs that are nearer than `distance` [m], in order.
fn collect_touching<'a>(
    pairs: &[[u32; 2]],
    touching: &'a mut Vec<[u32; 2]>,
    p: &Particles,
    distance: f32,
) -> &'a [[u32; 2]] {
    if touching.len() < pairs.len() {
        touching.resize(pairs.len(), [0; 2]);
    }
    let mut count = 0;
    // Compaction without a branch, as in `particle_pairs`.
    for pair in pairs {
        let [i, j] = pair.map(|particle| particle as usize);
        touching[count] = *pair;
        count += usize::from((p.x.get(j) - p.x.get(i)).length_squared() < distance * distance);
    }
    &touching[..count]
}
