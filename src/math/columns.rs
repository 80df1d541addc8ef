//! Vectors stored as three columns x, y, z: what straight SIMD loads want.

use crate::math::column::Column;
use glam::Vec3;
use serde::{Deserialize, Serialize};

/// A list of vectors, one column a component.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Columns {
    pub x: Column,
    pub y: Column,
    pub z: Column,
}

impl Columns {
    /// An empty list that holds `capacity` vectors without allocating again.
    pub fn with_capacity(capacity: usize) -> Self {
        let column = || Column::with_capacity(capacity);
        Self { x: column(), y: column(), z: column() }
    }

    /// So many zeros.
    pub fn zeros(count: usize) -> Self {
        let column = || Column::zeros(count);
        Self { x: column(), y: column(), z: column() }
    }

    /// Makes room for `capacity` vectors in all.
    pub fn reserve(&mut self, capacity: usize) {
        for column in [&mut self.x, &mut self.y, &mut self.z] {
            column.reserve(capacity);
        }
    }

    /// Makes it so long: by zeros, where it was shorter.
    pub fn resize(&mut self, count: usize) {
        for column in [&mut self.x, &mut self.y, &mut self.z] {
            column.resize(count);
        }
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let columns = [&self.x, &self.y, &self.z];
        columns.iter().map(|column| size_of::<f32>() * column.capacity()).sum()
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

    /// The three columns.
    #[inline(always)]
    pub fn all(&self) -> [&[f32]; 3] {
        [&self.x, &self.y, &self.z]
    }

    /// The three columns.
    #[inline(always)]
    pub fn all_mut(&mut self) -> [&mut [f32]; 3] {
        [&mut self.x, &mut self.y, &mut self.z]
    }

    /// Makes it the list of these vectors.
    pub fn set_all(&mut self, vectors: impl Iterator<Item = Vec3>) {
        [&mut self.x, &mut self.y, &mut self.z].into_iter().for_each(Column::clear);
        vectors.for_each(|v| self.push(v));
    }

    #[inline(always)]
    pub fn at(&self, i: usize) -> Vec3 {
        Vec3::new(self.x[i], self.y[i], self.z[i])
    }

    #[inline(always)]
    pub fn set(&mut self, i: usize, v: Vec3) {
        self.x[i] = v.x;
        self.y[i] = v.y;
        self.z[i] = v.z;
    }

    #[inline(always)]
    pub fn add(&mut self, i: usize, v: Vec3) {
        self.x[i] += v.x;
        self.y[i] += v.y;
        self.z[i] += v.z;
    }

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
