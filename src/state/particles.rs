//! Particles: positions, history, velocities and masses, as columns (SoA).
//!
//! ```text
//! x_prev_tick … x − displacement ──▶ x ──▶ x + next displacement
//!                                    v, v_extrapolated (BDF2 history, see `settings::BdfScheme`)
//! ```
//! Integration stages write all columns; constraint stages write `x` only.
//!
//! Invariant: every list has one entry per particle. Field order is part of the save format.

use crate::math::columns::Columns;
use crate::math::heap_bytes::heap_bytes;
use crate::math::reserve::{ReserveTotal, zeros};
use crate::math::{lerp, saturate};
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// The particles of a cloth. Every list has one entry per particle.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Particles {
    /// Position [m].
    pub x: Columns,
    /// Displacement during the last substep [m]. Stored, because the difference of two positions
    /// would lose most of its digits.
    pub displacement: Columns,
    /// Velocity [m/s].
    pub v: Columns,
    /// Velocity extrapolated to the next substep, (4 v − v_prev) / 3 [m/s].
    pub v_extrapolated: Columns,
    /// Position at the end of the previous tick [m], for blending between ticks and for recovery
    /// from NaN.
    pub x_prev_tick: Columns,
    /// Mass [kg].
    pub mass: Vec<f32>,
    /// Inverse mass that the solver uses [1/kg]: 0 while pinned or grabbed.
    pub w: Vec<f32>,
}

heap_bytes!(Particles { x, displacement, v, v_extrapolated, x_prev_tick, mass, w } plain {});

impl Particles {
    /// Creates particles at rest, allocated for `capacity` particles. Masses are 0 until they are
    /// computed.
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
            mass: zeros(positions.len()),
            w: zeros(positions.len()),
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

    /// Allocates for `capacity` particles in all.
    pub fn reserve(&mut self, capacity: usize) {
        for columns in self.all_columns() {
            columns.reserve(capacity);
        }
        for list in [&mut self.mass, &mut self.w] {
            list.reserve_total(capacity);
        }
    }

    pub fn len(&self) -> usize {
        self.mass.len()
    }

    /// Returns whether every list has `count` entries.
    pub fn is_consistent(&self, count: usize) -> bool {
        let columns =
            [&self.x, &self.displacement, &self.v, &self.v_extrapolated, &self.x_prev_tick];
        let three = |c: &Columns| c.x.len() == count && c.y.len() == count && c.z.len() == count;
        columns.into_iter().all(three) && self.mass.len() == count && self.w.len() == count
    }

    /// Appends a copy of particle `source` and returns its index.
    pub fn push_copy_of(&mut self, source: usize) -> usize {
        for columns in self.all_columns() {
            columns.push(columns.get(source));
        }
        self.mass.push(self.mass[source]);
        self.w.push(self.w[source]);
        self.len() - 1
    }

    /// Appends a particle interpolated at `share` of the way from `a` to `b`, and returns its
    /// index. It has no mass yet and is not held.
    pub fn push_between(&mut self, a: usize, b: usize, share: f32) -> usize {
        for columns in self.all_columns() {
            let (from, to) = (columns.get(a), columns.get(b));
            columns.push(lerp(from, to, share));
        }
        self.mass.push(0.0);
        self.w.push(0.0);
        self.len() - 1
    }

    /// Sets position and velocity of a particle. Its history becomes that of a free fall under
    /// `gravity` [m/s²] with substeps of `h` [s].
    pub fn set_motion(&mut self, i: usize, x: Vec3, v: Vec3, gravity: Vec3, h: f32) {
        self.x.set(i, x);
        self.v.set(i, v);
        self.displacement.set(i, saturate(v * h - gravity * (0.5 * h * h)));
        self.v_extrapolated.set(i, saturate(v + gravity * (h * (1.0 / 3.0))));
    }

    /// Adds to the velocity of a particle [m/s], and to its history with substeps of `h` [s].
    #[inline(never)]
    pub fn add_velocity(&mut self, i: usize, change: Vec3, h: f32) {
        self.v.add(i, change);
        self.v_extrapolated.add(i, change);
        self.displacement.add(i, change * h);
    }

    /// Drops the history of every particle, for a next substep of BDF1. Velocities stay.
    pub fn drop_history(&mut self) {
        self.v_extrapolated.copy_from(&self.v);
        self.displacement.fill(Vec3::ZERO);
    }

    /// Drops the history of one particle.
    pub fn drop_history_of(&mut self, i: usize) {
        self.v_extrapolated.set(i, self.v.get(i));
        self.displacement.set(i, Vec3::ZERO);
    }

    /// Resets the history of all particles, for a new substep length or scheme. Positions and
    /// velocities stay.
    pub fn reset_history(&mut self, gravity: Vec3, h: f32) {
        for i in 0..self.len() {
            self.set_motion(i, self.x.get(i), self.v.get(i), gravity, h);
        }
    }
}
