//! Unstable in-place sorting and selection with small code.
//!
//! Introsort: quicksort with random pivots (Hoare, "Quicksort", The Computer Journal 1962),
//! insertion sort for short lists, heapsort once the recursion gets too deep (Williams, Floyd,
//! "Treesort 3", CACM 1964). WebAssembly builds contain only insertion sort and heapsort. The sorts
//! of the standard library are instantiated for each element type and would be a sixth of the
//! WebAssembly module; these are about as fast with a quarter of the code.
//!
//! Reads and writes the list in place, without allocating.
//! Invariant: the result does not depend on the algorithm, because callers sort by orders in which
//! only identical entries are equal.

use core::cmp::Ordering;

/// Sorts a list in ascending order, in place.
pub(crate) fn sort<T: Ord>(list: &mut [T]) {
    sort_by(list, T::cmp);
}

/// Sorts a list whose order begins with that of a small number, `group`, in ascending order: into
/// groups by counting (Seward, 1954; Knuth, TAOCP 5.2), then each group. Takes memory of its own.
pub(crate) fn sort_groups<T: Ord + Copy>(list: &mut [T], group: fn(&T) -> u32) {
    let Some(most) = list.iter().map(group).max() else { return };
    let mut next = vec![0; most as usize + 2];
    list.iter().for_each(|entry| next[group(entry) as usize + 1] += 1);
    (1..next.len()).for_each(|at| next[at] += next[at - 1]);
    let unsorted = list.to_vec();
    for entry in &unsorted {
        let at: &mut usize = &mut next[group(entry) as usize];
        list[*at] = *entry;
        *at += 1;
    }
    let mut start = 0;
    for end in next {
        sort(&mut list[start..end]);
        start = end;
    }
}

/// Sorts a list by an order in which only identical entries are equal, in place.
#[inline]
pub(crate) fn sort_by<T>(list: &mut [T], mut order: impl FnMut(&T, &T) -> Ordering) {
    let is_less = &mut |a: &T, b: &T| order(a, b) == Ordering::Less;
    // The WebAssembly module contains only the simpler half.
    if cfg!(target_arch = "wasm32") {
        return sort_simply(list.len(), &mut Entries { list, is_less });
    }
    if (1..list.len()).all(|at| !is_less(&list[at], &list[at - 1])) {
        return;
    }
    // Twice the depth of perfect halving, then heapsort: the worst case stays n log n.
    let max_depth = 2 * (usize::BITS - list.len().leading_zeros());
    quicksort(list, is_less, max_depth);
}

/// Sorts entries by a measure, then by their numbers, ascending.
pub(crate) fn sort_measured(entries: &mut [(f64, u32, u32)]) {
    sort_by(entries, |p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)).then(p.2.cmp(&q.2)));
}

/// Lists up to this length are sorted by insertion.
const SHORT: usize = 12;

/// Quicksort with at most `depth` levels.
#[inline(never)]
fn quicksort<T>(mut list: &mut [T], is_less: &mut impl FnMut(&T, &T) -> bool, mut depth: u32) {
    let mut random = 1;
    while list.len() > SHORT && depth > 0 {
        depth -= 1;
        let less = partition(list, is_less, &mut random);
        let (before, after) = list.split_at_mut(less);
        let after = &mut after[1..];
        let (shorter, longer) =
            if before.len() < after.len() { (before, after) } else { (after, before) };
        quicksort(shorter, is_less, depth);
        list = longer;
    }
    insertion_or_heap_sort(list, is_less);
}

/// Moves the entries that are less than a pivot before it and the others behind it, and returns
/// where the pivot is. The pivot is the median of three entries at pseudo-random places, because
/// lists that come from a mesh have repeating patterns.
#[inline(always)]
fn partition<T>(
    list: &mut [T],
    is_less: &mut impl FnMut(&T, &T) -> bool,
    random: &mut u32,
) -> usize {
    let count = list.len();
    let mut any = || {
        *random = u32::wrapping_add(u32::wrapping_mul(*random, 1_664_525), 1_013_904_223);
        ((u64::from(*random) * count as u64) >> 32) as usize
    };
    let [mut a, mut b, c] = [any(), any(), any()];
    if is_less(&list[b], &list[a]) {
        (a, b) = (b, a);
    }
    if is_less(&list[c], &list[b]) {
        b = if is_less(&list[c], &list[a]) { a } else { c };
    }
    list.swap(0, b);
    let mut less = 0;
    if let Some((pivot, others)) = list.split_first_mut() {
        for at in 0..others.len() {
            let is_before = is_less(&others[at], pivot);
            others.swap(less, at);
            less += usize::from(is_before);
        }
    }
    list.swap(0, less);
    less
}

/// Moves the entry that has place `middle` in ascending order there, the lesser ones before it and
/// the greater ones behind it, by an order in which only identical entries are equal.
///
/// Quickselect (Hoare, "Find", CACM 1961), with a sort of what is left once it takes too many steps.
pub(crate) fn select_by<T>(
    mut list: &mut [T],
    mut middle: usize,
    mut order: impl FnMut(&T, &T) -> Ordering,
) {
    let is_less = &mut |a: &T, b: &T| order(a, b) == Ordering::Less;
    let mut steps = 2 * (usize::BITS - list.len().leading_zeros());
    let mut random = 1;
    while list.len() > SHORT && steps > 0 {
        steps -= 1;
        let less = partition(list, is_less, &mut random);
        match middle.cmp(&less) {
            Ordering::Less => list = &mut list[..less],
            Ordering::Equal => return,
            Ordering::Greater => (list, middle) = (&mut list[less + 1..], middle - less - 1),
        }
    }
    insertion_or_heap_sort(list, is_less);
}

#[inline(never)]
fn insertion_or_heap_sort<T>(list: &mut [T], is_less: &mut impl FnMut(&T, &T) -> bool) {
    if list.len() > SHORT || cfg!(target_arch = "wasm32") {
        return sort_simply(list.len(), &mut Entries { list, is_less });
    }
    for end in 1..list.len() {
        let mut at = end;
        while at > 0 && is_less(&list[at], &list[at - 1]) {
            list.swap(at, at - 1);
            at -= 1;
        }
    }
}

/// A list without its element type, so that what sorts it is compiled only once.
trait AnyList {
    fn is_less(&mut self, a: usize, b: usize) -> bool;

    fn swap(&mut self, a: usize, b: usize);
}

struct Entries<'a, T, F> {
    list: &'a mut [T],
    is_less: &'a mut F,
}

impl<T, F: FnMut(&T, &T) -> bool> AnyList for Entries<'_, T, F> {
    fn is_less(&mut self, a: usize, b: usize) -> bool {
        (self.is_less)(&self.list[a], &self.list[b])
    }

    fn swap(&mut self, a: usize, b: usize) {
        self.list.swap(a, b);
    }
}

/// Sorts a short list by insertion, and a long one by heapsort if it is not in order.
fn sort_simply(count: usize, list: &mut dyn AnyList) {
    if count > SHORT {
        if (1..count).any(|at| list.is_less(at, at - 1)) {
            heapsort(count, list);
        }
        return;
    }
    for end in 1..count {
        let mut at = end;
        while at > 0 && list.is_less(at, at - 1) {
            list.swap(at, at - 1);
            at -= 1;
        }
    }
}

/// Heapsort: builds a heap, then repeatedly moves the greatest entry behind it.
fn heapsort(count: usize, heap: &mut dyn AnyList) {
    for step in (0..count + count / 2).rev() {
        let (mut at, end) = if let Some(root) = step.checked_sub(count) {
            (root, count)
        } else {
            heap.swap(0, step);
            (0, step)
        };
        while 2 * at + 1 < end {
            let mut child = 2 * at + 1;
            if child + 1 < end && heap.is_less(child, child + 1) {
                child += 1;
            }
            if !heap.is_less(at, child) {
                break;
            }
            heap.swap(at, child);
            at = child;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_result_is_that_of_the_standard_library() {
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
                    let is_less = &mut |a: &u64, b: &u64| a < b;
                    sort_simply(simply.len(), &mut Entries { list: &mut simply, is_less });
                    assert_eq!(simply, right, "{length} numbers below {most}, without quicksort");
                }
            }
        }
    }

    #[test]
    fn sorting_by_groups_gives_the_order_of_a_plain_sort() {
        for groups in [1_u32, 7, 500] {
            let number = |i: u32| (i.wrapping_mul(0x9e37_79b9) >> 9) % groups;
            let any: Vec<(u32, u32)> = (0..900).map(|i| (number(i), i % 40)).collect();
            let (mut right, mut list) = (any.clone(), any);
            right.sort_unstable();
            sort_groups(&mut list, |entry| entry.0);
            assert_eq!(list, right);
        }
        sort_groups(&mut [], |entry: &u32| *entry);
    }

    #[test]
    fn selection_divides_a_list_at_the_entry_of_a_place() {
        for length in [1, 2, 13, 100, 4097] {
            for most in [1, 3, u64::MAX] {
                let number = |i: u64| (i ^ most).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 7;
                let any: Vec<u64> = (0..length).map(|i| number(i) % most).collect();
                let mut sorted = any.clone();
                sorted.sort_unstable();
                for middle in [0, length / 2, length - 1].map(|at| at as usize) {
                    let mut list = any.clone();
                    select_by(&mut list, middle, u64::cmp);
                    assert_eq!(list[middle], sorted[middle]);
                    assert!(list[..middle].iter().all(|before| *before <= list[middle]));
                    assert!(list[middle..].iter().all(|after| *after >= list[middle]));
                }
            }
        }
    }

    #[test]
    fn lists_of_equal_entries_take_n_log_n_comparisons() {
        let (count, mut comparisons) = (10_000_u32, 0_u64);
        let mut list: Vec<u32> = (0..count).map(|i| i % 2).rev().collect();
        sort_by(&mut list, |a, b| {
            comparisons += 1;
            a.cmp(b)
        });
        assert!(list.is_sorted());
        let most = u64::from(count) * 100;
        assert!(comparisons < most, "{comparisons} comparisons at {count} entries");
    }
}
