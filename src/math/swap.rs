//! Exchange of large values by one function for all types, which keeps the WebAssembly module small.
//!
//! Reads and writes only what callers pass in.
//! Invariant: afterwards each place holds what the other one held.

use core::mem::MaybeUninit;
use core::ptr::{from_mut, swap_nonoverlapping};

/// The part of a value that is moved at once.
type Word = MaybeUninit<usize>;

/// Exchanges two values whose size is a multiple of that of a pointer.
pub(crate) fn swap<T>(a: &mut T, b: &mut T) {
    const {
        assert!(size_of::<T>().is_multiple_of(size_of::<Word>()));
        assert!(align_of::<T>() >= align_of::<Word>());
    }
    // SAFETY: two exclusive references are valid, aligned and do not overlap.
    unsafe {
        swap_words(from_mut(a).cast(), from_mut(b).cast(), size_of::<T>() / size_of::<Word>())
    }
}

/// # Safety
/// Both point to `count` valid words, which do not overlap.
#[inline(never)]
unsafe fn swap_words(a: *mut Word, b: *mut Word, count: usize) {
    // SAFETY: as for this function.
    unsafe { swap_nonoverlapping(a, b, count) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_change_places() {
        let (mut a, mut b) = ((vec![1], 2_usize), (vec![3, 4], 5_usize));
        swap(&mut a, &mut b);
        assert_eq!((a, b), ((vec![3, 4], 5), (vec![1], 2)));
    }
}
