//! Points that several threads move at the same time, each thread its own points.
//!
//! Graph colouring makes this sound: no two links of one colour share a particle, so the threads
//! that work on one colour write disjoint sets of points.
//!
//! Reads and writes interleaved points `[x, y, z, w]` through raw pointers.
//! Invariant: different threads use [`SharedPoints::ptr`] for different points.

use core::cell::UnsafeCell;
use core::marker::PhantomData;

/// A mutable borrow of interleaved points that can be copied to several threads.
#[derive(Clone, Copy)]
pub(crate) struct SharedPoints<'a> {
    first: *mut [f32; 4],
    count: usize,
    list: PhantomData<&'a [UnsafeCell<[f32; 4]>]>,
}

// SAFETY: points are accessed only through `ptr`, whose callers guarantee that no other thread
// accesses the same point.
unsafe impl Send for SharedPoints<'_> {}
// SAFETY: as for `Send`.
unsafe impl Sync for SharedPoints<'_> {}

impl<'a> SharedPoints<'a> {
    pub fn new(list: &'a mut [[f32; 4]]) -> Self {
        Self { first: list.as_mut_ptr(), count: list.len(), list: PhantomData }
    }

    pub fn len(self) -> usize {
        self.count
    }

    /// Returns the address of a point: four consecutive numbers.
    ///
    /// # Safety
    /// `point` is below [`SharedPoints::len`], and no other thread accesses that point while the
    /// pointer is used.
    #[inline(always)]
    pub unsafe fn ptr(self, point: u32) -> *mut f32 {
        // SAFETY: the caller guarantees that the point lies in the list.
        unsafe { self.first.add(point as usize).cast() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_can_move_disjoint_points() {
        let mut list = vec![[1.0, 2.0, 3.0, 0.0]; 9];
        let points = SharedPoints::new(&mut list);
        assert_eq!(points.len(), 9);
        std::thread::scope(|scope| {
            for thread in 0..3 {
                scope.spawn(move || {
                    for point in (thread..9).step_by(3) {
                        // SAFETY: there are nine points, and each thread accesses every third.
                        unsafe { *points.ptr(point) += point as f32 };
                    }
                });
            }
        });
        assert!(list.iter().enumerate().all(|(at, point)| point[0] == 1.0 + at as f32), "{list:?}");
    }
}
