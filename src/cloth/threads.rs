//! How many threads a cloth may use.

use crate::cloth::Cloth;
use crate::error::{Result, check};
use crate::math::threads::Threads;

/// With the feature `parallel`.
impl Cloth {
    /// How many threads its ticks and normals may use; 1 as it is made.
    pub fn threads(&self) -> u32 {
        self.world.threads.most()
    }

    /// Lets ticks and normals use so many threads. The bits are the same for any number, so this is no
    /// part of the state: it stays at [`Cloth::reset`], goes to a clone, and is not saved.
    ///
    /// The threads are those of the [`rayon`] pool that the caller runs in, or else of the global one;
    /// there are no more of them than that has. A cloth is cut into parts only where that pays: a sheet
    /// of fewer than some ten thousand particles stays on one thread. A clock that a host has set
    /// ([`Cloth::set_clock`]) may be asked on any of them.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) for none.
    pub fn set_threads(&mut self, threads: u32) -> Result<()> {
        check(threads >= 1, "threads", "be at least 1")?;
        self.world.threads = Threads::up_to(threads);
        Ok(())
    }

    /// As [`Cloth::set_threads`], but even a small cloth is cut into parts, which does not pay: for tests.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) for none.
    #[doc(hidden)]
    pub fn set_threads_eagerly(&mut self, threads: u32) -> Result<()> {
        self.set_threads(threads)?;
        self.world.threads = Threads::eagerly(threads);
        Ok(())
    }
}
