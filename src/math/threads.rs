//! The threads that one cloth may use: one, unless Muslin is built with the feature `parallel` and
//! the host allows more.
//!
//! Work is cut only where no sum crosses the cut, so that every number comes about as it does on
//! one thread: the bits are the same. The threads are rayon's, of the pool that the caller is in or
//! else of the global one. What `join` offers to another thread lies on the stack, so nothing is
//! allocated.

/// How many threads may work on a cloth at once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Threads {
    #[cfg(feature = "parallel")]
    most: u32,
    /// Whether even little work is shared out, which does not pay: for tests.
    #[cfg(feature = "parallel")]
    is_eager: bool,
}

impl Threads {
    /// None but the caller's.
    pub const ONE: Self = Self {
        #[cfg(feature = "parallel")]
        most: 1,
        #[cfg(feature = "parallel")]
        is_eager: false,
    };
}

#[cfg(not(feature = "parallel"))]
/// Without the feature all work is one part.
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
        pub fn parallel_for<W: Split>(self, work: W, _least: usize, run: impl Fn(W)) {
            run(work);
        }
    }
}

#[cfg(feature = "parallel")]
#[cfg(feature = "parallel")]
pub(crate) use many::Split;

#[cfg(feature = "parallel")]
mod many {
    use super::Threads;
    use crate::math::float_env::{with_float_env, with_host_float_env};
    use core::ops::Range;

    /// Parts begin at multiples of this, so that no two threads write to one cache line for long.
    const GRAIN: usize = 16;

    /// Twice so many particles are worth leaving the caller's thread for.
    const FEW: usize = 2048;

    /// What can be cut in two.
    pub(crate) trait Split: Sized + Send {
        fn count(&self) -> usize;

        /// The first `mid`, and the others.
        fn cut(self, mid: usize) -> (Self, Self);
    }

    impl Threads {
        /// So many; at least one.
        pub fn up_to(most: u32) -> Self {
            Self { most: most.max(1), is_eager: false }
        }

        /// So many, for however little work.
        pub fn eagerly(most: u32) -> Self {
            Self { is_eager: true, ..Self::up_to(most) }
        }

        pub fn most(self) -> u32 {
            self.most
        }

        /// Into how many parts to cut `count` things, so that each has about `least` of them or
        /// more.
        pub fn parts(self, count: usize, least: usize) -> usize {
            let least = if self.is_eager { GRAIN } else { least };
            (count / least).clamp(1, self.most as usize)
        }

        /// Runs `work` on so many particles as one of the pool's threads, if it may want others:
        /// from outside, each call for help would take longer than most of what there is to do.
        pub fn run_in_pool<T: Send>(self, particles: usize, work: impl FnOnce() -> T + Send) -> T {
            if self.parts(particles, FEW) == 1 || rayon::current_thread_index().is_some() {
                return work();
            }
            rayon::join(work, || ()).0
        }

        /// Runs `run` over all of `work`, in parts of at least `least`.
        #[inline]
        pub fn parallel_for<W: Split>(self, work: W, least: usize, run: impl Fn(W) + Sync) {
            let count = work.count();
            let parts = self.parts(count, least);
            if parts == 1 {
                return run(work);
            }
            let border = |part| count * part / parts / GRAIN * GRAIN;
            with_host_float_env(|| share_out(0..parts, work, &border, &|_, work| run(work)));
        }

        /// Runs `run` over each of so many parts, with its number; `border` is where a part begins.
        pub fn parallel_for_parts<W: Split>(
            self,
            parts: usize,
            work: W,
            border: impl Fn(usize) -> usize + Sync,
            run: impl Fn(usize, W) + Sync,
        ) {
            with_host_float_env(|| share_out(0..parts, work, &border, &run));
        }
    }

    /// Runs a part here, or halves of several parts wherever there is a thread for them.
    fn share_out<W: Split>(
        parts: Range<usize>,
        work: W,
        border: &(impl Fn(usize) -> usize + Sync),
        run: &(impl Fn(usize, W) + Sync),
    ) {
        if parts.len() <= 1 {
            return with_float_env(|| run(parts.start, work));
        }
        let middle = parts.start + parts.len() / 2;
        let (first, second) = work.cut(border(middle) - border(parts.start));
        rayon::join(
            || share_out(parts.start..middle, first, border, run),
            || share_out(middle..parts.end, second, border, run),
        );
    }

    impl<T: Sync> Split for &[T] {
        fn count(&self) -> usize {
            self.len()
        }

        fn cut(self, mid: usize) -> (Self, Self) {
            self.split_at(mid)
        }
    }

    impl<T: Send> Split for &mut [T] {
        fn count(&self) -> usize {
            self.len()
        }

        fn cut(self, mid: usize) -> (Self, Self) {
            self.split_at_mut(mid)
        }
    }

    /// Columns.
    impl<S: Split> Split for [S; 3] {
        fn count(&self) -> usize {
            self[0].count().min(self[1].count()).min(self[2].count())
        }

        fn cut(self, mid: usize) -> (Self, Self) {
            let [(x, x_2), (y, y_2), (z, z_2)] = self.map(|column| column.cut(mid));
            ([x, y, z], [x_2, y_2, z_2])
        }
    }

    /// Lists side by side; as many as there are in the shortest.
    macro_rules! split_all {
        ($($name:ident)*) => {
            impl<$($name: Split),*> Split for ($($name,)*) {
                #[allow(non_snake_case)]
                fn count(&self) -> usize {
                    let ($($name,)*) = self;
                    usize::MAX$(.min($name.count()))*
                }

                #[allow(non_snake_case)]
                fn cut(self, mid: usize) -> (Self, Self) {
                    let ($($name,)*) = self;
                    $(let $name = $name.cut(mid);)*
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
    fn every_part_is_run_once_whatever_the_threads() {
        for most in 1..9 {
            for count in [0, 1, 15, 16, 100, 1000] {
                let (mut seen, marks) = (vec![0; count], vec![1; count]);
                let work = (&mut seen[..], &marks[..]);
                Threads::up_to(most).parallel_for(work, 7, |(seen, marks)| {
                    seen.iter_mut().zip(marks).for_each(|(seen, mark)| *seen += mark);
                });
                assert!(seen.iter().all(|n| *n == 1), "{count} things on {most} threads: {seen:?}");
            }
        }
    }

    #[test]
    fn no_part_is_less_than_the_least() {
        let threads = Threads::up_to(8);
        assert_eq!(threads.parts(0, 10), 1);
        assert_eq!(threads.parts(19, 10), 1);
        assert_eq!(threads.parts(20, 10), 2);
        assert_eq!(threads.parts(1000, 10), 8);
    }
}
