//! Where particles are in a substep, and how far each may still get.

use super::spots::{Spot, drift, place};
use super::sweep::Sweep;
use crate::math::{max, min};
use glam::Vec3;

/// What particles may be pushed by beyond where they are: a share of the mean rest length, of the gap, and of
/// how they moved against the mean. Those that were pushed farther are looked at again.
const SPARE: f32 = 0.02;
const SPARE_GAP: f32 = 1.0;
const SPARE_WAY: f32 = 0.25;

/// How far particles may get.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Scope {
    /// Little beyond where they are.
    Pushed,
    /// That, or back to where they were.
    Back,
}

/// The particles of a cloth in a substep.
#[derive(Clone, Debug)]
pub(super) struct Motion {
    /// Where particles were as the substep began, and where they are.
    pub start: Vec<Spot>,
    pub now: Vec<Spot>,
    /// How all moved in the mean.
    pub drift: Vec3,
    /// The ways from the start that each may have made in the end.
    from: Vec<Spot>,
    to: Vec<Spot>,
}

impl Motion {
    pub fn new(capacity: usize) -> Self {
        let [start, now, from, to] = [(); 4].map(|()| Vec::with_capacity(capacity));
        Self { start, now, drift: Vec3::ZERO, from, to }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let spots = [&self.start, &self.now, &self.from, &self.to];
        size_of::<Spot>() * spots.iter().map(|spots| spots.capacity()).sum::<usize>()
    }

    /// Gives each particle room around where it is.
    pub fn look_ahead(&mut self, spacing: f32, gap: f32, scope: Scope) {
        self.drift = drift(&self.start, &self.now);
        let spare = min(spacing * SPARE, gap * SPARE_GAP);
        self.from.clear();
        self.to.clear();
        let back = self.drift;
        for (start, now) in self.start.iter().zip(&self.now) {
            let way = place(now) - place(start);
            let room = (way - back).length() * SPARE_WAY + spare;
            let (mut from, mut to) = (way - room, way + room);
            if scope == Scope::Back {
                from = Vec3::new(
                    min(from.x, back.x - spare),
                    min(from.y, back.y - spare),
                    min(from.z, back.z - spare),
                );
                to = Vec3::new(
                    max(to.x, back.x + spare),
                    max(to.y, back.y + spare),
                    max(to.z, back.z + spare),
                );
            }
            self.from.push([from.x, from.y, from.z, 0.0]);
            self.to.push([to.x, to.y, to.z, 0.0]);
        }
    }

    /// Whether all are where they were thought to be in the end.
    pub fn is_as_thought(&self) -> bool {
        let mut is_within = true;
        let rooms = self.from.iter().zip(&self.to);
        for ((start, now), (from, to)) in self.start.iter().zip(&self.now).zip(rooms) {
            for k in 0..3 {
                let way = now[k] - start[k];
                is_within &= way >= from[k] && way <= to[k];
            }
        }
        is_within
    }

    /// Grows a sweep to hold a particle.
    #[inline(always)]
    pub fn add_to(&self, sweep: &mut Sweep, particle: u32) {
        sweep.join(&self.one(particle));
    }

    /// How a particle goes.
    #[inline(always)]
    pub fn one(&self, particle: u32) -> Sweep {
        let at = particle as usize;
        let start = self.start[at];
        Sweep { low: start, high: start, from: self.from[at], to: self.to[at] }
    }

    /// How particles go together.
    #[inline(always)]
    pub fn of(&self, particles: &[u32]) -> Sweep {
        let mut all = self.one(particles[0]);
        particles[1..].iter().for_each(|particle| self.add_to(&mut all, *particle));
        all
    }

    /// The least that a particle gets along `n`, and the most.
    #[inline(always)]
    pub fn ends_along(&self, particle: u32, n: Vec3) -> [f32; 2] {
        let at = particle as usize;
        let (from, to) = (place(&self.from[at]), place(&self.to[at]));
        let (a, b) = (n * from, n * to);
        let start = n.dot(place(&self.start[at]));
        [
            start + min(a.x, b.x) + min(a.y, b.y) + min(a.z, b.z),
            start + max(a.x, b.x) + max(a.y, b.y) + max(a.z, b.z),
        ]
    }
}
