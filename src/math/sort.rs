//! Sorting of lists whose equal entries cannot be told apart, so that how it is done cannot matter.
//!
//! The standard library's sorts are fast and large: one for each kind of list, they would be a sixth of what a page
//! loads. There lists are sorted in a simpler way.

use core::cmp::Ordering;

/// Sorts in place, without a word of memory.
pub(crate) fn sort<T: Ord>(list: &mut [T]) {
    sort_by(list, T::cmp);
}

/// The same by an order of one's own, which must tell apart whatever differs.
#[inline]
pub(crate) fn sort_by<T>(list: &mut [T], order: impl FnMut(&T, &T) -> Ordering) {
    #[cfg(not(target_arch = "wasm32"))]
    list.sort_unstable_by(order);
    #[cfg(target_arch = "wasm32")]
    {
        let mut order = order;
        sort_simply(list, &mut |a, b| order(a, b) == Ordering::Less);
    }
}

/// Lists up to here are sorted entry by entry.
#[cfg(any(test, target_arch = "wasm32"))]
const SHORT: usize = 12;

#[cfg(any(test, target_arch = "wasm32"))]
#[inline(never)]
fn sort_simply<T>(list: &mut [T], is_less: &mut impl FnMut(&T, &T) -> bool) {
    if list.len() <= SHORT {
        for end in 1..list.len() {
            let mut at = end;
            while at > 0 && is_less(&list[at], &list[at - 1]) {
                list.swap(at, at - 1);
                at -= 1;
            }
        }
        return;
    }
    if (1..list.len()).all(|at| !is_less(&list[at], &list[at - 1])) {
        return;
    }
    // Williams, Floyd, "Treesort 3", CACM 1964: first a heap is made, then its greatest is put behind it.
    for step in (0..list.len() + list.len() / 2).rev() {
        let (mut at, end) = if let Some(root) = step.checked_sub(list.len()) {
            (root, list.len())
        } else {
            list.swap(0, step);
            (0, step)
        };
        loop {
            let mut child = 2 * at + 1;
            if child >= end {
                break;
            }
            if child + 1 < end && is_less(&list[child], &list[child + 1]) {
                child += 1;
            }
            if !is_less(&list[at], &list[child]) {
                break;
            }
            list.swap(at, child);
            at = child;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_pages_sort_with_sorts_as_the_standard_library_does() {
        for length in (0..40).chain([100, 1000, 4097]) {
            for most in [1, 3, u64::MAX] {
                let number = |i: u64| (i ^ most).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 7;
                let any: Vec<u64> = (0..length).map(|i| number(i) % most).collect();
                let mut right = any.clone();
                right.sort_unstable();
                let back: Vec<_> = right.iter().rev().copied().collect();
                for mut list in [any, back, right.clone()] {
                    sort_simply(&mut list, &mut |a, b| a < b);
                    assert_eq!(list, right, "{length} numbers below {most}");
                }
            }
        }
    }
}
