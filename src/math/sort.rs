//! Sorting of lists whose equal entries cannot be told apart, so that how it is done cannot matter.
//!
//! The standard library's sorts are fast and large: one for each kind of list, they would be a
//! sixth of what a page loads. Here lists are sorted in parts about as fast, and with a quarter of
//! the code; on pages in a simpler way.

use core::cmp::Ordering;

/// Sorts in place, without a word of memory.
pub(crate) fn sort<T: Ord>(list: &mut [T]) {
    sort_by(list, T::cmp);
}

/// The same by an order of one's own, which must tell apart whatever differs.
#[inline]
pub(crate) fn sort_by<T>(list: &mut [T], mut order: impl FnMut(&T, &T) -> Ordering) {
    let is_less = &mut |a: &T, b: &T| order(a, b) == Ordering::Less;
    if (1..list.len()).all(|at| !is_less(&list[at], &list[at - 1])) {
        return;
    }
    // A page loads the simpler half of it only.
    if cfg!(target_arch = "wasm32") {
        return sort_simply(list, is_less);
    }
    // Twice as deep as halves would lead: whoever chose the list to be slow with gains nothing.
    let most = 2 * (usize::BITS - list.len().leading_zeros());
    sort_parts(list, is_less, most);
}

/// Lists up to here are sorted entry by entry.
const SHORT: usize = 12;

/// Hoare, "Quicksort", The Computer Journal 1962, with as many steps down as are allowed. Each step
/// goes by the middle one of three entries from anywhere, since lists of a mesh repeat themselves.
#[inline(never)]
fn sort_parts<T>(mut list: &mut [T], is_less: &mut impl FnMut(&T, &T) -> bool, mut most: u32) {
    let mut dice = 1;
    while list.len() > SHORT && most > 0 {
        most -= 1;
        let count = list.len();
        let mut any = || {
            dice = u32::wrapping_add(u32::wrapping_mul(dice, 1_664_525), 1_013_904_223);
            ((u64::from(dice) * count as u64) >> 32) as usize
        };
        let [mut a, mut b, c] = [any(), any(), any()];
        if is_less(&list[b], &list[a]) {
            (a, b) = (b, a);
        }
        if is_less(&list[c], &list[b]) {
            b = if is_less(&list[c], &list[a]) { a } else { c };
        }
        list.swap(0, b);
        let Some((middle, others)) = list.split_first_mut() else {
            return;
        };
        let mut less = 0;
        for at in 0..others.len() {
            let is_one = is_less(&others[at], middle);
            others.swap(less, at);
            less += usize::from(is_one);
        }
        list.swap(0, less);
        let (before, after) = list.split_at_mut(less);
        let after = &mut after[1..];
        let (shorter, longer) =
            if before.len() < after.len() { (before, after) } else { (after, before) };
        sort_parts(shorter, is_less, most);
        list = longer;
    }
    sort_simply(list, is_less);
}

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
    sort_as_heap(list.len(), &mut Entries { list, is_less });
}

/// A list as one way to sort them all sees it.
trait Heap {
    /// Which is the greatest of an entry, another one and what follows that before `end`.
    fn greatest(&mut self, at: usize, child: usize, end: usize) -> usize;

    fn swap(&mut self, a: usize, b: usize);
}

struct Entries<'a, T, F> {
    list: &'a mut [T],
    is_less: &'a mut F,
}

impl<T, F: FnMut(&T, &T) -> bool> Heap for Entries<'_, T, F> {
    fn greatest(&mut self, at: usize, mut child: usize, end: usize) -> usize {
        let list = &self.list[..end];
        if child + 1 < end && (self.is_less)(&list[child], &list[child + 1]) {
            child += 1;
        }
        if (self.is_less)(&list[at], &list[child]) { child } else { at }
    }

    fn swap(&mut self, a: usize, b: usize) {
        self.list.swap(a, b);
    }
}

/// Williams, Floyd, "Treesort 3", CACM 1964: first a heap is made, then its greatest is put behind
/// it.
fn sort_as_heap(count: usize, heap: &mut dyn Heap) {
    for step in (0..count + count / 2).rev() {
        let (mut at, end) = if let Some(root) = step.checked_sub(count) {
            (root, count)
        } else {
            heap.swap(0, step);
            (0, step)
        };
        while 2 * at + 1 < end {
            let greatest = heap.greatest(at, 2 * at + 1, end);
            if greatest == at {
                break;
            }
            heap.swap(at, greatest);
            at = greatest;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_are_sorted_as_by_the_standard_library() {
        for length in (0..40).chain([100, 1000, 4097]) {
            for most in [1, 3, u64::MAX] {
                let number = |i: u64| (i ^ most).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 7;
                let any: Vec<u64> = (0..length).map(|i| number(i) % most).collect();
                let mut right = any.clone();
                right.sort_unstable();
                let back: Vec<_> = right.iter().rev().copied().collect();
                for list in [any, back, right.clone()] {
                    let (mut simply, mut list) = (list.clone(), list);
                    sort(&mut list);
                    assert_eq!(list, right, "{length} numbers below {most}");
                    sort_simply(&mut simply, &mut |a, b| a < b);
                    assert_eq!(simply, right, "{length} numbers below {most}, simply");
                }
            }
        }
    }

    #[test]
    fn lists_of_equal_entries_take_no_longer_than_a_heap() {
        let (count, mut looks) = (10_000_u32, 0_u64);
        let mut list: Vec<u32> = (0..count).map(|i| i % 2).rev().collect();
        sort_by(&mut list, |a, b| {
            looks += 1;
            a.cmp(b)
        });
        assert!(list.is_sorted());
        let most = u64::from(count) * 100;
        assert!(looks < most, "{looks} looks at {count} entries");
    }
}
