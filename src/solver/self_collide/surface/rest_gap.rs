//! Gap of each pair: the gap of the material, or a smaller one for pairs that are nearer at rest.
//!
//! ```text
//! gap(pair) = min(own, max(½ · rest distance, ½ · split distance))    both sides of one piece
//! gap(pair) = own                                                     otherwise
//! own       = gap · mean painted thickness of both sides
//! ```
//! Without this rule, neighbours in a fine mesh, whose rest distance is below the gap, would push
//! each other all the time.
//!
//! Reads the mesh, its rest positions and the painted thickness; writes nothing.
//!
//! Invariant: the gap of a pair depends on the rest shape and on the map only, so it can be cached
//! until the map changes.

use crate::geometry::aabb::Aabb;
use crate::math::{max, min};
use crate::mesh::Mesh;
use crate::model::maps::mean;
use crate::solver::self_collide::surface::contact::{Contact, ContactKind};
use crate::solver::self_collide::surface::split_separation::SPLIT_DISTANCE;
use crate::state::sewing::Sewing;
use glam::Vec3;

/// Gap of a pair of one piece, as a share of its rest distance.
const REST_DISTANCE_SHARE: f32 = 0.5;

/// The rest shape of a cloth, and the gap between its layers.
#[derive(Clone, Copy)]
pub(crate) struct RestGap<'a> {
    pub mesh: &'a Mesh,
    /// Rest position of each site [m].
    pub rest: &'a [Vec3],
    /// Connected piece of each site in the mesh as created.
    pub pieces: &'a [u32],
    /// Mean rest length of the edges [m].
    pub mean_edge: f32,
    /// Largest gap between layers [m].
    pub gap: f32,
    /// Particles that are sewn together do not collide.
    pub sewing: &'a Sewing,
    pub painted: Option<PaintedGap<'a>>,
}

/// Gaps that differ from pair to pair, by the painted thickness.
#[derive(Clone, Copy)]
pub(crate) struct PaintedGap<'a> {
    /// Scale of each particle.
    pub scales: &'a [f32],
    /// Gap at scale 1, and least gap [m].
    pub gap: f32,
    pub least: f32,
}

impl PaintedGap<'_> {
    /// The gap of a pair before limits [m].
    fn of(&self, ids: [u32; 4], kind: ContactKind) -> f32 {
        let (one, other) = ids.split_at(kind as usize);
        self.gap * 0.5 * (mean(self.scales, one) + mean(self.scales, other))
    }
}

impl RestGap<'_> {
    /// Whether a particle of one side of a pair is, or is sewn to, one of the other side.
    #[inline(always)]
    pub fn are_joined(&self, one: &[u32], other: &[u32]) -> bool {
        one.iter().any(|id| other.contains(id))
            || (!self.sewing.is_empty() && self.are_sewn(one, other))
    }

    #[inline(never)]
    fn are_sewn(&self, one: &[u32], other: &[u32]) -> bool {
        let leader = |id: &u32| self.sewing.leader(*id);
        one.iter().any(|a| other.iter().any(|b| leader(a) == leader(b)))
    }

    /// Rest distance from which on a pair keeps the full gap [m].
    pub fn full_gap_distance(&self) -> f32 {
        self.gap / REST_DISTANCE_SHARE
    }

    /// The gap of a pair that is far apart at rest [m].
    #[inline(always)]
    pub fn full_gap_of<const KIND: ContactKind>(&self, ids: [u32; 4]) -> f32 {
        self.painted
            .map_or(self.gap, |painted| min(max(painted.of(ids, KIND), painted.least), self.gap))
    }

    /// The gap of a pair [m].
    pub fn gap_of<const KIND: ContactKind>(&self, ids: [u32; 4]) -> f32 {
        let gap = self.full_gap_of::<KIND>(ids);
        let [a, b, c, d] = ids;
        let site = |id: u32| self.mesh.source[id as usize] as usize;
        let sites = [site(a), site(b), site(c), site(d)];
        if self.pieces[sites[0]] != self.pieces[sites[3]] {
            return gap;
        }
        let rest = |k: usize| self.rest[sites[k]];
        let x = [rest(0), rest(1), rest(2), rest(3)];
        let (one, other) = x.split_at(KIND as usize);
        let sides = [one, other].map(|side: &[Vec3]| Aabb::from_points(side.iter().copied()));
        if !sides[0].expanded(self.full_gap_distance()).overlaps(&sides[1]) {
            return gap;
        }
        // Both sides of a split are at the same place at rest; `split_separation` moves them apart
        // this far.
        let least = self.mean_edge * (REST_DISTANCE_SHARE * SPLIT_DISTANCE);
        min(gap, max(REST_DISTANCE_SHARE * Contact::distance::<KIND>(x), least))
    }
}
