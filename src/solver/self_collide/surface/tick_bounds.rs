//! Tick bounds: a box for each particle that contains its motion in the rest of a tick.
//!
//! ```text
//!   base ●╌╌╌╌▶ now ╌╌╌╌▶ ╌╌╌╌▶ ╌╌╌╌▶ ┌┐      displacement of this substep × substeps left,
//!        └──────────────────────────────┘      grown by a slack
//! ```
//! Cluster pairs are collected from the cluster BVH once with these bounds, not in each substep.
//! The bounds are relative to the mean displacement, so that a cloth in free fall stays within
//! them.
//!
//! Reads [`SweptParticles`]; writes its own lists, which [`ClusterBvh::rebuild_tick_pairs`] reads.
//!
//! Invariant: while [`TickBounds::contain`] returns true, every pair of particles that can come
//! within the gap is in a cluster pair of the tick.
//!
//! [`ClusterBvh::rebuild_tick_pairs`]: super::cluster_bvh::ClusterBvh::rebuild_tick_pairs

use crate::math::simd::{Baseline, Float, Simd};
use crate::math::wide4::{Float4, xyz};
use crate::math::{max, min};
use crate::solver::particle_stage::interleaved::mean_displacement;
use crate::solver::self_collide::surface::swept_particles::SweptParticles;
use glam::Vec3;

/// Slack per axis, as a share of the length of the predicted displacement.
const SLACK_OF_DISPLACEMENT: f32 = 0.25;

/// Motion bounds of all particles for the rest of a tick.
#[derive(Clone, Debug)]
pub(crate) struct TickBounds {
    /// Positions when the bounds were built.
    base: Vec<Float4>,
    /// Lower and upper corner of the box of displacements from there, relative to the mean [m].
    bound_low: Vec<Float4>,
    bound_high: Vec<Float4>,
    /// Whether the bounds belong to the current tick, gap and particles.
    pub is_valid: bool,
    /// Mean displacement from `base` to the start of the substep, and to the current positions [m].
    mean_displacements: [Vec3; 2],
}

impl TickBounds {
    pub fn new(capacity: usize) -> Self {
        let [base, bound_low, bound_high] = [(); 3].map(|()| Vec::with_capacity(capacity));
        let mean_displacements = [Vec3::ZERO; 2];
        Self { base, bound_low, bound_high, is_valid: false, mean_displacements }
    }

    /// Heap memory [bytes].
    pub fn bytes(&self) -> usize {
        let lists = [&self.base, &self.bound_low, &self.bound_high];
        size_of::<Float4>() * lists.iter().map(|list| list.capacity()).sum::<usize>()
    }

    /// Rebuilds all bounds for `substeps` more substeps, this one included, each with the
    /// displacement of this one. `slack` [m] is added on each side.
    pub fn rebuild(&mut self, motion: &SweptParticles, substeps: u32, slack: f32) {
        let mean = motion.mean_displacement;
        self.base.clone_from(&motion.start);
        self.mean_displacements = [Vec3::ZERO, mean];
        self.bound_low.clear();
        self.bound_high.clear();
        let times = substeps as f32;
        for (i, (start, now)) in motion.start.iter().zip(&motion.now).enumerate() {
            let predicted = (xyz(now) - xyz(start) - mean) * times;
            let share = Vec3::splat(predicted.length() * SLACK_OF_DISPLACEMENT);
            let (low, high) =
                (predicted.min(Vec3::ZERO) - share, predicted.max(Vec3::ZERO) + share);
            let [substep_low, substep_high] = motion.bound_of(i).map(|bound| bound - mean);
            self.bound_low.push((low.min(substep_low) - slack).extend(0.0).to_array());
            self.bound_high.push((high.max(substep_high) + slack).extend(0.0).to_array());
        }
        self.is_valid = true;
    }

    /// Updates the mean displacements to the current substep.
    pub fn update_mean_displacements(&mut self, motion: &SweptParticles) {
        let before = mean_displacement(&self.base, &motion.start);
        self.mean_displacements = [before, before + motion.mean_displacement];
    }

    /// Whether the motion bounds of this substep lie within these bounds for all particles.
    pub fn contain(&self, motion: &SweptParticles) -> bool {
        let simd = Baseline::new();
        let [starts, substep_lows, substep_highs] = motion.start_and_bounds();
        let means = self.mean_displacements.map(|mean| mean.extend(0.0).to_array());
        // The fourth number is an inverse mass, not a coordinate.
        let is_axis = [1.0, 1.0, 1.0, 0.0];
        let mut is_within = true;
        for k in (0..4).step_by(Baseline::LANES) {
            let [mean_before, mean_after] = means.map(|mean| simd.load(&mean, k));
            let is_axis = simd.load(&is_axis, k);
            let zero = simd.splat(0.0);
            let (mut slack, mut finite) = (simd.splat(f32::INFINITY), zero);
            let bounds = self.bound_low.iter().zip(&self.bound_high);
            let substeps = starts.iter().zip(substep_lows).zip(substep_highs);
            for (((start, low), high), (base, (bound_low, bound_high))) in
                substeps.zip(self.base.iter().zip(bounds))
            {
                let moved = (simd.load(start, k) - simd.load(base, k)) * is_axis;
                let before = moved - mean_before;
                let low = Float::min(before, moved + simd.load(low, k) - mean_after);
                let high = Float::max(before, moved + simd.load(high, k) - mean_after);
                let left =
                    Float::min(low - simd.load(bound_low, k), simd.load(bound_high, k) - high);
                // `finite` becomes NaN if a bound is NaN or infinite.
                (slack, finite) = (Float::min(slack, left), finite + (low + high) * zero);
            }
            let mut lanes = [[0.0; 4]; 2];
            simd.store(&mut lanes[0], k, slack);
            simd.store(&mut lanes[1], k, finite);
            let [slack, finite] = lanes.each_ref().map(|lane| &lane[k..k + Baseline::LANES]);
            is_within &= slack.iter().all(|slack| *slack >= 0.0);
            is_within &= finite.iter().all(|finite| *finite == 0.0);
        }
        is_within
    }

    /// Widens the bound of a particle to contain its motion bound of this substep.
    pub fn widen(&mut self, motion: &SweptParticles, particle: u32) {
        let i = particle as usize;
        let moved = xyz(&motion.start[i]) - xyz(&self.base[i]);
        let corners = motion.bound_of(i).map(|end| moved + end - self.mean_displacements[1]);
        for corner in corners {
            for (k, x) in corner.to_array().into_iter().enumerate() {
                self.bound_low[i][k] = min(self.bound_low[i][k], x);
                self.bound_high[i][k] = max(self.bound_high[i][k], x);
            }
        }
    }

    /// Base positions, and the lower and upper corners of the bounds.
    pub fn base_and_bounds(&self) -> [&[Float4]; 3] {
        [&self.base, &self.bound_low, &self.bound_high]
    }
}
