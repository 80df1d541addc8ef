//! Stage `Hold`, once more: leashes keep their particles near where animation has them.
//!
//! They come last of all, for what they promise holds whatever else pulls or pushes: a particle is never
//! farther from its anchor than it may be, nor in its backstop. What is pinned or grabbed is not on a leash.

use crate::solver::world::World;
use crate::state::anchors::AnchorConstraint;

/// Keeps all that leashes hold where it may be, as the anchors are after substep `number`.
pub(crate) fn keep(world: &mut World, number: u32) {
    if world.anchors.is_empty() {
        return;
    }
    let share = (number + 1) as f32 / world.settings.substeps as f32;
    world.scratch.anchor_moved.clear();
    pull(world, share, |pulled, leash| pulled.push(leash.particle));
}

/// Once more at the end of a tick, after other stages moved particles.
pub(crate) fn keep_in(world: &mut World) {
    world.scratch.anchor_moved.clear();
    pull(world, 1.0, |pulled, leash| pulled.push(leash.particle));
}

fn pull(world: &mut World, share: f32, tell: impl Fn(&mut Vec<u32>, &AnchorConstraint)) {
    let p = &mut world.particles;
    for leash in world.anchors.iter() {
        let at = leash.particle as usize;
        let x = p.x.at(at);
        let kept = leash.keep(x, share);
        if kept != x && p.w[at] > 0.0 {
            p.x.set(at, kept);
            tell(&mut world.scratch.anchor_moved, leash);
        }
    }
}

/// What was pulled in this substep begins a new history: the second-order scheme must not look back across
/// it, or it would throw the particle back.
pub(crate) fn settle(world: &mut World, keep: f32) {
    if world.anchors.is_empty() {
        return;
    }
    let h = world.settings.scheme().h;
    let (p, scratch) = (&mut world.particles, &world.scratch);
    for i in scratch.anchor_moved.iter().map(|i| *i as usize) {
        let step = scratch.displacement.at(i) + (p.x.at(i) - scratch.predicted.at(i));
        let v = step * (keep / h);
        p.v.set(i, v);
        p.v_ahead.set(i, v);
        p.moved.set(i, step * keep);
    }
}

impl World {
    /// Sees to room for leashes, if there are any.
    pub fn reserve_anchor_scratch(&mut self) {
        let capacity = self.capacity();
        self.anchors.reserve(capacity);
        if !self.anchors.is_empty() {
            let pulled = &mut self.scratch.anchor_moved;
            pulled.reserve_exact(capacity.saturating_sub(pulled.len()));
        }
    }
}
