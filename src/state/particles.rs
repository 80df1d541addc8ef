//! What moves: positions, their history, velocities and masses.

use crate::math::columns::Columns;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// The particles of a cloth. Every list has one entry a particle.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Particles {
    /// Where they are [m].
    pub x: Columns,
    /// Where they were one substep ago [m], as far as the velocity update is concerned.
    pub x_prev: Columns,
    /// Velocity [m/s].
    pub v: Columns,
    /// Where they were one tick ago [m]: to blend between ticks when drawing, and to mend from.
    pub x_last: Columns,
    /// Mass [kg].
    pub mass: Vec<f32>,
    /// Inverse mass that the solver sees [1/kg]: 0 while pinned or grabbed.
    pub w: Vec<f32>,
}

impl Particles {
    /// Particles at rest, with room for `capacity`.
    pub fn at_rest(positions: &[Vec3], capacity: usize) -> Self {
        let mut x = Columns::with_capacity(capacity);
        positions.iter().for_each(|p| x.push(*p));
        let mut v = Columns::with_capacity(capacity);
        positions.iter().for_each(|_| v.push(Vec3::ZERO));
        let mut particles = Self {
            x_prev: x.clone(),
            x_last: x.clone(),
            x,
            v,
            mass: vec![0.0; positions.len()],
            w: vec![0.0; positions.len()],
        };
        particles.reserve(capacity);
        particles
    }

    /// Makes room for `capacity` particles in all.
    pub fn reserve(&mut self, capacity: usize) {
        for columns in [&mut self.x, &mut self.x_prev, &mut self.v, &mut self.x_last] {
            columns.reserve(capacity);
        }
        for list in [&mut self.mass, &mut self.w] {
            list.reserve_exact(capacity.saturating_sub(list.len()));
        }
    }

    /// Bytes that one particle takes.
    pub fn bytes_each(&self) -> usize {
        size_of::<f32>() * (4 * 3 + 2)
    }

    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether every list has `count` entries.
    pub fn is_consistent(&self, count: usize) -> bool {
        let columns = [&self.x, &self.x_prev, &self.v, &self.x_last];
        let three = |c: &Columns| c.x.len() == count && c.y.len() == count && c.z.len() == count;
        columns.into_iter().all(three) && self.mass.len() == count && self.w.len() == count
    }

    /// Adds a particle in the state of `source`, and gives its index.
    pub fn push_copy_of(&mut self, source: usize) -> usize {
        for columns in [&mut self.x, &mut self.x_prev, &mut self.v, &mut self.x_last] {
            columns.push(columns.at(source));
        }
        self.mass.push(self.mass[source]);
        self.w.push(self.w[source]);
        self.len() - 1
    }

    /// Puts a particle somewhere with a velocity, its history in line with both.
    pub fn place(&mut self, i: usize, x: Vec3, v: Vec3, substep: f32) {
        self.x.set(i, x);
        self.v.set(i, v);
        self.x_prev.set(i, x - v * substep);
    }

    /// Brings every history in line with position and velocity, for a substep of another length.
    pub fn restart_history(&mut self, substep: f32) {
        for i in 0..self.len() {
            self.x_prev.set(i, self.x.at(i) - self.v.at(i) * substep);
        }
    }
}
