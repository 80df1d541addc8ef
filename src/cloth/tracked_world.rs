//! A `World` that notes every access that may change it, so that the ticks of a sleeping cloth can
//! be skipped without a look at its pins, grabs and colliders.
//!
//! ```text
//! ticks that slept ─▶ idle ── advance ─▶ only the clock moves
//!                      └───── `DerefMut`, that is any change by the host ─▶ not idle
//! ```
//! Reads and writes `World::clock`.
//! Invariant: while the clock is idle, a tick would change nothing but the clock.

#[cfg(feature = "parallel")]
use crate::math::threads::Threads;
use crate::solver::world::World;
use core::mem::ManuallyDrop;
use core::ops::{Deref, DerefMut};

/// The world of a cloth. Mutable access ends the idle state of its clock.
#[derive(Clone, Debug)]
pub(crate) struct TrackedWorld(ManuallyDrop<World>);

impl TrackedWorld {
    pub fn new(world: World) -> Self {
        Self(ManuallyDrop::new(world))
    }

    /// Advances only the clock, which must be idle, by `seconds` [s], and returns the number of
    /// ticks.
    #[inline]
    pub fn advance_idle(&mut self, seconds: f32) -> u32 {
        self.0.clock.advance_idle(seconds)
    }

    /// Advances only the clock, which must be idle, by `ticks` ticks.
    pub fn step_idle(&mut self, ticks: u32) {
        self.0.clock.step_idle(ticks);
    }

    /// Makes the clock idle after ticks that the cloth slept through, until the next change.
    ///
    /// Does nothing while the host measures stages, because each call then resets their times.
    pub fn begin_idle(&mut self) {
        let world = &mut *self.0;
        if world.profile.clock().is_none() {
            world.clock.begin_idle(&world.settings);
        }
    }

    /// Sets the threads that a tick may use, and returns the previous ones. They change no result,
    /// so an idle clock stays idle.
    #[cfg(feature = "parallel")]
    pub fn replace_threads(&mut self, threads: Threads) -> Threads {
        core::mem::replace(&mut self.0.threads, threads)
    }
}

impl Drop for TrackedWorld {
    /// Out of line, so that a crate that drops a cloth has no copy of the code that frees its lists.
    #[inline(never)]
    fn drop(&mut self) {
        // SAFETY: nothing uses the world afterwards.
        unsafe { ManuallyDrop::drop(&mut self.0) }
    }
}

impl Deref for TrackedWorld {
    type Target = World;

    fn deref(&self) -> &World {
        &self.0
    }
}

impl DerefMut for TrackedWorld {
    fn deref_mut(&mut self) -> &mut World {
        self.0.clock.is_idle = false;
        &mut self.0
    }
}
