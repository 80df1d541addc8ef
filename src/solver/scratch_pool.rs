//! Scratch buffers of a thread, lent to the cloth that it steps.
//!
//! ```text
//! pool of the thread ──lend──▶ World::scratch   ticks   ──take_back──▶ pool of the thread
//! ```
//! Method: one set of buffers per thread, as large as the largest cloth that the thread has made or
//! stepped needs. A cloth that is stepped while another one has the buffers (inside a fork–join of that
//! one) gets new ones. After a panic in a tick the cloth keeps its buffers, and the next one gets new
//! ones.
//!
//! Reads the sizes of `World`; exchanges the lists of `World::scratch`.
//! Invariant: results do not depend on who had the buffers before. A cloth that had them last finds
//! them as it left them; any other finds them empty or zero, as a restored cloth does.

use crate::solver::tick_scratch::{ScratchOwner, TickScratch};
use crate::solver::world::World;
use core::cell::Cell;

thread_local! {
    static POOL: Cell<Option<Box<TickScratch>>> = const { Cell::new(None) };
}

/// Runs `work` with the buffers of this thread.
pub(crate) fn with_lent<T>(world: &mut World, work: impl FnOnce(&mut World) -> T) -> T {
    let rest = lend(world);
    let result = work(world);
    take_back(world, rest);
    result
}

/// Allocates the buffers of this thread for `world`, which needs others than before.
pub(crate) fn reserve(world: &mut World) {
    world.scratch.owner = ScratchOwner::default();
    let rest = lend(world);
    take_back(world, rest);
}

/// Gives `world` the buffers of this thread, as large as it needs them. Returns the rest of the pool.
#[inline(never)]
fn lend(world: &mut World) -> Box<TickScratch> {
    let mut pool =
        POOL.try_with(Cell::take).ok().flatten().unwrap_or_else(|| Box::new(TickScratch::empty()));
    world.scratch.swap_lent(&mut pool);
    world.scratch.owner.lengths = [world.particles.len(), world.constraints.dynamic.capacity()];
    if pool.owner != world.scratch.owner {
        pool.owner = world.scratch.owner;
        world.scratch.clear_lent();
        world.reserve_lent();
    }
    pool
}

#[inline(never)]
fn take_back(world: &mut World, mut pool: Box<TickScratch>) {
    world.scratch.swap_lent(&mut pool);
    // A thread that ends may have no pool any more.
    let _ = POOL.try_with(|at| at.set(Some(pool)));
}

impl World {
    /// Allocates the lent buffers. Those that have one entry per particle get that length.
    #[inline(never)]
    fn reserve_lent(&mut self) {
        let (count, particles) = (self.particles.len(), self.allocated_particles());
        let has_bodies = self.colliders.iter().next().is_some();
        let scratch = &mut self.scratch;
        let used = [self.settings.max_stretch > 0.0, has_bodies];
        scratch.reserve_columns(count, particles, used);
        if self.constraints.rows.is_none() {
            scratch.interleaved.reserve(particles);
        }
        scratch.lines.reserve(scratch.line_lengths);
        let links = [&self.constraints.links, &self.constraints.dynamic];
        for (lambda, links) in scratch.lambda.iter_mut().zip(links) {
            lambda.reserve(links.capacity());
        }
        if let Some(plates) = &self.plate_elements {
            scratch.bend.plates.resize_lent(plates);
        }
        if has_bodies {
            self.reserve_lent_contacts();
        }
    }
}
