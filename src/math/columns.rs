//! A list of vectors in structure-of-arrays order: one aligned column for each of x, y, z.
//!
//! ```text
//! x: x₀ x₁ x₂ …     y: y₀ y₁ y₂ …     z: z₀ z₁ z₂ …
//! ```
//! This is the layout of all per-particle stages: one SIMD load reads a component of several
//! particles.
//!
//! Reads and writes its own columns.
//! Invariant: all three columns have the same length.

use crate::math::column::Column;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// A list of vectors, one column for each component.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Columns {
    pub x: Column,
    pub y: Column,
    pub z: Column,
}

impl Columns {
    /// Makes an empty list that holds `capacity` vectors without allocating again.
    pub fn with_capacity(capacity: usize) -> Self {
        let column = || Column::with_capacity(capacity);
        Self { x: column(), y: column(), z: column() }
    }

    /// Allocates for `capacity` vectors in total.
    #[inline(never)]
    pub fn reserve(&mut self, capacity: usize) {
        for column in [&mut self.x, &mut self.y, &mut self.z] {
            column.reserve(capacity);
        }
    }

    /// Truncates the list to `count` vectors, or extends it with zeros.
    #[inline(never)]
    pub fn resize(&mut self, count: usize) {
        for column in [&mut self.x, &mut self.y, &mut self.z] {
            column.resize(count);
        }
    }

    pub fn push(&mut self, v: Vec3) {
        self.x.push(v.x);
        self.y.push(v.y);
        self.z.push(v.z);
    }

    pub fn fill(&mut self, v: Vec3) {
        self.x.fill(v.x);
        self.y.fill(v.y);
        self.z.fill(v.z);
    }

    /// Returns the columns x, y, z as slices.
    #[inline(always)]
    pub fn slices(&self) -> [&[f32]; 3] {
        [&self.x, &self.y, &self.z]
    }

    /// Returns the columns x, y, z as mutable slices.
    #[inline(always)]
    pub fn slices_mut(&mut self) -> [&mut [f32]; 3] {
        [&mut self.x, &mut self.y, &mut self.z]
    }

    /// Replaces the whole list by these vectors.
    pub fn set_all(&mut self, vectors: impl Iterator<Item = Vec3>) {
        [&mut self.x, &mut self.y, &mut self.z].into_iter().for_each(Column::clear);
        vectors.for_each(|v| self.push(v));
    }

    /// Returns the vector at index `i`.
    #[inline(always)]
    pub fn get(&self, i: usize) -> Vec3 {
        Vec3::new(self.x[i], self.y[i], self.z[i])
    }

    /// Replaces the vector at index `i`.
    #[inline(always)]
    pub fn set(&mut self, i: usize, v: Vec3) {
        self.x[i] = v.x;
        self.y[i] = v.y;
        self.z[i] = v.z;
    }

    /// Adds `v` to the vector at index `i`.
    #[inline(always)]
    pub fn add(&mut self, i: usize, v: Vec3) {
        self.x[i] += v.x;
        self.y[i] += v.y;
        self.z[i] += v.z;
    }

    /// Makes this list a copy of `other`, in the memory that it already has if that is enough.
    pub fn copy_from(&mut self, other: &Self) {
        self.x.clone_from(&other.x);
        self.y.clone_from(&other.y);
        self.z.clone_from(&other.z);
    }

    pub fn iter(&self) -> impl Iterator<Item = Vec3> + '_ {
        let xy = self.x.iter().zip(&*self.y);
        xy.zip(&*self.z).map(|((x, y), z)| Vec3::new(*x, *y, *z))
    }
}
