//! Where particles are in a substep, and how far each may still get.

use crate::math::wide4::{Four, WAYS};
use crate::solver::particle_stage::interleaved;

use crate::math::wide4::{Float4, xyz};
use crate::math::{max, min};
use crate::solver::particle_stage::interleaved::drift;
use crate::solver::self_collide::surface::swept_aabb::Sweep;
use glam::Vec3;

/// What particles may be pushed by beyond where they are: a share of the mean rest length, of the gap, and of
/// how they moved against the mean. Those that were pushed farther are looked at again.
const SPARE: f32 = 0.03;
const SPARE_GAP: f32 = 1.5;
const SPARE_WAY: f32 = 0.25;

/// The particles of a cloth in a substep.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    /// Where particles were as the substep began, and where they are.
    pub start: Vec<Float4>,
    pub now: Vec<Float4>,
    /// How all moved in the mean.
    pub drift: Vec3,
    /// The ways from the start that each may have made in the end.
    from: Vec<Float4>,
    to: Vec<Float4>,
    /// Whether each got out of that.
    strays: Vec<bool>,
}

impl Motion {
    pub fn new(capacity: usize) -> Self {
        let [start, now, from, to] = [(); 4].map(|()| Vec::with_capacity(capacity));
        let strays = Vec::with_capacity(capacity);
        Self { start, now, drift: Vec3::ZERO, from, to, strays }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let spots = [&self.start, &self.now, &self.from, &self.to];
        size_of::<Float4>() * spots.iter().map(|spots| spots.capacity()).sum::<usize>()
            + self.strays.capacity()
    }

    /// Gives each particle room around where it is.
    pub fn look_ahead(&mut self, spacing: f32, gap: f32) {
        let Self { start, now, from, to, .. } = self;
        self.drift = drift(start, now);
        from.resize(start.len(), [0.0; 4]);
        to.resize(start.len(), [0.0; 4]);
        let spare = min(spacing * SPARE, gap * SPARE_GAP);
        interleaved::give_room([start, now], [from, to], self.drift, [SPARE_WAY, spare]);
    }

    /// Gives those room that strayed from what they had, to where they are and, if they may, back to where they
    /// were; says whether there are any, and whether all are where they are thought to be by that.
    pub fn look_again(&mut self, spacing: f32, gap: f32, may_go_back: bool) -> [bool; 2] {
        let spare = min(spacing * SPARE, gap * SPARE_GAP);
        let drift = Four::way(self.drift);
        let (mut any, mut are_within) = (false, true);
        self.strays.clear();
        self.strays.resize(self.now.len(), false);
        let rooms = self.from.iter_mut().zip(&mut self.to).zip(&mut self.strays);
        for ((start, now), ((from, to), strays)) in self.start.iter().zip(&self.now).zip(rooms) {
            if surely_holds(from, to, Four::of(now) - Four::of(start))
                && (!may_go_back || surely_holds(from, to, drift))
            {
                continue;
            }
            let way = xyz(now) - xyz(start);
            *strays = !holds(from, to, way);
            if *strays {
                extend(from, to, way, way.distance(self.drift) * SPARE_WAY + spare);
            }
            if may_go_back && !holds(from, to, self.drift) {
                extend(from, to, self.drift, spare);
                *strays = true;
            }
            any |= *strays;
            are_within &= holds(from, to, way);
        }
        [any, are_within]
    }

    /// Whether a particle strayed.
    #[inline(always)]
    pub fn strays(&self, particle: u32) -> bool {
        self.strays[particle as usize]
    }

    /// Whether some are where they were thought to be in the end.
    pub fn are_as_thought(&self, mut particles: impl Iterator<Item = u32>) -> bool {
        particles.all(|at| {
            let at = at as usize;
            holds(&self.from[at], &self.to[at], xyz(&self.now[at]) - xyz(&self.start[at]))
        })
    }

    /// Where particles were as the substep began, and the ways that each may have made in the end, from and to.
    pub fn rooms(&self) -> [&[Float4]; 3] {
        [&self.start, &self.from, &self.to]
    }

    /// The ways that a particle may have made in the end, from and to.
    #[inline(always)]
    pub fn ways(&self, at: usize) -> [Vec3; 2] {
        [xyz(&self.from[at]), xyz(&self.to[at])]
    }

    /// Grows a sweep to hold a particle.
    #[inline(always)]
    pub fn add_to(&self, sweep: &mut Sweep, particle: u32) {
        sweep.join(&self.one(particle));
    }

    /// Where particles are together as the substep begins.
    #[inline(always)]
    pub fn still<const COUNT: usize>(&self, particles: [u32; COUNT]) -> Sweep {
        let mut all = Sweep::EMPTY;
        for particle in particles {
            let start = &self.start[particle as usize];
            for k in 0..4 {
                all.low[k] = min(all.low[k], start[k]);
                all.high[k] = max(all.high[k], start[k]);
            }
        }
        Sweep { from: [0.0; 4], to: [0.0; 4], ..all }
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
    pub fn of<const COUNT: usize>(&self, particles: [u32; COUNT]) -> Sweep {
        let mut all = self.one(particles[0]);
        for particle in &particles[1..] {
            all.join(&self.one(*particle));
        }
        all
    }

    /// The least that a particle gets along `n`, and the most.
    #[inline(always)]
    pub fn ends_along(&self, particle: u32, n: Vec3) -> [f32; 2] {
        let at = particle as usize;
        let (from, to) = (xyz(&self.from[at]), xyz(&self.to[at]));
        let (a, b) = (n * from, n * to);
        let start = n.dot(xyz(&self.start[at]));
        [
            start + min(a.x, b.x) + min(a.y, b.y) + min(a.z, b.z),
            start + max(a.x, b.x) + max(a.y, b.y) + max(a.z, b.z),
        ]
    }
}

#[inline(always)]
fn holds(from: &Float4, to: &Float4, way: Vec3) -> bool {
    let way = way.to_array();
    (0..3).all(|k| way[k] >= from[k] && way[k] <= to[k])
}

/// The same, but it may miss what is just within.
#[inline(always)]
fn surely_holds(from: &Float4, to: &Float4, way: Four) -> bool {
    (way - Four::of(from)).min(Four::of(to) - way).positives() & WAYS == WAYS
}

#[inline(always)]
fn extend(from: &mut Float4, to: &mut Float4, way: Vec3, room: f32) {
    for (k, way) in way.to_array().into_iter().enumerate() {
        from[k] = min(from[k], way - room);
        to[k] = max(to[k], way + room);
    }
}
