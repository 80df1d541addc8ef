//! What the corners of touching triangles get: of all that pushes a particle the mean, by what it weighs
//! there and how deep it is, so that what just begins or ends to touch changes nothing at once.
//!
//! One push after the other would leave the last right and all before it off, so that a cloth over a ridge
//! would never lie still.

use crate::solver::collide::{Place, Push};
use glam::Vec3;

/// Pushes of particles, gathered.
#[derive(Clone, Debug, Default)]
pub(super) struct Lifts {
    /// An entry for each particle.
    sums: Vec<Lift>,
    /// Those that are pushed, in the order of their first pushes.
    pushed: Vec<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Lift {
    moved: Vec3,
    normal: Vec3,
    weight: f32,
    /// The most that it weighs in one push.
    most: f32,
}

impl Lift {
    const NONE: Self = Self { moved: Vec3::ZERO, normal: Vec3::ZERO, weight: 0.0, most: 0.0 };
}

impl Lifts {
    pub fn reserve(&mut self, particles: usize) {
        self.sums.reserve_exact(particles.saturating_sub(self.sums.len()));
        self.pushed.reserve_exact(particles.saturating_sub(self.pushed.len()));
    }

    /// As many particles as there are, none of them pushed.
    pub fn begin(&mut self, count: usize) {
        self.sums.resize(count, Lift::NONE);
        self.pushed.clear();
    }

    /// Those that were pushed.
    pub fn pushed(&self) -> &[u32] {
        &self.pushed
    }

    /// A point of a triangle moves: its corners get of it what they weigh in it. All as the collider sees it.
    pub fn add(
        &mut self,
        corners: [usize; 3],
        weights: [f32; 3],
        w: [f32; 3],
        moved: Vec3,
        Push { normal, depth, .. }: Push,
    ) {
        let share: f32 = (0..3).map(|k| weights[k] * weights[k] * w[k]).sum();
        if share <= 0.0 {
            return;
        }
        for k in 0..3 {
            let lever = weights[k] * w[k];
            if lever <= 0.0 {
                continue;
            }
            let lift = &mut self.sums[corners[k]];
            if lift.weight == 0.0 {
                self.pushed.push(corners[k] as u32);
            }
            let weight = weights[k] * depth;
            lift.moved += moved * (lever / share * weight);
            lift.normal += normal * weight;
            lift.weight += weight;
            if weights[k] > lift.most {
                lift.most = weights[k];
            }
        }
    }

    /// Moves all that were pushed.
    pub fn apply(&mut self, place: &mut Place<'_>) {
        for i in &self.pushed {
            let i = *i as usize;
            let lift = core::mem::replace(&mut self.sums[i], Lift::NONE);
            let length = lift.normal.length();
            if length > 0.0 {
                let frame = place.frames[1];
                let normal = frame.vector_to_world(lift.normal * (1.0 / length));
                let moved = frame.vector_to_world(lift.moved * (1.0 / lift.weight));
                place.shift(i, place.now(i), normal, moved, lift.most);
            }
        }
    }
}
