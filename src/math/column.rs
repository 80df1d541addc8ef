//! A list of `f32` that is aligned to cache lines (64 bytes): one column of structure-of-arrays
//! data.
//!
//! Kernels walk columns from the start in steps of a whole vector, so with this alignment no load
//! or store crosses a cache line. A `Vec<f32>` is aligned to 16 bytes at most; then every second
//! store of a wide vector crosses a line, which was measured to cost kernels up to a tenth of their
//! time.
//!
//! Reads and writes like a slice; grows like a `Vec`. It serialises like a `Vec<f32>`.
//! Invariant: numbers beyond `len` in the last line are unspecified and never read.

use crate::math::reserve::ReserveTotal;
use core::ops::{Deref, DerefMut};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Numbers in a cache line.
const LINE_LEN: usize = 16;

#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct CacheLine([f32; LINE_LEN]);

const _: () = assert!(size_of::<CacheLine>() == LINE_LEN * size_of::<f32>());

/// A list of numbers that dereferences to a slice.
#[derive(Debug, Default)]
pub(crate) struct Column {
    /// The storage; numbers beyond `len` are unspecified.
    lines: Vec<CacheLine>,
    len: usize,
}

impl Column {
    /// Makes an empty list that holds `capacity` numbers without allocating again.
    pub fn with_capacity(capacity: usize) -> Self {
        Self { lines: Vec::with_capacity(capacity.div_ceil(LINE_LEN)), len: 0 }
    }

    /// Returns how many numbers fit without allocating again.
    pub fn capacity(&self) -> usize {
        self.lines.capacity() * LINE_LEN
    }

    /// Allocates for `capacity` numbers in total.
    pub fn reserve(&mut self, capacity: usize) {
        let lines = capacity.div_ceil(LINE_LEN);
        self.lines.reserve_total(lines);
    }

    pub fn clear(&mut self) {
        self.lines.clear();
        self.len = 0;
    }

    /// Truncates the list to `len` numbers, or extends it with zeros.
    pub fn resize(&mut self, len: usize) {
        let kept = self.len.min(len);
        self.lines.resize(len.div_ceil(LINE_LEN), CacheLine([0.0; LINE_LEN]));
        self.len = len;
        self[kept..].fill(0.0);
    }

    pub fn push(&mut self, value: f32) {
        if self.len == self.lines.len() * LINE_LEN {
            self.lines.push(CacheLine([0.0; LINE_LEN]));
        }
        self.len += 1;
        let last = self.len - 1;
        self[last] = value;
    }
}

impl Deref for Column {
    type Target = [f32];

    #[inline(always)]
    fn deref(&self) -> &[f32] {
        // SAFETY: a line is 16 numbers without padding, and the lines hold at least `len` numbers.
        unsafe { core::slice::from_raw_parts(self.lines.as_ptr().cast(), self.len) }
    }
}

impl DerefMut for Column {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut [f32] {
        // SAFETY: as for `deref`.
        unsafe { core::slice::from_raw_parts_mut(self.lines.as_mut_ptr().cast(), self.len) }
    }
}

impl Clone for Column {
    fn clone(&self) -> Self {
        Self { lines: self.lines.clone(), len: self.len }
    }

    fn clone_from(&mut self, other: &Self) {
        self.lines.clone_from(&other.lines);
        self.len = other.len;
    }
}

impl PartialEq for Column {
    fn eq(&self, other: &Self) -> bool {
        **self == **other
    }
}

impl FromIterator<f32> for Column {
    fn from_iter<I: IntoIterator<Item = f32>>(values: I) -> Self {
        let mut column = Self::default();
        column.extend(values);
        column
    }
}

impl Extend<f32> for Column {
    fn extend<I: IntoIterator<Item = f32>>(&mut self, values: I) {
        values.into_iter().for_each(|value| self.push(value));
    }
}

impl Serialize for Column {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (**self).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Column {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Ok(Vec::deserialize(deserializer)?.into_iter().collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_column_is_aligned_to_a_cache_line_and_holds_what_was_pushed() {
        for count in [1, 15, 16, 17, 100] {
            let column: Column = (0..count).map(|i| i as f32).collect();
            assert_eq!(column.as_ptr().addr() % 64, 0, "{count}");
            assert_eq!(column.len(), count);
            assert!(column.iter().enumerate().all(|(i, value)| *value == i as f32), "{count}");
        }
    }

    #[test]
    fn numbers_beyond_the_length_are_never_visible() {
        let mut column: Column = [1.0, 2.0, 3.0].into_iter().collect();
        let mut other = Column::with_capacity(40);
        (0..5).for_each(|_| other.push(9.0));
        other.clear();
        assert!(other.is_empty() && other.capacity() >= 40);
        column.clone_from(&other);
        assert_eq!(column, other);
        column.push(4.0);
        assert_eq!(*column, [4.0]);
        column.push(5.0);
        column.resize(1);
        column.resize(20);
        assert_eq!((column[0], &column[1..]), (4.0, &[0.0; 19][..]));
    }
}
