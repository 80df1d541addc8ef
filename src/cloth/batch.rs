//! Public calls for many cloths: copies of one, and one call that advances them all.
//!
//! ```text
//! advance_many   cloth 0   cloth 1   cloth 2 …      each by `advance`, in one part per thread
//! ```
//! Reads and writes each cloth alone; cloths share nothing.
//! Invariant: a cloth gets the bits of its own `advance`, for any order and any number of threads.

use crate::cloth::Cloth;
use crate::error::Result;
use crate::math::float_env::with_float_env;
use core::borrow::BorrowMut;

impl Cloth {
    /// Returns an independent cloth in the same state; the same as `clone`.
    ///
    /// Both continue with the same bits as long as they get the same calls. Handles of grabs,
    /// attachments and colliders are valid for both. Skins stay with the first cloth.
    ///
    /// ```
    /// use muslin::{Cloth, GridDesc};
    ///
    /// let mut cloth = Cloth::grid(&GridDesc::default())?;
    /// cloth.step(10);
    /// let mut copy = cloth.duplicate();
    /// cloth.step(1);
    /// copy.step(1);
    /// assert_eq!(copy.state_hash(), cloth.state_hash());
    /// # Ok::<(), muslin::Error>(())
    /// ```
    #[must_use]
    pub fn duplicate(&self) -> Self {
        self.clone()
    }

    /// Advances many cloths by `seconds` [s] of frame time, each as [`Cloth::advance`] does, and
    /// returns how many ticks each of them ran.
    ///
    /// Every cloth gets the bits that its own `advance` would give. `cloths` may hold cloths or
    /// mutable references to cloths. A cloth that sleeps costs next to nothing.
    ///
    /// With the feature `parallel`, the cloths are spread over the threads of the [`rayon`] pool
    /// that the caller runs in, or else of the global pool, and each cloth is advanced on one
    /// thread, whatever its [`threads`](Cloth::threads); a single cloth uses its own threads.
    ///
    /// [`rayon`]: https://docs.rs/rayon
    ///
    /// ```
    /// use muslin::{Cloth, GridDesc};
    ///
    /// let flag = Cloth::grid(&GridDesc { columns: 16, rows: 16, ..GridDesc::default() })?;
    /// let mut flags = vec![flag; 10];
    /// assert_eq!(Cloth::advance_many(&mut flags, 1.0 / 60.0)?, [1; 10]);
    /// # Ok::<(), muslin::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BadValue`](crate::Error::BadValue) if `seconds` is negative or not finite. The
    /// cloths are unchanged.
    pub fn advance_many<C>(cloths: &mut [C], seconds: f32) -> Result<Vec<u32>>
    where
        C: BorrowMut<Self> + Send,
    {
        Self::check_seconds(seconds)?;
        let mut ticks = vec![0; cloths.len()];
        if let [cloth] = cloths {
            ticks[0] = cloth.borrow_mut().run_due_ticks(seconds);
        } else {
            advance_each(cloths, &mut ticks, seconds);
        }
        Ok(ticks)
    }
}

/// The largest number of cloths that are advanced together: enough that the cache misses of the
/// clocks of sleeping ones overlap.
const MAX_BLOCK: usize = 16;

#[cfg(not(feature = "parallel"))]
fn advance_each<C: BorrowMut<Cloth>>(cloths: &mut [C], ticks: &mut [u32], seconds: f32) {
    for (cloths, ticks) in cloths.chunks_mut(MAX_BLOCK).zip(ticks.chunks_mut(MAX_BLOCK)) {
        advance_block(cloths, ticks, |cloth| cloth.run_due_ticks(seconds), seconds);
    }
}

/// Advances each cloth on one thread; a thread that has finished its blocks takes some of another.
#[cfg(feature = "parallel")]
fn advance_each<C: BorrowMut<Cloth> + Send>(cloths: &mut [C], ticks: &mut [u32], seconds: f32) {
    use crate::math::threads::Threads;
    use rayon::prelude::*;

    let advance = |cloth: &mut Cloth| {
        let threads = cloth.world.replace_threads(Threads::ONE);
        let ticks = cloth.run_due_ticks(seconds);
        cloth.world.replace_threads(threads);
        ticks
    };
    // Several blocks per thread, so that the threads end at about the same time.
    let block = (cloths.len() / (8 * rayon::current_num_threads())).clamp(1, MAX_BLOCK);
    let blocks = cloths.par_chunks_mut(block).zip(ticks.par_chunks_mut(block));
    blocks.for_each(|(cloths, ticks)| advance_block(cloths, ticks, advance, seconds));
}

/// Advances the cloths of a block: if all of them are idle, only their clocks, else each by
/// `advance`.
fn advance_block<C: BorrowMut<Cloth>>(
    cloths: &mut [C],
    ticks: &mut [u32],
    advance: impl Fn(&mut Cloth) -> u32,
    seconds: f32,
) {
    // Without short circuit: the loads do not wait for each other.
    let all_idle = cloths.iter().fold(true, |all, cloth| all & cloth.borrow().world.clock.is_idle);
    if all_idle {
        with_float_env(|| {
            for (cloth, ticks) in cloths.iter_mut().zip(ticks) {
                *ticks = cloth.borrow_mut().world.advance_idle(seconds);
            }
        });
        return;
    }
    for (cloth, ticks) in cloths.iter_mut().zip(ticks) {
        *ticks = advance(cloth.borrow_mut());
    }
}
