//! Data that clones of a cloth share until one of them changes it.
//!
//! Method: copy on write of a reference-counted value. Mutable access makes a copy of its own where
//! others share the value.
//!
//! Reads and writes its own value.
//! Invariant: no change is seen through another `Shared`. A tick changes only values that
//! `make_unique` has made unique before, so that it does not allocate.

use crate::math::heap_bytes::HeapBytes;
use core::ops::{Deref, DerefMut};
use std::sync::Arc;

/// A value that clones share.
#[derive(Debug, Default)]
pub(crate) struct Shared<T>(Arc<T>);

impl<T: Clone> Shared<T> {
    pub fn new(value: T) -> Self {
        Self(Arc::new(value))
    }

    /// Copies the value if others share it.
    pub fn make_unique(&mut self) {
        self.deref_mut();
    }
}

impl<T> Clone for Shared<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl<T> Deref for Shared<T> {
    type Target = T;

    #[inline(always)]
    fn deref(&self) -> &T {
        &self.0
    }
}

impl<T: Clone> DerefMut for Shared<T> {
    // `Arc::make_mut` also provides for weak references, which takes more code.
    #[inline(never)]
    fn deref_mut(&mut self) -> &mut T {
        if Arc::strong_count(&self.0) != 1 {
            self.0 = Arc::new(T::clone(self));
        }
        Arc::get_mut(&mut self.0).expect("a value that nobody shares")
    }
}

impl<T: HeapBytes> HeapBytes for Shared<T> {
    /// The same part of the value for each that shares it.
    #[inline(never)]
    fn heap_bytes(&self) -> usize {
        let counts = 2 * size_of::<usize>();
        (counts + size_of::<T>() + T::heap_bytes(self)) / Arc::strong_count(&self.0)
    }
}
