//! What moves: positions, their history, velocities and masses.

use crate::math::columns::Columns;
use crate::math::{lerp, saturate};
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// The particles of a cloth. Every list has one entry a particle.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Particles {
    /// Where they are [m].
    pub x: Columns,
    /// How far they moved in the last substep [m], kept apart because a difference of positions
    /// would lose most of its digits.
    pub displacement: Columns,
    /// Velocity [m/s].
    pub v: Columns,
    /// Velocity as its history lets expect it for the next substep, (4 v - v_prev) / 3 [m/s].
    pub v_extrapolated: Columns,
    /// Where they were one tick ago [m]: to blend lerp ticks when drawing, and to mend from.
    pub x_prev_tick: Columns,
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
            displacement: v.clone(),
            x_prev_tick: x.clone(),
            x,
            v_extrapolated: v.clone(),
            v,
            mass: vec![0.0; positions.len()],
            w: vec![0.0; positions.len()],
        };
        particles.reserve(capacity);
        particles
    }

    fn all_columns(&mut self) -> [&mut Columns; 5] {
        [
            &mut self.x,
            &mut self.displacement,
            &mut self.v,
            &mut self.v_extrapolated,
            &mut self.x_prev_tick,
        ]
    }

    /// Makes room for `capacity` particles in all.
    pub fn reserve(&mut self, capacity: usize) {
        for columns in self.all_columns() {
            columns.reserve(capacity);
        }
        for list in [&mut self.mass, &mut self.w] {
            list.reserve_exact(capacity.saturating_sub(list.len()));
        }
    }

    /// Bytes that one particle takes.
    pub fn bytes_each(&self) -> usize {
        size_of::<f32>() * (5 * 3 + 2)
    }

    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Whether every list has `count` entries.
    pub fn is_consistent(&self, count: usize) -> bool {
        let columns =
            [&self.x, &self.displacement, &self.v, &self.v_extrapolated, &self.x_prev_tick];
        let three = |c: &Columns| c.x.len() == count && c.y.len() == count && c.z.len() == count;
        columns.into_iter().all(three) && self.mass.len() == count && self.w.len() == count
    }

    /// Adds a particle in the state of `source`, and gives its index.
    pub fn push_copy_of(&mut self, source: usize) -> usize {
        for columns in self.all_columns() {
            columns.push(columns.at(source));
        }
        self.mass.push(self.mass[source]);
        self.w.push(self.w[source]);
        self.len() - 1
    }

    /// Adds a particle lerp two others, at a share of the way from `a` to `b`, and gives its index. It
    /// is free; its mass is still to be found.
    pub fn push_between(&mut self, a: usize, b: usize, share: f32) -> usize {
        for columns in self.all_columns() {
            let (from, to) = (columns.at(a), columns.at(b));
            columns.push(lerp(from, to, share));
        }
        self.mass.push(0.0);
        self.w.push(0.0);
        self.len() - 1
    }

    /// Puts a particle somewhere with a velocity, as if it had been falling freely for ever.
    pub fn set_motion(&mut self, i: usize, x: Vec3, v: Vec3, gravity: Vec3, h: f32) {
        self.x.set(i, x);
        self.v.set(i, v);
        self.displacement.set(i, saturate(v * h - gravity * (0.5 * h * h)));
        self.v_extrapolated.set(i, saturate(v + gravity * (h * (1.0 / 3.0))));
    }

    /// Begins every history anew, for another kind of substep. Velocities stay.
    pub fn reset_history(&mut self, gravity: Vec3, h: f32) {
        for i in 0..self.len() {
            self.set_motion(i, self.x.at(i), self.v.at(i), gravity, h);
        }
    }
}
