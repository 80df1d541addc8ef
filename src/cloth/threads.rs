//! Public calls for threads (feature `parallel`).
//!
//! Reads and writes `World::threads` only.
//! Invariant: the number of threads never changes a bit of the result.

use crate::cloth::Cloth;
use crate::error::{Result, check};
use crate::math::threads::Threads;

/// With the feature `parallel`.
impl Cloth {
    /// Returns the largest number of threads that ticks and normals may use. Default 1.
    pub fn threads(&self) -> u32 {
        self.world.threads.max()
    }

    /// Sets the largest number of threads that ticks and normals may use.
    ///
    /// The result has the same bits for any number, so this is not part of the state:
    /// [`Cloth::reset`] keeps it, a clone copies it, and a save does not contain it.
    ///
    /// The threads are those of the [`rayon`] pool that the caller runs in, or else of the global
    /// pool; the cloth never uses more than that pool has. Work is divided only where that pays: a
    /// sheet of fewer than about ten thousand particles stays on one thread. A clock
    /// ([`Cloth::set_clock`]) may be called on any of the threads.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) if `threads` is 0.
    pub fn set_threads(&mut self, threads: u32) -> Result<()> {
        check(threads >= 1, "threads", "be at least 1")?;
        self.world.threads = Threads::up_to(threads);
        Ok(())
    }

    /// Like [`Cloth::set_threads`], but divides small cloths too, which does not pay. For tests.
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) if `threads` is 0.
    #[doc(hidden)]
    pub fn set_threads_eagerly(&mut self, threads: u32) -> Result<()> {
        self.set_threads(threads)?;
        self.world.threads = Threads::eagerly(threads);
        Ok(())
    }
}
