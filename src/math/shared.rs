//! Data that clones of a cloth share until one of them changes it.
//!
//! Method: copy on write of a reference-counted value. Mutable access makes a copy of its own where
//! others share the value. Without the feature `shared-rest` every clone has a value of its own, so that
//! a program that never clones a cloth has no code for it.
//!
//! Reads and writes its own value.
//! Invariant: no change is seen through another `Shared`. A tick changes only values that
//! `make_unique` has made unique before, so that it does not allocate.

use crate::math::heap_bytes::HeapBytes;
use core::ops::{Deref, DerefMut};
#[cfg(feature = "shared-rest")]
use core::sync::atomic::{Ordering, fence};
#[cfg(feature = "shared-rest")]
use std::sync::Arc;

/// A value that clones share.
#[cfg(feature = "shared-rest")]
#[derive(Debug, Default)]
pub(crate) struct Shared<T>(Arc<T>);

/// A value that each clone has a copy of.
#[cfg(not(feature = "shared-rest"))]
#[derive(Clone, Debug, Default)]
pub(crate) struct Shared<T>(T);

#[cfg(feature = "shared-rest")]
impl<T: Clone> Shared<T> {
    pub fn new(value: T) -> Self {
        Self(Arc::new(value))
    }

    /// Copies the value if others share it.
    pub fn make_unique(&mut self) {
        self.deref_mut();
    }
}

#[cfg(not(feature = "shared-rest"))]
impl<T> Shared<T> {
    pub fn new(value: T) -> Self {
        Self(value)
    }

    /// Does nothing: nobody shares the value.
    pub fn make_unique(&mut self) {}
}

#[cfg(feature = "shared-rest")]
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

#[cfg(feature = "shared-rest")]
impl<T: Clone> DerefMut for Shared<T> {
    // `Arc::make_mut` also provides for weak references, which takes more code.
    #[inline(never)]
    fn deref_mut(&mut self) -> &mut T {
        if Arc::strong_count(&self.0) != 1 {
            self.0 = Arc::new(T::clone(self));
        }
        fence(Ordering::Acquire);
        // SAFETY: there is no other reference to the value: no weak one is ever made, and the fence
        // orders all that the last other owner did before this.
        unsafe { &mut *Arc::as_ptr(&self.0).cast_mut() }
    }
}

#[cfg(not(feature = "shared-rest"))]
impl<T> DerefMut for Shared<T> {
    #[inline(always)]
    fn deref_mut(&mut self) -> &mut T {
        &mut self.0
    }
}

impl<T: HeapBytes> HeapBytes for Shared<T> {
    /// The same part of the value for each that shares it.
    #[cfg(feature = "shared-rest")]
    #[inline(never)]
    fn heap_bytes(&self) -> usize {
        let counts = 2 * size_of::<usize>();
        (counts + size_of::<T>() + T::heap_bytes(self)) / Arc::strong_count(&self.0)
    }

    #[cfg(not(feature = "shared-rest"))]
    fn heap_bytes(&self) -> usize {
        self.0.heap_bytes()
    }
}
