//! A list of numbers that begins where a line of the processor's memory begins.
//!
//! Kernels walk such lists from their start in steps of a whole vector, so no load or store falls
//! into two lines (64 bytes on all processors that Muslin knows). A `Vec` begins anywhere that a
//! multiple of 16 bytes lets it, and then every second store does, which costs kernels up to a
//! tenth.

use core::ops::{Deref, DerefMut};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// How many numbers a line holds.
const WIDTH: usize = 16;

#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Line([f32; WIDTH]);

const _: () = assert!(size_of::<Line>() == WIDTH * size_of::<f32>());

/// A list of numbers, read and written as a slice.
#[derive(Debug, Default)]
pub(crate) struct Column {
    /// What holds them; behind the last there may be anything.
    lines: Vec<Line>,
    len: usize,
}

impl Column {
    /// An empty list that holds `capacity` numbers without allocating again.
    pub fn with_capacity(capacity: usize) -> Self {
        Self { lines: Vec::with_capacity(capacity.div_ceil(WIDTH)), len: 0 }
    }

    /// So many zeros.
    pub fn zeros(count: usize) -> Self {
        Self { lines: vec![Line([0.0; WIDTH]); count.div_ceil(WIDTH)], len: count }
    }

    /// How many numbers it holds without allocating again.
    pub fn capacity(&self) -> usize {
        self.lines.capacity() * WIDTH
    }

    /// Makes room for `capacity` numbers in all.
    pub fn reserve(&mut self, capacity: usize) {
        let lines = capacity.div_ceil(WIDTH);
        self.lines.reserve_exact(lines.saturating_sub(self.lines.len()));
    }

    pub fn clear(&mut self) {
        self.lines.clear();
        self.len = 0;
    }

    /// Makes it so long: by zeros, where it was shorter.
    pub fn resize(&mut self, len: usize) {
        let kept = self.len.min(len);
        self.lines.resize(len.div_ceil(WIDTH), Line([0.0; WIDTH]));
        self.len = len;
        self[kept..].fill(0.0);
    }

    pub fn push(&mut self, value: f32) {
        if self.len == self.lines.len() * WIDTH {
            self.lines.push(Line([0.0; WIDTH]));
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
        // SAFETY: lines are numbers without gaps, and hold at least `len` of them.
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
    fn begins_at_a_line_and_holds_what_was_pushed() {
        for count in [1, 15, 16, 17, 100] {
            let column: Column = (0..count).map(|i| i as f32).collect();
            assert_eq!(column.as_ptr().addr() % 64, 0, "{count}");
            assert_eq!(column.len(), count);
            assert!(column.iter().enumerate().all(|(i, value)| *value == i as f32), "{count}");
        }
    }

    #[test]
    fn a_list_is_its_numbers_and_not_what_lies_behind() {
        let mut column: Column = [1.0, 2.0, 3.0].into_iter().collect();
        let mut other = Column::with_capacity(40);
        (0..5).for_each(|_| other.push(9.0));
        other.clear();
        assert!(other.is_empty() && other.capacity() >= 40);
        column.clone_from(&other);
        assert_eq!(column, other);
        column.push(4.0);
        assert_eq!(*column, [4.0]);
        assert_eq!(*Column::zeros(3), [0.0; 3]);
        column.push(5.0);
        column.resize(1);
        column.resize(20);
        assert_eq!((column[0], &column[1..]), (4.0, &[0.0; 19][..]));
    }
}
