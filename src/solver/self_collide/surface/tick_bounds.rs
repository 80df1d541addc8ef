//! How far particles may get in all that is left of a tick, so that patches are paired once and not in each
//! substep.
//!
//! Ways are told against how all move in the mean, so that a cloth that falls as a whole stays where it is.

use crate::math::simd::{Baseline, Float, Simd};
use crate::math::wide4::{Float4, xyz};
use crate::math::{max, min};
use crate::solver::particle_stage::interleaved::drift;
use crate::solver::self_collide::surface::swept_particles::Motion;
use glam::Vec3;

/// What particles may be moved by beyond where they go on to: a share of the mean rest length, and of how far they
/// go on.
const SPARE_WAY: f32 = 0.25;

/// Where particles may get.
#[derive(Clone, Debug)]
pub(crate) struct Reach {
    /// Where particles were.
    base: Vec<Float4>,
    /// The ways from there, against the mean, that each may have made.
    from: Vec<Float4>,
    to: Vec<Float4>,
    /// Whether that is of this tick.
    pub is_known: bool,
    /// How all moved from the base to the start of the substep, and to where they are.
    drifts: [Vec3; 2],
}

impl Reach {
    pub fn new(capacity: usize) -> Self {
        let [base, from, to] = [(); 3].map(|()| Vec::with_capacity(capacity));
        Self { base, from, to, is_known: false, drifts: [Vec3::ZERO; 2] }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of::<Float4>() * (self.base.capacity() + self.from.capacity() + self.to.capacity())
    }

    /// Gives each particle room to go on for so many substeps, this one being the first.
    pub fn look_ahead(&mut self, motion: &Motion, substeps: u32, spare: f32) {
        self.base.clone_from(&motion.start);
        self.drifts = [Vec3::ZERO, motion.drift];
        self.from.clear();
        self.to.clear();
        let times = substeps as f32;
        for (at, (start, now)) in motion.start.iter().zip(&motion.now).enumerate() {
            let way = (xyz(now) - xyz(start) - motion.drift) * times;
            let room = Vec3::splat(way.length() * SPARE_WAY);
            let (from, to) = (way.min(Vec3::ZERO) - room, way.max(Vec3::ZERO) + room);
            let [least, most] = motion.ways(at).map(|way| way - motion.drift);
            self.from.push((from.min(least) - spare).extend(0.0).to_array());
            self.to.push((to.max(most) + spare).extend(0.0).to_array());
        }
        self.is_known = true;
    }

    /// Finds how all moved up to this substep.
    pub fn follow(&mut self, motion: &Motion) {
        let before = drift(&self.base, &motion.start);
        self.drifts = [before, before + motion.drift];
    }

    /// Whether all particles stay where they were thought to get in this substep.
    pub fn holds(&self, motion: &Motion) -> bool {
        let simd = Baseline::new();
        let [starts, leasts, mosts] = motion.rooms();
        let drifts = self.drifts.map(|drift| drift.extend(0.0).to_array());
        // Inverse masses are no ways.
        let is_way = [1.0, 1.0, 1.0, 0.0];
        let mut is_within = true;
        for k in (0..4).step_by(Baseline::LANES) {
            let [before_drift, after_drift] = drifts.map(|drift| simd.load(&drift, k));
            let is_way = simd.load(&is_way, k);
            let zero = simd.splat(0.0);
            let (mut room, mut sound) = (simd.splat(f32::INFINITY), zero);
            let rooms = self.from.iter().zip(&self.to);
            let ways = starts.iter().zip(leasts).zip(mosts);
            for (((start, least), most), (base, (from, to))) in
                ways.zip(self.base.iter().zip(rooms))
            {
                let way = (simd.load(start, k) - simd.load(base, k)) * is_way;
                let before = way - before_drift;
                let least = Float::min(before, way + simd.load(least, k) - after_drift);
                let most = Float::max(before, way + simd.load(most, k) - after_drift);
                let left = Float::min(least - simd.load(from, k), simd.load(to, k) - most);
                // What is no number leaves none in the second.
                (room, sound) = (Float::min(room, left), sound + (least + most) * zero);
            }
            let mut ends = [[0.0; 4]; 2];
            simd.store(&mut ends[0], k, room);
            simd.store(&mut ends[1], k, sound);
            let [room, sound] = ends.each_ref().map(|end| &end[k..k + Baseline::LANES]);
            is_within &= room.iter().all(|room| *room >= 0.0);
            is_within &= sound.iter().all(|sound| *sound == 0.0);
        }
        is_within
    }

    /// Gives a particle room to where it gets in this substep.
    pub fn widen(&mut self, motion: &Motion, particle: u32) {
        let at = particle as usize;
        let way = xyz(&motion.start[at]) - xyz(&self.base[at]);
        let ends = motion.ways(at).map(|end| way + end - self.drifts[1]);
        for way in ends {
            for (k, way) in way.to_array().into_iter().enumerate() {
                self.from[at][k] = min(self.from[at][k], way);
                self.to[at][k] = max(self.to[at][k], way);
            }
        }
    }

    /// Where particles were, and the ways from there that each may have made, from and to.
    pub fn rooms(&self) -> [&[Float4]; 3] {
        [&self.base, &self.from, &self.to]
    }
}
