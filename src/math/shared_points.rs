//! Points that several threads may move at once, each its own.

use core::cell::UnsafeCell;
use core::marker::PhantomData;

/// The points of a list, each x, y, z and 0, borrowed for whoever promises to keep apart from
/// others.
#[derive(Clone, Copy)]
pub(crate) struct SharedPoints<'a> {
    first: *mut [f32; 4],
    count: usize,
    list: PhantomData<&'a [UnsafeCell<[f32; 4]>]>,
}

// SAFETY: a point is reached only through `at`, whose callers promise that no other thread reaches
// it.
unsafe impl Send for SharedPoints<'_> {}
// SAFETY: as above.
unsafe impl Sync for SharedPoints<'_> {}

impl<'a> SharedPoints<'a> {
    pub fn new(list: &'a mut [[f32; 4]]) -> Self {
        Self { first: list.as_mut_ptr(), count: list.len(), list: PhantomData }
    }

    pub fn len(self) -> usize {
        self.count
    }

    /// Where a point is.
    ///
    /// # Safety
    /// There is such a point, and as long as it is read or written here no other thread does so.
    #[inline(always)]
    pub unsafe fn ptr(self, point: u32) -> *mut f32 {
        // SAFETY: the caller's promise that it is within the list.
        unsafe { self.first.add(point as usize).cast() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_move_points_of_their_own() {
        let mut list = vec![[1.0, 2.0, 3.0, 0.0]; 9];
        let points = SharedPoints::new(&mut list);
        assert_eq!(points.len(), 9);
        std::thread::scope(|scope| {
            for thread in 0..3 {
                scope.spawn(move || {
                    for point in (thread..9).step_by(3) {
                        // SAFETY: there are nine points, of which each thread has every third.
                        unsafe { *points.ptr(point) += point as f32 };
                    }
                });
            }
        });
        assert!(list.iter().enumerate().all(|(at, point)| point[0] == 1.0 + at as f32), "{list:?}");
    }
}
