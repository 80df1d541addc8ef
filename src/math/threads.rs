//! Multithreading of one tick: how many threads may work on a cloth, and data-parallel loops.
//!
//! A tick runs on one thread, unless Muslin is built with the feature `parallel` and the host
//! allows more. Work is split recursively in two (fork–join) with rayon's `join`, in the pool of
//! the calling thread or else in the global pool. `join` keeps its job on the stack, so nothing is
//! allocated.
//!
//! Reads and writes the slices that callers pass in; parts of them are disjoint.
//! Invariant: work is split only where no sum crosses the border of two parts, so results have the
//! same bits for every number of threads.

/// How many threads may work on a cloth at the same time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Threads {
    #[cfg(feature = "parallel")]
    max: u32,
    /// Whether even little work is split, which is slower: for tests.
    #[cfg(feature = "parallel")]
    is_eager: bool,
}

impl Threads {
    /// Only the calling thread.
    pub const ONE: Self = Self {
        #[cfg(feature = "parallel")]
        max: 1,
        #[cfg(feature = "parallel")]
        is_eager: false,
    };
}

/// Without the feature, all work runs in one part on the calling thread.
#[cfg(not(feature = "parallel"))]
mod one {
    use super::Threads;

    pub(crate) trait Split {}

    impl<W> Split for W {}

    impl Threads {
        #[inline(always)]
        pub fn run_in_pool<T>(self, _particles: usize, work: impl FnOnce() -> T) -> T {
            work()
        }

        #[inline(always)]
        pub fn parallel_for<W: Split>(self, work: W, _min_items: usize, run: impl Fn(W)) {
            run(work);
        }
    }
}

#[cfg(feature = "parallel")]
pub(crate) use many::Split;

#[cfg(feature = "parallel")]
mod many {
    use super::Threads;
    use crate::math::float_env::{with_float_env, with_host_float_env};
    use core::ops::Range;

    /// Parts begin at multiples of this many items, so that two threads rarely write to one cache
    /// line.
    const GRAIN: usize = 16;

    /// With at least twice this many particles, it pays to move a tick to a thread of the pool.
    const MIN_PARTICLES: usize = 2048;

    /// Work that can be split in two: slices, and tuples and arrays of them.
    pub(crate) trait Split: Sized + Send {
        /// Returns the number of items.
        fn count(&self) -> usize;

        /// Splits into the first `mid` items and the rest.
        fn split_at_item(self, mid: usize) -> (Self, Self);
    }

    impl Threads {
        /// At most `max` threads; 0 counts as 1.
        pub fn up_to(max: u32) -> Self {
            Self { max: max.max(1), is_eager: false }
        }

        /// At most `max` threads; splits even little work among all of them.
        pub fn eagerly(max: u32) -> Self {
            Self { is_eager: true, ..Self::up_to(max) }
        }

        /// Returns the largest number of threads.
        pub fn max(self) -> u32 {
            self.max
        }

        /// Returns into how many parts to split `count` items, so that each has about `min_items`
        /// or more.
        pub fn parts(self, count: usize, min_items: usize) -> usize {
            let min_items = if self.is_eager { GRAIN } else { min_items };
            (count / min_items).clamp(1, self.max as usize)
        }

        /// Runs `work` on a thread of the pool if it may be split at all, else on the calling
        /// thread. A `join` from outside the pool takes longer than most loops of a tick.
        pub fn run_in_pool<T: Send>(self, particles: usize, work: impl FnOnce() -> T + Send) -> T {
            if self.parts(particles, MIN_PARTICLES) == 1 || rayon::current_thread_index().is_some()
            {
                return work();
            }
            rayon::join(work, || ()).0
        }

        /// Runs `run` on parts of `work` that have at least about `min_items` items each, in
        /// parallel.
        #[inline]
        pub fn parallel_for<W: Split>(self, work: W, min_items: usize, run: impl Fn(W) + Sync) {
            let count = work.count();
            let parts = self.parts(count, min_items);
            if parts == 1 {
                return run(work);
            }
            let border = |part| count * part / parts / GRAIN * GRAIN;
            with_host_float_env(|| fork_join(0..parts, work, &border, &|_, work| run(work)));
        }

        /// Runs `run` on each of `parts` parts with its index, in parallel. `border` gives the
        /// first item of a part.
        pub fn parallel_for_parts<W: Split>(
            self,
            parts: usize,
            work: W,
            border: impl Fn(usize) -> usize + Sync,
            run: impl Fn(usize, W) + Sync,
        ) {
            with_host_float_env(|| fork_join(0..parts, work, &border, &run));
        }
    }

    /// Runs one part on this thread, or splits several parts in two halves that any thread may run.
    fn fork_join<W: Split>(
        parts: Range<usize>,
        work: W,
        border: &(impl Fn(usize) -> usize + Sync),
        run: &(impl Fn(usize, W) + Sync),
    ) {
        if parts.len() <= 1 {
            return with_float_env(|| run(parts.start, work));
        }
        let middle = parts.start + parts.len() / 2;
        let (first, second) = work.split_at_item(border(middle) - border(parts.start));
        rayon::join(
            || fork_join(parts.start..middle, first, border, run),
            || fork_join(middle..parts.end, second, border, run),
        );
    }

    impl<T: Sync> Split for &[T] {
        fn count(&self) -> usize {
            self.len()
        }

        fn split_at_item(self, mid: usize) -> (Self, Self) {
            self.split_at(mid)
        }
    }

    impl<T: Send> Split for &mut [T] {
        fn count(&self) -> usize {
            self.len()
        }

        fn split_at_item(self, mid: usize) -> (Self, Self) {
            self.split_at_mut(mid)
        }
    }

    /// The three columns of vectors.
    impl<S: Split> Split for [S; 3] {
        fn count(&self) -> usize {
            self[0].count().min(self[1].count()).min(self[2].count())
        }

        fn split_at_item(self, mid: usize) -> (Self, Self) {
            let [(x, x_2), (y, y_2), (z, z_2)] = self.map(|column| column.split_at_item(mid));
            ([x, y, z], [x_2, y_2, z_2])
        }
    }

    /// Parallel lists; the shortest determines the number of items.
    macro_rules! split_all {
        ($($name:ident)*) => {
            impl<$($name: Split),*> Split for ($($name,)*) {
                #[allow(non_snake_case)]
                fn count(&self) -> usize {
                    let ($($name,)*) = self;
                    usize::MAX$(.min($name.count()))*
                }

                #[allow(non_snake_case)]
                fn split_at_item(self, mid: usize) -> (Self, Self) {
                    let ($($name,)*) = self;
                    $(let $name = $name.split_at_item(mid);)*
                    (($($name.0,)*), ($($name.1,)*))
                }
            }
        };
    }

    split_all!(A B);
    split_all!(A B C);
    split_all!(A B C D);
    split_all!(A B C D E);
}

#[cfg(all(test, feature = "parallel"))]
mod tests {
    use super::*;

    #[test]
    fn every_item_runs_exactly_once_with_any_number_of_threads() {
        for max in 1..9 {
            for count in [0, 1, 15, 16, 100, 1000] {
                let (mut seen, marks) = (vec![0; count], vec![1; count]);
                let work = (&mut seen[..], &marks[..]);
                Threads::up_to(max).parallel_for(work, 7, |(seen, marks)| {
                    seen.iter_mut().zip(marks).for_each(|(seen, mark)| *seen += mark);
                });
                assert!(seen.iter().all(|n| *n == 1), "{count} items on {max} threads: {seen:?}");
            }
        }
    }

    #[test]
    fn parts_have_at_least_the_minimum_of_items() {
        let threads = Threads::up_to(8);
        assert_eq!(threads.parts(0, 10), 1);
        assert_eq!(threads.parts(19, 10), 1);
        assert_eq!(threads.parts(20, 10), 2);
        assert_eq!(threads.parts(1000, 10), 8);
    }
}
