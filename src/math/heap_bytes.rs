//! Heap memory of data structures.
//!
//! Method: the capacity of each list times the size of its entries. `heap_bytes!` adds up the fields
//! of a struct and names every one of them, so that no new field is forgotten.
//!
//! Reads only.
//! Invariant: the sum is what the allocator gave; `tests/allocations/memory.rs` compares both.

use crate::math::column::Column;
use crate::math::columns::Columns;
use std::collections::VecDeque;

/// Data with memory on the heap.
pub(crate) trait HeapBytes {
    /// Returns the allocated memory [bytes], without the value itself.
    fn heap_bytes(&self) -> usize;
}

/// Implements [`HeapBytes`] for a struct by adding up the fields in braces; those after `plain` have
/// no memory on the heap, or lists that are empty between ticks, because the thread lends them.
macro_rules! heap_bytes {
    ($type:ty { $($list:ident),* $(,)? } plain { $($plain:ident),* $(,)? }) => {
        impl $crate::math::heap_bytes::HeapBytes for $type {
            fn heap_bytes(&self) -> usize {
                let Self { $($list,)* $($plain: _,)* } = self;
                0 $(+ $crate::math::heap_bytes::HeapBytes::heap_bytes($list))*
            }
        }
    };
}
pub(crate) use heap_bytes;

impl<T: Copy> HeapBytes for Vec<T> {
    fn heap_bytes(&self) -> usize {
        size_of::<T>() * self.capacity()
    }
}

impl<T: Copy> HeapBytes for VecDeque<T> {
    fn heap_bytes(&self) -> usize {
        size_of::<T>() * self.capacity()
    }
}

impl HeapBytes for Column {
    fn heap_bytes(&self) -> usize {
        size_of::<f32>() * self.capacity()
    }
}

impl HeapBytes for Columns {
    fn heap_bytes(&self) -> usize {
        let Self { x, y, z } = self;
        x.heap_bytes() + y.heap_bytes() + z.heap_bytes()
    }
}

impl<T: HeapBytes, const N: usize> HeapBytes for [T; N] {
    fn heap_bytes(&self) -> usize {
        self.iter().map(T::heap_bytes).sum()
    }
}

impl<T: HeapBytes> HeapBytes for Option<T> {
    fn heap_bytes(&self) -> usize {
        self.as_ref().map_or(0, T::heap_bytes)
    }
}

impl<T: HeapBytes> HeapBytes for Box<T> {
    fn heap_bytes(&self) -> usize {
        size_of::<T>() + T::heap_bytes(self)
    }
}
