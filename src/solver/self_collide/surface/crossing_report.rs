//! Reports edges of the cloth that pass through triangles of it when a tick ends.
//!
//! Reads the intersections that the last substep found at its start; writes `violations` and an
//! event. Invariant: the cloth does not move.

use crate::solver::self_collide::surface::untangle::SurfaceIntersections;
use crate::solver::world::World;
use crate::state::events::EventKind;

/// Counts the crossing edges, and reports them by one event.
pub(crate) fn report(world: &mut World) {
    let found = world.scratch.surface_collision.as_ref().map(|surface| &surface.intersections);
    let count = found.map_or(0, SurfaceIntersections::len) as u32;
    let first = found.and_then(SurfaceIntersections::first_edge);
    if let (true, Some([a, b])) = (world.violations.crossings.update(count), first) {
        push_event(world, a, b);
    }
}

#[inline(never)]
fn push_event(world: &mut World, a: u32, b: u32) {
    let x = &world.particles.x;
    let middle = (x.get(a as usize) + x.get(b as usize)) * 0.5;
    let mut event = world.event_at(EventKind::LayersCross, middle);
    (event.particle_a, event.particle_b) = (a, b);
    event.count = world.violations.crossings.count;
    world.events.push(event);
}
