//! How far pairs keep apart: as far as layers do, unless they are nearer at rest.

use crate::geometry::aabb::Aabb;
use crate::math::{max, min};
use crate::solver::self_collide::surface::contact::{Contact, Kind};
use crate::solver::self_collide::surface::split_separation::HAIR;
use crate::solver::world::World;
use glam::Vec3;

/// Pairs of one piece keep no farther apart than this share of their distance at rest.
const WOVEN: f32 = 0.5;

/// A cloth at rest.
#[derive(Clone, Copy)]
pub(crate) struct RestGap<'a> {
    pub world: &'a World,
    /// The piece that each site was part of before anything tore.
    pub pieces: &'a [u32],
    /// How far layers keep apart [m].
    pub gap: f32,
}

impl RestGap<'_> {
    /// What is farther apart at rest keeps all of the gap [m].
    pub fn near(&self) -> f32 {
        self.gap / WOVEN
    }

    /// How far a pair keeps apart [m].
    pub fn gap_of<const FIRST: Kind>(&self, ids: [u32; 4]) -> f32 {
        let [a, b, c, d] = ids;
        let site = |id: u32| self.world.mesh.source[id as usize] as usize;
        let sites = [site(a), site(b), site(c), site(d)];
        if self.pieces[sites[0]] != self.pieces[sites[3]] {
            return self.gap;
        }
        let rest = |at: usize| self.world.rest[sites[at]];
        let x = [rest(0), rest(1), rest(2), rest(3)];
        let (one, other) = x.split_at(FIRST as usize);
        let sides = [one, other].map(|side: &[Vec3]| Aabb::from_points(side.iter().copied()));
        if !sides[0].expanded(self.near()).overlaps(&sides[1]) {
            return self.gap;
        }
        // The sides of a slit are at the same place at rest, and a hair apart as they part.
        let least = self.world.mean_edge * (WOVEN * HAIR);
        min(self.gap, max(WOVEN * Contact::distance::<FIRST>(x), least))
    }
}
