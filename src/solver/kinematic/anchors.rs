//! Stage `Hold`, anchors: max distance and backstop constraints to animated positions.
//!
//! ```text
//!    ╭───────────╮      outer sphere: |x − anchor| <= max_distance
//!    │     ● anchor     backstop: |x − center| >= backstop_radius,
//!    │   ╭───╮   │        center = anchor − normal (backstop_distance + backstop_radius)
//!    ╰───┤   ├───╯
//!        ╰───╯
//! ```
//! Method: projection onto the nearest valid position (`AnchorConstraint::project`), one pass,
//! because each anchor constrains one particle only.
//!
//! Reads anchors and inverse masses; writes positions, and the list `scratch.anchor_moved`.
//! Invariant: this runs after all other constraints of a substep, so the bound of an anchor holds
//! whatever else pulls at the particle. Pinned and grabbed particles ignore their anchors.

use crate::math::reserve::ReserveTotal;
use crate::solver::world::World;

/// Projects all anchor constraints, with the anchors where they are after substep `number`.
pub(crate) fn project(world: &mut World, number: u32) {
    if world.anchors.is_empty() {
        return;
    }
    let share = (number + 1) as f32 / world.substeps as f32;
    project_at(world, share);
}

/// Projects all anchor constraints with the anchors where they are at the end of the tick.
pub(crate) fn project_at_end(world: &mut World) {
    project_at(world, 1.0);
}

fn project_at(world: &mut World, share: f32) {
    let (p, moved) = (&mut world.particles, &mut world.scratch.anchor_moved);
    moved.clear();
    for anchor in world.anchors.iter() {
        let at = anchor.particle as usize;
        let x = p.x.get(at);
        let valid = anchor.project(x, share);
        if valid != x && p.w[at] > 0.0 {
            p.x.set(at, valid);
            moved.push(anchor.particle);
        }
    }
}

/// Resets the history of the particles that anchors moved in this substep, with velocities scaled
/// by `decay`.
///
/// The second-order scheme must not extrapolate over the correction; it would throw the particle
/// back.
pub(crate) fn reset_history(world: &mut World, decay: f32) {
    if world.anchors.is_empty() {
        return;
    }
    let h = world.regular_scheme().h;
    let (p, scratch) = (&mut world.particles, &world.scratch);
    for i in scratch.anchor_moved.iter().map(|i| *i as usize) {
        let step = scratch.displacement.get(i) + (p.x.get(i) - scratch.predicted.get(i));
        let v = step * (decay / h);
        p.v.set(i, v);
        p.v_extrapolated.set(i, v);
        p.displacement.set(i, step * decay);
    }
}

impl World {
    /// Reserves the buffers of the anchor constraints, if there are any.
    pub fn reserve_anchor_scratch(&mut self) {
        let capacity = self.allocated_particles();
        self.anchors.reserve(capacity);
        if !self.anchors.is_empty() {
            let moved = &mut self.scratch.anchor_moved;
            moved.reserve_total(capacity);
        }
    }
}
