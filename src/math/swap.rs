//! Exchange of large values by one function for all types, which keeps the WebAssembly module small.
//!
//! Reads and writes only what callers pass in.
//! Invariant: afterwards each place holds what the other one held.

use core::mem::MaybeUninit;
use core::ptr::{from_mut, swap_nonoverlapping};

/// The part of a value that is moved at once.
type Word = MaybeUninit<usize>;

/// Words that are moved at once.
const BLOCK: usize = 8;

/// Exchanges two values whose size is a multiple of that of a pointer.
pub(crate) fn swap<T>(a: &mut T, b: &mut T) {
    const {
        assert!(size_of::<T>().is_multiple_of(size_of::<Word>()));
        assert!(align_of::<T>() >= align_of::<Word>());
    }
    // SAFETY: two exclusive references are valid, aligned and do not overlap.
    unsafe {
        swap_words(from_mut(a).cast(), from_mut(b).cast(), size_of::<T>() / size_of::<Word>());
    }
}

/// # Safety
/// Both point to `count` valid words, which do not overlap.
#[inline(never)]
unsafe fn swap_words(a: *mut Word, b: *mut Word, count: usize) {
    // Blocks of words, since a loop over words is not vectorised.
    let blocks = count / BLOCK;
    // SAFETY: as for this function; a block is aligned like a word.
    unsafe {
        for at in 0..blocks {
            let (a, b) = (a.cast::<[Word; BLOCK]>().add(at), b.cast::<[Word; BLOCK]>().add(at));
            let (of_a, of_b) = (a.read(), b.read());
            a.write(of_b);
            b.write(of_a);
        }
        let done = blocks * BLOCK;
        swap_nonoverlapping(a.add(done), b.add(done), count - done);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_change_places() {
        let lists = |first: usize| [0, 1, 2, 3, 4].map(|at| vec![first + at; at]);
        let (mut a, mut b) = (lists(1), lists(7));
        swap(&mut a, &mut b);
        assert_eq!((a, b), (lists(7), lists(1)));
    }
}
